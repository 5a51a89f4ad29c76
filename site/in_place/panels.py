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
    name: str, values: Mapping[str, Any], link: Mapping[str, str] | None = None, ratio: float = 1.0
) -> dict[str, Any]:
    """Open a panel as it stands in the chapter, then move it to the values of a link, all as text.

    Return its number, title, widgets and values, and what is wrong with the link.
    """
    panel_class = getattr(driftlab.book, name)  # of its chapter alone, which takes less time
    panel = panel_class(_preset(panel_class, values))
    panel.page.ratio = ratio
    panel.paper.layout.display = "none"  # how to save by a line of Python; here it is a button
    if plain_values(panel.values) != values:
        panel.set(**_given(panel_class, values))
    refused = ""
    if link:
        try:
            panel.set(**_read(panel_class, link))
        except ValueError as error:
            refused = f"This link does not fit the panel. {error}"
    OPEN.append(panel)
    taken()
    return {
        "panel": len(OPEN) - 1,
        "title": panel.title,
        "widget": panel.described(),
        "values": plain_values(panel.values),
        "refused": refused,
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


def set(panel: int, link: Mapping[str, str]) -> dict[str, Any]:
    """Move a panel to the values of a link; ValueError if they do not fit it."""
    explorer = OPEN[panel]
    with _shown_in(explorer):
        explorer.set(**_read(type(explorer), link))
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


def _read(panel_class: type[Explorer], link: Mapping[str, str]) -> dict[str, Any]:
    """Values from the text of a link; ValueError if they do not fit the panel."""
    controls = {control.name: control for control in panel_class.controls}
    # Here, since `set(**values)` takes some names, like self, for something else.
    for name in link:
        if name not in controls:
            raise ValueError(f"values: expected names from {', '.join(controls)}, got {name}.")
    values: dict[str, Any] = {}
    for name, text in link.items():
        control = controls[name]
        if isinstance(control.start, str):
            values[name] = text
        elif control.is_box:
            values[name] = {"true": True, "false": False}.get(text, text)
        else:
            try:
                values[name] = type(control.start)(text)
            except ValueError:
                raise ValueError(f"{name}: expected a number, got {text!r}.") from None
    return _given(panel_class, values)
