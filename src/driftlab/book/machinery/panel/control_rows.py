"""How the controls of a panel stand: by groups, sliders in columns, boxes to tick in a row."""

from __future__ import annotations

import html
from collections.abc import Mapping, Sequence
from typing import Any

import ipywidgets as widgets

from .control import Control


def control_rows(
    controls: Sequence[Control], by_name: Mapping[str, widgets.Widget]
) -> list[widgets.Box]:
    """Return the widgets of all controls in rows.

    Boxes to tick and lines of text go across, one row a group; below them the sliders stand in
    columns, one a group.
    """
    groups: dict[str, list[Control]] = {}
    for control in controls:
        groups.setdefault(control.group, []).append(control)
    across: list[widgets.Box] = []
    columns = []
    for group, members in groups.items():
        heading = [widgets.HTML(html.escape(group))] if group else []
        row = [*heading, *(by_name[control.name] for control in members)]
        if all(control.is_box for control in members):
            box = widgets.HBox(row, layout={"flex_flow": "row wrap", "align_items": "center"})
            across.append(with_class(box, "driftlab-boxes"))
        elif all(control.examples for control in members):
            across.append(widgets.VBox(row))
        else:
            columns.append(with_class(widgets.VBox(row), "driftlab-group"))
    return [*across, with_class(widgets.HBox(columns), "driftlab-groups")]


def with_class(widget: Any, name: str) -> Any:
    """Return the widget with an HTML class, which page.css looks for."""
    widget.add_class(name)
    return widget
