"""A panel on a page beside the same panel in the process of the tests."""

from __future__ import annotations

import html
import io
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from panel_page import PanelPage
from PIL import Image
from places import Place

from driftlab import book
from driftlab.book.machinery.panel.panel import Explorer
from panel_numbers import Rows, assert_shown, results_of

if TYPE_CHECKING:
    from playwright.sync_api import Page


class Display(NamedTuple):
    """All that a panel shows for some values of its controls."""

    numbers: Rows
    code: str
    alt: str
    pixels: NDArray[Any]


@dataclass
class Panel:
    """A panel on a page, and the same explorer here, which draws once for the same values."""

    shown: PanelPage
    twin: Explorer
    start: dict[str, Any]
    """Values of the controls when a reader opens it."""
    _drawn: dict[tuple[Any, ...], Display] = field(default_factory=dict)

    @classmethod
    def on(cls, page: Page, place: Place) -> Panel:
        """Find the panel of a place in the book on a page."""
        explorer_class = getattr(book, place.explorer)
        twin = explorer_class(*place.arguments)
        return cls(PanelPage(page, explorer_class), twin, twin.values)

    def expected(self, values: dict[str, Any]) -> Display:
        """What the panel must show for some values; its numbers are those of the package."""
        key = tuple(values[control.name] for control in self.twin.controls)
        if key not in self._drawn:
            self.twin.set(**values)
            assert self.twin.message.value == ""
            numbers = results_of(self.twin)
            assert_shown(type(self.twin).__name__, values, numbers)
            self._drawn[key] = Display(
                numbers,
                self.twin.code.value,
                self.twin.page.alt,
                _pixels(self.twin.view.widget.value),
            )
        return self._drawn[key]

    def assert_agrees(self) -> None:
        """Fail unless all on display belongs to the values on display."""
        values = self.shown.values()
        expected = self.expected(values)
        assert self.shown.numbers() == expected.numbers
        assert f"<pre>{html.escape(self.shown.code())}</pre>" == expected.code
        np.testing.assert_array_equal(
            _pixels(self.shown.picture()), expected.pixels, err_msg=f"not the picture of {values}"
        )


def _pixels(file: bytes) -> NDArray[Any]:
    return np.asarray(Image.open(io.BytesIO(file)))
