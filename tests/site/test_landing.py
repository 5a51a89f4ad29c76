"""The first page: its moving picture is the book's scene, with the package's numbers."""

import re

import numpy as np
import pytest

from driftlab.book import TurningBlock
from driftlab.book.ch03_systematic_drift.controls import error_matrix_of
from driftlab.book.machinery.panel.axis import axis_of
from driftlab.drift import drift_per_revolution
from reading.landing import PRESETS

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("site-landing")]
MOMENT = "document.querySelector('.dl-bar input').valueAsNumber"


@pytest.fixture
def still(browser, site):
    """The first page from a disk, for a reader who wants little motion."""
    context = browser.new_context(reduced_motion="reduce", viewport={"width": 1280, "height": 900})
    page = context.new_page()
    page.goto((site / "index.html").as_uri())
    yield page
    context.close()


def test_it_moves_at_once_and_stops(page, site):
    page.goto((site / "index.html").as_uri())
    page.wait_for_function(f"{MOMENT} > 20")
    page.get_by_role("button", name="Pause").click()
    stopped = page.evaluate(MOMENT)
    page.wait_for_timeout(100)  # some frames
    assert page.evaluate(MOMENT) == stopped
    page.get_by_role("button", name="Play").click()
    page.wait_for_function(f"{MOMENT} > {stopped}")
    assert page.complaints == []


def test_its_numbers_are_those_of_the_package(still):
    assert still.evaluate(MOMENT) == 0
    for name in PRESETS:
        still.get_by_role("button", name=name).click()
        still.locator(".dl-bar input").press("End")
        (said,) = still.locator(".dl-readouts td").all_inner_texts()
        block = TurningBlock(name)
        left = drift_per_revolution(axis_of(block.values), error_matrix_of(block.values))
        assert (
            block.look_for[name]
            == still.locator("figure[data-panel=TurningBlock] > figcaption").inner_text()
        )
        assert abs(float(said[:-1])) == pytest.approx(abs(5 * 60 * np.degrees(left)), abs=0.01)


def test_it_fits_a_phone_and_shows_the_chapters_still_without_scripts(browser, site):
    context = browser.new_context(viewport={"width": 390, "height": 844}, has_touch=True)
    page = context.new_page()
    page.goto((site / "index.html").as_uri())
    for part in page.locator(".landing-choices button").all():
        box = part.bounding_box()
        assert box["height"] >= 43
        assert box["x"] + box["width"] <= 390
    context.close()
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto((site / "index.html").as_uri())
    picture = page.locator("figure[data-panel=TurningBlock] img")
    assert picture.is_visible()
    assert (site / picture.get_attribute("src")).is_file()
    context.close()


def test_it_says_how_large_the_pdf_is(page, site):
    page.goto((site / "index.html").as_uri())
    size = (site / "drift-lab.pdf").stat().st_size / 1e6
    assert re.search(rf"\(PDF, {size:.0f} MB\)", page.locator(".doors").inner_text())
