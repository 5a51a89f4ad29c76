"""A Matplotlib picture in a panel, redrawn at each move of a slider.

The picture is kept for the panel's life: its background is drawn once for each reach of the axes, a
move redraws only the artists that move, and the result goes as a JPEG into an image widget. At this
quality nobody sees the difference, and a PNG takes several times as long to make. There is no
output area to flicker or to swallow an error.
"""

from __future__ import annotations

import io
from typing import Any

import ipywidgets as widgets
from PIL import Image

from ..figure.picture import Picture
from ..figure.sheet import STYLE, drawn_in
from ..one_at_a_time import one_at_a_time
from .page import Page

LEAST_RATIO, MOST_RATIO = 1.25, 2.0
"""Pixels of the picture for one of the page: more are sharper, and take longer to compress."""

KEPT = 8
"""Backgrounds that a view keeps: a slider may move to and fro over a step of the axes."""


class MatplotlibView:
    """What draws a `Picture` for an explorer."""

    def __init__(self, picture: Picture, page: Page) -> None:
        self.picture = picture
        self._page = page
        for artist in picture.moving:
            artist.set_animated(True)
        canvas: Any = picture.figure.canvas  # Matplotlib says nothing of the types of its methods
        self._canvas = canvas
        self._dpi = picture.figure.dpi
        self._backgrounds: dict[Any, Any] = {}
        width, _ = canvas.get_width_height()
        self.widget = widgets.Image(format="jpeg", width=width)
        self._take_ratio()
        page.observe(self._ratio_told, "ratio")

    def _take_ratio(self) -> None:
        ratio = min(max(self._page.ratio, LEAST_RATIO), MOST_RATIO)
        self.picture.figure.dpi = ratio * self._dpi
        self.picture.rescaled = True  # nothing has been drawn at this size yet

    @one_at_a_time
    def _ratio_told(self, _: Any) -> None:
        self._take_ratio()
        if self.widget.value:
            self.widget.value = self._jpeg()

    def show(self, data: Any) -> None:
        """Bring the picture up to date."""
        self.picture.update(data)
        self.widget.value = self._jpeg()

    def still(self) -> tuple[bytes, str]:
        """Return the picture as it stands, and what kind of file it is."""
        return self.widget.value, "jpeg"

    def _draw_background(self) -> None:
        """Draw what does not move, or take it from what has been drawn with these limits before."""
        figure = self.picture.figure
        limits = tuple((axes.get_xlim(), axes.get_ylim()) for axes in figure.axes)
        key = (figure.dpi, limits)
        background = self._backgrounds.pop(key, None)
        if background is None:
            with drawn_in(STYLE):
                self._canvas.draw()
            background = self._canvas.copy_from_bbox(figure.bbox)
            if len(self._backgrounds) == KEPT:
                del self._backgrounds[next(iter(self._backgrounds))]
        self._backgrounds[key] = self.background = background  # the last used is the last
        self.picture.rescaled = False

    def _jpeg(self) -> bytes:
        canvas: Any = self._canvas
        if self.picture.rescaled:
            self._draw_background()
        canvas.restore_region(self.background)
        with drawn_in(STYLE):
            for artist in self.picture.moving:
                artist.axes.draw_artist(artist)  # type: ignore[union-attr]
        buffer = io.BytesIO()
        pixels = canvas.buffer_rgba()
        # X: the fourth byte means nothing. The picture is opaque.
        picture = Image.frombuffer("RGBX", canvas.get_width_height(), pixels, "raw", "RGBX", 0, 1)
        # Colours as fine as the rest, or thin coloured lines would fade.
        picture.save(buffer, format="jpeg", quality=90, subsampling=0)
        return buffer.getvalue()
