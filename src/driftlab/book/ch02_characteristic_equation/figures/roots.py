"""Roots of the characteristic equation against the size of the deformation; Larin (2.1), (2.2)."""

from typing import Any

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.picture import BLACK, GUIDE, SERIES, Picture, legend_below

from ..experiments import FORMULAS

SLOW_REACHES = (0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0)
"""How far the axis of the slow root may reach."""
PLANE_REACHES = (3.2, 5.0, 10.0, 20.0, 50.0)
"""How far the complex plane may reach."""


class RootsPicture(Picture):
    """Complex plane, the slow root over size, and errors over size."""

    size = (10.5, 4.2)

    def build(self) -> None:
        self.figure, panels = self.sheet.mosaic(
            "abc", self.size, (0.06, 0.26, 0.985, 0.92), spaces=(0.3, 0.2),
            width_ratios=(0.45, 1.15, 1.25), column="ab;cc", column_height=5.2, page_height=3.4,
        )  # fmt: skip
        plane, course, error = panels.values()
        self.plane_axes, self.course_axes, self.error_axes = plane, course, error
        plane.set(title="complex plane", xlabel=r"Re $s/|\omega|$")
        plane.set(ylabel=r"Im $s/|\omega|$", xlim=(-1, 1), ylim=(-3.2, 3.2))
        plane.axvline(0, color=BLACK, linewidth=0.8, label=GUIDE)
        self.names = [self.words(plane, fontsize="small") for _ in range(3)]
        narrow = self.sheet.narrow
        course.set(
            title="the slow root" if narrow else "the slow root as the bend grows",
            xlabel=r"size of deformation $\mu$",
        )
        course.set(ylabel=r"Im $s/|\omega|$", xlim=(0, 0.5))
        error.set(title="how far a formula is off the exact root")
        error.set(xlabel=r"size of deformation $\mu$", ylabel=r"error$/|\omega|$")
        error.set(xscale="log", yscale="log", xlim=(1e-4, 0.5), ylim=(1e-13, 10))
        for (name, label), marker, style in zip(FORMULAS.items(), "ox+s", SERIES, strict=False):
            point = {"marker": marker, "color": style["color"], "linestyle": "none"}
            if marker in "os":
                point |= {"fillstyle": "none", "markersize": 9 if marker == "o" else 5}
            self.curve(plane, f"plane, {name}, real", f"plane, {name}, imaginary", **point)
            self.curve(course, "sizes", f"root, {name}, slow", **style, label=label)
        self.here = [
            self.line(axes, color=BLACK, linewidth=0.8, linestyle=(0, (2, 2)), label=GUIDE)
            for axes in (course, error)
        ]
        drawn = {
            "first order, fast": "first order",
            "second order, fast": "with the next term",
            "in the copy, fast": "one term missing: fast root",
            "in the copy, slow": "one term missing: slow root",
        }
        for (name, label), style in zip(drawn.items(), SERIES[1:], strict=False):
            self.curve(error, "sizes", f"error, {name}", **style, label=label)
        for axes in (course, error):
            if self.sheet.on_paper:
                legend_below(axes, 1 if axes is course else 2)
            else:
                place: dict[str, Any] = {"loc": "upper center", "bbox_to_anchor": (0.5, -0.17)}
                axes.legend(ncols=2, columnspacing=1.2, frameon=False, **place)

    def update(self, table: DataTable) -> None:
        self.show(table)
        self.set_reach(self.course_axes, "y", table.root[:, 1], SLOW_REACHES)
        for direction, parts, steps in (
            ("x", table.roots.real, (1.0, *PLANE_REACHES)),
            ("y", table.roots.imag, PLANE_REACHES),
        ):
            self.set_reach(self.plane_axes, direction, np.append(parts, -parts), steps)
        across, reach = self.plane_axes.get_xlim()[1], self.plane_axes.get_ylim()[1]
        fast = table.roots[0, 0].imag
        places = (fast + 0.06 * reach, -fast - 0.11 * reach, 0.14 * reach)
        for words, height, name in zip(
            self.names, places, ("fast", "fast", "slow pair"), strict=True
        ):
            words.set(text=name, x=0.14 * across, y=height)
        for line, axes in zip(self.here, (self.course_axes, self.error_axes), strict=True):
            line.set_data([table.size, table.size], axes.get_ylim())
