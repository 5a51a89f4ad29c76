"""The panels and scenes of a page, made of the book's own classes; the worker calls what is here.

A panel is known to the page by its number, and each of its widgets by an identifier. All answers
are plain data: what has changed, what scripts are told, and the values of all controls.
"""

from __future__ import annotations

import logging
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from widgets_standin import WIDGETS, taken

# It may build its list of fonts first, and would say so.
logging.getLogger("matplotlib.font_manager").setLevel(logging.ERROR)

import driftlab.book  # noqa: E402
from driftlab.book.machinery.panel.control import Control  # noqa: E402
from driftlab.book.machinery.panel.panel import ERROR_CLASS, Explorer  # noqa: E402
from driftlab.book.machinery.panel.still import plain_values  # noqa: E402

OPEN: list[Explorer] = []


def open(
    name: str, values: Mapping[str, Any], now: Mapping[str, Any], ratio: float = 1.0
) -> dict[str, Any]:
    """Open a panel as it stands in the chapter, then move it to the values that it had last.

    Return its number, title, widgets and values.
    """
    panel_class = getattr(driftlab.book, name)  # of its chapter alone, which takes less time
    panel = panel_class(_preset(panel_class, values))
    panel.page.ratio = ratio
    panel.paper.layout.display = "none"  # how to save by a line of Python; here it is a button
    if plain_values(panel.values) != now:
        panel.set(**_given(panel_class, now))
    OPEN.append(panel)
    taken()
    return {
        "panel": len(OPEN) - 1,
        "title": panel.title,
        "widget": panel.described(),
        "values": plain_values(panel.values),
    }


def move(
    panel: int, changes: Sequence[Sequence[Any]], messages: Sequence[Sequence[Any]] = ()
) -> dict[str, Any]:
    """Take what the reader did.

    A change has the widget, the name in its state and the new value; a message has the widget and
    what was said to it: a button that it was pressed, a scene what was dragged.
    """
    explorer = OPEN[panel]
    for identifier, name, value in changes:
        with _shown_in(explorer):
            setattr(WIDGETS[identifier], name, value)
    for identifier, message in messages:
        with _shown_in(explorer):
            WIDGETS[identifier].received(message)
    return _news(explorer)


def picture(panel: int) -> bytes:
    """Return what a panel shows as an SVG, for a paper or a page."""
    with TemporaryDirectory() as folder:
        return OPEN[panel].save(Path(folder) / "picture.svg").read_bytes()


def _news(panel: Explorer) -> dict[str, Any]:
    changed, messages = taken()
    return {"changed": changed, "messages": messages, "values": plain_values(panel.values)}


@contextmanager
def _shown_in(panel: Explorer) -> Iterator[None]:
    """What is unforeseen stands as a traceback in the panel, and goes no further."""
    try:
        yield
    except Exception:
        if ERROR_CLASS not in panel.message.value:
            raise


def _preset(panel_class: type[Explorer], values: Mapping[str, Any]) -> str | None:
    """The preset that some values are, if any."""
    starts = {control.name: control.start for control in panel_class.controls}
    for name, preset in panel_class.presets.items():
        if plain_values({**starts, **preset}) == values:
            return name
    return None


def _given(panel_class: type[Explorer], values: Mapping[str, Any]) -> dict[str, Any]:
    """Values from a page, where a number does not say whether it is whole, and none is infinite."""
    controls = {control.name: control for control in panel_class.controls}
    return {
        name: _like(controls[name], value) if name in controls else value
        for name, value in values.items()
    }


def _like(control: Control, value: Any) -> Any:
    if isinstance(control.start, float):
        value = float(value)
    return next((option for option in control.options if option == value), value)
