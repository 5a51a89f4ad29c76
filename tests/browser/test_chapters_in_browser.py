"""Every chapter of the book in JupyterLab, as a reader opens it."""

from pathlib import Path

import pytest
from notebook_page import SCREENS, NotebookPage, opened
from places import CHAPTERS, PLACES, Place
from twin import Panel

from driftlab.book.panels import EXPLORERS

SCREENSHOTS = Path(__file__).parent / "screenshots"
HEAVY = ["08", "10", "11", "06"]
"""The chapters that take longest, to begin with them."""
NAMES = sorted(
    (path.name for path in CHAPTERS.glob("[0-9]*.ipynb")),
    key=lambda name: (name[:2] not in HEAVY, name),
)

pytestmark = pytest.mark.browser


def test_every_explorer_is_somewhere_in_the_book() -> None:
    assert {place.explorer for place in PLACES} == {explorer.__name__ for explorer in EXPLORERS}


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, id=name[:2], marks=pytest.mark.xdist_group(f"browser-{name[:2]}"))
        for name in NAMES
    ],
)
def test_a_chapter_runs_and_its_panels_live(name: str, browser, server) -> None:
    with opened(browser, server, name) as chapter:
        chapter.run_all()
        assert chapter.all_trouble() == []
        assert chapter.cells_not_run() == []
        for place in PLACES:
            if place.chapter == name:
                look_at(chapter, place)
        assert chapter.all_trouble() == []


def look_at(chapter: NotebookPage, place: Place) -> None:
    """Fail unless a panel is right, fits into the screen, and obeys a key."""
    chapter.show_cell(place.cell)
    panel = Panel.on(chapter.page, place)
    assert panel.shown.values() == panel.twin.values
    panel.assert_agrees()
    SCREENSHOTS.mkdir(exist_ok=True)
    for screen in SCREENS:
        chapter.show_on(screen)
        chapter.show_cell(place.cell)
        panel.shown.screenshot(SCREENSHOTS / f"{name_of(place)}-{screen}.png")
        assert panel.shown.cut_off() == []
    slider = next(control for control in panel.twin.controls if control.is_slider)
    before = panel.shown.values()[slider.name]
    high = slider.options[-1] if slider.options else slider.high
    panel.shown.press(slider, "End" if before != high else "Home")
    panel.shown.settle()
    assert panel.shown.values()[slider.name] != before
    panel.assert_agrees()


def name_of(place: Place) -> str:
    return f"{place.chapter[:2]}-{place.explorer}"
