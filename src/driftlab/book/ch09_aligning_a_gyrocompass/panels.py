"""The slider panel of chapter 09."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from driftlab.book.machinery.control import Control
from driftlab.book.machinery.panel import Explorer, Values
from driftlab.book.machinery.sensor_controls import (
    BODY_AXES,
    _degrees,
    _sensor_controls,
    _sensor_lines,
    _sensors,
)

from .figures import alignment_budget

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
            "from driftlab.frames import attitude_from_angles\n"
            "from driftlab.motion import sensed_at_rest\n"
            f"{_sensor_lines(values)}"
            f"attitude = attitude_from_angles(*np.radians([{heading}, {pitch}, {roll}]))\n"
            f"rate, force = sensed_at_rest(attitude, np.radians({latitude}))\n"
            f"error = align(rate + drift, force + offset).heading - np.radians({heading})\n"
            "print(np.degrees(np.arctan2(np.sin(error), np.cos(error))))"
        )


PANELS = (AlignmentBudgetExplorer,)
