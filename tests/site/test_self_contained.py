"""A site that needs no network: ``python3 lab.py site --self-contained FOLDER``.

What it has besides the published one is made here and put beside the site's other parts.
"""

import re
import zipfile

import pytest
from lively import at_rest, awaken, figure_of, same_as_native, values_of
from served import linked, served

from driftlab.book import DriftExplorer
from live.brought import bring
from live.make import BUILD
from live.packages import make_packages
from unfinished import Unfinished

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("site-lock")]


@pytest.mark.parametrize("spoilt", ["missing", "other"])
def test_a_distribution_that_is_not_pyodides_is_refused(spoilt, distribution, official, tmp_path):
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


def test_compiled_wheels_hold_what_the_published_do(all_here, distribution):
    for path in distribution.glob("*.whl"):
        with zipfile.ZipFile(path) as theirs, zipfile.ZipFile(all_here / path.name) as ours:
            there, here = set(theirs.namelist()), set(ours.namelist())
            for name in (n for n in here if not n.endswith((".pyc", "/RECORD"))):
                assert ours.read(name) == theirs.read(name), (path.name, name)
            modules = {n.removesuffix("c") for n in here if n.endswith(".pyc")}
            left = {n for n in there if n.endswith(".py")} - modules - here
            assert all(re.search(r"(^|/)tests?/", name) for name in left), path.name


@pytest.fixture
def own_site(site, all_here, tmp_path):
    """The site as built, with all of Pyodide in the place of what its lock leaves elsewhere."""
    own = linked(site, tmp_path / "site", without="live/static/pyodide")
    (own / "live/static/pyodide").symlink_to(all_here)
    return own


@pytest.mark.browser
def test_a_panel_of_a_chapter_lives_and_nothing_is_asked_of_the_network(own_site, page):
    elsewhere = []

    def refuse(route) -> None:
        elsewhere.append(route.request.url)
        route.abort()

    page.route(re.compile(r"^https?://(?!127\.0\.0\.1[:/])"), refuse)
    with served(own_site) as address:
        page.goto(f"{address}/03_systematic_drift.html")
        figure = figure_of(page, DriftExplorer)
        awaken(page, figure)
        same_as_native(page, figure, DriftExplorer())
        figure.locator("input[type=range]").last.press("Home")
        at_rest(page, figure)
        same_as_native(page, figure, DriftExplorer())
    assert values_of(figure)["elevation"] == -90
    assert elsewhere == []
    assert page.complaints == []
