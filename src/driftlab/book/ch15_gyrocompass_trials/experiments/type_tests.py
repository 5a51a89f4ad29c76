"""Would it pass? The paper's compass and three others on the tests of the marine standards."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import product

import numpy as np
from scipy.constants import degree

from driftlab.book.ch13_finding_north.experiments import MOVING_AVERAGE, WHITE, gyro_noise
from driftlab.book.ch14_gyrocompass_under_way.experiments import DAMPING
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import SARATOV_LATITUDE
from driftlab.checks import FloatArray, checked_instance, finite_array
from driftlab.earth import EARTH_RATE
from driftlab.gyrocompass.type_test import COARSE, FINE, TESTS, Gyrocompass, marine_type_test

from .dial import PAPER_LARGEST

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


def compasses(compass: Gyrocompass, damping: float, worse: float) -> dict[str, Gyrocompass]:
    """Return a compass and three others: damped with a log and without, and with worse gyros."""
    noise = compass.gyro_noise
    x, y, z = (worse * bias for bias in compass.gyro_bias)
    cheap = replace(
        compass,
        gyro_bias=(x, y, z),
        gyro_noise=replace(
            noise, white=worse * noise.white, gauss_markov=worse * noise.gauss_markov
        ),
    )
    name = "the paper's compass" if compass == PAPER_COMPASS else "a compass"
    return {
        name: compass,
        "the same, damped by a log": replace(compass, damping=damping, speed_log=True),
        "the same, damped without a log": replace(compass, damping=damping, speed_log=False),
        f"gyros {worse:g} times worse": cheap,
    }


LOW, HIGH = 3e-3, 300.0
"""Least and largest share of a limit that is drawn as it is."""


def type_tests(
    compass: Gyrocompass = PAPER_COMPASS,
    latitudes: Sequence[float] = tuple(np.radians(PLACES).tolist()),
    damping: float = DAMPING,
    worse: float = WORSE,
    seed: int = 0,
) -> DataTable:
    """Put a compass without damping and three others to the tests at several latitudes."""
    checked_instance(compass, Gyrocompass, "compass")
    places = finite_array(latitudes, "latitudes")
    shares = {}
    for name, each in compasses(compass, damping, worse).items():
        found = [
            marine_type_test(each, float(latitude), seed=seed, steps=STEPS).shares
            for latitude in places
        ]
        shares[name] = {test: np.array([one[test] for one in found]) for test in TESTS}
    names, tests, at = zip(*product(shares, TESTS, places), strict=True)
    share = np.concatenate([each for of_tests in shares.values() for each in of_tests.values()])
    settled = np.where(np.isinf(share), np.nan, share)
    return DataTable(
        {
            "compass": (names, "", "one of four"),
            "test": (tests, "", "of the standards"),
            "latitude": (np.array(at), "deg", "of the test"),
            "share_of_limit": (settled, "", "none if it never settles"),
            "drawn_at": (np.clip(share, LOW, HIGH), "", "share within the limits of the plot"),
        },
        {
            "latitudes": (places, "deg", "of the tests"),
            "worse": (worse, "", "how many times worse the gyros of the last compass are"),
            "shares": (shares, "", "by compass and test: more than 1 fails"),
        },
    )
