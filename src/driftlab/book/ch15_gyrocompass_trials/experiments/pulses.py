"""A damped compass with a real laser gyro unit, whose accelerometers count pulses."""

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RATE, gravity
from driftlab.gyrocompass.alignment import align
from driftlab.gyrocompass.levelling import initial_level_frame, propagate_level_frame
from driftlab.gyrocompass.levelling_loop import damped_gains
from driftlab.recordings.publishers import published
from driftlab.vectors import wrap_angle

from .settling import FREQUENCY

QUIET = (1050.0, 1490.0)
"""When nobody moves in the car, s from the beginning of the record."""
BEFORE = 300.0
"""For how long the horizon settles before it, s; the first minute of them finds North roughly."""
SHOWN_EVERY = 2.0
"""s."""


def count_and_pulse(increments: FloatArray) -> tuple[float, float]:
    """Unit of a file's velocity increments (n,), and the sum that most stretches have, m/s.

    A stretch lies between zeros: a pulse is spread over neighbouring samples.
    """
    count = float(np.median(np.diff(np.unique(increments.round(9)))))
    counts = np.round(increments / count).astype(int)
    begins = np.flatnonzero(np.diff((counts != 0).astype(int), prepend=0) == 1)
    sums = np.abs(np.add.reduceat(counts, begins))  # the zeros after a stretch add nothing
    return count, count * float(np.bincount(sums).argmax())


def counted_pulses() -> DataTable:
    """Level a horizon by the accelerometers of a laser gyro unit and read North from it."""
    recording = published("laser-gyro", download=False).in_axes("FUR")
    if recording.latitude is None:
        raise ValueError("recording: expected one that knows its latitude.")
    whole = recording.between(QUIET[0] - BEFORE, QUIET[1]).increments()
    interval, angle, velocity = whole
    gains = damped_gains(FREQUENCY, float(gravity(recording.latitude)))
    first = slice(round(60 / interval))
    roughly = align(angle[first].mean(axis=0) / interval, velocity[first].mean(axis=0) / interval)
    run = propagate_level_frame(
        initial_level_frame(roughly), whole, gains, EARTH_RATE * np.sin(recording.latitude)
    )
    late = run.times > BEFORE
    yaw, read = run.yaw_pitch_roll.heading[late], run.heading[late]
    rates = run.horizon_rate[late]
    seen = slice(round(SHOWN_EVERY / interval) - 1, None, round(SHOWN_EVERY / interval))
    minute = round(60 / interval)
    minutes = len(yaw) // minute
    means = rates[: minutes * minute].reshape(minutes, minute, 2).mean(axis=1)
    middle = yaw[: minutes * minute].reshape(minutes, minute).mean(axis=1)
    count, pulse = count_and_pulse(velocity[:, 0])
    worth = gains.proportional * pulse / interval / EARTH_RATE
    return DataTable(
        {
            "time": (
                run.times[late][seen] - BEFORE,
                "min",
                "since the beginning of the quiet stretch",
            ),
            "by_whole_rate": (
                _heading(yaw, rates)[seen],
                "deg",
                "heading from the whole level rates",
            ),
            "by_integrals": (read[seen], "deg", "heading from their integral parts"),
            "by_minutes": (
                _heading(middle, means),
                "deg",
                "from means of the whole rates, 60 s each",
            ),
            "count": (np.array([count]), "m_per_s", "the unit of the file"),
            "pulse": (np.array([pulse]), "m_per_s", "velocity of one pulse of the accelerometers"),
            "pulse_over_earth_rate": (np.array([worth]), "", "through k1, if in one interval"),
        }
    )


def _heading(yaw: FloatArray, rates: FloatArray) -> FloatArray:
    """Headings, rad, from the yaw and the level rates (..., 2), North and East."""
    return wrap_angle(yaw + np.arctan2(rates[..., 1], rates[..., 0]))
