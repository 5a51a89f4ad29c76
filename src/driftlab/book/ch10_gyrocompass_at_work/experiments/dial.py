"""Plotnikov Fig. 1, simulated from its description: heading error on a table of three angles."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.constants import arcminute, degree, g, hour, milli

from driftlab.book.scenarios import SARATOV_LATITUDE
from driftlab.checks import FloatArray, finite_array, whole_number
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass.alignment import alignment_errors
from driftlab.gyrocompass.trials import table_heading_error
from driftlab.quaternion import rotate

DIAL: FloatArray = np.radians(np.arange(0.0, 361.0, 15.0))
"""Stops of the table in heading and in roll, rad."""
PITCHES: FloatArray = np.radians(np.arange(-60.0, 61.0, 5.0))
"""As many stops in pitch, rad; how far the paper's table was pitched it does not say."""
STOPS: dict[str, FloatArray] = {
    name: np.stack(
        [angles if name == other else 0 * DIAL for other in ("heading", "pitch", "roll")]
    )
    for name, angles in (("heading", DIAL), ("pitch", PITCHES), ("roll", DIAL))
}
"""Heading, pitch and roll (3, n) at the stops of the three turns, rad: the others stay at zero."""
RUNS = 3
"""Times that the paper turns its table."""
LEVELLING, NORTH = 6 * arcminute, float(np.radians(0.1))
"""The paper's limits for the table: each axis is level, and its zero is North, within these."""
RANDOM = 0.01 * degree / hour
"""Deviation of an averaged gyro from stop to stop, rad/s: of the paper's 0.01 to 0.02 deg/h."""
LASTING: FloatArray = np.arange(0.0, 0.105, 0.01).round(2)
"""Deviation of the drift that each gyro keeps through all runs, deg/h."""
OFFSETS: FloatArray = np.arange(0.0, 11.0, 1.0)
"""Deviation of the offset that each accelerometer keeps through all runs, mg."""
SHOWN = 4
"""Index of the entry of `LASTING` from which one unit is shown in the published figure."""
SEED = 1
PAPER_LARGEST = 0.34
"""The paper's largest averaged error, degrees."""


class StaticCharacteristic(NamedTuple):
    """Heading errors of one unit on the table, and the largest errors of many."""

    # (3, n) each, heading errors of the shown unit by the angle that turns, rad
    runs: dict[str, FloatArray]
    # (n,) each, what its lasting errors make of the heading to first order, and the table's own,
    # rad
    formula: dict[str, FloatArray]
    lasting: FloatArray  # (m,), deviations of the drift that lasts, deg/h
    offsets: FloatArray  # (m,), deviations of the offset that lasts, mg
    shown: int  # index of the drift in `lasting` from which the unit is
    # (2, m, units), largest errors of the averaged characteristic, rad: in the turns in heading
    # alone, and in all three
    by_drift: FloatArray
    by_offset: FloatArray  # (2, m, units), likewise


class DialTrial(NamedTuple):
    """Many units, each on a table of its own."""

    # (units, 3, n) each, of the heading, by the angle that turns, rad
    errors: dict[str, FloatArray]
    drift: FloatArray  # (units, 1, 1, 3), that lasts, rad/s
    offset: FloatArray  # (units, 1, 1, 3), that lasts, m/s^2
    north_error: FloatArray  # (units, 1, 1), of the table's zero, rad
    tilt: FloatArray  # (units, 1, 1, 2), of the table about North and East, rad

    def largest(self) -> FloatArray:
        """Return largest errors (2, units) of the mean of the runs: in heading, in all turns."""
        worst = [np.abs(each.mean(axis=1)).max(axis=-1) for each in self.errors.values()]
        return np.array([worst[0], np.max(worst, axis=0)])


def dial_trial(
    lasting: float,
    offset: float,
    units: int,
    rng: np.random.Generator,
    random: float = RANDOM,
    latitude: float = SARATOV_LATITUDE,
) -> DialTrial:
    """Turn units in heading, pitch and roll on tables with errors within the paper's limits.

    The drift has a lasting part and one that changes from stop to stop, rad/s; the offset lasts,
    m/s^2. The errors of a table are the same at all stops of one unit.
    """
    drift = lasting * rng.standard_normal((units, 1, 1, 3))
    bias = offset * rng.standard_normal((units, 1, 1, 3))
    tilt = rng.uniform(-LEVELLING, LEVELLING, (units, 1, 1, 2))
    north = rng.uniform(-NORTH, NORTH, (units, 1, 1))
    errors = {}
    for name, (dial, pitch, roll) in STOPS.items():
        noise = random * rng.standard_normal((units, RUNS, len(dial), 3))
        errors[name] = table_heading_error(
            dial, drift + noise, bias, latitude, pitch=pitch, roll=roll,
            north_error=north, tilt=tilt,
        )  # fmt: skip
    return DialTrial(errors, drift, bias, north, tilt)


def table_and_unit(
    trial: DialTrial, unit: int, latitude: float = SARATOV_LATITUDE
) -> dict[str, FloatArray]:
    """Return the heading errors (n,) of one unit and its table to first order, by turn, rad."""
    expected = {}
    for name, (dial, pitch, roll) in STOPS.items():
        local = (
            rotate(from_euler_angles(dial, pitch, roll), part[unit, 0, 0])
            for part in (trial.drift, trial.offset)
        )
        north, east = trial.tilt[unit, 0, 0]
        # A leaning table turns a pitched bow aside; the compass is right, and the dial is not.
        aside = np.tan(pitch) * (east * np.sin(dial) - north * np.cos(dial))
        aligned = alignment_errors(dial, pitch, latitude, *local).heading
        expected[name] = aligned + trial.north_error[unit, 0, 0] + aside
    return expected


def static_characteristic(
    units: int = 500,
    lasting_drift: Sequence[float] = tuple((LASTING * degree / hour).tolist()),
    lasting_offset: Sequence[float] = tuple((OFFSETS * milli * g).tolist()),
    random_drift: float = RANDOM,
    latitude: float = SARATOV_LATITUDE,
    seed: int = SEED,
) -> StaticCharacteristic:
    """Turn many units on the table for each drift that lasts, and for each offset.

    The shown unit is of the drift of which the median is nearest to the paper's largest error, and
    the one of these whose largest error in the turns in heading is nearest to it.
    """
    units, rng = whole_number(units, "units"), np.random.default_rng(seed)
    drifts = finite_array(lasting_drift, "lasting_drift")
    offsets = finite_array(lasting_offset, "lasting_offset")
    drifting, offset = (
        [dial_trial(drift, bias, units, rng, random_drift, latitude) for drift, bias in sizes]
        for sizes in ([(float(s), 0.0) for s in drifts], [(0.0, float(s)) for s in offsets])
    )
    medians = [np.degrees(np.median(trial.largest()[0])) for trial in drifting]
    shown = int(np.abs(np.array(medians) - PAPER_LARGEST).argmin())
    unit = int(np.abs(np.degrees(drifting[shown].largest()[0]) - PAPER_LARGEST).argmin())
    return StaticCharacteristic(
        {name: errors[unit] for name, errors in drifting[shown].errors.items()},
        table_and_unit(drifting[shown], unit, latitude),
        drifts / (degree / hour),
        offsets / (milli * g),
        shown,
        *(np.stack([trial.largest() for trial in each], axis=1) for each in (drifting, offset)),
    )
