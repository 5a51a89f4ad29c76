"""Plotnikov Fig. 1, simulated from its description: heading error around the dial of a table."""

from typing import NamedTuple

import numpy as np
from scipy.constants import arcminute, degree, hour

from driftlab.book.scenarios import SARATOV_LATITUDE
from driftlab.checks import FloatArray
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass.alignment import alignment_errors
from driftlab.gyrocompass.trials import table_heading_error
from driftlab.quaternion import rotate

DIAL: FloatArray = np.radians(np.arange(0.0, 361.0, 15.0))
"""Stops of the table, rad."""
RUNS = 3
"""Times that the paper goes around the dial."""
LEVELLING, NORTH = 6 * arcminute, float(np.radians(0.1))
"""The paper's limits for the table: each axis is level, and its zero is North, within these."""
RANDOM = 0.01 * degree / hour
"""Deviation of an averaged gyro from stop to stop, rad/s: of the paper's 0.01 to 0.02 deg/h."""
LASTING: FloatArray = np.arange(0.0, 0.105, 0.01).round(2)
"""Deviation of the drift that each gyro keeps through all runs, deg/h."""
SHOWN = 4
"""Index of the entry of `LASTING` from which one unit is shown."""
PAPER_LARGEST = 0.34
"""The paper's largest averaged error, degrees."""


class StaticCharacteristic(NamedTuple):
    """Heading errors of one unit around the dial, and the largest errors of many.

    Attributes
    ----------
    runs : ndarray, shape (3, n)
        Heading errors of the shown unit, rad.
    formula : ndarray, shape (n,)
        What its lasting errors make of the heading to first order, rad.
    lasting : ndarray, shape (m,)
        Deviations of the drift that lasts, deg/h.
    largest : ndarray, shape (m, units)
        Largest errors of the averaged characteristic, rad.
    """

    runs: FloatArray
    formula: FloatArray
    lasting: FloatArray
    largest: FloatArray


def dial_trial(
    lasting: float, units: int, rng: np.random.Generator, random: float = RANDOM
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Turn units around the dial on tables with errors within the paper's limits.

    The errors of a table are the same for all stops of one unit.

    Parameters
    ----------
    lasting, random : float
        Deviations of the drift that lasts and of the one that changes from stop to stop, rad/s.
    units : int
    rng : numpy.random.Generator

    Returns
    -------
    errors : ndarray, shape (units, 3, n)
        Of the heading, rad.
    drift : ndarray, shape (units, 1, 1, 3)
        The one that lasts, rad/s.
    north_error : ndarray, shape (units, 1, 1)
        Of the table's zero, rad.
    """
    drift = lasting * rng.standard_normal((units, 1, 1, 3))
    tilt = rng.uniform(-LEVELLING, LEVELLING, (units, 1, 1, 2))
    north = rng.uniform(-NORTH, NORTH, (units, 1, 1))
    noise = random * rng.standard_normal((units, RUNS, len(DIAL), 3))
    errors = table_heading_error(
        DIAL, drift + noise, np.zeros(3), SARATOV_LATITUDE, north_error=north, tilt=tilt
    )
    return errors, drift, north


def static_characteristic(units: int = 300) -> StaticCharacteristic:
    """Turn many units around the dial for each of `LASTING`.

    The shown unit is the one whose largest error is nearest to the printed one.
    """
    rng = np.random.default_rng(1)
    largest = []
    for lasting in LASTING * degree / hour:
        errors, drift, north = dial_trial(float(lasting), units, rng)
        worst = np.abs(errors.mean(axis=1)).max(axis=-1)
        largest.append(worst)
        if len(largest) == SHOWN + 1:
            unit = int(np.abs(np.degrees(worst) - PAPER_LARGEST).argmin())
            local = rotate(from_euler_angles(DIAL, 0.0, 0.0), drift[unit, 0, 0])
            aligned = alignment_errors(DIAL, 0.0, SARATOV_LATITUDE, local, np.zeros(3))
            formula = aligned.heading + north[unit, 0, 0]
            runs = errors[unit]
    return StaticCharacteristic(runs, formula, LASTING, np.array(largest))
