"""The slider panel of chapter 14."""

from typing import Any, ClassVar

import numpy as np
from scipy.constants import arcminute, degree

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Explorer, Values
from driftlab.book.machinery.panel.results import ABSENT, Results
from driftlab.book.machinery.panel.sensor_controls import (
    BODY_AXES,
    gyro_bias_code,
    gyro_biases,
    gyro_controls,
    slider_value,
)
from driftlab.book.scenarios import QUARTER_TURN, SARATOV_LATITUDE, SPEED, ship_manoeuvre
from driftlab.checks import FloatArray
from driftlab.gyrocompass.simulation import simulate_gyrocompass

from .experiments import GYRO_BIAS, TUNING_FACTORS, error_table
from .figures.operation import OperationPicture

PERFECT: dict[str, Any] = {f"gyro_{axis}": 0.0 for axis in BODY_AXES}
"""Gyros without a bias."""


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
        "Perfect sensors": PERFECT,
        "Perfect sensors and a log": PERFECT | {"log": True},
        "Swinging for 84 minutes": PERFECT | {"speed": 0.0, "turn": 0.0, "tilt": 1.0},
        "Tuned too stiffly": PERFECT | {"tuning": 2.0},
        "Damped": PERFECT | {"damping": 0.5},
        "Damped by the log": {"damping": 0.5, "log": True},
        "Open azimuth": PERFECT | {"gyro_up": 0.1, "speed": 0.0, "turn": 0.0},
        "Whole turn": {"turn": 360.0},
    }
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

    def compute(self, values: Values) -> DataTable:
        latitude, course, turn = (
            float(np.radians(values[name])) for name in ("latitude", "course", "turn")
        )
        run = simulate_gyrocompass(
            ship_manoeuvre(latitude, values["speed"], course, turn),
            gyro_biases(values),
            tuning_factor=values["tuning"],
            damping=values["damping"],
            tilt=values["tilt"] * arcminute,
            speed_log=values["log"],
        )
        return error_table(run)

    def numbers(self, table: DataTable) -> Results:
        # The formula is of first order: good while all angles are small.
        large = max(np.abs(table.yaw_error).max(), np.abs(table.compass_angle_error).max()) > 0.2
        gap = np.degrees(np.abs(table.heading_error - table.formula))
        rows = [
            _row("heading", table.shown("heading_error"), "°", 4),
            _row("of it, yaw ψ", table.shown("yaw_error"), "°", 4),
            _row("of it, compass angle", table.shown("compass_angle_error"), "°", 4),
            _row("speed deviation", table.shown("speed_error"), "°", 4),
            _row("off the formula", np.full(1, np.nan) if large else gap, "°", 4),
            _row("tilt about North", table.shown("tilt_north"), "′", 3),
            _row("tilt about East", table.shown("tilt_east"), "′", 3),
        ]
        return Results(("largest heading error", rows[0][1]), rows, ("largest", "at the end"))

    def call(self, values: Values) -> str:
        latitude, speed, course, turn = (
            values[name] for name in ("latitude", "speed", "course", "turn")
        )
        return (
            "import numpy as np\n"
            "from scipy.constants import arcminute, degree, hour\n"
            "from driftlab.book.scenarios import ship_manoeuvre\n"
            "from driftlab.gyrocompass import simulate_gyrocompass\n"
            f"{gyro_bias_code(values)}"
            f"latitude, course, turn = np.radians([{latitude}, {course}, {turn}])\n"
            f"way = ship_manoeuvre(latitude, {speed}, course, turn)\n"
            f"run = simulate_gyrocompass(way, gyro_bias, tuning_factor={values['tuning']},\n"
            f"    damping={values['damping']}, tilt={values['tilt']} * arcminute,\n"
            f"    speed_log={values['log']})\n"
            "print(np.degrees(run.heading_error[-1]), np.degrees(run.formula.heading[-1]))"
        )


def _row(name: str, error: FloatArray, unit: str, decimals: int) -> tuple[str, str, str]:
    """Name of an error, its largest size and its last value, in a unit."""
    sizes = (np.abs(error).max(), error[-1])
    largest, last = (ABSENT if np.isnan(x) else f"{x:.{decimals}f}{unit}" for x in sizes)
    return name, largest, last


PANELS = (GyrocompassExplorer,)
