"""The live book's notebooks, lock and wheels: what a browser loads is there, and as published.

Both ways: as readers have it, who fetch the distribution from Pyodide, and self-contained.
"""

import ast
import hashlib
import json
import re
import sys
import zipfile
from base64 import urlsafe_b64encode
from pathlib import Path

import pytest
from packaging.utils import canonicalize_name

from executed import FOLDER, published
from live.brought import OFFICIAL, RUNTIME, bring, digest_of
from live.lock import needed, requirements
from live.make import BUILD
from live.packages import make_packages
from live.versions import VERSIONS
from unfinished import Unfinished

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("site-in-place")]
CDN = VERSIONS["pyodide"]["distribution"]
WANTED = VERSIONS["wheels"]["distribution"]


@pytest.fixture(params=["as built", "self-contained"])
def folder(request) -> Path:
    """What a browser loads."""
    if request.param == "self-contained":
        return request.getfixturevalue("all_here")
    return request.getfixturevalue("site") / "live/static/pyodide"


@pytest.fixture
def lock(folder) -> dict:
    return json.loads((folder / OFFICIAL).read_text("utf-8"))["packages"]


@pytest.fixture(scope="module")
def built(site) -> dict:
    """The lock as it was built."""
    return json.loads((site / "live/static/pyodide" / OFFICIAL).read_text("utf-8"))["packages"]


def test_every_notebook_is_live_and_links_to_what_is_there(site):
    live = site / "live/files"
    for name in published():
        notebook = json.loads((live / name).read_text("utf-8"))
        cells = (cell for cell in notebook["cells"] if cell["cell_type"] == "markdown")
        text = "".join("".join(cell["source"]) for cell in cells)
        for link in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", text):
            assert ((live / name).parent / link).exists(), (name, link)
        for page in re.findall(r"\]\(#site/([^)#]+)", text):
            assert (site / page).exists(), (name, page)


def test_every_module_that_notebooks_import_is_loaded_with_the_kernel(built):
    loaded = needed({"packages": built}, VERSIONS["kernel"]["packages"])
    there = {name.partition(".")[0] for each in loaded.values() for name in each["imports"]}
    there |= {*sys.stdlib_module_names}
    # Who teaches a class makes its notebooks with the project's folder, not in a browser.
    for name in set(published()) - {"for_instructors.ipynb"}:
        for cell in json.loads((FOLDER / name).read_text("utf-8"))["cells"]:
            if cell["cell_type"] != "code":
                continue
            lines = [line for line in cell["source"] if not line.startswith(("%", "!"))]
            for node in ast.walk(ast.parse("".join(lines))):
                if isinstance(node, ast.Import):
                    wanted = {each.name.partition(".")[0] for each in node.names}
                    assert wanted <= there, name
                elif isinstance(node, ast.ImportFrom):
                    assert node.module.partition(".")[0] in there, name


def test_panels_in_a_page_load_no_more_than_they_need(built):
    loaded = set(needed({"packages": built}, ["driftlab"]))
    assert not loaded & {"anywidget", "ipython", "ipywidgets", "jedi", "sympy"}


def test_every_package_is_there_once_with_all_that_it_needs(lock, folder, official):
    here = [each["file_name"] for each in lock.values() if not each["file_name"].startswith(CDN)]
    runtime = {*RUNTIME, OFFICIAL}
    assert sorted(here) == sorted({path.name for path in folder.iterdir()} - runtime)
    for name, each in lock.items():
        assert each["name"].replace("_", "-").lower() == name
        assert {need.replace("_", "-").lower() for need in each["depends"]} <= lock.keys()
        if each["file_name"] in here:
            assert digest_of(folder / each["file_name"]) == each["sha256"], name
    for path in folder.glob("*.whl"):
        for need in requirements(path):
            version = lock[canonicalize_name(need.name)]["version"]
            assert need.specifier.contains(version, prereleases=True), (path.name, need, version)
    for name in RUNTIME:
        assert digest_of(folder / name) == VERSIONS["pyodide"]["sha256"][name], name
    for name, each in needed({"packages": official}, WANTED).items():
        there = lock[name]
        assert there["version"] == each["version"]
        assert there["file_name"].removeprefix(CDN) == each["file_name"]
        if there["file_name"].startswith(CDN) or not there["file_name"].endswith(".whl"):
            assert there["sha256"] == each["sha256"], "a wheel that is here is compiled"


def test_compiled_wheels_are_whole_and_unchecked(site):
    sources = 0
    for path in (site / "live/static/pyodide").glob("*.whl"):
        with zipfile.ZipFile(path) as files:
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


@pytest.mark.parametrize("spoilt", ["missing", "other"])
def test_a_distribution_that_is_not_pyodides_is_refused(
    spoilt, site, distribution, official, tmp_path
):
    folder = tmp_path / "distribution"
    folder.mkdir()
    for path in distribution.iterdir():
        (folder / path.name).symlink_to(path)
    (folder / "openblas-0.3.26.zip").unlink()
    if spoilt == "other":
        (folder / "openblas-0.3.26.zip").write_bytes(b"other")
    says = "is missing in" if spoilt == "missing" else "is not the file that Pyodide published"
    with pytest.raises(Unfinished, match=f"openblas.*{says}"):
        make_packages(bring(BUILD / "live"), BUILD / "live", tmp_path / "made", folder)
