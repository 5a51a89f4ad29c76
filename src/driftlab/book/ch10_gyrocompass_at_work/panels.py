"""The slider panel of chapter 10."""

from typing import ClassVar

import numpy as np
from scipy.constants import arcminute, degree

from driftlab.book.machinery.control import Control
from driftlab.book.machinery.panel import Explorer, Values
from driftlab.book.machinery.results import ABSENT, Results
from driftlab.book.machinery.sensor_controls import (
    BODY_AXES,
    gyro_bias_code,
    gyro_biases,
    gyro_controls,
    slider_value,
)
from driftlab.book.scenarios import QUARTER_TURN, SARATOV_LATITUDE, SPEED, ship_manoeuvre
from driftlab.checks import FloatArray
from driftlab.gyrocompass.simulation import HeadingErrors, simulate_compass

from .experiments import GYRO_BIAS, TUNING_FACTORS
from .figures.operation import OperationPicture


class GyrocompassExplorer(Explorer):
    """A compass on board, for two hours."""

    title = "A gyrocompass at work"
    picture_class = OperationPicture
    controls = (
        Control("latitude", "latitude, °", slider_value(SARATOV_LATITUDE, degree), -85.0, 85.0,
                0.5, group="ship"),
        Control("speed", "speed, m/s", SPEED, 0.0, 30.0, 0.5, group="ship"),
        Control("course", "course to West, °", 0.0, -180.0, 180.0, 5.0, group="ship"),
        Control("turn", "then turns by, °", slider_value(QUARTER_TURN, degree), -360.0, 360.0,
                5.0, group="ship"),
        Control("tuning", "tuning k₂R", 1.0, stops=TUNING_FACTORS, group="instrument"),
        Control("damping", "damping ratio", 0.0, 0.0, 1.0, 0.05, group="instrument"),
        Control("tilt", "tilt at the start, ′", 0.0, -3.0, 3.0, 0.1, group="instrument"),
        *gyro_controls(GYRO_BIAS, 0.1),
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
        "Damped by the log": {"damping": 0.5, "log": True},
        "Open azimuth": {
            "gyro_forward": 0.0, "gyro_up": 0.1, "gyro_right": 0.0, "speed": 0.0, "turn": 0.0
        },
        "Whole turn": {"turn": 360.0},
    }  # fmt: skip
    look_for: ClassVar = {
        "Small drifts, a turn": "Find the turn that does the least harm to the heading.",
        "Perfect sensors": "Nothing is wrong with the sensors. Where does the error come from?",
        "Perfect sensors and a log": "A log tells the velocity. What does it take away?",
        "Swinging for 84 minutes": "Change the latitude. Who minds: the tilt, or the heading?",
        "Tuned too stiffly": "Tuned off Schuler's period. Is too stiff worse than too soft?",
        "Damped": "The swing dies out. What is the price?",
        "Damped by the log": "When the swing has gone, what is left?",
        "Open azimuth": "One gyro drifts about Up. Which curve is a straight line?",
        "Whole turn": "The ship comes back to its course. Does the heading come back too?",
    }

    def compute(self, values: Values) -> HeadingErrors:
        latitude, course, turn = (
            float(np.radians(values[name])) for name in ("latitude", "course", "turn")
        )
        return simulate_compass(
            ship_manoeuvre(latitude, values["speed"], course, turn),
            gyro_biases(values),
            tuning_factor=values["tuning"],
            damping=values["damping"],
            tilt=values["tilt"] * arcminute,
            log=values["log"],
        )

    def numbers(self, data: HeadingErrors) -> Results:
        # The formula is of first order: good while all angles are small.
        large = max(np.abs(data.yaw_error).max(), np.abs(data.compass_error).max()) > 0.2
        gap = np.abs(data.heading_error - data.formula.heading)
        rows = [
            _row(name, np.degrees(error), "°", 4)
            for name, error in (
                ("heading", data.heading_error),
                ("of it, yaw ψ", data.yaw_error),
                ("of it, compass angle", data.compass_error),
                ("speed deviation", data.speed_error),
                ("off the formula", np.full(1, np.nan) if large else gap),
            )
        ]
        for i, axis in enumerate(("North", "East")):
            rows.append(_row(f"tilt about {axis}", data.tilt[:, i] / arcminute, "′", 3))
        return Results(("largest heading error", rows[0][1]), rows, ("largest", "at the end"))

    def call(self, values: Values) -> str:
        latitude, speed, course, turn = (
            values[name] for name in ("latitude", "speed", "course", "turn")
        )
        return (
            "import numpy as np\n"
            "from scipy.constants import arcminute, degree, hour\n"
            "from driftlab.book.scenarios import ship_manoeuvre\n"
            "from driftlab.gyrocompass import simulate_compass\n"
            f"{gyro_bias_code(values)}"
            f"latitude, course, turn = np.radians([{latitude}, {course}, {turn}])\n"
            f"way = ship_manoeuvre(latitude, {speed}, course, turn)\n"
            f"run = simulate_compass(way, gyro_bias, tuning_factor={values['tuning']},\n"
            f"    damping={values['damping']}, tilt={values['tilt']} * arcminute,\n"
            f"    log={values['log']})\n"
            "print(np.degrees(run.heading_error[-1]), np.degrees(run.formula.heading[-1]))"
        )


def _row(name: str, error: FloatArray, unit: str, decimals: int) -> tuple[str, str, str]:
    """Name of an error, its largest size and its last value, in a unit."""
    sizes = (np.abs(error).max(), error[-1])
    largest, last = (ABSENT if np.isnan(x) else f"{x:.{decimals}f}{unit}" for x in sizes)
    return name, largest, last


PANELS = (GyrocompassExplorer,)
