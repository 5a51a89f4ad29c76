"""Every slider panel of the book, in the chapter that shows it, as a reader finds it."""

import html
import io
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from frames import blank_frames, frames_of, sizes_during
from notebook_page import NotebookPage
from panel_page import PanelPage
from PIL import Image

from book import PLACES, Place
from driftlab.book import panels
from driftlab.book.machinery.control import Control
from driftlab.book.machinery.panel import Explorer
from driftlab.book.panels import EXPLORERS
from panel_numbers import assert_shown, shown_numbers

SCREENSHOTS = Path(__file__).parent / "screenshots"
SCREENS = {"1280x800": (1280, 800), "1024x768": (1024, 768)}


# The tests of one chapter come together, so that each chapter is opened and run once.
every_panel = pytest.mark.parametrize(
    ("chapter", "place"),
    [(place.chapter, place) for place in PLACES],
    indirect=True,
    ids=[f"{place.chapter[:2]}-{place.explorer}" for place in PLACES],
    scope="module",
)


def test_every_explorer_is_somewhere_in_the_book() -> None:
    assert {place.explorer for place in PLACES} == {explorer.__name__ for explorer in EXPLORERS}


@pytest.fixture(scope="module")
def chapter(request, browser, server) -> Iterator[NotebookPage]:
    """A chapter of which all cells have been run."""
    address, token, _ = server
    width, height = SCREENS["1280x800"]
    page = browser.new_page(viewport={"width": width, "height": height})
    opened = NotebookPage(page, address, token)
    opened.open(request.param)
    opened.run_all()
    yield opened
    opened.close()


@pytest.fixture(scope="module")
def place(request) -> Place:
    return request.param


class Panel(NamedTuple):
    """A panel on a page, and the same explorer here."""

    shown: PanelPage
    twin: Explorer

    def assert_agrees(self) -> None:
        """Fail unless all on display belongs to the values on display."""
        values = self.shown.values()
        self.twin.set(**values)
        assert self.twin.message.value == ""
        assert self.shown.numbers() == shown_numbers(self.twin.text.value)
        assert f"<pre>{html.escape(self.shown.code())}</pre>" == self.twin.code.value
        pictures = (self.shown.picture(), self.twin.image.value)
        pixels = [np.asarray(Image.open(io.BytesIO(file))) for file in pictures]
        np.testing.assert_array_equal(*pixels, err_msg=f"not the picture of {values}")
        assert_shown(type(self.twin).__name__, values, self.shown.numbers())


@pytest.fixture
def panel(chapter: NotebookPage, place: Place) -> Iterator[Panel]:
    """The panel as its cell has made it; at the end nothing may have gone wrong anywhere."""
    chapter.show_cell(place.cell)
    shown = PanelPage(chapter.page, getattr(panels, place.explorer))
    yield Panel(shown, getattr(panels, place.explorer)(*place.arguments))
    shown.reset()
    assert chapter.all_trouble() == []


@every_panel
def test_opens_with_picture_and_numbers(panel: Panel) -> None:
    assert panel.shown.values() == panel.twin.values
    panel.assert_agrees()


@every_panel
def test_a_screen_reader_is_told_what_there_is(panel: Panel) -> None:
    shown, twin = panel
    assert shown.image.get_attribute("alt") == twin.title
    for control in twin.controls:
        element = shown.element(control)
        assert element.count() == 1
        if control.is_slider and not control.stops:
            readout = shown.readout(control)
            assert readout.count() == 1
            assert element.get_attribute("aria-valuetext") == readout.inner_text()


@every_panel
def test_a_number_can_be_typed_over_a_readout(panel: Panel) -> None:
    shown, twin = panel
    control = next(c for c in twin.controls if c.is_slider and not c.stops)
    near = control.low + control.step
    # Enter takes it and so does leaving; a decimal comma is a point.
    for leave, text, value in (
        ("Enter", f"{near:g}".replace(".", ","), near),
        ("Tab", f"{control.high:g}", control.high),
        ("Tab", "nonsense", control.high),
    ):
        shown.readout(control).fill(text)
        shown.page.keyboard.press(leave)
        shown.settle()
        assert shown.values()[control.name] == pytest.approx(value)
    panel.assert_agrees()


@every_panel
def test_keys_in_a_panel_are_no_commands_of_jupyterlab(panel: Panel, chapter: NotebookPage) -> None:
    shown, twin = panel
    slider = next(control for control in twin.controls if control.is_slider)
    before = chapter.count_cells()
    shown.press(slider, "x", "b", "d", "d", "Enter", "Escape")
    assert chapter.count_cells() == before
    chapter.show_files(True)
    shown.press(slider, "Control+b")  # but this one is
    assert not chapter.files_are_shown()
    chapter.show_files(True)


@every_panel
def test_every_preset_and_reset(panel: Panel) -> None:
    shown, twin = panel
    at_first = shown.picture()
    for name, values in twin._presets.items():
        shown.choose_preset(name)
        assert shown.values() == values
        assert shown.preset() == name
        panel.assert_agrees()
    shown.reset()
    assert shown.picture() == at_first


def keys_for(control: Control) -> list[tuple[str, object]]:
    """Keys, and the value that each must lead to."""
    if control.is_box:
        return [("Space", not control.start), ("Space", control.start)]
    if control.examples:
        return [("Enter", control.examples[0])]
    if control.options:
        low, second, third, high = (
            control.options[i] for i in (0, 1, min(2, len(control.options) - 1), -1)
        )
    else:
        low, second, third = (control.low + k * control.step for k in range(3))
        high = control.high
    if control.choices:
        return [("End", high), ("Home", low), ("ArrowDown", second)]
    return [("End", high), ("Home", low), ("ArrowRight", second), ("ArrowUp", third)]


@every_panel
def test_every_control_obeys_the_keyboard(panel: Panel) -> None:
    shown, twin = panel
    idle = list(twin.controls)
    for preset in twin.presets:
        for control in tuple(idle):
            shown.choose_preset(preset)
            picture = shown.picture()
            for key, value in keys_for(control):
                if control.examples:
                    shown.element(control).fill(value)
                shown.press(control, key)
                shown.settle()
                found = shown.values()[control.name]
                assert found == (value if isinstance(value, str) else pytest.approx(value))
                if shown.picture() != picture and control in idle:
                    idle.remove(control)
            panel.assert_agrees()
    assert idle == [], "these change no picture from any preset"


@every_panel
def test_every_slider_obeys_the_mouse(panel: Panel) -> None:
    shown, twin = panel
    idle = [control for control in twin.controls if control.is_slider]
    for preset in twin.presets:
        for control in tuple(idle):
            shown.choose_preset(preset)
            picture, before = shown.picture(), shown.values()
            shown.drag(control)
            after = shown.values()
            assert {name for name in before if after[name] != before[name]} == {control.name}
            if shown.picture() != picture:
                idle.remove(control)
            panel.assert_agrees()
    assert idle == [], "these change no picture from any preset"


@every_panel
def test_tab_reaches_every_control_and_shows_where_it_is(panel: Panel) -> None:
    shown, twin = panel
    shown.panel.get_by_role("combobox", name="preset").focus()
    waiting = {shown.name(control) for control in twin.controls}
    unmarked = []
    for _ in range(3 * len(twin.controls) + 3):
        shown.page.keyboard.press("Tab")
        name = shown.focused_name()
        if name in waiting:
            waiting.discard(name)
            if not shown.focus_is_visible():
                unmarked.append(name)
    assert waiting == set(), "Tab does not come here"
    assert unmarked == [], "the focus does not show here"


@every_panel
def test_picture_is_never_blank_and_stays_in_its_place(panel: Panel) -> None:
    shown, twin = panel
    slider = next(control for control in twin.controls if control.is_slider)
    shown.bring_into_sight(slider)
    sizes = []

    def slide() -> None:
        sizes.extend(sizes_during(shown.page, shown.image, lambda: shown.sweep(slider)))

    frames = frames_of(shown.page, shown.image, slide)
    shown.settle()
    assert len({frame.tobytes() for frame in frames}) > 2, "no motion was recorded"
    assert blank_frames(frames) == 0
    assert len(sizes) == 1


@pytest.mark.parametrize("screen", SCREENS)
@every_panel
def test_nothing_is_cut_off(panel: Panel, chapter: NotebookPage, place: Place, screen: str) -> None:
    shown = panel.shown
    chapter.show_files(screen == "1280x800")
    width, height = SCREENS[screen]
    chapter.page.set_viewport_size({"width": width, "height": height})
    chapter.show_cell(place.cell)
    shown.settle()
    try:
        SCREENSHOTS.mkdir(exist_ok=True)
        name = f"{place.chapter[:2]}-{place.explorer}-{screen}.png"
        shown.screenshot(SCREENSHOTS / name)
        assert shown.cut_off() == []
    finally:
        chapter.show_files(True)
        chapter.page.set_viewport_size({"width": 1280, "height": 800})
