"""Larin, section 3: find the non-orthogonality Sigma from attitude errors after whole turns.

A triad is turned k whole times about a known body axis while the computer integrates its gyros.
The body is back where it was, so what the computer shows is all error, and along the axis n it is
k pi n^T Sigma n, to first order, in the tangent of half its angle.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import (
    FloatArray,
    finite_array,
    finite_arrays,
    nonzero_vectors,
    whole_number,
)
from driftlab.core.quaternion import cumulative_product, from_rotation_vector
from driftlab.triad import measured_rate

from .step_formulas import step_formula
from .systematic_drift import exact_drift_coefficient

PAIR_AXES: FloatArray = np.array([[1.0, 1, 0], [1, 0, 1], [0, 1, 1]]) / np.sqrt(2)
"""Larin's (3.4): turning about row s gives sigma_s itself."""
PAIR_AXES.setflags(write=False)

YATES_AXES: FloatArray = np.vstack([PAIR_AXES, np.ones(3) / np.sqrt(3)])
"""Larin's (3.4) and (3.5): the three pair axes and the space diagonal."""
YATES_AXES.setflags(write=False)


def turn_estimate(error_quaternion: ArrayLike, axis: ArrayLike, turns: int = 1) -> FloatArray:
    """n^T Sigma n (...) from the attitude error after whole turns about `axis`; Larin (3.3).

    Parameters
    ----------
    error_quaternion : array_like, shape (..., 4)
        Error after the turns; its sign and its norm do not matter.
    axis : array_like, shape (..., 3)
        Body axis n of the turns; only its direction counts.
    turns : int
        Number k of whole turns. The estimate is unique while |n^T Sigma n| < 1/(2k).

    Raises
    ------
    ValueError
        Also for an error of half a turn across the axis, of which (3.3) makes 0/0.
    """
    error, axis = finite_arrays(error_quaternion=(error_quaternion, 4), axis=(axis, 3))
    if not error.any(axis=-1).all():
        raise ValueError("error_quaternion: expected nonzero quaternions, got a zero quaternion.")
    turns = whole_number(turns, "turns")
    n, _ = nonzero_vectors(axis, "axis")
    along = np.einsum("...i,...i->...", error[..., :3], n)
    scalar = error[..., 3]
    if not (np.abs(along) + np.abs(scalar)).all():
        raise ValueError(
            "error_quaternion: expected a turn about the axis, got half a turn across."
        )
    # arctan(along/scalar), defined where the scalar part is zero as well.
    half_angle = np.arctan2(np.where(scalar < 0, -along, along), np.abs(scalar))
    return half_angle / (turns * np.pi)


def exact_turn_estimate(misalignment: ArrayLike, axis: ArrayLike, turns: int = 1) -> FloatArray:
    """What (3.3) gives (...) with exact integration and no noise, in closed form.

    (k pi)^-1 arctan((m^T n) tan(k pi (|A n| - 1))), m the direction of A n. Its distance from
    n^T Sigma n is the bias of the method itself.
    """
    turns = whole_number(turns, "turns")
    axis, misalignment = finite_arrays(axis=(axis, 3), misalignment=(misalignment, 3, 3))
    n, _ = nonzero_vectors(axis, "axis")
    m, _ = nonzero_vectors(measured_rate(n, misalignment), "axis")
    half_drift = turns * np.pi * exact_drift_coefficient(n, misalignment)
    return turn_estimate(from_rotation_vector(2 * half_drift[..., np.newaxis] * m), n, turns)


@dataclass(frozen=True)
class TurnExperiment:
    """How the turns are made and integrated: everything about the test but the triad and the axis.

    Attributes
    ----------
    turns : int
        Whole turns k about each axis.
    steps_per_turn : int
        Integration steps in one turn.
    step_formula : str
        A name in `driftlab.drift.step_formulas.STEP_FORMULAS`.
    angle_noise : float
        Standard deviation, in rad and per gyro, of the angle that white gyro noise adds up to
        over one turn (angle random walk times the square root of the turn's time).
    """

    turns: int = 1
    steps_per_turn: int = 100
    step_formula: str = "exact"
    angle_noise: float = 0.0

    def __post_init__(self) -> None:
        whole_number(self.turns, "turns")
        whole_number(self.steps_per_turn, "steps_per_turn", least=3)
        step_formula(self.step_formula)
        if finite_array(self.angle_noise, "angle_noise").ndim or self.angle_noise < 0:
            raise ValueError(
                f"angle_noise: expected one number of at least 0, got {self.angle_noise!r}."
            )

    def error_quaternion(
        self,
        misalignment: ArrayLike,
        axis: ArrayLike,
        rng: np.random.Generator | None = None,
    ) -> FloatArray:
        """Integrate the triad's increments over the turns, as the computer does; Larin (1.2).

        Parameters
        ----------
        misalignment : array_like, shape (..., 3, 3)
        axis : array_like, shape (..., 3)
        rng : numpy.random.Generator, optional
            Needed when `angle_noise` is not zero.

        Returns
        -------
        ndarray, shape (..., 4)
            Error after the turns. The true attitude is plus or minus one then, so that the
            computed attitude is the error itself, up to sign.
        """
        axis, misalignment = finite_arrays(axis=(axis, 3), misalignment=(misalignment, 3, 3))
        n, _ = nonzero_vectors(axis, "axis")
        increment = 2 * np.pi / self.steps_per_turn * measured_rate(n, misalignment)
        count = self.turns * self.steps_per_turn
        increments = np.repeat(increment[..., np.newaxis, :], count, axis=-2)
        if self.angle_noise:
            if rng is None:
                raise ValueError("rng: expected a numpy Generator to draw the noise, got None.")
            scale = self.angle_noise / np.sqrt(self.steps_per_turn)
            increments = increments + rng.normal(0.0, scale, increments.shape)
        steps = step_formula(self.step_formula)(increments)
        # To unit norm, or the norms of many steps would multiply up to overflow.
        steps /= np.linalg.norm(steps, axis=-1, keepdims=True)
        return cumulative_product(steps)[..., -1, :]

    def estimate(
        self,
        misalignment: ArrayLike,
        axis: ArrayLike,
        rng: np.random.Generator | None = None,
    ) -> FloatArray:
        """n^T Sigma n (...) as the whole experiment finds it: integrate, then apply (3.3)."""
        return turn_estimate(self.error_quaternion(misalignment, axis, rng), axis, self.turns)


def weighing(estimates: ArrayLike) -> FloatArray:
    """[sigma1, sigma2, sigma3] (..., 3) by Yates's weighing design; Larin, last formulas.

    Parameters
    ----------
    estimates : array_like, shape (..., 4)
        Estimates of sigma1, sigma2, sigma3 and of their sum. The sum is **3/2** of the turn
        estimate about (1, 1, 1): the factor that (3.5) lacks in print.

    Notes
    -----
    Each result is half of a sum with two signs plus and two minus, so an offset common to all four
    *numbers* cancels, and independent noise of one size in all four keeps its variance.
    """
    signs = np.array([[1, -1, -1, 1], [-1, 1, -1, 1], [-1, -1, 1, 1]])
    return 0.5 * finite_array(estimates, "estimates", 4) @ signs.T


@dataclass(frozen=True, eq=False)
class TurnFit:
    """Least-squares answer of `fit_turns`.

    Attributes
    ----------
    sigma : ndarray, shape (..., 3)
        sigma1, sigma2, sigma3.
    scale : ndarray, shape (..., s)
        Scale-factor errors: none, one common to all gyros, or one a gyro.
    covariance : ndarray, shape (3 + s, 3 + s)
        Covariance of (sigma, scale) when each estimate has unit variance.
    """

    sigma: FloatArray
    scale: FloatArray
    covariance: FloatArray


def fit_turns(estimates: ArrayLike, axes: ArrayLike, scale: str = "none") -> TurnFit:
    """Least squares on any set of turn axes, with or without scale-factor errors; Larin (3.4).

    Parameters
    ----------
    estimates : array_like, shape (..., m)
        Turn estimates n^T Sigma n, one an axis.
    axes : array_like, shape (m, 3)
        The axes; only their directions count.
    scale : {"none", "common", "each"}
        What else is unknown: nothing, one scale-factor error common to the three gyros (an offset
        common to all estimates: a wrong turn angle looks the same), or one for each gyro.

    Returns
    -------
    TurnFit
        The sigmas, the scale-factor errors, and their covariance for unit noise.

    Raises
    ------
    ValueError
        If the axes do not determine the unknowns.
    """
    n, _ = nonzero_vectors(axes, "axes")
    if n.ndim != 2:
        raise ValueError(f"axes: expected shape (m, 3), got shape {n.shape}.")
    estimates = finite_array(estimates, "estimates", len(n))
    squares = {"none": n[:, :0], "common": np.ones((len(n), 1)), "each": n**2}
    if scale not in squares:
        raise ValueError(f"scale: expected one of {', '.join(squares)}, got {scale!r}.")
    x, y, z = n.T
    design = np.column_stack([2 * x * y, 2 * x * z, 2 * y * z, squares[scale]])
    unknowns = design.shape[1]
    if np.linalg.matrix_rank(design) < unknowns:
        raise ValueError(
            f"axes: expected axes that determine {unknowns} unknowns, "
            f"got {len(n)} axes that determine {np.linalg.matrix_rank(design)}."
        )
    inverse = np.linalg.pinv(design)
    solution = estimates @ inverse.T
    return TurnFit(solution[..., :3], solution[..., 3:], inverse @ inverse.T)
