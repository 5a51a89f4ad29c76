"""Calibrations by turns about several axes: estimated against true non-orthogonality."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.scenarios import LARIN_TRIAD
from driftlab.checks import FloatArray, finite_array
from driftlab.drift.turn_calibration import TurnExperiment
from driftlab.drift.weighing_designs import PAIR_AXES, YATES_AXES, fit_turns, weighing
from driftlab.triad import non_orthogonality

from ..experiment_numbers import SUM_FACTORS
from .turns import SEED

AS_COPIED, AS_DERIVED = SUM_FACTORS["1, n4 as in the copy"], SUM_FACTORS["3/2, as derived"]
"""What multiplies the fourth turn estimate to give the sum of the sigmas."""
REPEATS = 12
"""Runs of a calibration with noise."""


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
    runs : ndarray, shape (REPEATS, 3)
        Estimates; all the same if there is no noise.
    axes : ndarray, shape (m, 3)
        Axes of the turns.
    """

    true: FloatArray
    runs: FloatArray
    axes: FloatArray


def turn_estimates(
    triad_error: ArrayLike,
    plan: str = "three pair axes, (3.4)",
    experiment: TurnExperiment | None = None,
    seed: int = SEED,
) -> TurnEstimates:
    """Calibrate one triad `REPEATS` times (once, if there is no noise).

    Parameters
    ----------
    triad_error : array_like, shape (3, 3)
    plan : str
        A name in `PLANS`.
    experiment : TurnExperiment, optional
    seed : int
        Of the noise.
    """
    triad_error = finite_array(triad_error, "triad_error", 3, 3)
    if plan not in PLANS:
        raise ValueError(f"plan: expected one of {', '.join(PLANS)}, got {plan!r}.")
    experiment = experiment or TurnExperiment()
    axes, method = PLANS[plan]
    repeats = REPEATS if experiment.angle_noise else 1
    repeated = np.broadcast_to(axes, (repeats, *axes.shape))
    estimates = experiment.estimate(repeated, triad_error, np.random.default_rng(seed))
    runs = yates_sigma(estimates) if method == "yates" else fit_turns(estimates, axes, method).sigma
    sigma = non_orthogonality(triad_error)[..., [0, 0, 1], [1, 2, 2]]
    return TurnEstimates(sigma, np.broadcast_to(runs, (REPEATS, 3)), axes)


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
