"""What three centimetres of lever arm do to a filter that does not know of them."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from driftlab.book.ch11_kalman_calibration.experiments import TYPICAL_NOISE, VELOCITIES
from driftlab.book.ch11_kalman_calibration.experiments.calibration import SEED
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.calibration import ERROR_MODELS, TurntableTrial, nees
from driftlab.checks import FloatArray, positive_number
from driftlab.higher_order_errors import NO_HIGHER_ORDER_ERRORS, HigherOrderErrors
from driftlab.imu import NO_ERRORS, TYPICAL_ERRORS, ImuNoise
from driftlab.monte_carlo import mean_square_bounds
from driftlab.motion.scheme import SCHEMES, Scheme

ARM = 0.03
"""m: each accelerometer lies so far out on its own axis."""
ARM_SIZES = (0.003, 0.01, 0.02, 0.03, 0.05, 0.1)
"""Arms, m."""
RATES = (5.0, 10.0, 20.0)
"""Of the table, deg/s."""
TABLE = TurntableTrial(sample_interval=0.1, keep=10**6)
FILTERS = ("filter of 27 states", "with the arms as states")
BAND = 3.0
"""Stated deviations within which errors should be."""


def on_own_axes(arm: float | FloatArray) -> HigherOrderErrors:
    """Return lever arms (..., 3, 3): each accelerometer so far out on its own axis, m."""
    lengths = np.asarray(arm)[..., np.newaxis, np.newaxis]
    return NO_HIGHER_ORDER_ERRORS._replace(lever_arms=lengths * np.eye(3))


def size_effect(
    arm: float = ARM,
    sizes: Sequence[float] = ARM_SIZES,
    rates: Sequence[float] = tuple(np.radians(RATES).tolist()),
    dwell: float = TABLE.scheme.dwell,
    velocities: Sequence[float] = tuple(VELOCITIES.tolist()),
    seed: int = SEED,
) -> DataTable:
    """Calibrate units with lever arms on tables of several rates: about a minute.

    `arm` is that of each accelerometer of the typical unit, on its own axis; `sizes` are arms of
    units without other errors. The filter takes the usual reference velocity, and at the usual rate
    and with `arm` all `velocities`.
    """
    arm = positive_number(arm, "arm")
    table = replace(TABLE, scheme=replace(TABLE.scheme, dwell=dwell))
    trials = [
        replace(table, states=states).run(
            np.random.default_rng(seed), imu_errors=TYPICAL_ERRORS, higher_order=on_own_axes(arm)
        )
        for states in ((), ("lever arms",))
    ]
    ratios = [(t.errors / t.calibration.standard_deviations)[-1, 6:27] for t in trials]
    innovations = np.array([t.calibration.nis.mean() / 3 for t in trials])
    schemes = [replace(scheme, dwell=dwell) for scheme in SCHEMES.values()]
    found = np.array([
        [arms_alone(replace(scheme, rate=rate), sizes, seed) for rate in rates]
        for scheme in schemes
    ])  # fmt: skip
    told = np.array([
        [arms_alone(scheme, (arm,), seed, each)[:, 0] for each in velocities]
        for scheme in schemes
    ])  # fmt: skip
    squares, noticed, worst, bias, updates = np.moveaxis(found, 2, 0)
    names = ERROR_MODELS["averaged"].names[6:]
    shape = squares.shape
    scheme, rate, size = (index.ravel() for index in np.indices(shape))
    turned = np.array(rates, float)[rate]
    _, high = mean_square_bounds(3, int(updates[0, shape[1] // 2, 0]))
    return DataTable(
        {
            "sensor_error": (list(names), "", "by name"),
            "number": (np.arange(1, len(names) + 1), "", "of the sensor error"),
            "in_deviations": (
                np.array(ratios), "", "errors of the typical unit with arms, in stated deviations",
                FILTERS,
            ),
            "innovations_over_expected": (innovations, "", "mean squared, of both filters"),
            "with_arms_of": (np.array([arm]), "cm", "of the typical unit"),
            "table": ([
                f"{[*SCHEMES][i]} at {np.degrees(each):g} deg/s"
                for i, each in zip(scheme, turned, strict=True)
            ], "", "scheme and rate"),
            "rate": (turned, "deg_per_s", "of the table"),
            "arm": (np.array(sizes, float)[size], "cm", "of units without other errors"),
            "squares": (squares.ravel(), "", "expected squared errors of states over variances"),
            "noticed": (noticed.ravel(), "", "expected mean squared innovation, normalised"),
            "worst": (worst.ravel(), "", "largest error of an accelerometer bias, in deviations"),
            "bias": (bias.ravel(), "m_per_s2", "the same"),
            "updates": (updates.ravel(), "", "innovations of three components in a calibration"),
            "reference_velocity": (np.array(velocities), "mm_per_s", "that the filter takes"),
            "noticed_at": (told[..., 1], "", "noticed, arm of the typical unit", tuple(SCHEMES)),
            "worst_at": (told[..., 2], "", "worst, likewise", tuple(SCHEMES)),
            "band_from_deviations": ([-BAND], "", "of a right filter"),
            "band_to_deviations": ([BAND], "", "likewise"),
            "clean_innovations_below": ([high / 3], "", "95 % of those of a right filter"),
        },
        {"shape": (shape, "", "schemes, rates and arms")},
    )  # fmt: skip


def on_tables(table: DataTable, name: str) -> FloatArray:
    """Return a column by scheme, rate of the table (the middle one is drawn) and arm."""
    return np.reshape(table.entry(name).values, table.shape)


def arms_alone(
    scheme: Scheme,
    sizes: Sequence[float],
    seed: int = SEED,
    velocity: float = TYPICAL_NOISE.reference_velocity,
) -> FloatArray:
    """What the arms do by themselves, and the updates (5, sizes): see the columns of the table.

    The sensors are perfect, and the filter expects the usual noise and this reference velocity.
    Noise would add one to each expected square, and nothing else: the filter is nearly linear.
    """
    quiet = ImuNoise(0.0, 0.0, 0.0)
    expected = ImuNoise(reference_velocity=velocity)
    table = replace(TABLE, scheme=scheme, noise=quiet, assumed_noise=expected)
    rng, arms = np.random.default_rng(seed), on_own_axes(np.array(sizes, float))
    trial = table.run(rng, len(sizes), imu_errors=NO_ERRORS, higher_order=arms)
    errors, nis = trial.errors[:, -1, 6:], trial.calibration.nis
    covariance = trial.calibration.covariance[:, -1, 6:, 6:]
    names = trial.calibration.model.names[6:]
    biases = [names.index(f"accelerometer bias {axis}") for axis in "xyz"]
    size = np.abs(errors[:, biases])
    standard_deviations = np.sqrt(np.einsum("...ii->...i", covariance))[:, biases]
    return np.array([
        1 + nees(errors, covariance) / errors.shape[-1],
        1 + nis.mean(axis=-1) / 3,
        (size / standard_deviations).max(axis=-1),
        size.max(axis=-1),
        np.full(len(sizes), nis.shape[-1]),
    ])  # fmt: skip
