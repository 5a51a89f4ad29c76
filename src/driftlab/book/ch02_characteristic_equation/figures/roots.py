"""Roots of the characteristic equation against the size of the deformation; Larin (2.1), (2.2)."""

from typing import Any

import numpy as np

from driftlab.book.machinery.picture import BLACK, GUIDE, SERIES, Picture, legend_below
from driftlab.checks import FloatArray

from ..experiments import FORMULAS, Roots, root_errors

SLOW_REACHES = (0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0)
"""How far the axis of the slow root may reach."""
PLANE_REACHES = (3.2, 5.0, 10.0, 20.0, 50.0)
"""How far the complex plane may reach."""
NAMES = ("exact", "first_order", "second_order", "in_the_copy")
"""Of `FORMULAS`, in the CSV."""


def columns(data: Roots) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    table = {"size": data.sizes}
    for i, name in enumerate(NAMES):
        table |= {f"fast_{name}": data.branches[i, :, 0], f"slow_{name}": data.branches[i, :, 1]}
    for name, errors in zip(NAMES[1:], drawn_errors(data), strict=True):
        table |= {f"error_of_fast_{name}": errors[:, 0], f"error_of_slow_{name}": errors[:, 1]}
    for name, roots in zip(NAMES, data.roots, strict=True):
        table |= {f"plane_re_{name}": roots.real, f"plane_im_{name}": roots.imag}
    return table


def drawn_errors(data: Roots) -> FloatArray:
    """Errors (3, m, 2) of the approximate roots; NaN below rounding, which has no place on a log
    scale."""
    errors = root_errors(data)
    return np.where(errors > 1e-15, errors, np.nan)


class RootsPicture(Picture[Roots]):
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
        markers = ("o", "x", "+", "s")
        self.points, self.slow = [], []
        for name, marker, style in zip(FORMULAS, markers, SERIES, strict=False):
            point = {"marker": marker, "color": style["color"], "linestyle": "none"}
            if marker in "os":
                point |= {"fillstyle": "none", "markersize": 9 if marker == "o" else 5}
            self.points.append(self.line(plane, **point))
            self.slow.append(self.line(course, **style, label=name))
        self.here = [
            self.line(axes, color=BLACK, linewidth=0.8, linestyle=(0, (2, 2)), label=GUIDE)
            for axes in (course, error)
        ]
        self.errors = [
            self.line(error, **SERIES[1], label="first order"),
            self.line(error, **SERIES[2], label="with the next term"),
            self.line(error, **SERIES[3], label="in the copy: fast root"),
            self.line(error, **SERIES[4], label="in the copy: slow root"),
        ]
        for axes in (course, error):
            if self.sheet.on_paper:
                legend_below(axes, 1 if axes is course else 2)
                continue
            below: dict[str, Any] = {
                "loc": "upper center",
                "bbox_to_anchor": (0.5, -0.17),
                "frameon": False,
            }
            axes.legend(ncols=2, columnspacing=1.2, **below)

    def update(self, data: Roots) -> None:
        for i in range(len(FORMULAS)):
            self.points[i].set_data(data.roots[i].real, data.roots[i].imag)
            self.slow[i].set_data(data.sizes, data.branches[i, :, 1])
        self.set_reach(self.course_axes, "y", data.branches[..., 1], SLOW_REACHES)
        for direction, parts, steps in (
            ("x", data.roots.real, (1.0, *PLANE_REACHES)),
            ("y", data.roots.imag, PLANE_REACHES),
        ):
            self.set_reach(self.plane_axes, direction, np.append(parts, -parts), steps)
        across, reach = self.plane_axes.get_xlim()[1], self.plane_axes.get_ylim()[1]
        fast = data.roots[0, 0].imag
        places = (fast + 0.06 * reach, -fast - 0.11 * reach, 0.14 * reach)
        for words, height, name in zip(
            self.names, places, ("fast", "fast", "slow pair"), strict=True
        ):
            words.set(text=name, x=0.14 * across, y=height)
        first, second, copied = drawn_errors(data)
        for line, values in zip(
            self.errors, (first[:, 0], second[:, 0], copied[:, 0], copied[:, 1]), strict=True
        ):
            line.set_data(data.sizes, values)
        for line, axes in zip(self.here, (self.course_axes, self.error_axes), strict=True):
            line.set_data([data.size, data.size], axes.get_ylim())
