"""Results that depend on the reference velocity, for tables that stand more or less still."""

from collections.abc import Sequence

import numpy as np
from scipy.constants import hour, knot, minute

from driftlab.book.ch11_kalman_calibration.experiments import (
    TYPICAL_NOISE,
    VELOCITIES,
    expected_covariance,
)
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration import ERROR_MODELS, calibration_error_budget
from driftlab.motion.scheme import SCHEMES, Scheme

TWELVE_TURNS = TYPICAL_NOISE.angle_random_walk * np.sqrt(36.0) / (2 * np.pi) * np.sqrt(3 / 4)
"""Standard deviation of a pair of gyro axes by twelve turns of 36 s, rad; chapter 16 derives it."""
TIMES = np.arange(5 * minute, 4 * hour + 1, 5 * minute)
LEVEL = (0.0, 0.0, 0.0, 1.0)
KINDS = ("gyro bias", "gyro scale", "gyro non-orthogonality", "accelerometer bias")


def on_reference_velocity(
    velocities: Sequence[float] = tuple(VELOCITIES.tolist()), latitude: float = TABLE_LATITUDE
) -> DataTable:
    """Standard deviations after both schemes, and what follows from them, without any data."""
    found = np.array([
        [_after(scheme, latitude, each) for each in velocities] for scheme in SCHEMES.values()
    ])  # fmt: skip
    bias, scale, pair, acc_bias, rest, turned, dearer = np.moveaxis(found, 2, 0)
    names = tuple(SCHEMES)
    return DataTable({
        "reference_velocity": (np.array(velocities), "mm_per_s", "standard deviation"),
        "gyro_bias": (bias, "deg_per_h", "largest standard deviation of the three", names),
        "gyro_scale": (scale, "ppm", "likewise", names),
        "pair": (pair, "arcsec", "non-orthogonality of two gyros, likewise", names),
        "over_turns": (pair / TWELVE_TURNS, "", "the same over that of twelve turns", names),
        "acc_bias": (acc_bias, "ug", "largest standard deviation of the three", names),
        "knots": (rest, "", "nautical miles an hour, rms over four hours of rest", names),
        "knots_turned": (turned, "", "the same if a half turn follows the alignment", names),
        "with_arms": (dearer, "", "growth of a deviation by lever arms as states, at most", names),
    })  # fmt: skip


def _after(scheme: Scheme, latitude: float, velocity: float) -> list[float]:
    """One scheme and one velocity: the last columns but the ratio (7,)."""
    model = ERROR_MODELS["averaged"]
    states = model, model.with_states("lever arms")
    covariances = [expected_covariance(scheme, latitude, velocity, each) for each in states]
    known, with_arms = (np.sqrt(np.diag(each))[: model.size] for each in covariances)
    largest = [known[[name.startswith(kind) for name in model.names]].max() for kind in KINDS]
    rates = [
        calibration_error_budget(TIMES, latitude, model, covariances[0], LEVEL, turn)["all"]
        for turn in (0.0, np.pi)
    ]
    knots = [float(each.radial_error_rate) / knot for each in rates]
    return [*largest, *knots, (with_arms / known)[6:].max()]
