"""The output by which a page shows a widget, whatever ipywidgets calls its own way to it."""

from typing import Any

from ipywidgets import DOMWidget

KIND = "application/vnd.jupyter.widget-view+json"


def widget_view(widget: DOMWidget) -> dict[str, Any]:
    """Return what shows a widget, by its MIME type; ipywidgets hands it out from 8.0 on only."""
    return {KIND: {"version_major": 2, "version_minor": 0, "model_id": widget.model_id}}
