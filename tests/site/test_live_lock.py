"""The live book's lock and wheels: what a browser loads is there, and is what Pyodide published."""

import hashlib
import io
import json
import os
import re
import shutil
import tarfile
import zipfile
from base64 import b64encode, urlsafe_b64encode
from pathlib import Path

import pytest

from live.brought import OFFICIAL, RUNTIME, bring_runtime, digest_of
from live.lite import settings, with_links, write_contents
from live.lock import check, entry_of, needed, requirements
from live.make import make_live, reason_not
from live.own_wheels import figures_wheel
from live.versions import ROOT, VERSIONS, older, pin, wheel_pins
from unfinished import Unfinished

CDN = VERSIONS["pyodide"]["distribution"]
DIGESTS = VERSIONS["pyodide"]["sha256"]
KEPT = ROOT / "build/site/live"


def wheel(folder, name="one", version="1.0", needs=()):
    """A wheel of one module."""
    path = folder / f"{name}-{version}-py3-none-any.whl"
    lines = ["Metadata-Version: 2.1", f"Name: {name}", f"Version: {version}"]
    with zipfile.ZipFile(path, "w") as files:
        files.writestr(f"{name}/__init__.py", "")
        text = "\n".join([*lines, *(f"Requires-Dist: {need}" for need in needs)])
        files.writestr(f"{name}-{version}.dist-info/METADATA", text)
    return path


@pytest.fixture(scope="module")
def distribution() -> Path:
    """Folder with the distribution's files."""
    folder = os.environ.get("DRIFTLAB_PYODIDE")
    if not folder:
        pytest.skip("DRIFTLAB_PYODIDE names no folder with Pyodide's distribution")
    return Path(folder)


@pytest.fixture(scope="module")
def official() -> dict:
    """The lock that Pyodide publishes, which came with the runtime."""
    path = KEPT / "runtime" / OFFICIAL
    if not path.exists():
        pytest.skip("Pyodide's runtime was not brought; 'python3 lab.py site' brings it")
    assert digest_of(path) == DIGESTS[OFFICIAL]
    return json.loads(path.read_text("utf-8"))["packages"]


@pytest.fixture
def folder(site) -> Path:
    """What a browser loads, on the site as built."""
    return site / "live/static/pyodide"


@pytest.fixture
def lock(folder) -> dict:
    return json.loads((folder / OFFICIAL).read_text("utf-8"))["packages"]


# ------------------------------------------------------------------ without a built site


def test_the_packages_of_the_book_are_pinned_once_with_their_digests():
    assert pin("ipywidgets").version == "8.1.8"
    for each in [*wheel_pins(), older()]:
        assert each.sha256, each.name
    names = [each.name for each in wheel_pins()]
    assert len(set(names)) == len(names)
    with pytest.raises(LookupError, match=r"^no-such is pinned neither in environment\.txt nor"):
        pin("no-such")


def test_a_lock_keeps_what_is_needed_and_what_that_depends_on():
    packages = {
        "a": {"depends": ["B_b"]},
        "b-b": {"depends": ["c"]},
        "c": {"depends": []},
        "d": {"depends": []},
    }
    assert list(needed({"packages": packages}, ["A"])) == ["a", "b-b", "c"]


def test_a_wheel_tells_what_it_needs_in_a_browser(tmp_path):
    needs = [
        'Tool_a>=1; sys_platform == "emscripten"',
        'tool-b; sys_platform == "win32"',
        'tool-c; extra == "more"',
        'tool-d; python_version >= "3.13"',
    ]
    path = wheel(tmp_path, needs=needs)
    assert [need.name for need in requirements(path)] == ["Tool_a"]
    entry = entry_of(path)
    assert (entry["name"], entry["version"], entry["depends"]) == ("one", "1.0", ["tool-a"])
    assert entry["imports"] == ["one"]
    assert entry["sha256"] == hashlib.sha256(path.read_bytes()).hexdigest()


def test_a_lock_that_lacks_something_is_refused(tmp_path):
    path = wheel(tmp_path, needs=["two>=2"])
    packages = {"one": entry_of(path)}
    with pytest.raises(Unfinished, match=r"needs two>=2, which is not there"):
        check(packages, [path])
    packages["two"] = {"version": "1.0", "depends": ["three"]}
    with pytest.raises(Unfinished) as trouble:
        check(packages, [path])
    assert "two needs three, which is not there" in str(trouble.value)
    assert "needs two>=2, which is there in version 1.0" in str(trouble.value)
    packages["two"] = {"version": "2.0", "depends": []}
    check(packages, [path])


def test_links_out_of_the_book_lead_to_the_site():
    text = "[a](../ERRATA.md) [b](../figures/README.md#x) ![c](../figures/p.svg) [d](03_x.ipynb)"
    assert with_links(text) == (
        "[a](#site/errata.html) [b](#site/gallery/index.html) ![c](figures/p.svg) [d](03_x.ipynb)"
    )


def test_every_notebook_is_live_and_links_to_what_is_there(tmp_path):
    write_contents(tmp_path)
    book = ROOT / "notebooks"
    names = {
        path.relative_to(book) for path in book.rglob("*.ipynb") if "." not in path.parent.name
    }
    assert {path.relative_to(tmp_path) for path in tmp_path.rglob("*.ipynb")} == names
    for name in names:
        notebook = json.loads((tmp_path / name).read_text("utf-8"))
        text = "".join(
            "".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "markdown"
        )
        for link in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", text):
            assert ((tmp_path / name).parent / link).exists(), (name, link)


def test_work_is_kept_under_the_version_and_nothing_is_asked_of_a_registry():
    data = settings("Drift Lab 9.9")["jupyter-config-data"]
    assert data["contentsStorageName"] == "Drift Lab 9.9"
    (kernel,) = data["litePluginSettings"].values()
    assert kernel["disablePyPIFallback"] is True
    assert kernel["pyodideUrl"].startswith("./")


def test_figures_that_no_browser_computes_travel_as_numbers(tmp_path):
    with zipfile.ZipFile(figures_wheel(tmp_path, "3.12")) as files:
        names = [name for name in files.namelist() if name.endswith(".csv")]
        assert any(name.endswith("lib/python3.12/figures/13-five-units.csv") for name in names)
        assert files.testzip() is None


def test_the_list_of_fonts_is_that_of_the_matplotlib_it_is_for(distribution):
    ours = json.loads((ROOT / "site/live/fontlist.json").read_text("utf-8"))
    (path,) = distribution.glob("matplotlib-3*.whl")
    with zipfile.ZipFile(path) as files:
        names = set(files.namelist())
        source = files.read("matplotlib/font_manager.py").decode()
        theirs = json.loads(files.read("matplotlib/fontlist.json"))
    assert f"__version__ = {ours['_version']}\n" in source
    for kind in ("ttflist", "afmlist"):
        own = [entry for entry in theirs[kind] if not entry["fname"].startswith("/")]
        assert sorted(own, key=lambda entry: entry["fname"]) == ours[kind]
        assert {f"matplotlib/mpl-data/{entry['fname']}" for entry in own} <= names


def test_the_size_that_readers_are_told_is_that_of_the_files(distribution, official):
    files = [each["file_name"] for each in needed({"packages": official}, wanted()).values()]
    size = sum((distribution / name).stat().st_size for name in files)
    assert VERSIONS["pyodide"]["megabytes"] == round(size / 1e6)


def wanted():
    return VERSIONS["wheels"]["distribution"]


# ------------------------------------------------------------------ bad surroundings


def program(folder, name, text):
    """A program of a folder, which a shell runs."""
    path = folder / name
    path.write_text(f"#!/bin/sh\n{text}\n", "utf-8")
    path.chmod(0o755)


def npm_brings(programs, packed):
    """An npm that brings some bytes."""
    (programs / "packed.tgz").write_bytes(packed)
    lines = [
        "for last; do :; done",
        f'{shutil.which("cp", path="/usr/bin:/bin")} "{programs}/packed.tgz" "$last/packed.tgz"',
        'echo \'[{"filename": "packed.tgz"}]\'',
    ]
    program(programs, "npm", "\n".join(lines))


@pytest.fixture
def programs(tmp_path, monkeypatch) -> Path:
    """The folder that programs are looked for in, and no other; empty."""
    if os.name == "nt":
        pytest.skip("the stand-ins are scripts of a shell")
    folder = tmp_path / "programs"
    folder.mkdir()
    monkeypatch.setenv("PATH", str(folder))
    return folder


def test_without_node_a_sentence_says_so(programs, tmp_path):
    assert reason_not(tmp_path) == (
        "The book is not made live: that needs Node.js, which is not installed."
    )


def test_an_old_node_is_named(programs, tmp_path):
    program(programs, "node", "echo v12.1.0")
    assert reason_not(tmp_path).endswith("needs Node.js 18; this is v12.1.0.")


def test_without_npm_or_its_network_a_sentence_says_so(programs, tmp_path):
    program(programs, "node", "echo v20.0.0")
    begin = "The book is not made live: npm does not bring pyodide@"
    assert reason_not(tmp_path).startswith(begin)
    program(programs, "npm", "echo no network >&2; exit 1")
    assert reason_not(tmp_path).startswith(begin)
    assert reason_not(tmp_path).endswith("no network")


def test_other_contents_than_those_published_are_refused(programs, tmp_path):
    npm_brings(programs, b"other")
    with pytest.raises(Unfinished, match=r"other contents than versions\.toml says"):
        bring_runtime(tmp_path / "runtime")
    assert not (tmp_path / "runtime").exists()


def test_an_npm_that_does_not_say_what_it_brought_is_told_in_a_sentence(programs, tmp_path):
    for said in ("npm notice", "[]", "{}", "null"):
        program(programs, "npm", f"echo '{said}'")
        with pytest.raises(Unfinished, match=r"^npm does not say which file it brought for"):
            bring_runtime(tmp_path / "runtime")


@pytest.fixture
def package(programs, monkeypatch) -> dict[str, bytes]:
    """Small files in place of the runtime's, as npm brings them and versions.toml has them."""
    files = {name: name.encode() for name in DIGESTS}
    packed = io.BytesIO()
    with tarfile.open(fileobj=packed, mode="w:gz") as archive:
        for name, data in files.items():
            entry = tarfile.TarInfo(f"package/{name}")
            entry.size = len(data)
            archive.addfile(entry, io.BytesIO(data))
    npm_brings(programs, packed.getvalue())
    integrity = b64encode(hashlib.sha512(packed.getvalue()).digest()).decode()
    digests = {name: hashlib.sha256(data).hexdigest() for name, data in files.items()}
    monkeypatch.setitem(VERSIONS["pyodide"], "integrity", f"sha512-{integrity}")
    monkeypatch.setitem(VERSIONS["pyodide"], "sha256", digests)
    return files


def there(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_a_runtime_that_is_kept_whole_is_not_brought_again(package, programs, tmp_path):
    folder = tmp_path / "kept/runtime"
    bring_runtime(folder)
    assert there(folder) == package
    assert list(folder.parent.iterdir()) == [folder], "nothing is left beside it"
    program(programs, "npm", "exit 1")
    bring_runtime(folder)


@pytest.mark.parametrize("name", DIGESTS)
@pytest.mark.parametrize("spoilt", ["missing", "changed"])
def test_a_runtime_that_is_not_whole_is_brought_anew(spoilt, name, package, programs, tmp_path):
    folder = tmp_path / "kept/runtime"
    bring_runtime(folder)
    (folder / name).unlink()
    if spoilt == "changed":
        (folder / name).write_bytes(b"other")
    bring_runtime(folder)
    assert there(folder) == package
    assert list(folder.parent.iterdir()) == [folder]


def test_a_package_whose_files_are_others_is_refused(package, monkeypatch, tmp_path):
    monkeypatch.setitem(VERSIONS["pyodide"]["sha256"], OFFICIAL, "0" * 64)
    with pytest.raises(Unfinished, match=r"other contents than versions\.toml says"):
        bring_runtime(tmp_path / "kept/runtime")
    assert list((tmp_path / "kept").iterdir()) == []


@pytest.mark.parametrize("spoilt", ["missing", "other"])
def test_a_distribution_that_is_not_pyodides_is_refused(spoilt, distribution, official, tmp_path):
    if reason := reason_not():
        pytest.skip(reason)
    folder = tmp_path / "distribution"
    folder.mkdir()
    for path in distribution.iterdir():
        (folder / path.name).symlink_to(path)
    (folder / "openblas-0.3.26.zip").unlink()
    if spoilt == "other":
        (folder / "openblas-0.3.26.zip").write_bytes(b"other")
    says = "is missing in" if spoilt == "missing" else "is not the file that Pyodide published"
    with pytest.raises(Unfinished, match=f"openblas.*{says}"):
        make_live(KEPT.parent, tmp_path, folder)


# ------------------------------------------------------------------ the site as built


def is_published(lock):
    """Whether readers fetch the distribution's files from where Pyodide publishes them."""
    return lock["numpy"]["file_name"].startswith(CDN)


def test_every_package_is_there_once_with_all_that_it_needs(lock, folder):
    here = [each["file_name"] for each in lock.values() if not each["file_name"].startswith(CDN)]
    runtime = {*RUNTIME, OFFICIAL}
    assert sorted(here) == sorted({path.name for path in folder.iterdir()} - runtime)
    for name, each in lock.items():
        assert each["name"].replace("_", "-").lower() == name
        assert {need.replace("_", "-").lower() for need in each["depends"]} <= lock.keys()
        if each["file_name"] in here:
            data = (folder / each["file_name"]).read_bytes()
            assert hashlib.sha256(data).hexdigest() == each["sha256"], name
    asked = {*VERSIONS["kernel"]["packages"], *VERSIONS["wheels"]["driftlab"]["depends"]}
    assert asked <= lock.keys()


def test_panels_in_a_page_load_no_more_than_they_need(lock):
    loaded = set(needed({"packages": lock}, ["driftlab"]))
    assert not loaded & {"anywidget", "ipython", "ipywidgets", "jedi", "sympy"}


def test_the_runtime_is_that_of_pyodide(folder):
    for name in RUNTIME:
        assert digest_of(folder / name) == DIGESTS[name], name


def test_what_pyodide_publishes_has_its_official_digest(lock, official):
    expected = needed({"packages": official}, wanted())
    assert expected.keys() <= lock.keys()
    for name, each in expected.items():
        there = lock[name]
        assert there["version"] == each["version"]
        if is_published(lock):
            assert there["file_name"] == CDN + each["file_name"]
            assert there["sha256"] == each["sha256"]
        else:
            assert there["file_name"] == each["file_name"]
            assert there["file_name"].endswith(".whl") or there["sha256"] == each["sha256"]


def test_the_files_at_hand_are_those_that_pyodide_published(distribution, official):
    for name, each in needed({"packages": official}, wanted()).items():
        data = (distribution / each["file_name"]).read_bytes()
        assert hashlib.sha256(data).hexdigest() == each["sha256"], name


def test_compiled_wheels_hold_what_the_published_do(lock, folder, distribution):
    if is_published(lock):
        pytest.skip("the published site holds none of the distribution's wheels")
    for path in distribution.glob("*.whl"):
        with zipfile.ZipFile(path) as theirs, zipfile.ZipFile(folder / path.name) as ours:
            there, here = set(theirs.namelist()), set(ours.namelist())
            for name in (n for n in here if not n.endswith((".pyc", "/RECORD"))):
                assert ours.read(name) == theirs.read(name), (path.name, name)
            modules = {n.removesuffix("c") for n in here if n.endswith(".pyc")}
            left = {n for n in there if n.endswith(".py")} - modules - here
            assert all(re.search(r"(^|/)tests?/", name) for name in left), path.name


def test_compiled_wheels_are_whole_and_unchecked(lock, folder):
    sources = 0
    for path in folder.glob("*.whl"):
        with zipfile.ZipFile(path) as files:
            assert files.testzip() is None
            (record,) = (n for n in files.namelist() if re.fullmatch(r"[^/]+\.dist-info/RECORD", n))
            rows = [row.rsplit(",", 2) for row in files.read(record).decode().split()]
            assert sorted(name for name, _, _ in rows) == sorted(files.namelist())
            for name, digest, size in rows:
                data = files.read(name)
                if digest:
                    found = urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
                    assert (digest, int(size)) == (f"sha256={found}", len(data)), (path.name, name)
                if name.endswith(".pyc"):
                    assert data[4:8] == b"\x01\0\0\0", "compiled by content, and not checked"
                    sources += "/__pycache__/" in name
    assert sources > 100, "the package keeps its source"
