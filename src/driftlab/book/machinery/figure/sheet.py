"""What a figure is drawn on: a screen, or paper of a width, where its panels stand otherwise.

On a screen a figure has its own size and its own margins, and an explorer's picture is that one.
In a journal it must fit a column or a page: type has the size of print, panels that stand side by
side on a screen stand one above the other in a column, and Matplotlib finds the room for labels.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.resources import as_file, files
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from driftlab.checks import positive_number

from ..one_at_a_time import ONE_AT_A_TIME

COLUMN, PAGE = 3.5, 7.2
"""Widths of a column and of a page of two columns in most journals, inches."""
LEAST, MOST = 3.0, 12.0
"""Widths that a figure can be drawn in; the book's largest is wider than any page."""
NARROW = 5.0
"""Below this width, in inches, panels stand one above the other."""
_BETWEEN = 0.06
"""Room between panels on paper, inches."""

with as_file(files(__package__) / "driftlab.mplstyle") as _path:
    STYLE = matplotlib.rc_params_from_file(_path, use_default_template=True)
PRINT = matplotlib.RcParams({
    **STYLE,
    "font.size": 7.5,
    "axes.titlesize": 8,
    "axes.titlelocation": "left",
    "axes.labelsize": 7.5,
    "axes.linewidth": 0.6,
    "grid.linewidth": 0.4,
    "legend.fontsize": 7,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "lines.linewidth": 1.1,
    "lines.markersize": 3.5,
    "pdf.fonttype": 42,  # TrueType, embedded; journals refuse type 3
    "savefig.dpi": 600,
    "figure.constrained_layout.w_pad": _BETWEEN,
    "figure.constrained_layout.h_pad": _BETWEEN,
})  # fmt: skip


@contextmanager
def drawn_in(style: matplotlib.RcParams) -> Iterator[None]:
    """Draw in a style, while no other thread draws in another."""
    with ONE_AT_A_TIME, matplotlib.rc_context(style):
        yield


@dataclass(frozen=True)
class Sheet:
    """What a figure is drawn on."""

    width: float | None = None  # inches; None for a screen, where each figure has a size of its own

    def __post_init__(self) -> None:
        if self.width is not None:
            width = positive_number(self.width, "width")
            if not LEAST <= width <= MOST:
                inches = f": in mm? {width:g} / 25.4." if LEAST <= width / 25.4 <= MOST else "."
                raise ValueError(
                    f"width: expected inches between {LEAST:g} and {MOST:g}, such as {COLUMN:g} "
                    f"for a column and {PAGE:g} for a page, got {width:g}{inches}"
                )

    @property
    def on_paper(self) -> bool:
        """Whether it has the type and the layout of print."""
        return self.width is not None

    @property
    def narrow(self) -> bool:
        """Whether it is a column, in which panels stand one above the other."""
        return self.width is not None and self.width < NARROW

    @property
    def style(self) -> matplotlib.RcParams:
        """Matplotlib's settings for it."""
        return PRINT if self.on_paper else STYLE

    def mosaic(
        self,
        wide: str,
        size: tuple[float, float],
        margins: tuple[float, float, float, float],
        *,
        column: str | None = None,
        column_height: float | None = None,
        page_height: float | None = None,
        spaces: tuple[float, float] = (0.2, 0.2),
        width_ratios: Sequence[float] | None = None,
        height_ratios: Sequence[float] | None = None,
        column_heights: Sequence[float] | None = None,
        **settings: Any,
    ) -> tuple[Figure, dict[str, Axes]]:
        """Return a figure and its panels, by the letters that place them.

        Panels are placed as `Figure.subplot_mosaic` reads them, rows between semicolons
        (``"ab;ac"``): `wide` on a screen or a page, `column` in a narrow column, where they stand
        one above the other if it is not given. Sizes and heights are in inches; on paper a column
        has two for each row and a little, a page a tenth more than the screen. Margins (left,
        bottom, right, top) are parts of the figure on a screen, `spaces` (``wspace``, ``hspace``)
        parts of a panel. `column_heights` are ratios of the rows of `column`; further settings are
        those of `Figure.subplot_mosaic`.
        """
        if self.width is None:
            figure = Figure(figsize=size)
            panels = figure.subplot_mosaic(
                wide, width_ratios=width_ratios, height_ratios=height_ratios, **settings
            )
            figure.subplots_adjust(*margins, *spaces)
            return figure, panels
        if not self.narrow:
            height = page_height or 1.1 * size[1] * self.width / size[0]
            figure = Figure(figsize=(self.width, height), layout="constrained")
            return figure, figure.subplot_mosaic(
                wide, width_ratios=width_ratios, height_ratios=height_ratios, **settings
            )
        letters = dict.fromkeys(letter for letter in wide if letter not in "; .\n")
        rows = column or ";".join(letters)
        height = column_height or 0.3 + 2.0 * (rows.count(";") + 1)
        figure = Figure(figsize=(self.width, height), layout="constrained")
        return figure, figure.subplot_mosaic(rows, height_ratios=column_heights, **settings)


SCREEN = Sheet()
