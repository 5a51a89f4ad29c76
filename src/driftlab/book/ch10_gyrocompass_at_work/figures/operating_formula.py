"""The paper's formula for the heading error at work, term by term, against the simulation."""

from typing import Any, NamedTuple

import numpy as np
from scipy.constants import degree, g, hour, milli, minute

from driftlab.book.ch10_gyrocompass_at_work.figures import operation
from driftlab.book.machinery.picture import BLACK, SERIES, Picture
from driftlab.checks import FloatArray
from driftlab.gyrocompass.simulation import ErrorsUnderWay

TERMS = ("rate about East", "rate about North", "minus the yaw's error", "tilt by tan pitch")
SETTING: dict[str, Any] = {
    "speed": 30.0,
    "course": float(np.radians(20.0)),
    "turn": float(np.radians(70.0)),
    "drift": np.array([0.03, 0.05, 0.04]) * degree / hour,
    "offset": np.array([0.1, 0.0, -0.1]) * milli * g,
    "tuning_factor": 1.05,
    "pitch": float(np.radians(50.0)),
    "tilt": float(np.radians(1 / 60)),
    "interval": 1.0,
}
"""A fast craft with its bow up, and everything wrong at once."""


class OperatingFormula(NamedTuple):
    """One voyage, and how far the formula is off with all of its terms and without each."""

    run: ErrorsUnderWay
    gaps: FloatArray  # (5, n), rad: simulated minus formula; all terms, then each left out


def compute() -> OperatingFormula:
    """Simulate the voyage and compare."""
    run = operation.compute(**SETTING)
    gap = run.compass_error - run.formula.compass_angle
    return OperatingFormula(run, np.stack([gap, *(gap + term for term in run.formula)]))


def columns(data: OperatingFormula) -> dict[str, FloatArray]:
    """Columns of the figure's CSV, each two minutes."""
    rows = slice(119, None, 120)
    run = data.run
    table = {
        "time_s": run.times[rows],
        "simulated_deg": np.degrees(run.compass_error[rows]).round(7),
        "formula_deg": np.degrees(run.formula.compass_angle[rows]).round(7),
    }
    for name, term in zip(TERMS, run.formula, strict=True):
        table[f"{name}_deg"] = np.degrees(term[rows]).round(7)
    return table


class OperatingFormulaPicture(Picture[OperatingFormula]):
    """The terms and their sum; and what is missing without each."""

    size = (10.5, 4.3)

    def build(self) -> None:
        self.panels = self.figure.subplots(1, 2)
        self.figure.subplots_adjust(0.065, 0.28, 0.985, 0.91, wspace=0.2)
        terms, gaps = self.panels
        terms.set(title="error of the compass angle, degrees")
        gaps.set(title="simulated minus formula, size, degrees", yscale="log", ylim=(1e-4, 3))
        for panel in self.panels:
            panel.set(xlabel="time, minutes", xlim=(0, 120))
            operation.shade_manoeuvres(panel)

    def update(self, data: OperatingFormula) -> None:
        terms, gaps = self.panels
        run = data.run
        minutes = run.times / minute
        terms.plot(
            minutes, np.degrees(run.compass_error), color=BLACK, linewidth=3.5, alpha=0.35,
            label="simulated",
        )  # fmt: skip
        terms.plot(
            minutes, np.degrees(run.formula.compass_angle), color=BLACK, linewidth=1.0,
            label="formula, all terms",
        )  # fmt: skip
        gaps.plot(minutes, np.degrees(np.abs(data.gaps[0])), color=BLACK, linewidth=1.0)
        for i, name in enumerate(TERMS):
            terms.plot(minutes, np.degrees(run.formula[i]), **SERIES[i], label=name)
            gaps.plot(minutes, np.degrees(np.abs(data.gaps[i + 1])), **SERIES[i])
        handles, labels = terms.get_legend_handles_labels()
        self.figure.legend(
            handles, labels, loc="lower center", ncols=3, fontsize=8,
            title="left: the terms; right: what is missing without each", title_fontsize=8,
        )  # fmt: skip
