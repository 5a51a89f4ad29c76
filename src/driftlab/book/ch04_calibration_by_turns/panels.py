"""The slider panel of chapter 04."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from driftlab.book.machinery.axis import matrix_code
from driftlab.book.machinery.control import Control
from driftlab.book.machinery.panel import Explorer, Values
from driftlab.checks import FloatArray
from driftlab.drift.step_formulas import STEP_FORMULAS
from driftlab.drift.turn_calibration import TurnExperiment

from .experiments import PLANS, TurnEstimates, triad_error, turn_estimates
from .figures.turn_estimates import TurnEstimatesPicture

ARC_SECOND = float(np.radians(1 / 3600))


class TurnCalibrationExplorer(Explorer):
    """Calibration by whole turns: axes, turns, steps, integrator and noise."""

    title = "Calibration by turns: estimated against true non-orthogonality"
    picture_class = TurnEstimatesPicture
    controls = (
        Control("sigma1", "σ₁ (x, y), 1e-3", 0.0, -2.5, 2.5, 0.1, group="true triad"),
        Control("sigma2", "σ₂ (x, z), 1e-3", 1.0, -2.5, 2.5, 0.1, group="true triad"),
        Control("sigma3", "σ₃ (y, z), 1e-3", -1.0, -2.5, 2.5, 0.1, group="true triad"),
        Control("skew", "skew part, 1e-3", 0.0, -2.5, 2.5, 0.1, group="true triad"),
        Control("scale", "common scale, 1e-3", 0.0, -0.5, 0.5, 0.01, group="true triad"),
        Control(
            "plan", "turns and weighing", next(iter(PLANS)), choices=tuple(PLANS),
            group="experiment",
        ),
        Control("turns", "turns k", 1, 1, 5, 1, group="experiment"),
        Control("steps", "steps in a turn", 100, 6, 200, 1, group="experiment"),
        Control(
            "formula", "step formula", "taylor-4", choices=tuple(STEP_FORMULAS), group="experiment"
        ),
        Control("noise", "noise, arcsec a turn", 0.0, 0.0, 20.0, 0.5, group="experiment"),
    )  # fmt: skip
    presets: ClassVar = {
        "Larin's triad, axes as in (2.4)": {"skew": 1.0, "formula": "pade"},
        "Noisy gyros": {"noise": 5.0},
        "Coarse steps": {"steps": 12, "formula": "taylor-2"},
        "Scale error, three axes": {"scale": 0.2},
        "Scale error, solved for": {
            "scale": 0.2, "plan": "four axes, least squares and common scale"
        },
    }  # fmt: skip

    @staticmethod
    def _triad_error(values: Values) -> FloatArray:
        sigma = [values[f"sigma{i}"] for i in (1, 2, 3)]
        return 1e-3 * triad_error(sigma, values["skew"], values["scale"])

    @staticmethod
    def _experiment(values: Values) -> TurnExperiment:
        return TurnExperiment(
            values["turns"], values["steps"], values["formula"], ARC_SECOND * values["noise"]
        )

    def compute(self, values: Values) -> TurnEstimates:
        return turn_estimates(self._triad_error(values), values["plan"], self._experiment(values))

    def numbers(self, data: TurnEstimates) -> list[tuple[str, str]]:
        runs = f", mean of {len(data.runs)}" if self.values["noise"] else ""
        rows = zip((1, 2, 3), data.true, data.runs.mean(axis=0), strict=True)
        return [
            (f"σ{'₀₁₂₃'[i]} true, found{runs}, 1e-3", f"{1e3 * true:.3f}, {1e3 * mean:.6f}")
            for i, true, mean in rows
        ]

    def call(self, values: Values) -> str:
        experiment = self._experiment(values)
        return (
            "import numpy as np\n"
            "from driftlab.book.ch04_calibration_by_turns.experiments import turn_estimates\n"
            "from driftlab.drift import TurnExperiment\n"
            f"triad_error = {matrix_code(self._triad_error(values))}\n"
            f"experiment = {experiment}\n"
            f"turn_estimates(triad_error, {values['plan']!r}, experiment).runs"
        )


PANELS = (TurnCalibrationExplorer,)
