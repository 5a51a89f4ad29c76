"""The slider panels of Part I."""

from typing import ClassVar

import numpy as np

from ..checks import FloatArray
from ..figures import drift_history, error_motion, roots, turn_estimates
from ..larin_table import MISALIGNMENT
from ..step_formulas import STEP_FORMULAS
from ..turn_calibration import TurnExperiment
from .axis import AXIS_CONTROLS, axis_code, axis_of
from .control import Control
from .panel import Explorer, Values

ARC_SECOND = float(np.radians(1 / 3600))

SHAPES = {
    "symmetric": [[0, 1, 1], [1, 0, 1], [1, 1, 0]],
    "skew": [[0, -1, 1], [1, 0, -1], [-1, 1, 0]],
    "third axis bent, as in Larin's table": [[0, 0, 0], [0, 0, 0], [1, -1, 0]],
    "x leans to axis 2 only": [[0, 1, 0], [0, 0, 0], [0, 0, 0]],
    "scale factor of all three": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
}

SIZES = (1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5)
TOLERANCES = (1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1)

ENTRIES = [f"m{row}{column}" for row in (1, 2, 3) for column in (1, 2, 3)]

MISALIGNMENT_CONTROLS = tuple(
    Control(
        entry,
        f"{gyro} {'scale' if gyro == 'xyz'[column] else f'to axis {column + 1}'}, 1e-3",
        0.0,
        -2.0,
        2.0,
        0.05,
        group=f"gyro {gyro}",
    )
    for entry, (gyro, column) in zip(
        ENTRIES, ((gyro, column) for gyro in "xyz" for column in range(3)), strict=True
    )
)
"""The nine entries of the misalignment, row by row: what each gyro picks up of each body axis."""


def misalignment_of(values: Values) -> FloatArray:
    """Misalignment (3, 3) of `MISALIGNMENT_CONTROLS`."""
    return 1e-3 * np.array([values[entry] for entry in ENTRIES]).reshape(3, 3)


def misalignment_values(misalignment: FloatArray) -> dict[str, float]:
    """Values of `MISALIGNMENT_CONTROLS` that give a misalignment (3, 3)."""
    rounded = np.round(1e3 * np.asarray(misalignment).ravel(), 6)
    return dict(zip(ENTRIES, rounded.tolist(), strict=True))


def matrix_code(misalignment: FloatArray) -> str:
    """Code for a misalignment."""
    return f"1e-3 * np.array({np.round(1e3 * misalignment, 6).tolist()})"


class ErrorMotionExplorer(Explorer):
    """Components of the error quaternion for any true and measured rate."""

    title = "Error quaternion for a constant true and measured rate"
    picture_class = error_motion.ErrorMotionPicture
    controls = (
        *(
            Control(f"rate{i}", f"true rate {i}, deg/s", start, -15.0, 15.0, 0.5, group="true rate")
            for i, start in zip((1, 2, 3), (6.0, 12.0, 6.0), strict=True)
        ),
        *(
            Control(f"error{i}", f"error {i}, deg/s", start, -3.0, 3.0, 0.05, group="gyro error")
            for i, start in zip((1, 2, 3), (1.0, -3.0, 0.0), strict=True)
        ),
        Control("tolerance", "RK45 tolerance", 1e-2, stops=TOLERANCES, group="integrator"),
    )
    presets: ClassVar = {
        "Gross error": {},
        "Error along the rate": {
            "rate1": 0.0, "rate2": 0.0, "rate3": 12.0, "error1": 0.0, "error2": 0.0, "error3": 1.0
        },
        "Error across the rate": {
            "rate1": 0.0, "rate2": 0.0, "rate3": 12.0, "error1": 1.0, "error2": 0.0, "error3": 0.0
        },
        "A true zero": {"rate1": 0.0, "rate2": 0.0, "rate3": 0.0},
    }  # fmt: skip

    @staticmethod
    def _rates(values: Values) -> tuple[FloatArray, FloatArray]:
        rate = np.radians([values[f"rate{i}"] for i in (1, 2, 3)])
        return rate, rate + np.radians([values[f"error{i}"] for i in (1, 2, 3)])

    def compute(self, values: Values) -> error_motion.ErrorMotion:
        return error_motion.compute(*self._rates(values), tolerance=values["tolerance"])

    def numbers(self, data: error_motion.ErrorMotion) -> list[tuple[str, str]]:
        rate, measured = self._rates(self.values)
        worst = error_motion.integration_error(data, rate, measured).max()
        true_size, size = np.degrees(np.linalg.norm([rate, measured], axis=-1))
        return [
            ("true rate", f"{true_size:.3f} deg/s"),
            ("measured rate", f"{size:.3f} deg/s"),
            ("their sum, fast", f"{size + true_size:.3f} deg/s"),
            ("their difference, slow", f"{size - true_size:.3f} deg/s"),
            ("RK45 steps", f"{len(data.integrated_time) - 1}"),
            ("its worst error", f"{worst:.1e}"),
        ]

    def call(self, values: Values) -> str:
        rate = [values[f"rate{i}"] for i in (1, 2, 3)]
        error = [values[f"error{i}"] for i in (1, 2, 3)]
        return (
            "import numpy as np\nfrom driftlab.kinematics import error_quaternion\n"
            f"rate = np.radians({rate})\nmeasured_rate = rate + np.radians({error})\n"
            "error_quaternion(rate, measured_rate, np.linspace(0, 60, 601))"
        )


class RootsExplorer(Explorer):
    """Roots of (2.1): exact, asymptotic, and as printed."""

    title = "Roots of the characteristic equation against deformation and axis"
    picture_class = roots.RootsPicture
    controls = (
        Control("shape", "shape T", "symmetric", choices=tuple(SHAPES), group="deformation"),
        Control("size", "size μ", 0.1, stops=SIZES, group="deformation"),
        *AXIS_CONTROLS,
    )
    presets: ClassVar = {
        "Symmetric triad": {},
        "Skew triad": {"shape": "skew"},
        "Larin's triad": {
            "shape": "third axis bent, as in Larin's table", "size": 2e-3, "azimuth": 0.0,
            "elevation": 45.0,
        },
        "Across the error": {
            "shape": "x leans to axis 2 only", "size": 0.3, "azimuth": 90.0, "elevation": 0.0
        },
    }  # fmt: skip

    def compute(self, values: Values) -> roots.Roots:
        return roots.compute(values["size"], SHAPES[values["shape"]], axis_of(values))

    def numbers(self, data: roots.Roots) -> list[tuple[str, str]]:
        fast, slow = data.roots[:, 0].imag, data.roots[:, 2].imag
        rows = zip(roots.FORMULAS, fast, slow, strict=True)
        return [(name, f"{a:.9f} i, {b:.9f} i") for name, a, b in rows]

    def call(self, values: Values) -> str:
        return (
            "import numpy as np\n"
            "from driftlab.drift import asymptotic_roots, direction_from_angles, exact_roots, "
            "measured_rate\n"
            f"rate = {axis_code(values)}\n"
            f"misalignment = {values['size']} * np.array({SHAPES[values['shape']]})\n"
            "exact_roots(rate, measured_rate(rate, misalignment))\n"
            "asymptotic_roots(rate, misalignment)"
        )


class DriftExplorer(Explorer):
    """The error of a bent triad over the turns."""

    title = "Drift of a bent triad, turn after turn"
    picture_class = drift_history.DriftHistoryPicture
    controls = (*MISALIGNMENT_CONTROLS, *AXIS_CONTROLS)
    presets: ClassVar = {
        "Symmetric triad": misalignment_values(1e-3 * np.array(SHAPES["symmetric"])),
        "Skew triad": misalignment_values(2e-3 * np.array(SHAPES["skew"])),
        "Larin's triad": {
            **misalignment_values(MISALIGNMENT), "azimuth": 0.0, "elevation": 45.0
        },
        "One gyro leans": {"m12": 2.0, "elevation": 0.0},
        "Scale factor": misalignment_values(1e-3 * np.eye(3)),
    }  # fmt: skip

    def compute(self, values: Values) -> drift_history.DriftHistory:
        return drift_history.compute(misalignment_of(values), axis_of(values))

    def numbers(self, data: drift_history.DriftHistory) -> list[tuple[str, str]]:
        return [
            ("drift a turn, exact", f"{_arcmin(data.exact_per_turn)}"),
            ("first order", f"{_arcmin(data.first_order_per_turn)}"),
            ("drift a turn about the worst axis", f"{_arcmin(data.worst_per_turn)}"),
            ("which is", np.array2string(data.worst_axis.round(3), suppress_small=True)),
        ]

    def call(self, values: Values) -> str:
        return (
            "import numpy as np\n"
            "from driftlab.drift import direction_from_angles, drift_per_turn, principal_drifts\n"
            f"misalignment = {matrix_code(misalignment_of(values))}\n"
            f"drift_per_turn({axis_code(values)}, misalignment)\n"
            "principal_drifts(misalignment, exact=True)"
        )


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
            "import numpy as np\nfrom driftlab.turn_calibration import TurnExperiment\n"
            "from driftlab.figures import turn_estimates\n"
            f"misalignment = {matrix_code(self._misalignment(values))}\n"
            f"experiment = {experiment}\n"
            f"turn_estimates.compute(misalignment, {values['plan']!r}, experiment).runs"
        )


def _arcmin(angle: float) -> str:
    return f"{60 * np.degrees(angle):.3f} arcmin"
