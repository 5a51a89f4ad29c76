"""The record itself, as rates and in plots."""

from __future__ import annotations

import numpy as np

from driftlab.checks import FloatArray
from driftlab.recordings.recording import Recording

from .findings import Plot, Shading, lines

AXES = ("x", "y", "z")


def moments(recording: Recording) -> FloatArray:
    """Time of each sample since the first, s."""
    if recording.times is None:
        return recording.interval * np.arange(len(recording), dtype=float)
    return recording.times - recording.times[0]


def rates(recording: Recording) -> FloatArray:
    """Angular rate of each sample, or its mean over an interval, (n, 3), rad/s."""
    return recording.gyro / (recording.interval if recording.kind == "increments" else 1.0)


def forces(recording: Recording) -> FloatArray:
    """Specific force of each sample, or its mean over an interval, (n, 3), m/s^2."""
    if recording.accelerometer is None:
        raise ValueError(
            "--columns: expected three gyros and three accelerometers, got gyros only."
        )
    return recording.accelerometer / (recording.interval if recording.kind == "increments" else 1.0)


def record_plots(recording: Recording, shaded: tuple[Shading, ...] = ()) -> tuple[Plot, ...]:
    """The record over time, some stretches of it shaded."""
    x = moments(recording)
    note = ", shaded where at rest" if shaded else ""
    turn = lines(x, np.degrees(rates(recording)), AXES)
    plots = [Plot(f"Gyros{note}", "time, s", "deg/s", turn, shaded)]
    if recording.accelerometer is not None:
        plots.append(
            Plot(
                f"Accelerometers{note}",
                "time, s",
                "m/s²",
                lines(x, forces(recording), AXES),
                shaded,
            )
        )
    return tuple(plots)
