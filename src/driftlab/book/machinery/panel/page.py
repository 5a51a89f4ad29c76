"""The panels' part in the page: their script and style, and what the page is asked for.

Script and style come in a widget of their own, which shows nothing: it works wherever widgets do,
also where a page refuses outputs with scripts.
"""

from importlib.resources import files

import anywidget
import traitlets


class Page(anywidget.AnyWidget):
    """Names what ipywidgets leaves without a name, keeps the keys for the panel, and measures."""

    _esm = (files(__package__) / "page.js").read_text("utf-8")
    _css = (files(__package__) / "page.css").read_text("utf-8")
    # what the panel's picture shows, for those who do not see it
    alt = traitlets.Unicode().tag(sync=True)
    # pixels of the screen for one of the page; the page sets it
    ratio = traitlets.Float(1.0).tag(sync=True)
