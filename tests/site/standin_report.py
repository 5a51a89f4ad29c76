"""What panels look like as data, with real widgets or, after ``python standin_report.py``, without.

Run as a script it puts the page's stand-in in the place of ipywidgets, and prints the report of all
panels and scenes as JSON.
"""

import hashlib
import json
import sys
from collections.abc import Iterator
from typing import Any

TRAITS = ("value", "description", "tooltip", "min", "max", "step", "readout_format", "index")


def report(panel: Any) -> dict[str, Any]:
    """What a panel shows when it opens, after another preset, after a move, and after Reset."""
    steps = {"opened": list(shown(panel))}
    panel.preset.value = list(panel.presets)[-1]
    steps["preset"] = list(shown(panel))
    name, widget = moved(panel)
    steps[f"moved {name}"] = list(shown(panel))
    if hasattr(widget, "max"):
        widget.value = widget.max + 1  # goes to its end
        assert widget.value == widget.max
    panel.reset.click()
    steps["reset"] = list(shown(panel))
    return {"values": panel.values, **steps}


def moved(panel: Any) -> tuple[str, Any]:
    """Move the first control to another of its values."""
    control = panel.controls[0]
    widget = panel._widgets[control.name]
    if control.options:
        widget.value = next(each for each in control.options if each != widget.value)
    elif control.examples:
        widget.value = control.examples[1]
    else:
        far = control.high if widget.value < control.high else control.low
        widget.value = far
    return control.name, widget


def shown(widget: Any) -> Iterator[Any]:
    """A widget and all in it: its kind, its classes, and the state that a reader would see."""
    kind = next(each.__name__ for each in type(widget).__mro__ if each.__module__ in ORIGINS)
    classes = getattr(widget, "_dom_classes", None) or getattr(widget, "classes", ())
    state = {name: getattr(widget, name) for name in TRAITS if hasattr(widget, name)}
    if not state.get("description"):
        state.pop("description", None)  # not all of the real ones can have one
    if kind == "Image":
        state["value"] = hashlib.sha256(widget.value).hexdigest()
    if hasattr(widget, "stage"):
        state["stage"] = hashlib.sha256(repr(plain(widget.stage)).encode()).hexdigest()
    if kind == "AnyWidget":
        classes = ()  # some of the real one's are its own
    yield [kind, list(classes), widget.layout.display, state]
    for child in getattr(widget, "children", ()):
        yield from shown(child)


ORIGINS = {"widgets_standin", "anywidget.widget"} | {
    f"ipywidgets.widgets.widget_{each}"
    for each in ("bool", "box", "button", "float", "int", "media", "selection",
                 "selectioncontainer", "string")
}  # fmt: skip


def plain(value: Any) -> Any:
    """Buffers as bytes."""
    if isinstance(value, memoryview):
        return bytes(value)
    if isinstance(value, dict):
        return {name: plain(each) for name, each in value.items()}
    return [plain(each) for each in value] if isinstance(value, (list, tuple)) else value


if __name__ == "__main__":
    sys.path.insert(0, sys.argv[1])
    import widgets_standin

    widgets_standin.install()
    from driftlab.book.panels import EXPLORERS, SCENES

    reports = {each.__name__: report(each()) for each in (*EXPLORERS, *SCENES)}
    wrong = {"sympy", "IPython", "ipykernel", "comm"} & set(sys.modules)
    print(json.dumps({"reports": reports, "wrong": sorted(wrong)}))
