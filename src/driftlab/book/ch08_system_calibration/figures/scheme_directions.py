"""Which way is up in body axes, all along the two rotation schemes."""

from typing import NamedTuple

import numpy as np

from driftlab.book.machinery.picture import SERIES, Picture, long_table
from driftlab.checks import FloatArray
from driftlab.motion.turntable import SCHEMES, simulate
from driftlab.quaternion import conjugate, rotate


class SchemeDirections(NamedTuple):
    """For each scheme, Up in body axes over time."""

    names: list[str]
    times: list[FloatArray]  # (n,), s
    up: list[FloatArray]  # (n, 3)


def compute() -> SchemeDirections:
    """The schemes of `driftlab.motion.turntable.SCHEMES`, once a second."""
    times, up = [], []
    for scheme in SCHEMES.values():
        attitude = simulate(scheme, 0.0, 1.0).attitude
        times.append(np.arange(len(attitude), dtype=np.float64))
        up.append(rotate(conjugate(attitude), [0.0, 0.0, 1.0]))
    return SchemeDirections(list(SCHEMES), times, up)


def columns(data: SchemeDirections) -> dict[str, FloatArray]:
    """Columns of the figure's CSV, each thirtieth second."""
    return long_table({
        f"{name}, {axis}": (times[::30], up[::30, i].round(12))
        for name, times, up in zip(data.names, data.times, data.up, strict=True)
        for i, axis in enumerate("xyz")
    })  # fmt: skip


class SchemeDirectionsPicture(Picture[SchemeDirections]):
    """One row a scheme, one line a body axis."""

    size = (10.5, 4.4)

    def build(self) -> None:
        self.panels = self.figure.subplots(len(SCHEMES), 1, sharex=True, sharey=True)
        self.figure.subplots_adjust(0.065, 0.18, 0.985, 0.93, hspace=0.28)
        self.panels[-1].set_xlabel("time, minutes")

    def update(self, data: SchemeDirections) -> None:
        for panel, name, times, up in zip(
            self.panels, data.names, data.times, data.up, strict=True
        ):
            panel.set(title=name, ylabel="along Up", ylim=(-1.15, 1.15), yticks=(-1, 0, 1))
            for axis, values, style in zip("xyz", up.T, SERIES, strict=False):
                panel.plot(times / 60, values, **style, label=f"body axis {axis}")
        handles, labels = self.panels[0].get_legend_handles_labels()
        self.figure.legend(handles, labels, loc="lower center", ncols=3)
