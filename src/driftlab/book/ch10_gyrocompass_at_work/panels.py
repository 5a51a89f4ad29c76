"""The slider panel of chapter 10."""

from typing import ClassVar

import numpy as np
from scipy.constants import arcminute, degree

from driftlab.book.machinery.control import Control
from driftlab.book.machinery.panel import Explorer, Values
from driftlab.book.machinery.sensor_controls import (
    BODY_AXES,
    degrees_text,
    gyro_bias_code,
    gyro_biases,
    gyro_controls,
    slider_value,
)
from driftlab.book.scenarios import QUARTER_TURN, SARATOV_LATITUDE, SPEED, ship_manoeuvre
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
        Control("tuning", "tuning k2 R", 1.0, stops=TUNING_FACTORS, group="instrument"),
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

    def numbers(self, data: HeadingErrors) -> list[tuple[str, str]]:
        worst = np.abs(data.tilt).max(axis=0) / arcminute
        gap = np.abs(data.heading_error - data.formula.heading).max()
        # Of first order: good while all angles are small.
        large = max(np.abs(data.yaw_error).max(), np.abs(data.compass_error).max()) > 0.2
        return [
            ("largest heading error", degrees_text(np.abs(data.heading_error).max())),
            ("at the end", degrees_text(data.heading_error[-1])),
            (
                "largest gap to the formula",
                "too large errors for it" if large else degrees_text(gap),
            ),
            ("largest tilt about North", f"{worst[0]:.3f}′"),
            ("largest tilt about East", f"{worst[1]:.3f}′"),
            ("largest speed error", degrees_text(np.abs(data.speed_error).max())),
            ("yaw error at the end", degrees_text(data.yaw_error[-1])),
            ("compass error at the end", degrees_text(data.compass_error[-1])),
        ]

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


PANELS = (GyrocompassExplorer,)
