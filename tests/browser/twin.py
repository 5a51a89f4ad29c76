"""A panel on a page beside the same panel in the process of the tests."""

from __future__ import annotations

import html
import io
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from panel_page import PanelPage
from PIL import Image
from places import Place

from driftlab import book
from driftlab.book.machinery.panel import Explorer
from panel_numbers import assert_shown, results_of

if TYPE_CHECKING:
    from playwright.sync_api import Page


class Panel(NamedTuple):
    """A panel on a page, and the same explorer here."""

    shown: PanelPage
    twin: Explorer

    @classmethod
    def on(cls, page: Page, place: Place) -> Panel:
        """Find the panel of a place in the book on a page."""
        explorer_class = getattr(book, place.explorer)
        return cls(PanelPage(page, explorer_class), explorer_class(*place.arguments))

    def reset(self) -> None:
        """Go back to the values at the start."""
        self.shown.reset()
        self.twin.reset.click()

    def assert_agrees(self) -> None:
        """Fail unless all on display belongs to the values on display."""
        values = self.shown.values()
        self.twin.set(**values)
        assert self.twin.message.value == ""
        assert self.shown.numbers() == results_of(self.twin)
        assert f"<pre>{html.escape(self.shown.code())}</pre>" == self.twin.code.value
        pictures = (self.shown.picture(), self.twin.view.widget.value)
        pixels = [np.asarray(Image.open(io.BytesIO(file))) for file in pictures]
        np.testing.assert_array_equal(*pixels, err_msg=f"not the picture of {values}")
        assert_shown(type(self.twin).__name__, values, self.shown.numbers())
