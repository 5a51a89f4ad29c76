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

from .figures import turn_estimates

ARC_SECOND = float(np.radians(1 / 3600))


class TurnCalibrationExplorer(Explorer):
    """Calibration by whole turns: axes, turns, steps, integrator and noise."""

    title = "Calibration by turns: estimated against true non-orthogonality"
    picture_class = turn_estimates.TurnEstimatesPicture
    controls = (
        Control("sigma1", "σ₁ (x, y), 1e-3", 0.0, -2.5, 2.5, 0.1, group="true triad"),
        Control("sigma2", "σ₂ (x, z), 1e-3", 1.0, -2.5, 2.5, 0.1, group="true triad"),
        Control("sigma3", "σ₃ (y, z), 1e-3", -1.0, -2.5, 2.5, 0.1, group="true triad"),
        Control("skew", "skew part, 1e-3", 0.0, -2.5, 2.5, 0.1, group="true triad"),
        Control("scale", "common scale, 1e-3", 0.0, -0.5, 0.5, 0.01, group="true triad"),
        Control(
            "plan", "turns and weighing", next(iter(turn_estimates.PLANS)),
            choices=tuple(turn_estimates.PLANS), group="experiment",
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
    def _misalignment(values: Values) -> FloatArray:
        s1, s2, s3 = (values[f"sigma{i}"] for i in (1, 2, 3))
        symmetric = np.array([[0, s1, s2], [s1, 0, s3], [s2, s3, 0]])
        # The skew part of Larin's triad, of unit size: rotation of the triad about (1, 1, 0).
        skew = np.array([[0, 0, -1], [0, 0, 1], [1, -1, 0]])
        return 1e-3 * (symmetric + values["skew"] * skew + values["scale"] * np.eye(3))

    @staticmethod
    def _experiment(values: Values) -> TurnExperiment:
        return TurnExperiment(
            values["turns"], values["steps"], values["formula"], ARC_SECOND * values["noise"]
        )

    def compute(self, values: Values) -> turn_estimates.TurnEstimates:
        return turn_estimates.compute(
            self._misalignment(values), values["plan"], self._experiment(values)
        )

    def numbers(self, data: turn_estimates.TurnEstimates) -> list[tuple[str, str]]:
        runs = f", mean of {len(data.runs)}" if self.values["noise"] else ""
        rows = zip((1, 2, 3), data.true, data.runs.mean(axis=0), strict=True)
        return [
            (f"σ{'₀₁₂₃'[i]} true, found{runs}, 1e-3", f"{1e3 * true:.3f}, {1e3 * mean:.6f}")
            for i, true, mean in rows
        ]

    def call(self, values: Values) -> str:
        experiment = self._experiment(values)
        return (
            "import numpy as np\nfrom driftlab.drift import TurnExperiment\n"
            "from driftlab.figures import turn_estimates\n"
            f"misalignment = {matrix_code(self._misalignment(values))}\n"
            f"experiment = {experiment}\n"
            f"turn_estimates.compute(misalignment, {values['plan']!r}, experiment).runs"
        )


PANELS = (TurnCalibrationExplorer,)
