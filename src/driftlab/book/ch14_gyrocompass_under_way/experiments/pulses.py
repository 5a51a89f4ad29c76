"""A damped compass with a real laser gyro unit, whose accelerometers count pulses."""

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
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
        initial_level_frame(roughly),
        whole,
        gains,
        EARTH_RATE * np.sin(recording.latitude),
        every=round(SHOWN_EVERY / interval),
    )
    late = run.times > BEFORE
    north, east = np.moveaxis(run.horizon_rate, -1, 0)
    by_whole = wrap_angle(run.yaw_pitch_roll.heading + np.arctan2(east, north))
    # The step between neighbouring velocity increments of the forward accelerometer.
    pulse = np.median(np.diff(np.unique(velocity[:, 0].round(9))))
    worth = gains.proportional * pulse / interval / EARTH_RATE
    return DataTable(
        {
            "time": (run.times[late] - BEFORE, "min", "since the beginning of the quiet stretch"),
            "by_whole_rate": (by_whole[late], "deg", "heading from the whole level rates"),
            "by_integrals": (run.heading[late], "deg", "heading from their integral parts"),
            "pulse": (np.array([pulse]), "m_per_s", "velocity of one pulse of the accelerometers"),
            "pulse_over_earth_rate": (np.array([worth]), "", "through k1, for one interval"),
        }
    )
