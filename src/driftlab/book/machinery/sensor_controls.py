"""Sliders for the errors of gyros and accelerometers: the same wherever there are some."""

from __future__ import annotations

import numpy as np
from scipy.constants import degree, g, hour, milli

from driftlab.checks import FloatArray

from .control import Control
from .panel import Values

BODY_AXES = ("forward", "up", "right")


def slider_value(quantity: float, unit: float) -> float:
    """Return a quantity in the unit of its slider, without the last digits of the conversion."""
    return round(float(quantity / unit), 6)


def degrees_text(angle: float) -> str:
    """Return an angle, rad, as a panel shows it in degrees; NaN is shown as "none"."""
    return "none" if np.isnan(angle) else f"{np.degrees(angle):.4f}°"


def gyro_controls(drift: FloatArray, most: float) -> tuple[Control, ...]:
    """Return sliders up to `most` deg/h for three gyro drifts (3,) that begin at `drift`, rad/s."""
    return tuple(
        Control(f"gyro_{axis}", f"{axis}, °/h", slider_value(value, degree / hour), -most, most,
                0.005, group="gyro drifts")
        for axis, value in zip(BODY_AXES, drift, strict=True)
    )  # fmt: skip


def accelerometer_controls(offset: FloatArray) -> tuple[Control, ...]:
    """Return sliders up to 5 mg for three offsets (3,) that begin at `offset`, m/s^2."""
    return tuple(
        Control(f"acc_{axis}", f"{axis}, mg", slider_value(value, milli * g), -5.0, 5.0, 0.05,
                group="accelerometer offsets")
        for axis, value in zip(BODY_AXES, offset, strict=True)
    )  # fmt: skip


def gyro_drifts(values: Values) -> FloatArray:
    """Return the drifts (3,) of `gyro_controls`, rad/s."""
    return np.array([values[f"gyro_{axis}"] for axis in BODY_AXES]) * degree / hour


def accelerometer_offsets(values: Values) -> FloatArray:
    """Return the offsets (3,) of `accelerometer_controls`, m/s^2."""
    return np.array([values[f"acc_{axis}"] for axis in BODY_AXES]) * milli * g


def gyro_drift_code(values: Values) -> str:
    """Return the line of Python that defines `drift` as `gyro_drifts` does."""
    return f"drift = np.array({[values[f'gyro_{axis}'] for axis in BODY_AXES]}) * degree / hour\n"


def accelerometer_offset_code(values: Values) -> str:
    """Return the line of Python that defines `offset` as `accelerometer_offsets` does."""
    return f"offset = np.array({[values[f'acc_{axis}'] for axis in BODY_AXES]}) * milli * g\n"
