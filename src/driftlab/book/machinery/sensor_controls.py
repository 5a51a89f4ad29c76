"""Sliders for the errors of six sensors: the same wherever there are some."""

from __future__ import annotations

import numpy as np
from scipy.constants import degree, g, hour, milli

from driftlab.checks import FloatArray

from .control import Control
from .panel import Values

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
