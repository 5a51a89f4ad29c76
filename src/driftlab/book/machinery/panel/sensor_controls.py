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


def gyro_controls(gyro_bias: FloatArray, most: float) -> tuple[Control, ...]:
    """Return sliders up to `most` deg/h for gyro biases that begin at `gyro_bias` (3,), rad/s."""
    return tuple(
        Control(f"gyro_{axis}", f"{axis}, °/h", slider_value(value, degree / hour), -most, most,
                0.005, group="gyro biases")
        for axis, value in zip(BODY_AXES, gyro_bias, strict=True)
    )  # fmt: skip


def accelerometer_controls(accelerometer_bias: FloatArray) -> tuple[Control, ...]:
    """Return sliders up to 5 mg for three biases (3,) that begin at `accelerometer_bias`, m/s^2."""
    return tuple(
        Control(f"acc_{axis}", f"{axis}, mg", slider_value(value, milli * g), -5.0, 5.0, 0.05,
                group="accelerometer biases")
        for axis, value in zip(BODY_AXES, accelerometer_bias, strict=True)
    )  # fmt: skip


def gyro_biases(values: Values) -> FloatArray:
    """Return the biases (3,) of `gyro_controls`, rad/s."""
    return np.array([values[f"gyro_{axis}"] for axis in BODY_AXES]) * degree / hour


def accelerometer_biases(values: Values) -> FloatArray:
    """Return the biases (3,) of `accelerometer_controls`, m/s^2."""
    return np.array([values[f"acc_{axis}"] for axis in BODY_AXES]) * milli * g


def gyro_bias_code(values: Values) -> str:
    """Return the line of Python that defines `gyro_bias` as `gyro_biases` does."""
    return (
        f"gyro_bias = np.array({[values[f'gyro_{axis}'] for axis in BODY_AXES]}) * degree / hour\n"
    )


def accelerometer_bias_code(values: Values) -> str:
    """Return the line that defines `accelerometer_bias` as `accelerometer_biases` does."""
    sizes = [values[f"acc_{axis}"] for axis in BODY_AXES]
    return f"accelerometer_bias = np.array({sizes}) * milli * g\n"
