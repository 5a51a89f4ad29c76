"""The slider panel of chapter 05."""

from __future__ import annotations

from typing import ClassVar

from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Values

from ..ch04_calibration_by_turns.experiments import SENSES
from ..ch04_calibration_by_turns.panels import (
    NOISE_CONTROL,
    TRIAD_CONTROLS,
    TURN_CONTROLS,
    TurnCalibrationExplorer,
)

PERFECT = {"sigma2": 0.0, "sigma3": 0.0}


class EarthTurnsExplorer(TurnCalibrationExplorer):
    """Calibration by turns on the Earth, with gyro biases and badly known axes."""

    title = "Calibration by turns on the Earth: estimated against true errors"
    controls = (
        *TRIAD_CONTROLS,
        *TURN_CONTROLS,
        NOISE_CONTROL,
        Control("axis", "error of an axis, ″", 0.0, 0.0, 120.0, 5.0, group="experiment"),
        Control("earth", "Earth", "turning", choices=("none", "turning"), group="table"),
        Control("latitude", "latitude, °", 37.5, -85.0, 85.0, 0.5, group="table"),
        Control("rate", "table rate, °/s", 10.0, 5.0, 100.0, 1.0, group="table"),
        Control("senses", "directions", "one", choices=tuple(SENSES), group="table"),
        Control("bias", "gyro bias, °/h", 0.0, -1.0, 1.0, 0.05, group="table"),
    )
    fixed: ClassVar[Values] = {"steps": 100, "formula": "exact"}
    presets: ClassVar = {
        "A perfect triad": PERFECT,
        "Larin's triad": {"skew": 1.0},
        "Both directions": {"skew": 1.0, "senses": "both"},
        "Common offset": {"skew": 1.0, "plan": "four axes, least squares and common scale"},
        "Axes known to 60″": {
            "skew": 1.0, "earth": "none", "noise": 5.0, "axis": 60.0,
            "plan": "six axes, least squares and three scales",
        },
    }  # fmt: skip
    look_for: ClassVar = {
        "A perfect triad": "Nothing is misaligned, and something is found. What is it?",
        "Larin's triad": "How much of what is found belongs to the triad?",
        "Both directions": "Turned forth and back. What has become of the Earth?",
        "Common offset": "Another remedy. Add a gyro bias: does it still work?",
        "Axes known to 60″": "Which of the nine pay for it? Then turn about three axes only.",
    }


PANELS = (EarthTurnsExplorer,)
