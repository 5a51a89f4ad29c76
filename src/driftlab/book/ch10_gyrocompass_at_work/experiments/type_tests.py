"""Would it pass? The paper's compass and three others on the tests of the marine standards."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from scipy.constants import degree

from driftlab.book.ch09_aligning_a_gyrocompass.experiments import (
    MOVING_AVERAGE,
    WHITE,
    gyro_noise,
)
from driftlab.book.scenarios import SARATOV_LATITUDE
from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RATE
from driftlab.gyrocompass.type_test import marine_type_test
from driftlab.gyrocompass.type_test_compass import COARSE, FINE, Gyrocompass
from driftlab.gyrocompass.type_test_limits import LIMITS

from .dial import PAPER_LARGEST
from .voyages import DAMPING

PLACES: FloatArray = np.array([0.0, 40.0, 60.0, 70.0, 75.0, 80.0])
"""Latitudes, degrees."""
LASTING_DRIFT = PAPER_LARGEST * degree * EARTH_RATE * float(np.cos(SARATOV_LATITUDE))
"""Level drift that makes all of the paper's largest error at the latitude of Saratov, rad/s."""
STEPS = COARSE._replace(turn=FINE.turn)
"""Only the quick turn wants fine steps."""
WORSE = 20.0
"""How many times worse the gyros of the cheap compass are."""
_NOISE = gyro_noise(WHITE[0])
PAPER_COMPASS = Gyrocompass(
    gyro_bias=(0.0, 0.0, LASTING_DRIFT),
    gyro_noise=_NOISE,
    alignment_time=MOVING_AVERAGE * _NOISE.interval,
)
"""The paper's, as reconstructed: undamped, with the quieter gyros, 0.34 degrees as one drift."""
CHEAP_COMPASS = replace(
    PAPER_COMPASS,
    gyro_bias=(0.0, 0.0, WORSE * LASTING_DRIFT),
    gyro_noise=replace(_NOISE, white=WORSE * _NOISE.white, slow=WORSE * _NOISE.slow),
)
COMPASSES = {
    "the paper's compass": PAPER_COMPASS,
    "the same, damped by a log": replace(PAPER_COMPASS, damping=DAMPING, log=True),
    "the same, damped without a log": replace(PAPER_COMPASS, damping=DAMPING),
    f"gyros {WORSE:g} times worse": CHEAP_COMPASS,
}


class TypeTests(NamedTuple):
    """Shares of the limits that compasses use up.

    Attributes
    ----------
    latitudes : ndarray, shape (n,)
        degrees.
    shares : dict of dict of ndarray, shape (n,)
        By compass and by test, without unit: more than 1 fails; infinite if it never settles.
    """

    latitudes: FloatArray
    shares: dict[str, dict[str, FloatArray]]


def type_tests() -> TypeTests:
    """Put each of `COMPASSES` to the tests at all of `PLACES`."""
    shares = {}
    for name, compass in COMPASSES.items():
        found = [
            marine_type_test(compass, latitude, steps=STEPS).shares
            for latitude in np.radians(PLACES)
        ]
        shares[name] = {test: np.array([each[test] for each in found]) for test in LIMITS}
    return TypeTests(PLACES, shares)
