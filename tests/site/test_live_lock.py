"""The live book's lock and wheels: what a browser loads is there, and is what Pyodide published.

Both ways: as readers have it, who fetch the distribution from Pyodide, and self-contained.
"""

import hashlib
import json
import re
import zipfile
from base64 import urlsafe_b64encode
from pathlib import Path

import pytest
from packaging.utils import canonicalize_name

from live.brought import OFFICIAL, RUNTIME, digest_of
from live.lock import entry_of, needed, requirements
from live.own_wheels import figures_wheel
from live.versions import ROOT, VERSIONS, older, pin, wheel_pins

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("site-lock")]
CDN = VERSIONS["pyodide"]["distribution"]
DIGESTS = VERSIONS["pyodide"]["sha256"]


def wheel(folder, name="one", version="1.0", needs=()):
    """A wheel of one module."""
    path = folder / f"{name}-{version}-py3-none-any.whl"
    lines = ["Metadata-Version: 2.1", f"Name: {name}", f"Version: {version}"]
    with zipfile.ZipFile(path, "w") as files:
        files.writestr(f"{name}/__init__.py", "")
        text = "\n".join([*lines, *(f"Requires-Dist: {need}" for need in needs)])
        files.writestr(f"{name}-{version}.dist-info/METADATA", text)
    return path


@pytest.fixture(params=["as built", "self-contained"])
def folder(request) -> Path:
    """What a browser loads."""
    if request.param == "self-contained":
        return request.getfixturevalue("all_here")
    return request.getfixturevalue("site") / "live/static/pyodide"


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


# ------------------------------------------------------------------ what a browser loads


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
    for path in folder.glob("*.whl"):
        for need in requirements(path):
            version = lock[canonicalize_name(need.name)]["version"]
            assert need.specifier.contains(version, prereleases=True), (path.name, need, version)
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
