"""Every panel of the book in a page: each control goes to both ends, and nothing is cut off."""

import pytest
from notebook_page import SCREENS, NotebookPage, wait_until
from places import PLACES
from twin import Panel

FIRST_PLACES = {place.explorer: place for place in reversed(PLACES)}
OF_ALL_KINDS = ("AlgorithmLaboratoryExplorer", "AllanExplorer", "ObservabilityExplorer")
"""Together they have every kind of control; what such a widget does is its own affair."""

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("browser")]


def panels(*names: str) -> pytest.MarkDecorator:
    """Run a test with these panels, each alone in the notebook."""
    cases = [pytest.param(FIRST_PLACES[name], id=name) for name in names]
    return pytest.mark.parametrize("panel", cases, indirect=True)


@panels(*sorted(FIRST_PLACES))
def test_every_control_goes_to_both_ends_and_nothing_is_cut_off(
    panel: Panel, notebook: NotebookPage
) -> None:
    shown = panel.shown
    assert shown.values() == panel.start
    panel.assert_agrees()
    assert shown.cut_off() == []
    assert shown.image.get_attribute("alt") == panel.twin.page.alt
    assert len(list(shown.tab_through())) == len(panel.twin.controls)
    panel.sweep()
    name, values = list(panel.twin._presets.items())[-1]
    shown.choose_preset(name)
    assert (shown.values(), shown.preset()) == (values, name)
    assert shown.cut_off() == []
    notebook.show_on(SCREENS[0])
    shown.reset()
    assert shown.values() == panel.start
    assert shown.cut_off() == []


@panels(*OF_ALL_KINDS)
def test_each_kind_of_control_obeys_mouse_and_keys_and_shows_its_focus(panel: Panel) -> None:
    shown, kinds = panel.shown, set()
    for control in shown.tab_through():
        kind = type(panel.twin._widgets[control.name])
        if kind in kinds:
            continue
        kinds.add(kind)
        assert shown.focus_is_visible(), control.name
        if control.is_slider:
            before = shown.values()
            shown.drag(control)
            after = shown.values()
            assert {name for name in before if after[name] != before[name]} == {control.name}
            if not control.stops:
                said = shown.element(control).get_attribute("aria-valuetext")
                assert said == shown.readout(control).inner_text()
            shown.element(control).focus()
    panel.assert_agrees()


@panels("DriftExplorer")
def test_what_is_typed_goes_to_the_panel_and_not_to_jupyterlab(
    panel: Panel, notebook: NotebookPage
) -> None:
    shown, control = panel.shown, panel.twin.controls[0]
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
    before = notebook.cells()
    shown.press(control, "x", "b", "d", "d", "Enter", "Escape")
    assert notebook.cells() == before
    notebook.show_files(True)
    shown.press(control, "Control+b")  # but this one is a command
    wait_until(notebook.page, lambda: not notebook.files_are_shown(), "the files to be hidden")
