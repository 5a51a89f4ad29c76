"""Calibrations by turns about several axes: estimated against true non-orthogonality."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import LARIN_TRIAD
from driftlab.checks import FloatArray, finite_array, nonnegative_number, whole_number
from driftlab.drift.recorded_turns import fit_error_matrix
from driftlab.drift.turn_calibration import TurnExperiment, turn_estimate
from driftlab.drift.weighing_designs import PAIR_AXES, YATES_AXES, fit_turns, weighing_estimate
from driftlab.imu import NO_ERRORS, ImuErrors
from driftlab.increments import measure
from driftlab.motion.turntable_rotation import TurntableRotation
from driftlab.triad import non_orthogonality

from ..experiment_numbers import SUM_FACTORS
from .turns import ANGLE_NOISE, SEED

AS_COPIED, AS_DERIVED = SUM_FACTORS["1, n4 as in the copy"], SUM_FACTORS["3/2, as derived"]
"""What multiplies the fourth turn estimate to give the sum of the sigmas."""
SENSES = {"one": (1.0,), "both": (1.0, -1.0)}
"""Factors of the table's rate by what the panel calls them."""
NINE = ("s x", "s y", "s z", "σ xy", "σ xz", "σ yz", "κ x", "κ y", "κ z")
"""Numbers of an error matrix: scale factors, non-orthogonality, turn of the triad as a whole."""
REPEATS = 12
"""Runs of a calibration with noise."""
NOISY_TURN = TurnExperiment(step_formula="taylor-4", angle_noise=ANGLE_NOISE)
"""How the turns of the published figure are made."""


class Plan(NamedTuple):
    """About which axes to turn, and how to combine the estimates."""

    axes: FloatArray  # (m, 3)
    method: str  # "yates", or the `scale_factor` of `driftlab.drift.weighing_designs.fit_turns`


PLANS = {
    "three pair axes, (3.4)": Plan(PAIR_AXES, "none"),
    "four axes, Yates's weighing": Plan(YATES_AXES, "yates"),
    "four axes, least squares": Plan(YATES_AXES, "none"),
    "four axes, least squares and common scale": Plan(YATES_AXES, "common"),
    "six axes, least squares and three scales": Plan(np.vstack([PAIR_AXES, np.eye(3)]), "each"),
}


def turn_estimates(
    error_matrix: ArrayLike = LARIN_TRIAD,
    plan: str = "three pair axes, (3.4)",
    experiment: TurnExperiment = NOISY_TURN,
    seed: int = SEED,
    *,
    table: TurntableRotation | None = None,
    senses: str = "one",
    gyro_bias: float = 0.0,
    axis_error: float = 0.0,
    repeats: int = REPEATS,
) -> DataTable:
    """Calibrate one triad several times (once, if there is no noise).

    Without a table the turns are Larin's, in inertial space, and there is no gyro bias. With
    `senses="both"` the table turns both ways, and the mean is taken. The nine numbers are found
    from both senses in any case. The body turns about axes that err by `axis_error` (rad, one
    standard deviation in each direction), which the calibration does not know.
    """
    count = whole_number(repeats, "repeats")
    error_matrix = finite_array(error_matrix, "error_matrix", 3, 3)
    if plan not in PLANS:
        raise ValueError(f"plan: expected one of {', '.join(PLANS)}, got {plan!r}.")
    if senses not in SENSES:
        raise ValueError(f"senses: expected one of {', '.join(SENSES)}, got {senses!r}.")
    if gyro_bias and table is None:
        raise ValueError(
            "table: expected a TurntableRotation, whose rate says what a bias does, got None."
        )
    axes, method = PLANS[plan]
    uncertain = nonnegative_number(axis_error, "axis_error")
    different = count if experiment.angle_noise or uncertain else 1
    repeated = np.broadcast_to(axes, (different, *axes.shape))
    rng = np.random.default_rng(seed)
    unit = NO_ERRORS._replace(gyro_error_matrix=error_matrix, gyro_bias=np.full(3, gyro_bias))
    other = np.random.default_rng(seed + 1)
    mounted = axes + uncertain * np.cross(axes, other.standard_normal(repeated.shape))
    where = (repeated, mounted if uncertain else axes)
    turning = table or TurntableRotation(1.0, experiment.turns)
    turned = [
        _on_table(replace(turning, rate=sense * turning.rate), experiment, where, unit, rng)
        for sense in SENSES[senses]
    ]
    estimates = np.mean(turned, axis=0)
    runs = yates_sigma(estimates) if method == "yates" else fit_turns(estimates, axes, method).sigma
    sigma = non_orthogonality(error_matrix)[..., [0, 0, 1], [1, 2, 2]]
    every = np.broadcast_to(runs, (count, 3))
    shown = every if np.ptp(every, axis=0).any() else every[:1]  # without noise all runs are one
    names = [f"sigma{i}" for _ in shown for i in (1, 2, 3)]
    noise = experiment.angle_noise * np.sqrt(experiment.turns)
    forward, backward = (
        measure(turn.increments(mounted[0], 8 * turn.turns), unit).angle.sum(axis=-2)
        + noise * other.standard_normal(axes.shape)
        for turn in (replace(turning, rate=sense * turning.rate) for sense in SENSES["both"])
    )
    fit = fit_error_matrix(
        forward, backward, axes, turning.turns,
        angle_noise=max(noise, 1e-9), axis_error=uncertain,  # not below rounding
    )  # fmt: skip
    weights = nine_of(np.eye(9).reshape(9, 3, 3)).T
    spread = np.sqrt(((weights @ fit.covariance) * weights).sum(axis=-1))
    nine_error = nine_of(fit.error_matrix - error_matrix)
    return DataTable(
        {
            "sigma": (names, "", "which one, run after run"),
            "found": (shown.ravel(), "mrad", "estimate of each run"),
            "error": ((shown - sigma).ravel(), "arcsec", "estimate minus true value"),
            "true": (sigma, "mrad", "true sigma1, sigma2, sigma3"),
            "mean_error": ((shown - sigma).mean(axis=0), "arcsec", "mean of all runs"),
            "nine": ([*NINE], "", "numbers of the error matrix, from the sums of both directions"),
            "nine_true": (nine_of(error_matrix), "mrad", "true value of each"),
            "nine_error": (nine_error, "arcsec", "error of each, one calibration"),
            "nine_spread": (spread, "arcsec", "standard deviation of each"),
        },
        {
            "runs": (every, "mrad", "estimates by run and sigma"),
            "axes": (axes, "", "axes of the turns"),
            "angle_noise": (experiment.angle_noise, "arcsec", "noise of a turn and gyro"),
        },
    )


def _on_table(
    table: TurntableRotation,
    experiment: TurnExperiment,
    axes_and_true: tuple[FloatArray, FloatArray],
    unit: ImuErrors,
    rng: np.random.Generator,
) -> FloatArray:
    """Turn estimates (..., m) about axes (..., m, 3), integrated as in Larin's experiment."""
    axes, mounted = axes_and_true
    true = table.increments(mounted, experiment.steps_per_turn * table.turns)
    rows = measure(true, unit).angle
    size = experiment.angle_noise / np.sqrt(experiment.steps_per_turn)
    if size:
        rows = rows + rng.normal(0.0, size, (len(axes), *rows.shape[-3:]))
    error = experiment.integrate(rows)
    return turn_estimate(error, np.sign(table.rate) * axes, table.turns)


def nine_of(matrix: FloatArray) -> FloatArray:
    """`NINE` (..., 9) of error matrices (..., 3, 3)."""
    scale = np.diagonal(matrix, axis1=-2, axis2=-1)
    sigma, skew = (0.5 * (matrix + sign * np.swapaxes(matrix, -2, -1)) for sign in (1, -1))
    kappa = skew[..., [2, 0, 1], [1, 2, 0]]
    return np.concatenate([scale, sigma[..., [0, 0, 1], [1, 2, 2]], kappa], axis=-1)


def yates_sigma(estimates: ArrayLike, sum_factor: float = AS_DERIVED) -> FloatArray:
    """[sigma1, sigma2, sigma3] (..., 3) by Yates's weighing of Larin's four turns (..., 4).

    The sum factor multiplies the fourth estimate to give the sum of the sigmas.
    """
    return weighing_estimate(finite_array(estimates, "estimates", 4) * [1, 1, 1, sum_factor])


def error_matrix(sigma: ArrayLike, skew: float = 0.0, scale: float = 0.0) -> FloatArray:
    """Triad error (3, 3) of a triad with the non-orthogonality [sigma1, sigma2, sigma3].

    `skew` is the largest entry of the skew part, a rotation of the whole triad about (1, 1, 0).
    """
    s1, s2, s3 = finite_array(sigma, "sigma", 3)
    symmetric = np.array([[scale, s1, s2], [s1, scale, s3], [s2, s3, scale]])
    larin = LARIN_TRIAD - LARIN_TRIAD.T
    return symmetric + skew / larin.max() * larin
