"""The slider panel of chapter 01."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Explorer, Values
from driftlab.book.machinery.panel.results import Results
from driftlab.book.machinery.panel.units import angle_text, number_text

from .experiments import DURATION, SAMPLES, SPIN, error_motion
from .figures.error_motion import ErrorMotionPicture

TOLERANCES = (1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1)


class ErrorMotionExplorer(Explorer):
    """Components of the error quaternion for any true and measured rate."""

    title = "Error quaternion for a constant true and measured rate"
    picture_class = ErrorMotionPicture
    controls = (
        *(
            Control(f"rate{i}", f"axis {i}, °/s", start, -15.0, 15.0, 0.5, group="true rate")
            for i, start in zip((1, 2, 3), (6.0, 12.0, 6.0), strict=True)
        ),
        *(
            Control(f"error{i}", f"axis {i}, °/s", start, -3.0, 3.0, 0.05, group="gyro error")
            for i, start in zip((1, 2, 3), (1.0, -3.0, 0.0), strict=True)
        ),
        Control("tolerance", "RK45 tolerance", 1e-2, stops=TOLERANCES, group="integrator"),
    )
    presets: ClassVar = {
        "Gross error": {},
        "Error along the rate": {
            "rate1": 0.0, "rate2": 0.0, "rate3": SPIN, "error1": 0.0, "error2": 0.0, "error3": 1.0
        },
        "Error across the rate": {
            "rate1": 0.0, "rate2": 0.0, "rate3": SPIN, "error1": 1.0, "error2": 0.0, "error3": 0.0
        },
        "A true zero": {"rate1": 0.0, "rate2": 0.0, "rate3": 0.0},
    }  # fmt: skip
    look_for: ClassVar = {
        "Gross error": "The dots are a numerical integrator. Where do they leave the lines?",
        "Error along the rate": "Does the error come back after a turn, or does it grow?",
        "Error across the rate": "The same size of error, turned by 90°. What is different now?",
        "A true zero": "The body stands still. What is left for the error to do?",
    }

    def compute(self, values: Values) -> DataTable:
        rate, error = (
            np.radians([values[f"{name}{i}"] for i in (1, 2, 3)]) for name in ("rate", "error")
        )
        return error_motion(rate, rate + error, tolerance=values["tolerance"])

    def numbers(self, table: DataTable) -> Results:
        return Results(
            ("error after one whole turn", angle_text(table.after_one_turn)),
            [
                *(
                    table.row(name, ".3f")
                    for name in ("true_rate", "measured_rate", "sum", "difference")
                ),
                table.row("steps", ".0f"),
                ("its largest error", number_text(table.largest_error)),
            ],
        )

    def call(self, values: Values) -> str:
        rate = [values[f"rate{i}"] for i in (1, 2, 3)]
        error = [values[f"error{i}"] for i in (1, 2, 3)]
        return (
            "import numpy as np\nfrom driftlab.drift import error_quaternion\n"
            f"rate = np.radians({rate})\nmeasured_rate = rate + np.radians({error})\n"
            f"error_quaternion(rate, measured_rate, np.linspace(0, {DURATION:g}, {SAMPLES}))"
        )


PANELS = (ErrorMotionExplorer,)
