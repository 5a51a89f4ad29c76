"""A panel on a page beside the same panel in the process of the tests."""

from __future__ import annotations

import html
import io
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from panel_page import PanelPage
from PIL import Image
from places import Place

from driftlab import book
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Explorer
from driftlab.book.machinery.scene.view import SceneExplorer
from panel_numbers import results_of

if TYPE_CHECKING:
    from playwright.sync_api import Page


def ends(control: Control, now: object) -> list[tuple[str, object]]:
    """Keys that bring a control to its ends, or a line to its examples, and the values there."""
    if control.is_box:
        return [("Space", not now), ("Space", now)]
    if control.examples:
        return [("Enter", control.examples[0]), ("Enter", control.examples[-1])]
    listed = control.options or (control.low, control.high)
    return [("End", listed[-1]), ("Home", listed[0])]


@dataclass
class Panel:
    """A panel on a page, and the same explorer here."""

    shown: PanelPage
    twin: Explorer
    start: dict[str, Any]
    """Values of the controls when a reader opens it."""

    @classmethod
    def on(cls, page: Page, place: Place) -> Panel:
        """Find the panel of a place in the book on a page."""
        explorer_class = getattr(book, place.explorer)
        twin = explorer_class(*place.arguments)
        return cls(PanelPage(page, explorer_class), twin, twin.values)

    @property
    def is_picture(self) -> bool:
        """Tell whether it is no scene; what a scene draws has tests of its own."""
        return not isinstance(self.twin, SceneExplorer)

    def sweep(self, *, apart: bool = False) -> None:
        """Bring each control to both ends by its keys; the kernel must answer with these values.

        The code comes from there. What else belongs to the values is compared at the end only: the
        tests without a browser sweep the same panel. `apart`: each control from the opening values,
        in a panel that refuses the ends of several together.
        """
        shown, place, opening = self.shown, self.shown.place(), self.shown.preset()
        values = dict(self.start)
        for control in self.twin.controls:
            if apart:
                shown.choose_preset(opening)
                values = dict(self.start)
            element = shown.element(control)
            element.focus()
            for key, value in ends(control, values[control.name]):
                if control.examples:
                    element.fill(str(value))
                shown.page.keyboard.press(key)
                shown.settle()
                values[control.name] = value if isinstance(value, str) else pytest.approx(value)
                found = shown.values()
                assert found == values
                assert shown.code() == self.twin.call(found), (control.name, value)
                if self.is_picture:
                    assert shown.place() == place, "the picture does not stay in its place"
        self.assert_agrees()

    def assert_agrees(self) -> None:
        """Fail unless numbers, code and picture on display belong to the values on display."""
        shown, twin, values = self.shown, self.twin, self.shown.values()
        if twin.values != values:
            twin.set(**values)
        assert shown.numbers() == results_of(twin)
        assert f"<pre>{html.escape(shown.code())}</pre>" == twin.code.value
        if self.is_picture:
            found, expected = (
                np.asarray(Image.open(io.BytesIO(file)))
                for file in (shown.picture(), twin.view.widget.value)
            )
            np.testing.assert_array_equal(found, expected, err_msg=f"not the picture of {values}")
