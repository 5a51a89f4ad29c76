"""A still picture that stands where a live widget cannot.

The page of a notebook prefers the widget to every picture in the same output, even if all it can
say is that there is no such widget any more: a day later, in a file without a kernel, in print. So
the picture is an output of its own, and hides as long as the widget lives beside it.
"""

import base64
import html
import json
import math
from collections.abc import Mapping
from typing import Any

from ipywidgets import DOMWidget

from .widget_view import widget_view

STILL_CLASS = "driftlab-still"
"""HTML class of a still; its style and the tests look for it."""

# In JupyterLab, Notebook and nbconvert's pages. A widget that was found has parts; one that was
# not is a sentence, which the still makes superfluous.
STYLE = f"""
.jp-OutputArea:has(.jupyter-widgets *) .{STILL_CLASS} {{ display: none; }}
.jp-OutputArea:has(.{STILL_CLASS}) .jp-OutputArea-output.jupyter-widgets:not(:has(*)) {{
  display: none;
}}
"""


def still(
    picture: bytes, kind: str, description: str, panel: str, values: Mapping[str, Any]
) -> str:
    """Return HTML with a picture and the sentence that says how to have the live one.

    `kind` is that of the file, such as "jpeg" or "svg+xml". The figure says which panel it is
    of, and with which values: a page that can run Python by itself makes the panel live in its
    place.
    """
    source = f"data:image/{kind};base64,{base64.b64encode(picture).decode()}"
    # JSON is full of double quotes, so the attribute stands between single ones.
    text = json.dumps(plain_values(values), ensure_ascii=False, allow_nan=False)
    data = html.escape(text, quote=False)
    data = data.replace("'", "&#x27;")
    stood = html.escape(
        "This is how it stood when its cell was run. Run the cell again to move it."
    )
    return (
        f'<style>{STYLE}</style><figure class="{STILL_CLASS}" data-panel="{html.escape(panel)}" '
        f"data-values='{data}' style=\"margin: 0\">"
        f'<img src="{source}" alt="{html.escape(description)}" style="max-width: 100%">'
        f"<figcaption>{stood}</figcaption></figure>"
    )


def plain_values(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return values as JSON has them: what is no finite number is its text, "inf"."""
    return {
        name: str(value) if isinstance(value, float) and not math.isfinite(value) else value
        for name, value in values.items()
    }


def display_with_still(widget: DOMWidget, picture: str, description: str) -> None:
    """Show a widget, and, wherever it does not live, the picture that `still` returns."""
    from IPython.display import display  # where a page shows nothing so, panels do without it

    live = {**widget_view(widget), "text/plain": description}
    for bundle in (live, {"text/html": picture, "text/plain": ""}):
        display(bundle, raw=True)  # type: ignore[no-untyped-call]
