"""What each sensor error does to the heading of an aligned compass: by term, and exactly."""

import numpy as np
from matplotlib.artist import Artist
from matplotlib.patches import Rectangle
from matplotlib.ticker import MaxNLocator

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import Rows
from driftlab.book.machinery.figure.picture import (
    BLACK,
    GUIDE,
    SERIES,
    Picture,
    legend_above,
    legend_below_all,
)

from ..experiments import TERMS

STEPS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 180.0)
"""How far the axes may reach, degrees."""


class AlignmentBudgetPicture(Picture):
    """Bars by term on the left, the error over all headings on the right."""

    size = (10.5, 3.7)

    def build(self) -> None:
        self.figure, panels = self.sheet.mosaic(
            "ab", self.size, (0.155, 0.13, 0.985, 0.91), spaces=(0.16, 0.2),
            width_ratios=(1, 1.15), column_height=4.8, page_height=2.9,
        )  # fmt: skip
        self.left, self.right = left, right = panels["a"], panels["b"]
        rows = np.arange(len(TERMS), dtype=float)
        left.set_yticks(rows, TERMS)
        left.set(title="heading error by term, °")
        left.set_ylim(len(TERMS) - 0.4, -0.6)
        left.xaxis.set_major_locator(MaxNLocator(5))
        left.axvline(0, color=BLACK, linewidth=0.8, label=GUIDE)
        left.axhline(3.5, color=BLACK, linewidth=0.8, linestyle=":", label=GUIDE)
        styles = [*(SERIES[0],) * 4, SERIES[1], SERIES[4]]
        bars = left.barh(rows, np.zeros(len(TERMS)), 0.6)
        self.bars = self.record(left, bars, [Rows("error", rows)])
        for bar, style in zip(self.bars, styles, strict=True):
            bar.set_color(style["color"])
            self.moving.append(bar)
        right.set(title="at all headings, °", xlim=(-180, 180))
        right.set_xticks([-180, -90, 0, 90, 180], ["South", "East", "North", "West", "South"])
        # They lie close together: one wide, the other narrow.
        wide, narrow = (1.8, 0.5) if self.sheet.on_paper else (1.6, 0.9)
        self.curve(
            right, "at_heading", "first_order", **SERIES[1], linewidth=wide, label="first order"
        )
        self.curve(right, "at_heading", "exact", color=BLACK, linewidth=narrow, label="exact")
        here = {"color": BLACK, "marker": "o", "linestyle": "none", "label": "this heading"}
        self.curve(right, "this_heading", "this_error", **here)
        if self.sheet.on_paper:
            legend_below_all(self.figure, self.sheet, right, ncols=3, column=3)
        else:
            legend_above(right, 3)
        self.nowhere: list[Artist] = []  # over each panel a hatched sheet, and why
        for panel in (left, right):
            sheet = Rectangle((0, 0), 1, 1, transform=panel.transAxes, facecolor="#f4f4f4",
                              edgecolor="#9a9a9a", hatch="//", linewidth=0,
                              label=GUIDE)  # fmt: skip
            reason = panel.text(
                0.5, 0.5, "no heading exists here", transform=panel.transAxes, ha="center",
                va="center", fontsize="x-large", bbox={"facecolor": "white", "edgecolor": "none"},
            )  # fmt: skip
            self.nowhere += [panel.add_patch(sheet), reason]
        self.moving += self.nowhere

    def update(self, table: DataTable) -> None:
        self.show(table)
        # A body that points to the zenith or the nadir heads nowhere: no error, and no zero either.
        nowhere = bool(np.isnan(table.error).all())
        for artist in self.nowhere:
            artist.set_visible(nowhere)
        for bar, value in zip(self.bars, table.shown("error"), strict=True):
            bar.set_width(value)
        self.set_reach(self.left, "x", table.shown("error"), STEPS)
        shown = [*table.shown("exact"), *table.shown("first_order")]
        self.set_reach(self.right, "y", shown, STEPS)
