"""Every slider panel of the book, alone in a notebook, tried in every way a reader has."""

from collections.abc import Callable, Iterable, Iterator

import pytest
from frames import blank_frames, frames_of, sizes_during
from notebook_page import NotebookPage, wait_until
from panel_page import PanelPage
from places import PLACES
from twin import Panel

from driftlab.book.machinery.panel.control import Control

HEAVY = ["CapstoneExplorer", "CalibrationRunExplorer", "GyrocompassExplorer"]
"""The panels that take longest, to begin with them."""
FIRST_PLACES = {place.explorer: place for place in reversed(PLACES)}


RECORDED = ["CapstoneExplorer", "DriftExplorer", "GyrocompassExplorer"]
"""A quick one and the two that compute longest: a picture is exchanged alike in all."""


def panels(*names: str) -> pytest.MarkDecorator:
    """Run a test with these panels.

    The panel beside the one on the page computes what the other tests of its explorer do.
    """
    cases = [
        pytest.param(FIRST_PLACES[name], id=name, marks=pytest.mark.xdist_group(name))
        for name in names
    ]
    return pytest.mark.parametrize("shown", cases, indirect=True)


every_panel = panels(*sorted(FIRST_PLACES, key=lambda name: (name not in HEAVY, name)))
pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def shown(request, notebook: NotebookPage) -> Panel:
    """The panel of a place in the book, which the notebook shows, and nothing else."""
    place = request.param
    name, arguments = place.explorer, ", ".join(map(repr, place.arguments))
    notebook.show_on("1280x800")
    notebook.show(f"from driftlab.book import {name}\n{name}({arguments})")
    assert notebook.all_trouble() == []
    return Panel.on(notebook.page, place)


@pytest.fixture
def panel(shown: Panel, notebook: NotebookPage) -> Iterator[Panel]:
    """The panel as its cell has made it; at the end nothing may have gone wrong anywhere."""
    yield shown
    shown.shown.reset()
    assert notebook.all_trouble() == []


@pytest.fixture
def smaller_screen(notebook: NotebookPage) -> Iterator[None]:
    """The screen of a projector for one test."""
    notebook.show_on("1024x768")
    yield
    notebook.show_on("1280x800")


@every_panel
def test_opens_with_picture_and_numbers(panel: Panel) -> None:
    assert panel.shown.values() == panel.start
    panel.assert_agrees()


@every_panel
def test_a_screen_reader_is_told_what_there_is(panel: Panel) -> None:
    shown, twin = panel.shown, panel.twin
    assert shown.image.get_attribute("alt") == panel.expected(panel.start).alt
    for control in twin.controls:
        element = shown.element(control)
        assert element.count() == 1
        if control.is_slider and not control.stops:
            readout = shown.readout(control)
            assert readout.count() == 1
            assert element.get_attribute("aria-valuetext") == readout.inner_text()


@every_panel
def test_a_number_can_be_typed_over_a_readout(panel: Panel) -> None:
    shown, twin = panel.shown, panel.twin
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
def test_keys_in_a_panel_are_no_commands_of_jupyterlab(
    panel: Panel, notebook: NotebookPage
) -> None:
    shown, twin = panel.shown, panel.twin
    slider = next(control for control in twin.controls if control.is_slider)
    before = notebook.cells()
    shown.press(slider, "x", "b", "d", "d", "Enter", "Escape")
    assert notebook.cells() == before
    notebook.show_files(True)
    shown.press(slider, "Control+b")  # but this one is
    wait_until(notebook.page, lambda: not notebook.files_are_shown(), "the files to be hidden")
    notebook.show_files(True)


@every_panel
def test_every_preset_and_reset(panel: Panel) -> None:
    shown, twin = panel.shown, panel.twin
    at_first = shown.picture()
    for name, values in twin._presets.items():
        shown.choose_preset(name)
        assert shown.values() == values
        assert shown.preset() == name
        assert shown.cut_off() == [], name
        panel.assert_agrees()
    shown.reset()
    assert shown.picture() == at_first


def kind_of(control: Control) -> tuple[type, bool, bool, bool]:
    """What decides which widget of ipywidgets shows a control."""
    return type(control.start), bool(control.options), control.is_slider, bool(control.examples)


def first_of_each_kind(controls: Iterable[Control]) -> list[Control]:
    """What a widget does to all keys and to the mouse, and how it looks, is its own affair."""
    return list({kind_of(control): control for control in reversed([*controls])}.values())


def keys_for(control: Control) -> list[tuple[str, object]]:
    """Keys, and the value that each must lead to."""
    if control.is_box:
        other = not control.start
        return [("Space", other), ("Space", control.start), ("Space", other)]
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


def press(shown: PanelPage, control: Control) -> None:
    """Press the keys of a control, and fail unless each leads to the value that it must.

    They come faster than the pictures.
    """
    element = shown.element(control)
    element.focus()
    for key, value in keys_for(control):
        if control.examples:
            element.fill(value)
        shown.page.keyboard.press(key)
        found = shown.values()[control.name]
        assert found == (value if isinstance(value, str) else pytest.approx(value))
    shown.settle()


def move(shown: PanelPage, control: Control) -> None:
    """Drag a slider, and fail if another control moves with it, or the picture on its page."""
    before = shown.values()
    sizes = sizes_during(shown.page, shown.image, lambda: shown.drag(control))
    assert len(sizes) == 1, "the picture does not stay in its place"
    after = shown.values()
    assert {name for name in before if after[name] != before[name]} == {control.name}


def try_from_all_presets(
    panel: Panel, controls: Iterable[Control], act: Callable[[PanelPage, Control], None]
) -> None:
    """Move each control from a preset, and fail where the panel does not follow.

    From the first preset all of them; from the others those that have changed no picture so far.
    """
    shown, twin = panel.shown, panel.twin
    idle = list(controls)
    for preset, values in twin._presets.items():
        if not idle:
            break
        shown.choose_preset(preset)
        picture = shown.picture()
        for control in tuple(idle):
            shown.begin_with(preset, values)
            act(shown, control)
            panel.assert_agrees()
            if shown.picture() != picture:
                idle.remove(control)
    assert idle == [], "these change no picture from any preset"


@every_panel
def test_every_control_obeys_the_keyboard(panel: Panel) -> None:
    try_from_all_presets(panel, panel.twin.controls, press)


@every_panel
def test_sliders_of_every_kind_obey_the_mouse(panel: Panel) -> None:
    sliders = [control for control in panel.twin.controls if control.is_slider]
    try_from_all_presets(panel, first_of_each_kind(sliders), move)


@every_panel
def test_tab_reaches_every_control_and_shows_where_it_is(panel: Panel) -> None:
    shown, twin = panel.shown, panel.twin
    shown.panel.get_by_role("combobox", name="preset").focus()
    waiting = {shown.name(control) for control in twin.controls}
    looked_at = {shown.name(control) for control in first_of_each_kind(twin.controls)}
    unmarked = []
    for _ in range(3 * len(twin.controls) + 3):
        shown.page.keyboard.press("Tab")
        name = shown.focused_name()
        if name in waiting:
            waiting.discard(name)
            if name in looked_at and not shown.focus_is_visible():
                unmarked.append(name)
    assert waiting == set(), "Tab does not come here"
    assert unmarked == [], "the focus does not show here"


@panels(*RECORDED)
def test_picture_is_never_blank(panel: Panel) -> None:
    shown, twin = panel.shown, panel.twin
    slider = next(control for control in twin.controls if control.is_slider)
    shown.bring_into_sight(slider)
    frames = frames_of(shown.page, shown.image, *shown.sweep(slider))
    assert len({frame.tobytes() for frame in frames}) > 2, "no motion was recorded"
    assert blank_frames(frames) == 0


@every_panel
@pytest.mark.usefixtures("smaller_screen")
def test_nothing_is_cut_off_on_a_smaller_screen(panel: Panel) -> None:
    shown, twin = panel.shown, panel.twin
    for preset in twin.presets:
        shown.choose_preset(preset)
        assert shown.cut_off() == [], preset
