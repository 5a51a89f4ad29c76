"""The slider panel of chapter 01."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from driftlab.book.machinery.control import Control
from driftlab.book.machinery.panel import Explorer, Values
from driftlab.book.machinery.results import ABSENT, Results
from driftlab.book.machinery.units import angle_text, number_text
from driftlab.checks import FloatArray
from driftlab.drift.error_kinematics import error_quaternion
from driftlab.quaternion import rotation_angle

from .experiments import (
    DURATION,
    SAMPLES,
    SPIN,
    ErrorMotion,
    error_motion,
    integration_error,
)
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

    @staticmethod
    def _rates(values: Values) -> tuple[FloatArray, FloatArray]:
        rate = np.radians([values[f"rate{i}"] for i in (1, 2, 3)])
        return rate, rate + np.radians([values[f"error{i}"] for i in (1, 2, 3)])

    def compute(self, values: Values) -> ErrorMotion:
        return error_motion(*self._rates(values), tolerance=values["tolerance"])

    def numbers(self, data: ErrorMotion) -> Results:
        rate, measured = self._rates(self.values)
        worst = integration_error(data, rate, measured).max()
        true_size, size = np.linalg.norm([rate, measured], axis=-1)
        after = ABSENT
        if true_size:
            turned = error_quaternion(rate, measured, 2 * np.pi / true_size)
            after = angle_text(float(rotation_angle(turned)))
        sizes = (true_size, size, size + true_size, size - true_size)
        names = ("true rate", "measured rate", "sum: the fast root", "difference: the slow one")
        return Results(
            ("error after one whole turn", after),
            [
                *(
                    (name, f"{np.degrees(value):.3f} °/s")
                    for name, value in zip(names, sizes, strict=True)
                ),
                ("steps of the integrator", f"{len(data.integrated_time) - 1}"),
                ("its largest error", number_text(float(worst))),
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
