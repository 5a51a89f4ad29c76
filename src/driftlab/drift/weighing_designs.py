"""Non-orthogonality from several turns: axes, weighings, least squares; Larin (3.4), (3.5)."""

from __future__ import annotations

import warnings
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import (
    USUAL_TABLE,
    FloatArray,
    UnusualWarning,
    finite_array,
    nonzero_vectors,
    one_of,
    shown,
    truth_value,
)

PAIR_AXES: FloatArray = np.array([[1.0, 1, 0], [1, 0, 1], [0, 1, 1]]) / np.sqrt(2)
"""Larin's (3.4): turning about row s gives sigma_s itself."""
PAIR_AXES.setflags(write=False)


YATES_AXES: FloatArray = np.vstack([PAIR_AXES, np.ones(3) / np.sqrt(3)])
"""Larin's (3.4) and (3.5): the three pair axes and the space diagonal."""
YATES_AXES.setflags(write=False)


def weighing_estimate(estimates: ArrayLike) -> FloatArray:
    """Non-orthogonality from four turns by Yates's weighing design; Larin, last formulas.

    Parameters
    ----------
    estimates : array_like, shape (..., 4)
        Estimates of sigma1, sigma2, sigma3 and of their sum. The sum is **3/2** of the turn
        estimate about (1, 1, 1): the factor that (3.5) lacks in the copy.

    Returns
    -------
    ndarray, shape (..., 3)
        [sigma1, sigma2, sigma3], in the unit of the estimates.

    Notes
    -----
    Each result is half of a sum with two signs plus and two minus, so an offset common to all four
    *numbers* cancels, and independent noise of one size in all four keeps its variance.

    Examples
    --------
    The sigmas are 1, 2 and 3, and an offset of 10 is common to all four numbers:

    >>> weighing_estimate([11, 12, 13, 16])
    array([1., 2., 3.])
    """
    signs = np.array([[1, -1, -1, 1], [-1, 1, -1, 1], [-1, -1, 1, 1]])
    return 0.5 * finite_array(estimates, "estimates", 4) @ signs.T


class TurnFit(NamedTuple):
    """Least-squares solution for the non-orthogonality; the result of `fit_turns`.

    Attributes
    ----------
    sigma : ndarray, shape (..., 3)
        sigma1, sigma2, sigma3, without unit.
    scale_factor : ndarray, shape (..., s)
        Scale-factor errors, without unit: none, one common to all gyros, or one for each gyro.
    gyro_bias : ndarray, shape (..., g)
        None, or that of each gyro, rad/s.
    earth_rate : ndarray, shape (..., e)
        None, or the Earth's rate along the table's axis, rad/s.
    covariance : ndarray, shape (3 + s + g + e, 3 + s + g + e)
        Covariance of (sigma, scale, gyro_bias, earth_rate) when each estimate has unit variance.
    residuals : ndarray, shape (..., m)
        Each estimate less what the unknowns make of it, without unit.
    """

    sigma: FloatArray
    scale_factor: FloatArray
    gyro_bias: FloatArray
    earth_rate: FloatArray
    covariance: FloatArray
    residuals: FloatArray


def fit_turns(
    estimates: ArrayLike,
    axes: ArrayLike,
    scale_factor: str = "none",
    *,
    table_rates: ArrayLike | None = None,
    earth_rate: ArrayLike | str = 0.0,
    gyro_bias: bool = False,
) -> TurnFit:
    r"""Least squares on any set of turns, for the sigmas and what else is unknown; Larin (3.4).

    Parameters
    ----------
    estimates : array_like, shape (..., m)
        Turn estimates, one for each turn.
    axes : array_like, shape (m, 3)
        Axes n in the body, each as it points along the table's axis in space: up, on a level
        table. Only their directions count.
    scale_factor : {"none", "common", "each"}
        Other unknowns: none, one scale-factor error common to the three gyros (an offset common to
        all estimates: a table that overshoots looks the same), or one for each gyro.
    table_rates : array_like, shape (m,), optional
        Rate of each turn about its axis, rad/s: whole turns over the time of the record, positive
        if counter-clockwise, seen from above on a level table. Needed for the two that follow.
    earth_rate : array_like, shape (m,) or (), or "unknown"
        Component of the Earth's rate along each axis as it stands in space, rad/s, whose share is
        taken off; or that the same component for all axes is one more unknown.
    gyro_bias : bool
        Whether the bias of each gyro is unknown.

    Returns
    -------
    TurnFit
        The unknowns, their covariance for unit noise, and the residuals.

    Raises
    ------
    ValueError
        If the turns do not determine the unknowns.

    Warns
    -----
    UnusualWarning
        If a table rate is more than a turn a second, and so perhaps in degrees.

    See Also
    --------
    recorded_turn_estimate : A turn estimate from a record.
    fit_hand_turns : From turns by hand.

    Notes
    -----
    The estimate from a turn at the rate w about n, n pointing along a in space, is

    .. math:: n^T \Sigma n + (U \cdot a + n^T b) / w

    to first order, with the scale-factor errors on the diagonal of Sigma.

    Examples
    --------
    With Yates's four axes a scale-factor error common to all gyros can be found as well:

    >>> from driftlab.drift.turn_calibration import TurnExperiment
    >>> triad = 1e-4 * np.array([[4, 1, 2], [1, 4, 3], [2, 3, 4]])
    >>> estimates = TurnExperiment().estimate(YATES_AXES, triad)
    >>> fit = fit_turns(estimates, YATES_AXES, scale_factor="common")
    >>> print(fit.sigma.round(6), fit.scale_factor.round(6))
    [0.0001 0.0002 0.0003] [0.0004]
    """
    n, _ = nonzero_vectors(axes, "axes")
    if n.ndim != 2:
        raise ValueError(f"axes: expected shape (m, 3), got shape {n.shape}.")
    values = finite_array(estimates, "estimates", len(n))
    squares = {"none": n[:, :0], "common": np.ones((len(n), 1)), "each": n**2}
    one_of(scale_factor, squares, "scale_factor")
    truth_value(gyro_bias, "gyro_bias")
    times = _time_of_a_radian(table_rates, len(n))
    if isinstance(earth_rate, str):
        if earth_rate != "unknown":
            raise ValueError(f"earth_rate: expected rates or 'unknown', got {shown(earth_rate)}.")
        earth = times[:, np.newaxis]
    else:
        earth = times[:, np.newaxis][:, :0]
        known = finite_array(earth_rate, "earth_rate")
        if known.shape not in ((), (len(n),)):
            raise ValueError(f"earth_rate: expected shape ({len(n)},), got shape {known.shape}.")
        values = values - known * times
    if table_rates is None and (gyro_bias or isinstance(earth_rate, str) or known.any()):
        raise ValueError("table_rates: expected a rate for each turn, got none.")
    x, y, z = n.T
    sigmas = np.column_stack([2 * x * y, 2 * x * z, 2 * y * z])
    bias = times[:, np.newaxis] * (n if gyro_bias else n[:, :0])
    parts = [sigmas, squares[scale_factor], bias, earth]
    design = np.hstack(parts)
    inverse = _solve(design)
    ends = np.cumsum([part.shape[1] for part in parts])[:-1]
    unknowns = values @ inverse.T
    residuals = values - unknowns @ design.T
    sigma, scales, biases, along = np.split(unknowns, ends, axis=-1)
    return TurnFit(sigma, scales, biases, along, inverse @ inverse.T, residuals)


def _time_of_a_radian(table_rates: ArrayLike | None, count: int) -> FloatArray:
    """Inverse of each table rate (m,), s; zero if no rates are given."""
    if table_rates is None:
        return np.zeros(count)
    rates = finite_array(table_rates, "table_rates", count)
    if rates.ndim != 1 or not rates.all():
        raise ValueError(f"table_rates: expected {count} rates that are not zero, got {rates}.")
    fastest = float(rates[np.abs(rates).argmax()])
    if abs(fastest) > USUAL_TABLE:
        warnings.warn(
            f"table_rates: {fastest:g} rad/s is {np.degrees(fastest):.0f} degrees a second. If "
            "degrees were meant, np.radians(table_rates).",
            UnusualWarning,
            stacklevel=3,
        )
    return 1 / rates


def _solve(design: FloatArray) -> FloatArray:
    """Pseudo-inverse of a design matrix, refused if it does not determine the unknowns."""
    # Columns of one size: a bias in rad/s is a small number, and no less determined for it.
    size = np.linalg.norm(design, axis=0)
    size[size == 0] = 1.0
    turns, unknowns = design.shape
    rank = np.linalg.matrix_rank(design / size)
    if rank < unknowns:
        raise ValueError(
            f"axes: expected turns that determine {unknowns} unknowns, "
            f"got {turns} turns that determine {rank}."
        )
    return np.linalg.pinv(design / size) / size[:, np.newaxis]
