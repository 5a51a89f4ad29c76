"""The slider panels of chapter 14."""

from typing import Any, ClassVar

import numpy as np
from scipy.constants import arcminute, degree, hour, knot, minute

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
from driftlab.gyrocompass.noise import GyroNoise
from driftlab.gyrocompass.simulation import simulate_gyrocompass
from driftlab.gyrocompass.type_test import COARSE, LIMITS, Gyrocompass, TypeTest, marine_type_test

from .experiments import GYRO_BIAS, TUNING_FACTORS, error_table
from .figures.operation import OperationPicture
from .figures.type_tests import BarsPicture

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


class TypeTestExplorer(Explorer):
    """A compass on the tests of the marine standards: a bar for each, as share of its limit.

    Parameters
    ----------
    preset : str, optional
        Name of the preset to open with. Single values are set afterwards, as in
        ``explorer.set(latitude=80.0)``, by the names that ``explorer.values`` shows.
    """

    title = "Would it pass?"
    picture_class = BarsPicture
    controls = (
        Control("drift", "lasting drift, °/h", 0.05,
                stops=(0.0, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0),
                group="level gyros"),
        Control("gauss_markov", "at each start, °/h", 0.01,
                stops=(0.0, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0), group="level gyros"),
        Control("walk", "random walk, °/√h", 0.0003,
                stops=(0.0, 0.0003, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3), group="level gyros"),
        Control("alignment", "alignment, min", 1.0, stops=(0.5, 1.0, 2.0, 5.0, 10.0, 30.0),
                group="instrument"),
        Control("damping", "damping ratio", 0.0, 0.0, 1.0, 0.05, group="instrument"),
        Control("latitude", "latitude, °", slider_value(SARATOV_LATITUDE, degree), -85.0, 85.0,
                0.5, group="trials"),
        Control("speed", "speed, kn", 70.0, 10.0, 70.0, 5.0, group="trials"),
        Control("log", "a log tells the velocity", False, group=""),
    )  # fmt: skip
    presets: ClassVar = {
        "The paper's compass": {},
        "80 degrees North": {"latitude": 80.0},
        "Damped without a log": {"damping": 0.5},
        "Damped by a log": {"damping": 0.5, "log": True},
        "A tactical gyro": {"drift": 1.0, "gauss_markov": 0.3, "walk": 0.03},
        "A MEMS gyro": {"drift": 10.0, "gauss_markov": 3.0, "walk": 0.3},
    }
    look_for: ClassVar = {
        "The paper's compass": "Move the latitude alone. Which bars stay, and which grow?",
        "80 degrees North": "Which limits are failed, and what do they have in common?",
        "Damped without a log": "At the quay all is well. What is not?",
        "Damped by a log": "What has the log made good, and what does the drift still do?",
        "A tactical gyro": "How many times better must the gyros be? Look for the longest bar.",
        "A MEMS gyro": "Is there anything that a longer alignment can do?",
    }

    def compute(self, values: Values) -> TypeTest:
        noise = GyroNoise(
            white=values["walk"] * degree / np.sqrt(hour),
            gauss_markov=values["gauss_markov"] * degree / hour, interval=1.0,
        )  # fmt: skip
        compass = Gyrocompass(
            gyro_bias=(0.0, 0.0, values["drift"] * degree / hour),
            gyro_noise=noise,
            damping=values["damping"],
            speed_log=values["log"],
            alignment_time=values["alignment"] * minute,
        )
        latitude, speed = float(np.radians(values["latitude"])), values["speed"] * knot
        return marine_type_test(compass, latitude, speed=speed, steps=COARSE)

    def numbers(self, data: TypeTest) -> Results:
        rows = []
        for test, share in data.shares.items():
            measured, limit = data.measured[test], LIMITS[test].at(data.latitude)
            if np.isinf(measured):
                shown = "never"
            elif test == "settling":
                shown = f"{measured / hour:.2f} h"
            else:
                shown = f"{np.degrees(measured):.4f}°"
            most = f"{limit / hour:.2f} h" if test == "settling" else f"{np.degrees(limit):.3f}°"
            rows.append((test, shown, most, ABSENT if np.isinf(share) else f"{share:.3f}"))
        kept = sum(data.passed.values())
        return Results(
            ("limits kept", f"{kept} of {len(rows)}"),
            rows,
            ("measured", "limit", "share"),
            "The gyros' noise is drawn once; another draw gives other numbers.",
        )

    def call(self, values: Values) -> str:
        return (
            "import numpy as np\n"
            "from scipy.constants import degree, hour, knot, minute\n"
            "from driftlab.gyrocompass import COARSE, Gyrocompass, GyroNoise, marine_type_test\n"
            f"noise = GyroNoise(white={values['walk']} * degree / np.sqrt(hour),\n"
            f"    gauss_markov={values['gauss_markov']} * degree / hour, interval=1.0)\n"
            f"compass = Gyrocompass((0.0, 0.0, {values['drift']} * degree / hour), noise,\n"
            f"    damping={values['damping']}, speed_log={values['log']},\n"
            f"    alignment_time={values['alignment']} * minute)\n"
            f"found = marine_type_test(compass, np.radians({values['latitude']}),\n"
            f"    speed={values['speed']} * knot, steps=COARSE)\n"
            "print(np.degrees(found.measured['turn']))"
        )


PANELS = (GyrocompassExplorer, TypeTestExplorer)
