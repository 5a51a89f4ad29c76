"""Every control of every panel is moved, each alone and all at once, and no fault stays hidden."""

import random
from collections.abc import Iterator
from typing import Any

import ipywidgets as widgets
import pytest

from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import ERROR_CLASS, Explorer
from grouped import every_panel, opened
from panel_numbers import assert_shown, results_of


def places(control: Control) -> list:
    """Both ends of a slider, or every choice or example."""
    if control.is_slider:
        return (
            [control.stops[0], control.stops[-1]] if control.stops else [control.low, control.high]
        )
    return list(control.options or control.examples)


def any_place(control: Control, rng: random.Random) -> Any:
    listed = control.options or control.examples
    if listed:
        return rng.choice(listed)
    return type(control.start)(rng.uniform(control.low, control.high))


def parts_of(widget: widgets.Widget) -> Iterator[widgets.Widget]:
    yield widget
    for child in getattr(widget, "children", ()):
        yield from parts_of(child)


def hidden_errors(panel: Explorer) -> list[str]:
    """Tracebacks in the state of any widget of a panel, where no exception comes out."""
    found = []
    for part in parts_of(panel):
        found += [out["evalue"] for out in getattr(part, "outputs", ()) if "evalue" in out]
        value = getattr(part, "value", "")
        if isinstance(value, str) and (ERROR_CLASS in value or "Traceback" in value):
            found.append(value)
    return found


def assert_sound(panel: Explorer) -> None:
    """Fail if anything in the panel tells of an error."""
    assert hidden_errors(panel) == []
    assert panel.message.value == ""
    assert "nan" not in panel.headline.value + panel.text.value


def sweep(panel: Explorer) -> None:
    """Move each control alone to all its places and back.

    From the first preset all of them; from the others those that have changed no picture so far.
    """
    idle = list(panel.controls)
    for values in panel._presets.values():
        if not idle:
            break
        panel.set(**values)
        assert_sound(panel)
        picture = panel.view.widget.value
        for control in idle.copy():
            for place in places(control):
                panel._widgets[control.name].value = place
                assert_sound(panel)
                if panel.view.widget.value != picture and control in idle:
                    idle.remove(control)
            panel._widgets[control.name].value = values[control.name]
            assert panel.view.widget.value == picture, (
                "the picture depends on the way to the values"
            )
        assert panel.values == values
    assert idle == [], "these change no picture from any preset"


def combine(panel: Explorer, name: str, count: int = 8) -> None:
    """Set all controls at once, at random, and run the code that the panel shows."""
    rng = random.Random(7)
    for _ in range(count):
        panel.set(**{control.name: any_place(control, rng) for control in panel.controls})
        assert_sound(panel)
        assert_shown(name, panel.values, results_of(panel))
        exec(panel.call(panel.values), {})


@pytest.mark.slow
@every_panel
def test_every_control_sweeps_to_both_ends_and_back(panel_class: type[Explorer]) -> None:
    sweep(opened(panel_class))


@pytest.mark.slow
@every_panel
def test_any_combination_gives_a_picture_numbers_and_code_that_runs(
    panel_class: type[Explorer],
) -> None:
    combine(opened(panel_class), panel_class.__name__)
