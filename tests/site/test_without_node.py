"""A site that is built where Node is missing: it can be read, does not move, and says so."""

import os
import subprocess
from pathlib import Path

import pytest
from served import served

from live.versions import ROOT

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("site-without-node")]
CHAPTER = "03_systematic_drift"


@pytest.fixture(scope="module")
def built(site_python, tmp_path_factory) -> tuple[Path, str]:
    """The site, and what its build said."""
    if not (ROOT / f"build/site/executed/{CHAPTER}.ipynb").exists():
        pytest.skip("'python3 lab.py site' has not run in this folder: it has what is needed here")
    folder = tmp_path_factory.mktemp("without-node")
    command = [str(site_python), str(Path(__file__).with_name("build_small.py")), str(folder)]
    nothing = {**os.environ, "PATH": str(folder)}
    done = subprocess.run(command, capture_output=True, encoding="utf-8", env=nothing)
    assert done.returncode == 0, done.stderr
    return folder / "made", done.stderr


def test_the_build_says_why_nothing_moves_and_goes_on(built):
    made, said = built
    assert "The book is not made live: that needs Node.js, which is not installed." in said
    there = {path.name for path in made.iterdir()}
    assert {"index.html", f"{CHAPTER}.html", "colab", "licences.html", "_static"} <= there
    assert not there & {"live", "in_place"}


def test_its_pages_are_read_and_promise_nothing_that_is_not_there(built, page):
    with served(built[0]) as address:
        page.goto(f"{address}/{CHAPTER}.html")
        page.wait_for_function("document.querySelector('mjx-container') !== null")
        stood = page.locator("figure.driftlab-still", has_text="how it stood when the chapter")
        assert stood.count() > 0
        picture = stood.locator("img:visible").first  # of a light page
        picture.scroll_into_view_if_needed()
        page.wait_for_function("(img) => img.naturalWidth > 0", arg=picture.element_handle())
        assert page.locator("article button:not(.copybtn)").count() == 0
        assert page.locator('a[href*="live/"], script[src*="in_place/"]').count() == 0
        page.goto(f"{address}/index.html")
        assert page.locator('a[href*="live/"]').count() == 0
        assert "has a button that wakes it" not in page.locator("article").inner_text()
    assert page.complaints == []
