"""What each sensor error does to the heading of an aligned compass: by term, and exactly."""

import numpy as np
from matplotlib.patches import Rectangle
from matplotlib.ticker import MaxNLocator

from driftlab.book.machinery.picture import (
    BLACK,
    GUIDE,
    SERIES,
    Picture,
    legend_above,
    legend_below_all,
)
from driftlab.checks import FloatArray

from ..experiments import TERMS, AlignmentBudget

STEPS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 180.0)
"""How far the axes may reach, degrees."""


def columns(data: AlignmentBudget) -> dict[str, FloatArray | list[str]]:
    """Columns of the figure's CSV: the bars, the curves over all headings, and the one heading."""
    return {
        "term": list(TERMS),
        "error_deg": np.degrees(data.bars),
        "heading_deg": np.degrees(data.headings),
        "first_order_deg": np.degrees(data.first_order),
        "exact_deg": np.degrees(data.exact),
        "this_heading_deg": np.degrees([data.heading]),
        "this_error_deg": np.degrees(data.bars[-1:]),
    }


class AlignmentBudgetPicture(Picture[AlignmentBudget]):
    """Bars by term on the left, the error over all headings on the right."""

    size = (10.5, 3.7)

    def build(self) -> None:
        self.figure, panels = self.sheet.mosaic(
            "ab", self.size, (0.155, 0.13, 0.985, 0.91), spaces=(0.16, 0.2),
            width_ratios=(1, 1.15), column_height=4.8, page_height=2.9,
        )  # fmt: skip
        self.left, self.right = left, right = panels["a"], panels["b"]
        rows = np.arange(len(TERMS))
        left.set_yticks(rows, TERMS)
        left.set(title="heading error by term, °")
        left.set_ylim(len(TERMS) - 0.4, -0.6)
        left.xaxis.set_major_locator(MaxNLocator(5))
        left.axvline(0, color=BLACK, linewidth=0.8, label=GUIDE)
        left.axhline(3.5, color=BLACK, linewidth=0.8, linestyle=":")
        styles = [*(SERIES[0],) * 4, SERIES[1], SERIES[4]]
        self.bars = left.barh(rows, np.zeros(len(TERMS)), 0.6)
        for bar, style in zip(self.bars, styles, strict=True):
            bar.set_color(style["color"])
            self.moving.append(bar)
        right.set(title="at all headings, °", xlim=(-180, 180))
        right.set_xticks([-180, -90, 0, 90, 180], ["South", "East", "North", "West", "South"])
        # They lie close together: one wide, the other narrow.
        wide, narrow = (1.8, 0.5) if self.sheet.on_paper else (1.6, 0.9)
        self.first_order = self.line(right, **SERIES[1], linewidth=wide, label="first order")
        self.exact = self.line(right, color=BLACK, linewidth=narrow, label="exact")
        self.here = self.line(
            right, color=BLACK, marker="o", linestyle="none", label="this heading"
        )
        if self.sheet.on_paper:
            handles = [self.first_order, self.exact, self.here]
            legend_below_all(self.figure, self.sheet, handles, ncols=3, column=3)
        else:
            legend_above(right, 3)
        self.hatched, self.reasons = [], []
        for panel in (left, right):
            sheet = Rectangle((0, 0), 1, 1, transform=panel.transAxes, facecolor="#f4f4f4",
                              edgecolor="#9a9a9a", hatch="//", linewidth=0,
                              label=GUIDE)  # fmt: skip
            panel.add_patch(sheet)
            self.moving.append(sheet)
            self.hatched.append(sheet)
            reason = self.words(
                panel,
                transform=panel.transAxes,
                ha="center",
                va="center",
                fontsize="x-large",
                bbox={"facecolor": "white", "edgecolor": "none"},
            )
            reason.set_position((0.5, 0.5))
            self.reasons.append(reason)

    def update(self, data: AlignmentBudget) -> None:
        # A body that points to the zenith or the nadir heads nowhere: no error, and no zero either.
        nowhere = bool(np.isnan(data.bars).all())
        for sheet, reason in zip(self.hatched, self.reasons, strict=True):
            sheet.set_visible(nowhere)
            reason.set_text("no heading exists here" if nowhere else "")
            reason.set_visible(nowhere)
        for bar, value in zip(self.bars, np.degrees(data.bars), strict=True):
            bar.set_width(value)
        self.set_reach(self.left, "x", np.degrees(data.bars), STEPS)
        self.set_reach(self.right, "y", np.degrees([*data.exact, *data.first_order]), STEPS)
        degrees = np.degrees(data.headings)
        self.first_order.set_data(degrees, np.degrees(data.first_order))
        self.exact.set_data(degrees, np.degrees(data.exact))
        self.here.set_data([np.degrees(data.heading)], [np.degrees(data.bars[-1])])
