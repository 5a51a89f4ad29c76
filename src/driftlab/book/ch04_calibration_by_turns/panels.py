"""The slider panel of chapter 04."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.axis import matrix_code
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Explorer, Values
from driftlab.book.machinery.panel.results import ABSENT, Results
from driftlab.checks import FloatArray
from driftlab.drift.step_formulas import STEP_FORMULAS
from driftlab.drift.turn_calibration import TurnExperiment
from driftlab.motion.turntable_rotation import TurntableRotation

from .experiments import PLANS, error_matrix, turn_estimates
from .figures.turn_estimates import TurnEstimatesPicture

ARC_SECOND = float(np.radians(1 / 3600))
DEGREE_PER_HOUR = float(np.radians(1 / 3600))
TRIAD_CONTROLS = (
    Control("sigma1", "σ₁ (x, y), mrad", 0.0, -2.5, 2.5, 0.1, group="true triad"),
    Control("sigma2", "σ₂ (x, z), mrad", 1.0, -2.5, 2.5, 0.1, group="true triad"),
    Control("sigma3", "σ₃ (y, z), mrad", -1.0, -2.5, 2.5, 0.1, group="true triad"),
    Control("skew", "skew part, mrad", 0.0, -2.5, 2.5, 0.1, group="true triad"),
    Control("scale", "scale of all, 10⁻³", 0.0, -0.5, 0.5, 0.01, group="true triad"),
)
TURN_CONTROLS = (
    Control(
        "plan", "turns and weighing", next(iter(PLANS)), choices=tuple(PLANS), group="experiment"
    ),
    Control("turns", "turns k", 1, 1, 5, 1, group="experiment"),
)
NOISE_CONTROL = Control("noise", "noise of a turn, ″", 0.0, 0.0, 20.0, 0.5, group="experiment")


class TurnCalibrationExplorer(Explorer):
    """Calibration by whole turns: three sigmas by Larin's formula, all nine errors by sums."""

    title = "Calibration by turns: estimated against true non-orthogonality"
    picture_class = TurnEstimatesPicture
    controls: ClassVar[Sequence[Control]] = (
        *TRIAD_CONTROLS,
        *TURN_CONTROLS,
        Control("steps", "steps in a turn", 100, 8, 200, 1, group="experiment"),
        Control(
            "formula", "step formula", "taylor-4", choices=tuple(STEP_FORMULAS), group="experiment"
        ),
        NOISE_CONTROL,
    )
    fixed: ClassVar[Values] = {
        "axis": 0.0, "earth": "none", "latitude": 37.5, "rate": 10.0, "senses": "one", "bias": 0.0,
    }  # fmt: skip
    """What this panel has no control for, and that of chapter 05 has."""
    presets: ClassVar = {
        "Larin's triad, axes as in (2.4)": {"skew": 1.0, "formula": "pade"},
        "Noisy gyros": {"noise": 5.0},
        "Coarse steps": {"steps": 12, "formula": "taylor-2"},
        "Scale error, three axes": {"scale": 0.2},
        "Scale error, solved for": {
            "scale": 0.2, "plan": "four axes, least squares and common scale"
        },
    }  # fmt: skip
    look_for: ClassVar = {
        "Larin's triad, axes as in (2.4)": "Change the step formula. Which can you tell apart?",
        "Noisy gyros": "Twelve calibrations of one triad. How far apart do they lie?",
        "Coarse steps": "Twelve steps in a turn. Is the error still a matter of the gyros?",
        "Scale error, three axes": "The gyros are a little too sensitive. What gets the blame?",
        "Scale error, solved for": "The same gyros, another plan. What has it done with the scale?",
    }

    @staticmethod
    def _triad_error(values: Values) -> FloatArray:
        sigma = [values[f"sigma{i}"] for i in (1, 2, 3)]
        return 1e-3 * error_matrix(sigma, values["skew"], values["scale"])

    @staticmethod
    def _experiment(values: Values) -> TurnExperiment:
        return TurnExperiment(
            values["turns"], values["steps"], values["formula"], ARC_SECOND * values["noise"]
        )

    @staticmethod
    def _table(values: Values) -> TurntableRotation:
        turning = values["earth"] == "turning"
        latitude = float(np.radians(values["latitude"])) if turning else None
        return TurntableRotation(float(np.radians(values["rate"])), values["turns"], latitude)

    def compute(self, values: Values) -> DataTable:
        values = {**self.fixed, **values}
        return turn_estimates(
            self._triad_error(values), values["plan"], self._experiment(values),
            table=self._table(values), senses=values["senses"],
            gyro_bias=values["bias"] * DEGREE_PER_HOUR, axis_error=values["axis"] * ARC_SECOND,
        )  # fmt: skip

    def numbers(self, table: DataTable) -> Results:
        found, count = table.runs.mean(axis=0), len(table.runs)
        differ = len(table.found) > 3  # without noise they are one and the same
        errors = (found - table.true) / ARC_SECOND
        return Results(
            ("largest error", f"{errors[np.abs(errors).argmax()]:.2f}″"),
            [
                (name, f"{1e3 * true:.3f}", f"{1e3 * mean:.4f}", f"{error:.2f}", ABSENT)
                for name, true, mean, error in zip(
                    ("σ₁", "σ₂", "σ₃"), table.true, found, errors, strict=True
                )
            ]
            + [
                (name, f"{true:.3f}", ABSENT, f"{error:.2f}", f"{spread:.2f}")
                for name, true, error, spread in zip(
                    table.nine, *map(table.shown, ("nine_true", "nine_error", "nine_spread")),
                    strict=True,
                )
            ],
            (
                "true, mrad", f"mean of {count}, mrad" if differ else "found, mrad",
                "error, ″", "1σ, ″",
            ),
            "Below the three sigmas by Larin's formula: all nine numbers from the summed "
            "increments of both directions, one calibration, with their standard deviations.",
        )  # fmt: skip

    def call(self, values: Values) -> str:
        values = {**self.fixed, **values}
        experiment, table = self._experiment(values), self._table(values)
        given = ["error_matrix", repr(values["plan"]), "experiment", "table=table"]
        if values["bias"]:
            given.append(f"gyro_bias={values['bias'] * DEGREE_PER_HOUR!r}")
        if values["axis"]:
            given.append(f"axis_error={values['axis'] * ARC_SECOND!r}")
        if values["senses"] != "one":
            given.append(f"senses={values['senses']!r}")
        return (
            "import numpy as np\n"
            "from driftlab.book.ch04_calibration_by_turns.experiments import turn_estimates\n"
            "from driftlab.drift import TurnExperiment\n"
            "from driftlab.motion import TurntableRotation\n"
            f"error_matrix = {matrix_code(self._triad_error(values))}\n"
            f"experiment = {experiment}\n"
            f"table = {table}\n"
            f"turn_estimates({', '.join(given)}).runs"
        )


PANELS = (TurnCalibrationExplorer,)
