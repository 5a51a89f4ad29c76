"""The slider panel of chapter 13."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from scipy.constants import degree

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Explorer, Values
from driftlab.book.machinery.panel.results import ABSENT, Results
from driftlab.book.machinery.panel.sensor_controls import (
    BODY_AXES,
    accelerometer_bias_code,
    accelerometer_biases,
    accelerometer_controls,
    gyro_bias_code,
    gyro_biases,
    gyro_controls,
    slider_value,
)
from driftlab.book.machinery.panel.units import degrees_text
from driftlab.book.scenarios import SARATOV_LATITUDE

from .experiments import (
    ACCELEROMETER_BIAS,
    GYRO_BIAS,
    HEADING,
    PITCH,
    ROLL,
    TERMS,
    alignment_budget,
)
from .figures.alignment_budget import AlignmentBudgetPicture

NO_ERRORS = {f"{kind}_{axis}": 0.0 for kind in ("gyro", "acc") for axis in BODY_AXES}


class AlignmentBudgetExplorer(Explorer):
    """Six sensor errors, and what each does to the heading."""

    title = "Error budget of an alignment"
    picture_class = AlignmentBudgetPicture
    controls = (
        Control("latitude", "latitude, °", slider_value(SARATOV_LATITUDE, degree), -89.5, 89.5,
                0.5, group="place"),
        Control("heading", "heading to West, °", slider_value(HEADING, degree), -180.0, 180.0,
                1.0, group="place"),
        Control("pitch", "pitch, °", slider_value(PITCH, degree), -90.0, 90.0, 1.0, group="place"),
        Control("roll", "roll, °", slider_value(ROLL, degree), -180.0, 180.0, 1.0, group="place"),
        *gyro_controls(GYRO_BIAS, 0.2),
        *accelerometer_controls(ACCELEROMETER_BIAS),
    )  # fmt: skip
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
    look_for: ClassVar = {
        "A bit of everything": "Six small errors. Which one spoils the heading most?",
        "No errors, level, to the North": "Nothing is wrong. Add one error, and turn the heading.",
        "One gyro, level": "At which headings does this gyro do no harm at all?",
        "One accelerometer, level": "Move to the equator. What happens there? Then lift the bow.",
        "Far North": "The same sensors, 85° of latitude. Which bars have grown?",
        "Nearly vertical": "Five degrees more to go. What will the heading do?",
        "Vertical": "The bow points to the zenith. Where does it head now?",
        "Upside down": "Belly up. Which of the six errors have changed sides?",
    }

    def compute(self, values: Values) -> DataTable:
        latitude, heading, pitch, roll = (
            float(np.radians(values[name])) for name in ("latitude", "heading", "pitch", "roll")
        )
        return alignment_budget(
            latitude, heading, pitch, roll, gyro_biases(values), accelerometer_biases(values)
        )

    def numbers(self, table: DataTable) -> Results:
        *terms, total, exact = table.error
        rows = [
            ("heading", degrees_text(exact), degrees_text(total)),
            *(
                (f"by {name}", ABSENT, degrees_text(term))
                for name, term in zip(TERMS[:-2], terms, strict=True)
            ),
        ]
        for name in ("pitch", "roll", "latitude", "attitude"):
            first_order, error = getattr(table, name)
            rows.append((name, degrees_text(error), degrees_text(first_order)))
        no_heading = np.isnan(exact)
        return Results(
            ("heading error", "no heading" if no_heading else degrees_text(exact)),
            rows,
            ("exact", "first order"),
        )

    def call(self, values: Values) -> str:
        latitude, heading, pitch, roll = (
            values[name] for name in ("latitude", "heading", "pitch", "roll")
        )
        return (
            "import numpy as np\n"
            "from scipy.constants import degree, g, hour, milli\n"
            "from driftlab.gyrocompass import align\n"
            "from driftlab.frames import from_euler_angles\n"
            "from driftlab.motion import static_imu\n"
            f"{gyro_bias_code(values)}{accelerometer_bias_code(values)}"
            f"attitude = from_euler_angles(*np.radians([{heading}, {pitch}, {roll}]))\n"
            f"rate, force = static_imu(attitude, np.radians({latitude}))\n"
            "wrong = rate + gyro_bias, force + accelerometer_bias\n"
            "found = align(*wrong, heading_tolerance=np.inf)  # no warning of what was put in\n"
            f"error = found.heading - np.radians({heading})\n"
            "print(np.degrees(np.arctan2(np.sin(error), np.cos(error))))"
        )


PANELS = (AlignmentBudgetExplorer,)
