"""Calibrations by turns about several axes: estimated against true non-orthogonality."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.scenarios import LARIN_TRIAD
from driftlab.checks import FloatArray, finite_array, whole_number
from driftlab.drift.step_formulas import integrate_steps
from driftlab.drift.turn_calibration import TurnExperiment, turn_estimate
from driftlab.drift.weighing_designs import PAIR_AXES, YATES_AXES, fit_turns, weighing
from driftlab.imu import NO_ERRORS, ImuErrors
from driftlab.increments import measure
from driftlab.motion.table_turn import TableTurn
from driftlab.triad import non_orthogonality

from ..experiment_numbers import SUM_FACTORS
from .turns import ANGLE_NOISE, SEED

AS_COPIED, AS_DERIVED = SUM_FACTORS["1, n4 as in the copy"], SUM_FACTORS["3/2, as derived"]
"""What multiplies the fourth turn estimate to give the sum of the sigmas."""
SENSES = {"one": (1.0,), "both": (1.0, -1.0)}
"""Factors of the table's rate by what the panel calls them."""
REPEATS = 12
"""Runs of a calibration with noise."""
NOISY_TURN = TurnExperiment(step_formula="taylor-4", angle_noise=ANGLE_NOISE)
"""How the turns of the published figure are made."""


class Plan(NamedTuple):
    """About which axes to turn, and how to combine the estimates.

    Attributes
    ----------
    axes : ndarray, shape (m, 3)
    method : str
        "yates", or what `driftlab.drift.weighing_designs.fit_turns` calls `scale`.
    """

    axes: FloatArray
    method: str


PLANS = {
    "three pair axes, (3.4)": Plan(PAIR_AXES, "none"),
    "four axes, Yates's weighing": Plan(YATES_AXES, "yates"),
    "four axes, least squares": Plan(YATES_AXES, "none"),
    "four axes, least squares and common scale": Plan(YATES_AXES, "common"),
    "six axes, least squares and three scales": Plan(np.vstack([PAIR_AXES, np.eye(3)]), "each"),
}


class TurnEstimates(NamedTuple):
    """True and estimated [sigma1, sigma2, sigma3].

    Attributes
    ----------
    true : ndarray, shape (3,)
    runs : ndarray, shape (repeats, 3)
        Estimates; all the same if there is no noise.
    axes : ndarray, shape (m, 3)
        Axes of the turns.
    angle_noise : float
        rad a turn and gyro.
    """

    true: FloatArray
    runs: FloatArray
    axes: FloatArray
    angle_noise: float


def turn_estimates(
    triad_error: ArrayLike = LARIN_TRIAD,
    plan: str = "three pair axes, (3.4)",
    experiment: TurnExperiment = NOISY_TURN,
    seed: int = SEED,
    *,
    table: TableTurn | None = None,
    senses: str = "one",
    gyro_bias: float = 0.0,
    repeats: int = REPEATS,
) -> TurnEstimates:
    """Calibrate one triad several times (once, if there is no noise).

    Parameters
    ----------
    triad_error : array_like, shape (3, 3)
    plan : str
        A name in `PLANS`.
    experiment : TurnExperiment
        Turns, steps, step formula and noise.
    seed : int
        Of the noise.
    table : TableTurn, optional
        How a table makes the turns, and how many; without one they are Larin's, in inertial
        space.
    senses : {"one", "both"}
        Whether to turn as the table says only, or also the other way, and take the mean.
    gyro_bias : float
        Of each gyro, rad/s. It needs a table, for a turn without a time has no rate.
    repeats : int
        Runs.
    """
    count = whole_number(repeats, "repeats")
    triad_error = finite_array(triad_error, "triad_error", 3, 3)
    if plan not in PLANS:
        raise ValueError(f"plan: expected one of {', '.join(PLANS)}, got {plan!r}.")
    if senses not in SENSES:
        raise ValueError(f"senses: expected one of {', '.join(SENSES)}, got {senses!r}.")
    if gyro_bias and table is None:
        raise ValueError("table: expected a TableTurn, whose rate says what a bias does, got None.")
    axes, method = PLANS[plan]
    different = count if experiment.angle_noise else 1
    repeated = np.broadcast_to(axes, (different, *axes.shape))
    rng = np.random.default_rng(seed)
    if table is None:
        turned = [experiment.estimate(repeated, triad_error, rng) for _ in SENSES[senses]]
    else:
        unit = NO_ERRORS._replace(gyro_error=triad_error, gyro_bias=np.full(3, gyro_bias))
        turned = [
            _on_table(replace(table, rate=sense * table.rate), experiment, repeated, unit, rng)
            for sense in SENSES[senses]
        ]
    estimates = np.mean(turned, axis=0)
    runs = yates_sigma(estimates) if method == "yates" else fit_turns(estimates, axes, method).sigma
    sigma = non_orthogonality(triad_error)[..., [0, 0, 1], [1, 2, 2]]
    every = np.broadcast_to(runs, (count, 3))
    return TurnEstimates(sigma, every, axes, experiment.angle_noise)


def _on_table(
    table: TableTurn,
    experiment: TurnExperiment,
    axes: FloatArray,
    unit: ImuErrors,
    rng: np.random.Generator,
) -> FloatArray:
    """Turn estimates (..., m) about axes (..., m, 3), integrated as in Larin's experiment."""
    true = table.increments(axes[0], experiment.steps_per_turn * table.turns)
    rows = measure(true, unit).angle
    size = experiment.angle_noise / np.sqrt(experiment.steps_per_turn)
    if size:
        rows = rows + rng.normal(0.0, size, (len(axes), *rows.shape))
    error = integrate_steps(rows, experiment.step_formula)
    return turn_estimate(error, np.sign(table.rate) * axes, table.turns)


def yates_sigma(estimates: ArrayLike, sum_factor: float = AS_DERIVED) -> FloatArray:
    """[sigma1, sigma2, sigma3] (..., 3) by Yates's weighing of turns about Larin's four axes.

    Parameters
    ----------
    estimates : array_like, shape (..., 4)
        Turn estimates about `driftlab.drift.weighing_designs.YATES_AXES`.
    sum_factor : float
        What multiplies the fourth of them to give the sum of the sigmas.
    """
    return weighing(finite_array(estimates, "estimates", 4) * [1, 1, 1, sum_factor])


def triad_error(sigma: ArrayLike, skew: float = 0.0, scale: float = 0.0) -> FloatArray:
    """Triad error (3, 3) of a triad with given non-orthogonality.

    Parameters
    ----------
    sigma : array_like, shape (3,)
        [sigma1, sigma2, sigma3]: entries (1, 2), (1, 3), (2, 3) of the symmetric part.
    skew : float
        Largest entry of the skew part, which is shaped like that of Larin's triad: a rotation of
        the whole triad about (1, 1, 0).
    scale : float
        Scale-factor error common to the three gyros.
    """
    s1, s2, s3 = finite_array(sigma, "sigma", 3)
    symmetric = np.array([[scale, s1, s2], [s1, scale, s3], [s2, s3, scale]])
    larin = LARIN_TRIAD - LARIN_TRIAD.T
    return symmetric + skew / larin.max() * larin
