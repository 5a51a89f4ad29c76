"""What a rotation scheme shows: eigenvalues of the Gramian, and the accuracy to expect."""

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.picture import BLACK, BLUE, GREY, GUIDE, VERMILION, Picture

from ..experiments import DRAWN_ZERO, SLOTS

DARK_GREY = "#5c5c5c"


def caption(table: DataTable) -> str:
    """Say how many eigenvalues are zero, and how many sensor errors become known."""
    zeros = "1 eigenvalue of the Gramian is" if table.unobservable == 1 else (
        f"{table.unobservable} eigenvalues of the Gramian are"
    )  # fmt: skip
    ratios = table.deviation_after_over_before
    return (
        f"{len(table.names)} states on {table.positions} positions. Left: {zeros} zero to "
        "rounding (crosses). Right: σ of each sensor error after the scheme, divided by its prior; "
        f"{np.count_nonzero(ratios < 0.1)} of {len(ratios)} become known to a tenth or better. "
        "Defaults: all 30 states, nineteen positions; there biases and scale-factor errors still "
        "become known, and of the off-diagonal entries only combinations."
    )


class TableObservabilityPicture(Picture):
    """Eigenvalues on the left, accuracy of each sensor error on the right."""

    def build(self) -> None:
        self.figure, panels = self.sheet.mosaic(
            "ab", (10.5, 4.0), (0.065, 0.27, 0.99, 0.91), spaces=(0.16, 0.2),
            width_ratios=(0.62, 1.0), page_height=3.3, column_height=5.0,
        )  # fmt: skip
        values, ratios = panels["a"], panels["b"]
        values.set(title="how strongly each direction shows", yscale="log")
        values.set(xlabel="eigenvalue of the Gramian, by size")
        values.set(xlim=(0, 31), ylim=(DRAWN_ZERO / 10, 10), ylabel="relative to the largest")
        values.set_yticks([1e-12, 1e-9, 1e-6, 1e-3, 1])
        values.axhline(DRAWN_ZERO, color=GREY, linewidth=0.8, label=GUIDE)
        values.text(30.5, 1.7 * DRAWN_ZERO, "zero: not observable", color=DARK_GREY, ha="right",
                    fontsize="medium" if self.sheet.on_paper else 8.5)  # fmt: skip
        small, large = (2.5, 4) if self.sheet.on_paper else (4, 7)
        self.bright, self.unobservable = (
            self.curve(
                values, "direction", "eigenvalue_relative", where={"direction_is": label},
                **style, linestyle="none", label=label,
            )
            for label, style in (
                ("observable", {"color": BLUE, "marker": "o", "markersize": small}),
                ("not observable", {"color": VERMILION, "marker": "X", "markersize": large}),
            )
        )  # fmt: skip
        narrow = "deviation after the scheme, over that before"
        ratios.set(title=narrow if self.sheet.narrow else f"{narrow}: lower is better")
        ratios.set(yscale="log")
        ratios.set(xlim=(-0.7, len(SLOTS) - 0.3), ylim=(5e-4, 2))
        self.ratio_axes = ratios
        ratios.axhline(1.0, color=BLACK, linewidth=0.8, label=GUIDE)
        if self.sheet.narrow:
            ratios.set_xticks(range(len(SLOTS)), SLOTS, rotation=90, fontsize=5.6)
        else:
            size = 6.5 if self.sheet.on_paper else 7.5
            ratios.set_xticks(range(len(SLOTS)), SLOTS, rotation=55, ha="right", fontsize=size)
        self.ratios = self.curve(
            ratios, "place", "deviation_after_over_before", color=BLUE, marker="o",
            markersize=3 if self.sheet.on_paper else 5, linestyle="none", label="sensor errors",
        )  # fmt: skip

    def update(self, table: DataTable) -> None:
        self.show(table)
        low = 5e-4 if table.deviation_after_over_before.min() >= 5e-4 else 1e-5
        self.set_limits(self.ratio_axes, "y", low, 2.0)


draw = TableObservabilityPicture.draw
