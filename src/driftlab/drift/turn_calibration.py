"""Calibration by whole turns: the non-orthogonality Sigma from attitude errors; Larin, section 3.

A triad is turned k whole times about a known body axis n while the computer integrates its gyros.
The body then has its first attitude again, so the computed rotation is all error. To first order
the tangent of half its angle, taken along n, is k pi n^T Sigma n.

All this is so in inertial space. On the Earth a body that a table has brought back has turned with
the Earth meanwhile, and a gyro without any error says so: see `earth_rate_offset`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import (
    SMALLEST_DIVISOR,
    FloatArray,
    checked_generator,
    finite_array,
    finite_arrays,
    keep,
    nonnegative_number,
    nonzero_vectors,
    one_of,
    plausible_error_matrix,
    whole_number,
    within,
)
from driftlab.core.loops import cumulative_product
from driftlab.core.quaternion import from_rotation_vector
from driftlab.core.vectors import transform
from driftlab.earth import checked_latitude, earth_rate
from driftlab.triad import checked_triad

from .step_formulas import STEP_FORMULAS
from .systematic_drift import _exact_drift_coefficient


def turn_estimate(error_quaternion: ArrayLike, axis: ArrayLike, turns: int = 1) -> FloatArray:
    """Estimate n^T Sigma n from the attitude error after whole turns about an axis; Larin (3.3).

    Parameters
    ----------
    error_quaternion : array_like or Rotation, shape (..., 4)
        Error after the turns; its sign and its norm do not matter.
    axis : array_like, shape (..., 3)
        Body axis n of the turns; only its direction counts.
    turns : int
        Number k of whole turns. The estimate is unique while |n^T Sigma n| < 1/(2k).

    Returns
    -------
    ndarray, shape (...)
        Estimates, without unit.

    Raises
    ------
    ValueError
        Also for an error of half a turn across the axis, for which (3.3) is 0/0.

    See Also
    --------
    recorded_turn_estimate : The same from the increments of a record.
    fit_turns : The sigmas from several turns.

    Examples
    --------
    >>> error = [0.0, 0.0, np.sin(0.001 * np.pi), np.cos(0.001 * np.pi)]
    >>> print(f"{turn_estimate(error, [0, 0, 1]):.6f}")
    0.001000
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
    slip = "an error so large is no small misalignment; or is the scalar first? It belongs last."
    within(half_angle, "error_quaternion", np.inf, "rad of half its angle", slip, usual=0.3)
    return half_angle / (turns * np.pi)


def exact_turn_estimate(axis: ArrayLike, error_matrix: ArrayLike, turns: int = 1) -> FloatArray:
    r"""Result of `turn_estimate` with exact integration and without noise, in closed form.

    Parameters
    ----------
    axis : array_like, shape (..., 3)
        Body axis n of the turns; only its direction counts.
    error_matrix : array_like, shape (..., 3, 3)
        Matrix M of the errors of the triad, without unit.
    turns : int
        Number k of whole turns.

    Returns
    -------
    ndarray, shape (...)
        Estimates, without unit. Their distance from n^T Sigma n is the bias of the method itself.

    Notes
    -----
    With A = I + M and n-hat the direction of A n,

    .. math:: \frac{1}{k\pi} \arctan\left( \hat n^T n \tan(k\pi(|A n| - 1)) \right).

    Its distance from rho = n^T Sigma n has a bound without k. Let d = |A n| - 1 with k|d| < 1/2, c
    the cosine of the angle between the two axes, a = 1 + rho > 0, and r the length of the part of
    M n across n, so that c = a/|A n|. With theta = k pi d, the estimate differs from d by

    .. math::
        \frac{1}{k\pi} \left| \arctan\frac{(1-c)\tan\theta}{1 + c\tan^2\theta} \right|
        \le \frac{(1-c)|\sin 2\theta|}{2ck\pi} \le \frac{1-c}{c}|d| \le \frac{r^2}{2a^2}|d|,

    and d from rho by at most :math:`r^2/2a`, as in `asymptotic_roots`. If m < 1 is the spectral
    norm of M, the sum of both is at most

    .. math:: \frac{r^2}{2a}\left(1 + \frac{|d|}{a}\right) \le \frac{m^2}{2(1-m)^2}.

    Examples
    --------
    >>> error_matrix = 0.01 * np.array([[0, 1, 0], [1, 0, 0], [0, 0, 0]])
    >>> print(f"{exact_turn_estimate([1, 1, 0], error_matrix):.6f}")  # n is an eigenvector
    0.010000
    """
    turns = whole_number(turns, "turns")
    axis, error_matrix = finite_arrays(axis=(axis, 3), error_matrix=(error_matrix, 3, 3))
    plausible_error_matrix(error_matrix, "error_matrix")
    n, _ = nonzero_vectors(axis, "axis")
    n_hat, _ = nonzero_vectors(transform(checked_triad(error_matrix), n), "axis")
    half_drift = turns * np.pi * _exact_drift_coefficient(n, error_matrix)
    after = from_rotation_vector(2 * half_drift[..., np.newaxis] * n_hat)
    return turn_estimate(after, n, turns)


def earth_rate_offset(
    latitude: ArrayLike, table_rate: ArrayLike, table_axis: ArrayLike = (0.0, 0.0, 1.0)
) -> FloatArray:
    r"""What the turning Earth adds to a turn estimate; (3.3) carried over to a real table.

    Parameters
    ----------
    latitude : array_like, shape (...)
        rad; not a pole.
    table_rate : array_like, shape (...)
        Whole turns over the time of the record, rad/s, not zero. The sign is the sense: positive
        is counter-clockwise, seen from the tip of the table's axis.
    table_axis : array_like, shape (..., 3)
        Direction a of the table's axis in East, North, Up; only its direction counts.

    Returns
    -------
    ndarray, shape (...)
        Offset of the estimate, without unit, whatever the axis in the body.

    Notes
    -----
    With the Earth's rate U and the table's rate w it is :math:`U \cdot a / w` to first order. A
    gyro bias b adds n . b / w in the same way.

    Examples
    --------
    A table at latitude 37.5 degrees with its axis upright, at 10 degrees a second:

    >>> offset = earth_rate_offset(np.radians(37.5), np.radians([10.0, -10.0]))
    >>> (np.degrees(offset) * 3600).round(2)  # arc seconds
    array([ 52.46, -52.46])
    """
    latitude, rate, axis = finite_arrays(
        latitude=(latitude,), table_rate=(table_rate,), table_axis=(table_axis, 3)
    )
    if np.abs(rate).min() < SMALLEST_DIVISOR:
        least = rate.flat[np.abs(rate).argmin()]
        raise ValueError(
            f"table_rate: expected rates of at least {SMALLEST_DIVISOR:g} in size, got {least:g}."
        )
    a, _ = nonzero_vectors(axis, "table_axis")
    return np.einsum("...i,...i->...", earth_rate(checked_latitude(latitude)), a) / rate


@dataclass(frozen=True)
class TurnExperiment:
    """Larin's computer experiment, in inertial space: all of it but the axis and the triad.

    Attributes
    ----------
    turns : int
        Whole turns k about each axis.
    steps_per_turn : int
        Integration steps in one turn, at least 3.
    step_formula : str
        A name in `driftlab.drift.step_formulas.STEP_FORMULAS`.
    angle_noise : float
        Standard deviation, per gyro, of the angle that white gyro noise adds up to over one turn
        (angle random walk times the square root of the turn's time), rad.

    See Also
    --------
    driftlab.motion.TurntableRotation : The turn of a real table.
    turn_estimate : The estimate from one error.

    Examples
    --------
    Larin's three turns find the three sigmas:

    >>> from driftlab.drift.weighing_designs import PAIR_AXES
    >>> error_matrix = 1e-4 * np.array([[0, 1, 2], [1, 0, 3], [2, 3, 0]])
    >>> TurnExperiment(turns=1, steps_per_turn=100).estimate(PAIR_AXES, error_matrix).round(6)
    array([0.0001, 0.0002, 0.0003])
    """

    turns: int = 1
    steps_per_turn: int = 100
    step_formula: str = "exact"
    angle_noise: float = 0.0

    def __post_init__(self) -> None:
        keep(
            self,
            turns=whole_number(self.turns, "turns"),
            steps_per_turn=whole_number(self.steps_per_turn, "steps_per_turn", least=3),
            step_formula=one_of(self.step_formula, STEP_FORMULAS, "step_formula"),
            angle_noise=nonnegative_number(self.angle_noise, "angle_noise"),
        )

    def error_quaternion(
        self,
        axis: ArrayLike,
        error_matrix: ArrayLike,
        rng: np.random.Generator | int | None = None,
    ) -> FloatArray:
        """Attitude error (..., 4) after the turns, integrated step by step; Larin (1.2)."""
        axis, error_matrix = finite_arrays(axis=(axis, 3), error_matrix=(error_matrix, 3, 3))
        plausible_error_matrix(error_matrix, "error_matrix")
        n, _ = nonzero_vectors(axis, "axis")
        increment = 2 * np.pi / self.steps_per_turn * transform(checked_triad(error_matrix), n)
        count = self.turns * self.steps_per_turn
        increments = np.repeat(increment[..., np.newaxis, :], count, axis=-2)
        source = None if rng is None else checked_generator(rng)
        if self.angle_noise:
            scale = self.angle_noise / np.sqrt(self.steps_per_turn)
            increments = increments + checked_generator(source).normal(0.0, scale, increments.shape)
        # The true attitude is plus or minus one after the turns: what is computed is the error.
        return self.integrate(increments)

    def integrate(self, increments: ArrayLike) -> FloatArray:
        """Rotation (..., 4) over a row of increments (..., n, 3), rad, each of them one step."""
        rows = finite_array(increments, "increments", 3)
        if rows.ndim < 2:
            raise ValueError(f"increments: expected shape (..., n, 3), got shape {rows.shape}.")
        steps = STEP_FORMULAS[self.step_formula](rows)
        # To unit norm, or the norms of many steps would multiply up to overflow.
        steps /= np.linalg.norm(steps, axis=-1, keepdims=True)
        return cumulative_product(steps)[..., -1, :]

    def estimate(
        self,
        axis: ArrayLike,
        error_matrix: ArrayLike,
        rng: np.random.Generator | int | None = None,
    ) -> FloatArray:
        """Estimate n^T Sigma n (...) by the whole experiment: integrate, then `turn_estimate`."""
        return turn_estimate(self.error_quaternion(axis, error_matrix, rng), axis, self.turns)
