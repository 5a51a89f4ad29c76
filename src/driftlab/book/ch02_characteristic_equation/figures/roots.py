"""Roots of the characteristic equation against the size of the deformation; Larin (2.1), (2.2)."""

import numpy as np

from driftlab.book.machinery.picture import BLACK, SERIES, Picture
from driftlab.checks import FloatArray

from ..experiments import FORMULAS, Roots, root_errors


def columns(data: Roots) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    names = ("exact", "first_order", "second_order", "in_the_copy")
    table = {"size": data.sizes}
    for i, name in enumerate(names):
        table |= {f"fast_{name}": data.branches[i, :, 0], f"slow_{name}": data.branches[i, :, 1]}
    return table


class RootsPicture(Picture[Roots]):
    """Complex plane, branches over size, and errors over size."""

    size = (10.5, 4.0)

    def build(self) -> None:
        plane, course, error = self.figure.subplots(
            1, 3, gridspec_kw={"width_ratios": [0.7, 1.1, 1.3]}
        )
        self.figure.subplots_adjust(0.065, 0.14, 0.985, 0.9, wspace=0.32)
        plane.set(title="roots in the complex plane", xlabel=r"Re $s/|\omega|$")
        plane.set(ylabel=r"Im $s/|\omega|$", xlim=(-0.5, 0.5), ylim=(-3.2, 3.2))
        plane.axvline(0, color=BLACK, linewidth=0.8)
        course.set(title="positive branches", xlabel=r"size of deformation $\mu$")
        course.set(ylabel=r"Im $s/|\omega|$", xlim=(0, 0.5), ylim=(-1.1, 3.2))
        error.set(title="distance from the exact root", xlabel=r"size of deformation $\mu$")
        error.set(xscale="log", yscale="log", xlim=(1e-4, 0.5), ylim=(1e-13, 100))
        error.set(ylabel=r"error$/|\omega|$")
        markers = ("o", "x", "+", "s")
        self.points, self.fast, self.slow = [], [], []
        for name, marker, style in zip(FORMULAS, markers, SERIES, strict=False):
            point = {"marker": marker, "color": style["color"], "linestyle": "none"}
            if marker in "os":
                point |= {"fillstyle": "none", "markersize": 9 if marker == "o" else 5}
            self.points.append(self.line(plane, **point, label=name))
            self.fast.append(self.line(course, **style, label=name))
            self.slow.append(self.line(course, **style))
        self.here = [
            self.line(axes, color=BLACK, linewidth=0.8, linestyle=(0, (2, 2)))
            for axes in (course, error)
        ]
        self.errors = [
            self.line(error, **SERIES[1], label="first order: both roots"),
            self.line(error, **SERIES[2], label="with the next term: both roots"),
            self.line(error, **SERIES[3], label="in the copy: fast root"),
            self.line(error, **SERIES[4], label="in the copy: slow root"),
        ]
        plane.legend(loc="center", bbox_to_anchor=(0.5, 0.66), fontsize=7, handletextpad=0.1)
        course.legend(loc="center left", bbox_to_anchor=(0.0, 0.585))
        error.legend(loc="upper left")

    def update(self, data: Roots) -> None:
        for i in range(len(FORMULAS)):
            self.points[i].set_data(data.roots[i].real, data.roots[i].imag)
            self.fast[i].set_data(data.sizes, data.branches[i, :, 0])
            self.slow[i].set_data(data.sizes, data.branches[i, :, 1])
        first, second, copied = root_errors(data)
        for line, values in zip(
            self.errors, (first[:, 0], second[:, 0], copied[:, 0], copied[:, 1]), strict=True
        ):
            # An error below rounding has no place on a logarithmic axis.
            line.set_data(data.sizes, np.where(values > 1e-15, values, np.nan))
        for line, bounds in zip(self.here, ((-1.1, 3.2), (1e-13, 100)), strict=True):
            line.set_data([data.size, data.size], bounds)
