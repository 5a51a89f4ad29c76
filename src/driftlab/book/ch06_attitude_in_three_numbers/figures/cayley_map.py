"""Both Cayley vectors of a rotation, and how far each is from its singularity; (1.2), (1.3)."""

from typing import Any

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import Drawing
from driftlab.book.machinery.figure.picture import (
    BLACK,
    BLUE,
    GREY,
    GUIDE,
    PURPLE,
    SERIES,
    VERMILION,
    Picture,
    legend_below,
    plain_axes,
    project,
)

from ..experiments import REACH, VECTORS


class CayleyMapPicture(Picture):
    """The turned frame, and both vectors against the angle."""

    size = (10.5, 4.4)

    def build(self) -> None:
        self.figure, panels = self.sheet.mosaic(
            "ab", self.size, (0.01, 0.2, 0.985, 0.92), spaces=(0.13, 0.2), width_ratios=(0.7, 1.6),
            column_height=5.4,
        )  # fmt: skip
        triad, curves = panels["a"], panels["b"]
        on_paper, narrow = self.sheet.on_paper, self.sheet.narrow
        small = "small" if on_paper else 8.5
        plain_axes(triad)
        triad.set_title("body frame, turned about the axis")
        for label, tip in zip(("$i_1$", "$i_2$", "$i_3$"), project(np.eye(3)), strict=True):
            triad.plot([0, tip[0]], [0, tip[1]], color=GREY, linewidth=1.2)
            triad.text(1.12 * tip[0], 1.12 * tip[1], label, ha="center", va="center")
        self.axis = self.line(triad, color=BLACK, linestyle="-.", linewidth=1.2, label="axis")
        self.frame = [self.line(triad, color=PURPLE, marker="o", markersize=4) for _ in range(3)]
        self.frame[0].set_label("turned frame")
        triad.legend(loc="lower left", ncols=2, bbox_to_anchor=(0.05, -0.1))
        curves.set(title="the vector's component along the axis", xlim=(-360, 360))
        curves.set(xlabel=r"angle $\varphi$, °", ylim=(-REACH, REACH))
        curves.set_xticks(range(-360, 361, 90))
        formulas = (
            r"dimension 3: $-\tan(\varphi/2)$",
            r"dimension 4: $-\tan(\varphi/4)$",
            r"shadow of dimension 4: $\cot(\varphi/4)$",
        )
        for name, label, style in zip(VECTORS, formulas, SERIES, strict=False):
            # Drawn once: these curves never move.
            Drawing.curve(self, curves, "angles", f"component, {name}", **style, label=label)
        for angle in (-180, 180):
            curves.axvline(angle, color=BLUE, linewidth=0.8, label=GUIDE)
        for angle in (-360, 360):
            curves.axvline(angle, color=VERMILION, linewidth=2.5, label=GUIDE)
        says = "has no\nend here" if on_paper else "has no end here"
        name = "dim." if narrow else "dimension"
        letters: dict[str, Any] = {"fontsize": small, "linespacing": 1.0 if on_paper else 1.2}
        curves.text(187, 0.95 * -REACH, f"{name} 3\n{says}", va="bottom", **letters)
        curves.text(353, 0.97 * REACH, f"{name} 4\n{says}", va="top", ha="right", **letters)
        self.here = self.line(
            curves, color=BLACK, linewidth=0.8, linestyle=(0, (2, 2)), label=GUIDE
        )
        for name, marker, style in zip(VECTORS, "os^", SERIES, strict=False):
            dot: dict[str, Any] = {"marker": marker, "color": style["color"], "linestyle": "none"}
            dot["markersize"] = 5 if on_paper else 8
            self.curve(curves, "mark_angle", f"mark, {name}", **dot)
        if on_paper:
            legend_below(curves, 1 if narrow else 2)
        else:
            curves.legend(loc="upper center", ncols=3, bbox_to_anchor=(0.5, -0.14))

    def update(self, table: DataTable) -> None:
        self.show(table)
        self.axis.set_data(*project(np.stack([-1.1 * table.axis, 1.1 * table.axis])).T)
        for line, tip in zip(self.frame, project(table.turned), strict=True):
            line.set_data([0, tip[0]], [0, tip[1]])
        self.here.set_data([table.shown("angle")] * 2, [-REACH, REACH])
