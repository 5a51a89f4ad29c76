"""Order of each attitude algorithm, measured on motions that show it and motions that hide it."""

from typing import NamedTuple

import numpy as np

from driftlab.attitude.coning_algorithms import ALGORITHMS
from driftlab.book.ch06_picard_algorithms.figures import algorithm_laboratory
from driftlab.book.machinery.picture import Picture
from driftlab.checks import FloatArray
from driftlab.motion.profiles import Coning, FixedAxis, Motion, Sway

from .algorithm_laboratory import STYLES, draw_slopes

RATES = (24, 48, 96, 192, 384, 768)
"""Sample rates in Hz."""
MOTIONS: dict[str, Motion] = {
    "small cone, half angle 1°, 1 Hz": Coning(float(np.radians(1.0)), 1.0),
    "wide cone, half angle 60°, 1 Hz": Coning(float(np.radians(60.0)), 1.0),
    "swaying ship, roll 30°, 0.5 Hz": Sway(float(np.radians(30.0)), 0.5),
    "fixed axis, 57° and 57°/s, 0.5 Hz": FixedAxis(1.0, 0.5),
}


class AlgorithmOrders(NamedTuple):
    """Largest errors in rad, by motion and algorithm."""

    rates: FloatArray  # (m,), Hz
    worst: FloatArray  # (motion, algorithm, m)
    orders: list[list[float | None]]  # fitted, None where rounding hides it


def compute() -> AlgorithmOrders:
    """Try every algorithm on every motion of `MOTIONS`."""
    trials = [
        algorithm_laboratory.compute(motion, RATES[0], tuple(ALGORITHMS), rates=RATES)
        for motion in MOTIONS.values()
    ]
    return AlgorithmOrders(
        trials[0].rates,
        np.array([trial.worst for trial in trials]),
        [algorithm_laboratory.fitted_orders(trial) for trial in trials],
    )


def columns(data: AlgorithmOrders) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: errors in rad, except those of pure rounding."""
    table = {"rate_hz": data.rates}
    for motion, errors in zip(("cone_1", "cone_60", "sway", "fixed_axis"), data.worst, strict=True):
        for name, column in zip(ALGORITHMS, errors, strict=True):
            # On a fixed axis a rotation vector is exact, and what is left differs by machine.
            if column.max() > 1e-13:
                table[f"{motion}_{name}"] = column
    return table


class AlgorithmOrdersPicture(Picture[AlgorithmOrders]):
    """One panel a motion."""

    size = (10.0, 7.2)

    def build(self) -> None:
        panels = self.figure.subplots(2, 2, sharex=True, sharey=True).ravel()
        self.figure.subplots_adjust(0.085, 0.135, 0.985, 0.955, wspace=0.06, hspace=0.16)
        self.lines = []
        for panel, title in zip(panels, MOTIONS, strict=True):
            panel.set(title=title, xscale="log", yscale="log", xlim=(21, 900), ylim=(1e-16, 3))
            panel.set_xticks(RATES, [str(rate) for rate in RATES])
            panel.minorticks_off()
            if not title.startswith("fixed axis"):  # there errors lie in the way
                draw_slopes(panel, RATES[0], 1e-11)
            self.lines.append([
                self.line(panel, **style, label=name) for name, style in STYLES.items()
            ])  # fmt: skip
        for panel in panels[2:]:
            panel.set_xlabel("sample rate, Hz")
        for panel in panels[::2]:
            panel.set_ylabel("largest error of attitude, rad")
        self.figure.legend(handles=self.lines[0], loc="lower center", ncols=len(STYLES), fontsize=8)

    def update(self, data: AlgorithmOrders) -> None:
        for lines, errors in zip(self.lines, data.worst, strict=True):
            for line, values in zip(lines, errors, strict=True):
                line.set_data(data.rates, np.where(values > 0, values, np.nan))
