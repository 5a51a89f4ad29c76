"""Roots of the characteristic equation against the size of the deformation; Larin (2.1), (2.2)."""

import numpy as np

from driftlab.book.machinery.picture import BLACK, SERIES, Picture
from driftlab.checks import FloatArray

from ..experiments import FORMULAS, Roots, root_errors

SLOW_REACHES = (0.05, 0.1, 0.2, 0.5, 1.0, 2.0)
"""How far the axis of the slow root may reach."""


def columns(data: Roots) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    names = ("exact", "first_order", "second_order", "in_the_copy")
    table = {"size": data.sizes}
    for i, name in enumerate(names):
        table |= {f"fast_{name}": data.branches[i, :, 0], f"slow_{name}": data.branches[i, :, 1]}
    return table


class RootsPicture(Picture[Roots]):
    """Complex plane, the slow root over size, and errors over size."""

    size = (10.5, 4.2)

    def build(self) -> None:
        plane, course, error = self.figure.subplots(
            1, 3, gridspec_kw={"width_ratios": [0.45, 1.15, 1.25]}
        )
        self.figure.subplots_adjust(0.06, 0.26, 0.985, 0.92, wspace=0.3)
        self.course_axes = course
        plane.set(title="complex plane", xlabel=r"Re $s/|\omega|$")
        plane.set(ylabel=r"Im $s/|\omega|$", xlim=(-1, 1), ylim=(-3.2, 3.2))
        plane.axvline(0, color=BLACK, linewidth=0.8)
        for height, name in ((2.35, "fast"), (-2.5, "fast"), (0.45, "slow pair")):
            plane.text(0.14, height, name, fontsize=8.5)
        course.set(title="the slow root as the bend grows", xlabel=r"size of deformation $\mu$")
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
            self.line(axes, color=BLACK, linewidth=0.8, linestyle=(0, (2, 2)))
            for axes in (course, error)
        ]
        self.errors = [
            self.line(error, **SERIES[1], label="first order"),
            self.line(error, **SERIES[2], label="with the next term"),
            self.line(error, **SERIES[3], label="in the copy: fast root"),
            self.line(error, **SERIES[4], label="in the copy: slow root"),
        ]
        for axes in (course, error):
            below = {"loc": "upper center", "bbox_to_anchor": (0.5, -0.17), "frameon": False}
            axes.legend(ncols=2, columnspacing=1.2, **below)

    def update(self, data: Roots) -> None:
        for i in range(len(FORMULAS)):
            self.points[i].set_data(data.roots[i].real, data.roots[i].imag)
            self.slow[i].set_data(data.sizes, data.branches[i, :, 1])
        self.set_reach(self.course_axes, "y", data.branches[..., 1], SLOW_REACHES)
        first, second, copied = root_errors(data)
        for line, values in zip(
            self.errors, (first[:, 0], second[:, 0], copied[:, 0], copied[:, 1]), strict=True
        ):
            # An error below rounding has no place on a logarithmic axis.
            line.set_data(data.sizes, np.where(values > 1e-15, values, np.nan))
        for line, axes in zip(self.here, (self.course_axes, self.errors[0].axes), strict=True):
            line.set_data([data.size, data.size], axes.get_ylim())
