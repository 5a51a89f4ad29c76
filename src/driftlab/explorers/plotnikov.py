"""The slider panels of Part IV."""

from typing import ClassVar

import numpy as np
from scipy.constants import arcminute, arcsecond, degree, g, hour, milli

from ..algorithm_table import ALGORITHMS
from ..checks import FloatArray
from ..compass_voyage import ErrorsUnderWay
from ..figures import alignment_budget, capstone, operation
from .control import Control
from .panel import Explorer, Values

BODY_AXES = ("forward", "up", "right")


def _degrees(angle: float) -> str:
    return "none" if np.isnan(angle) else f"{np.degrees(angle):.4f}°"


def _sensor_controls(drift: FloatArray, offset: FloatArray, most: float) -> tuple[Control, ...]:
    """Sliders of three gyros up to `most` deg/h and three accelerometers up to 5 mg."""
    gyros = drift / (degree / hour)
    offsets = offset / (milli * g)
    return (
        *(
            Control(f"gyro_{axis}", f"{axis}, °/h", round(float(value), 6), -most, most, 0.005,
                    group="gyro drifts")
            for axis, value in zip(BODY_AXES, gyros, strict=True)
        ),
        *(
            Control(f"acc_{axis}", f"{axis}, mg", round(float(value), 6), -5.0, 5.0, 0.05,
                    group="accelerometer offsets")
            for axis, value in zip(BODY_AXES, offsets, strict=True)
        ),
    )  # fmt: skip


def _sensors(values: Values) -> tuple[FloatArray, FloatArray]:
    """Gyro drifts in rad/s and accelerometer offsets in m/s^2, (3,) each."""
    drift = np.array([values[f"gyro_{axis}"] for axis in BODY_AXES]) * degree / hour
    return drift, np.array([values[f"acc_{axis}"] for axis in BODY_AXES]) * milli * g


def _sensor_lines(values: Values) -> str:
    gyros = [values[f"gyro_{axis}"] for axis in BODY_AXES]
    offsets = [values[f"acc_{axis}"] for axis in BODY_AXES]
    return f"drift = np.array({gyros}) * degree / hour\noffset = np.array({offsets}) * milli * g\n"


NO_ERRORS = {f"{kind}_{axis}": 0.0 for kind in ("gyro", "acc") for axis in BODY_AXES}


class AlignmentBudgetExplorer(Explorer):
    """Six sensor errors, and what each does to the heading."""

    title = "Error budget of an alignment"
    picture_class = alignment_budget.AlignmentBudgetPicture
    controls = (
        Control("latitude", "latitude, °", 51.5, -89.5, 89.5, 0.5, group="place"),
        Control("heading", "heading to West, °", 40.0, -180.0, 180.0, 1.0, group="place"),
        Control("pitch", "pitch, °", 30.0, -90.0, 90.0, 1.0, group="place"),
        Control("roll", "roll, °", 10.0, -180.0, 180.0, 1.0, group="place"),
        *_sensor_controls(alignment_budget.DRIFT, alignment_budget.OFFSET, 0.2),
    )
    presets: ClassVar = {
        "A bit of everything": {},
        "No errors, level, to the North": {"heading": 0.0, "pitch": 0.0, "roll": 0.0, **NO_ERRORS},
        "One gyro, level": {"pitch": 0.0, "roll": 0.0, **NO_ERRORS, "gyro_right": 0.04},
        "One accelerometer, level": {"pitch": 0.0, "roll": 0.0, **NO_ERRORS, "acc_right": 2.0},
        "Far North": {"latitude": 85.0},
        "Nearly vertical": {"pitch": 85.0},
        "Vertical": {"pitch": 90.0},
        "Upside down": {"roll": 180.0},
    }

    def compute(self, values: Values) -> alignment_budget.AlignmentBudget:
        latitude, heading, pitch, roll = (
            float(np.radians(values[name])) for name in ("latitude", "heading", "pitch", "roll")
        )
        return alignment_budget.compute(latitude, heading, pitch, roll, *_sensors(values))

    def numbers(self, data: alignment_budget.AlignmentBudget) -> list[tuple[str, str]]:
        rows = list(zip(alignment_budget.TERMS, map(_degrees, data.bars), strict=True))
        for name in ("pitch", "roll", "latitude", "attitude"):
            first_order, exact = getattr(data, name)
            rows.append((f"{name} error, exact", _degrees(exact)))
            rows.append((f"{name} error, first order", _degrees(first_order)))
        return rows

    def call(self, values: Values) -> str:
        latitude, heading, pitch, roll = (
            values[name] for name in ("latitude", "heading", "pitch", "roll")
        )
        return (
            "import numpy as np\n"
            "from scipy.constants import degree, g, hour, milli\n"
            "from driftlab.gyrocompass import align\n"
            "from driftlab.horizon_axes import attitude_from_angles\n"
            "from driftlab.voyage import sensed_at_rest\n"
            f"{_sensor_lines(values)}"
            f"attitude = attitude_from_angles(*np.radians([{heading}, {pitch}, {roll}]))\n"
            f"rate, force = sensed_at_rest(attitude, np.radians({latitude}))\n"
            f"error = align(rate + drift, force + offset).heading - np.radians({heading})\n"
            "print(np.degrees(np.arctan2(np.sin(error), np.cos(error))))"
        )


class GyrocompassExplorer(Explorer):
    """A compass on board, for two hours."""

    title = "A gyrocompass at work"
    picture_class = operation.OperationPicture
    controls = (
        Control("latitude", "latitude, °", 51.5, -85.0, 85.0, 0.5, group="ship"),
        Control("speed", "speed, m/s", 10.0, 0.0, 30.0, 0.5, group="ship"),
        Control("course", "course to West, °", 0.0, -180.0, 180.0, 5.0, group="ship"),
        Control("turn", "then turns by, °", 90.0, -360.0, 360.0, 5.0, group="ship"),
        Control(
            "tuning", "tuning k2 R", 1.0, stops=(0.25, 0.5, 0.8, 0.95, 1.0, 1.05, 1.25, 2.0, 4.0),
            group="instrument",
        ),
        Control("damping", "damping ratio", 0.0, 0.0, 1.0, 0.05, group="instrument"),
        Control("tilt", "tilt at the start, ′", 0.0, -3.0, 3.0, 0.1, group="instrument"),
        *_sensor_controls(operation.DRIFT, np.zeros(3), 0.1)[:3],
        Control("log", "a log tells the velocity", False, group=""),
    )  # fmt: skip
    presets: ClassVar = {
        "Small drifts, a turn": {},
        "Perfect sensors": {f"gyro_{axis}": 0.0 for axis in BODY_AXES},
        "Perfect sensors and a log": {
            **{f"gyro_{axis}": 0.0 for axis in BODY_AXES}, "log": True
        },
        "Swinging for 84 minutes": {
            **{f"gyro_{axis}": 0.0 for axis in BODY_AXES}, "speed": 0.0, "turn": 0.0, "tilt": 1.0
        },
        "Tuned too stiffly": {f"gyro_{axis}": 0.0 for axis in BODY_AXES} | {"tuning": 2.0},
        "Damped": {f"gyro_{axis}": 0.0 for axis in BODY_AXES} | {"damping": 0.5},
        "Open azimuth": {
            "gyro_forward": 0.0, "gyro_up": 0.1, "gyro_right": 0.0, "speed": 0.0, "turn": 0.0
        },
        "Whole turn": {"turn": 360.0},
    }  # fmt: skip

    def compute(self, values: Values) -> ErrorsUnderWay:
        latitude, course, turn = (
            float(np.radians(values[name])) for name in ("latitude", "course", "turn")
        )
        gyros = np.array([values[f"gyro_{axis}"] for axis in BODY_AXES])
        return operation.compute(
            latitude,
            values["speed"],
            course,
            turn,
            gyros * degree / hour,
            tuning_factor=values["tuning"],
            damping=values["damping"],
            tilt=values["tilt"] * arcminute,
            log=values["log"],
        )

    def numbers(self, data: ErrorsUnderWay) -> list[tuple[str, str]]:
        worst = np.abs(data.tilt).max(axis=0) / arcminute
        gap = np.abs(data.heading_error - data.formula.heading).max()
        # Of first order: good while all angles are small.
        large = max(np.abs(data.yaw_error).max(), np.abs(data.compass_error).max()) > 0.2
        return [
            ("largest heading error", _degrees(np.abs(data.heading_error).max())),
            ("at the end", _degrees(data.heading_error[-1])),
            ("largest gap to the formula", "too large errors for it" if large else _degrees(gap)),
            ("largest tilt about North", f"{worst[0]:.3f}′"),
            ("largest tilt about East", f"{worst[1]:.3f}′"),
            ("largest speed deviation", _degrees(np.abs(data.deviation).max())),
            ("yaw error at the end", _degrees(data.yaw_error[-1])),
            ("compass error at the end", _degrees(data.compass_error[-1])),
        ]

    def call(self, values: Values) -> str:
        gyros = [values[f"gyro_{axis}"] for axis in BODY_AXES]
        return (
            "import numpy as np\n"
            "from scipy.constants import arcminute, degree, hour\n"
            "from driftlab.figures import operation\n"
            f"run = operation.compute(*np.radians([{values['latitude']}]), {values['speed']},\n"
            f"    *np.radians([{values['course']}, {values['turn']}]),\n"
            f"    np.array({gyros}) * degree / hour, tuning_factor={values['tuning']},\n"
            f"    damping={values['damping']}, tilt={values['tilt']} * arcminute,\n"
            f"    log={values['log']})\n"
            "print(np.degrees(run.heading_error[-1]), np.degrees(run.formula.heading[-1]))"
        )


PAIRS = ("forward-up", "forward-right", "up-right")


class CapstoneExplorer(Explorer):
    """One bent triad, from the bend to the heading."""

    title = "One triad through all four papers"
    picture_class = capstone.CapstonePicture
    controls = (
        *(
            Control(f"pair_{i}", f"{pair}, ″", round(float(value / arcsecond), 6), -100.0, 100.0,
                    1.0, group="non-orthogonality")
            for i, (pair, value) in enumerate(
                zip(PAIRS, capstone.NON_ORTHOGONALITY, strict=True)
            )
        ),
        *(
            Control(f"turn_{axis}", f"about {axis}, ″", round(float(value / arcsecond), 6), -100.0,
                    100.0, 1.0, group="misalignment")
            for axis, value in zip(BODY_AXES, capstone.MISALIGNMENT, strict=True)
        ),
        Control("latitude", "latitude, °", 51.5, -85.0, 85.0, 0.5, group="ship"),
        Control("turn", "ship turns by, °", 90.0, -360.0, 360.0, 5.0, group="ship"),
        Control("cone", "mount shakes by, ′", 0.0, 0.0, 10.0, 0.1, group="ship"),
        Control("algorithm", "attitude algorithm", "two-step-4", choices=tuple(ALGORITHMS),
                group="ship"),
    )  # fmt: skip
    presets: ClassVar = {
        "Bent and turned": {},
        "The puzzle": {
            **{f"pair_{i}": 0.0 for i in range(3)}, **{f"turn_{axis}": 0.0 for axis in BODY_AXES},
            "pair_0": -15.0, "turn_right": 15.0,
        },
        "Bent only": {f"turn_{axis}": 0.0 for axis in BODY_AXES},
        "Turned as a whole": {f"pair_{i}": 0.0 for i in range(3)},
        "Straight": {
            **{f"pair_{i}": 0.0 for i in range(3)}, **{f"turn_{axis}": 0.0 for axis in BODY_AXES}
        },
        "The ship turns right round": {"turn": 360.0},
        "A shaking mount, no correction": {"cone": 3.0, "algorithm": "picard-1"},
        "A shaking mount, corrected": {"cone": 3.0},
    }  # fmt: skip

    def compute(self, values: Values) -> capstone.Capstone:
        return capstone.compute(
            np.array([values[f"pair_{i}"] for i in range(3)]) * arcsecond,
            np.array([values[f"turn_{axis}"] for axis in BODY_AXES]) * arcsecond,
            float(np.radians(values["latitude"])),
            float(np.radians(values["turn"])),
            half_angle=values["cone"] * arcminute,
            algorithm=values["algorithm"],
        )

    def numbers(self, data: capstone.Capstone) -> list[tuple[str, str]]:
        rows = []
        for i, stage in enumerate(capstone.STAGES):
            drift = np.abs(data.per_turn[i]).max() / arcsecond
            rows += [
                (f"drift in a turn, {stage}", f"{drift:.1f}″"),
                (f"aligned heading, {stage}",
                 f"{np.abs(data.aligned[i]).max() / arcminute:.3f}′"),
                (f"under way, {stage}",
                 _degrees(np.abs(data.under_way.heading_error[i]).max())),
            ]  # fmt: skip
        return rows

    def call(self, values: Values) -> str:
        pairs = [values[f"pair_{i}"] for i in range(3)]
        turns = [values[f"turn_{axis}"] for axis in BODY_AXES]
        return (
            "import numpy as np\n"
            "from scipy.constants import arcminute, arcsecond\n"
            "from driftlab.figures import capstone\n"
            f"story = capstone.compute(np.array({pairs}) * arcsecond,\n"
            f"    np.array({turns}) * arcsecond,\n"
            f"    *np.radians([{values['latitude']}, {values['turn']}]),\n"
            f"    half_angle={values['cone']} * arcminute, algorithm={values['algorithm']!r})\n"
            "print(*np.degrees(abs(story.under_way.heading_error).max(axis=-1)))"
        )
