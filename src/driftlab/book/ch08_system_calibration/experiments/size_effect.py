"""What three centimetres of lever arm do to a filter that does not know of them."""

from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from typing import NamedTuple

import numpy as np

from driftlab.calibration.kalman import nees
from driftlab.calibration.simulation import TableTrial, Trial
from driftlab.checks import FloatArray, positive_number
from driftlab.higher_order_errors import NO_HIGHER_ORDER_ERRORS, HigherOrderErrors
from driftlab.imu import NO_ERRORS, TYPICAL_ERRORS, ImuNoise
from driftlab.motion.scheme import SCHEMES, Scheme

from .calibration import SEED

ARM = 0.03
"""m: each accelerometer lies so far out on its own axis."""
ARM_SIZES = (0.003, 0.01, 0.02, 0.03, 0.05, 0.1)
"""Arms, m."""
RATES = (5.0, 10.0, 20.0)
"""Of the table, deg/s."""
TABLE = TableTrial(sample_interval=0.1, keep=10**6)


class SizeEffect(NamedTuple):
    """Calibrations of units with accelerometers away from the point that the table turns about."""

    arm: float  # m
    rates: FloatArray  # (rates,), of the table, rad/s; the middle one is drawn
    sizes: FloatArray  # (sizes,), arms, m
    # (2, 21), errors of the sensor states of the typical unit with `arm`, on the nineteen
    # positions, in stated deviations: by the filter of 27 states, and by one that has the arms as
    # states
    ratios: FloatArray
    # (2,), mean squared normalised innovation in these two runs; 1 is what it should be
    innovations: FloatArray
    # (schemes, rates, sizes), expected squared errors of the 21 sensor states, normalised; 1 is
    # what they should be
    squares: FloatArray
    # (schemes, rates, sizes), expected mean squared normalised innovation; 1 is what it should be
    noticed: FloatArray
    # (schemes, rates, sizes), largest error of an accelerometer bias that the arms make, in stated
    # deviations
    worst: FloatArray
    bias: FloatArray  # (schemes, rates, sizes), the same in m/s^2
    # (schemes, rates), how many innovations of three components a calibration has
    updates: FloatArray

    @property
    def shown(self) -> int:
        """Index of the rate that is drawn."""
        return len(self.rates) // 2


def on_own_axes(arm: float | FloatArray) -> HigherOrderErrors:
    """Return lever arms (..., 3, 3): each accelerometer so far out on its own axis, m."""
    lengths = np.asarray(arm)[..., np.newaxis, np.newaxis]
    return NO_HIGHER_ORDER_ERRORS._replace(lever_arms=lengths * np.eye(3))


@cache
def unit_with_arms(
    states: tuple[str, ...] = (),
    arm: float = ARM,
    dwell: float = TABLE.scheme.dwell,
    seed: int = SEED,
) -> Trial:
    """Calibrate the typical unit with arms, m, on the nineteen positions, pauses of `dwell` s."""
    table = replace(TABLE, states=states, scheme=replace(TABLE.scheme, dwell=dwell))
    rng = np.random.default_rng(seed)
    return table.run(rng, imu_errors=TYPICAL_ERRORS, higher_order=on_own_axes(arm))


def size_effect(
    arm: float = ARM,
    sizes: Sequence[float] = ARM_SIZES,
    rates: Sequence[float] = tuple(np.radians(RATES).tolist()),
    dwell: float = TABLE.scheme.dwell,
    seed: int = SEED,
) -> SizeEffect:
    """Calibrate units with lever arms on tables of several rates: about a minute.

    `arm` is that of each accelerometer of the typical unit, on its own axis; `sizes` are arms of
    units without other errors.
    """
    arm = positive_number(arm, "arm")
    trials = [unit_with_arms(states, arm, dwell, seed) for states in ((), ("lever arms",))]
    ratios = [(t.errors / t.calibration.deviations)[-1, 6:27] for t in trials]
    found = [
        [_without_noise(replace(scheme, rate=rate, dwell=dwell), sizes, seed) for rate in rates]
        for scheme in SCHEMES.values()
    ]
    squares, noticed, worst, bias, updates = (
        np.array([[case[i] for case in row] for row in found]) for i in range(5)
    )
    innovations = np.array([t.calibration.nis.mean() / 3 for t in trials])
    return SizeEffect(
        arm, np.array(rates, float), np.array(sizes, float),
        np.array(ratios), innovations, squares, noticed, worst, bias, updates,
    )  # fmt: skip


def _without_noise(
    scheme: Scheme, sizes: Sequence[float], seed: int
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, int]:
    """What the arms do by themselves: perfect sensors, and a filter that expects the usual noise.

    Noise would add one to each expected square, and nothing else: the filter is nearly linear.
    """
    table = replace(
        TABLE,
        scheme=scheme,
        noise=ImuNoise(0.0, 0.0, 0.0),
        assumed_noise=TABLE.noise,
    )
    rng, arms = np.random.default_rng(seed), on_own_axes(np.array(sizes, float))
    trial = table.run(rng, len(sizes), imu_errors=NO_ERRORS, higher_order=arms)
    errors, nis = trial.errors[:, -1, 6:], trial.calibration.nis
    covariance = trial.calibration.covariance[:, -1, 6:, 6:]
    names = trial.calibration.model.names[6:]
    biases = [names.index(f"accelerometer bias {axis}") for axis in "xyz"]
    size = np.abs(errors[:, biases])
    deviations = np.sqrt(np.einsum("...ii->...i", covariance))[:, biases]
    return (
        1 + nees(errors, covariance) / errors.shape[-1],
        1 + nis.mean(axis=-1) / 3,
        (size / deviations).max(axis=-1),
        size.max(axis=-1),
        nis.shape[-1],
    )
