"""From the record of a table's turn, simulated or real, to the turn estimate of Larin (3.3)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.attitude.coning_algorithms import (
    AnyAlgorithm,
    AttitudeAlgorithm,
    checked_algorithm,
)
from driftlab.attitude.integration import integrate
from driftlab.checks import (
    FloatArray,
    finite_array,
    finite_arrays,
    nonnegative_number,
    nonzero_vectors,
    positive_number,
    whole_number,
)
from driftlab.core.quaternion import from_rotation_vector, multiply
from driftlab.core.vectors import norms
from driftlab.drift.turn_calibration import turn_estimate

_TOLERANCE = 0.05
"""By which part a triad may say too much or too little: more than a simple one does."""


def recorded_turn_estimate(
    increments: ArrayLike,
    axis: ArrayLike,
    turns: int = 1,
    algorithm: AnyAlgorithm = "rotation-vector-2",
) -> FloatArray:
    """Estimate n^T Sigma n from the angle increments of a gyro triad that a table has turned.

    On the Earth the estimate contains the offsets of the Earth's rate and of the gyro bias as well:
    see `earth_rate_offset`. The mean of two turns in opposite directions is free of both to first
    order.

    Parameters
    ----------
    increments : array_like, shape (..., n, 3)
        Integrals of the rates that the gyros measure, over equal intervals, rad; from rest to rest,
        or as many whole turns at a constant rate.
    axis : array_like, shape (..., 3)
        Axis n of the turns in the body; only its direction counts. Whether the table turned about n
        or -n is read from the increments, and does not change the sign of the estimate.
    turns : int
        Number k of whole turns.
    algorithm : str or Algorithm or FunctionalIteration or callable
        As in `driftlab.attitude.integrate`. A turn is nearly at a constant rate, for which a
        rotation vector is exact; algorithms with a tangent err with the fourth power of the angle
        between rows, by 1.6 arc seconds at 36 rows a turn. Rows at the end that do not make a whole
        step are taken one by one at constant rate; one's own function must take all rows.

    Returns
    -------
    ndarray, shape (...)
        Estimates, without unit.

    Raises
    ------
    ValueError
        If the increments do not add up to `turns` turns about the axis: along it they may be off by
        5 % of these (and by less than half a turn), across it by as much. Also as in
        `driftlab.attitude.integrate` and `turn_estimate`.

    See Also
    --------
    fit_error_matrix : All nine errors from the same records.
    fit_turns : The sigmas from several turns.
    turn_estimate : The same from an attitude error.

    Examples
    --------
    A perfect triad on the Earth, once about a body axis:

    >>> from driftlab.motion import TurntableRotation
    >>> turn = TurntableRotation(np.radians(10.0), latitude=np.radians(37.5))
    >>> record = turn.increments([1, 1, 0], samples=3600)
    >>> found = recorded_turn_estimate(record.angle, [1, 1, 0])
    >>> print(f"{3600 * np.degrees(found):.2f}")  # arc seconds
    52.46
    """
    chosen = checked_algorithm(algorithm)
    count = whole_number(turns, "turns")
    n, _ = nonzero_vectors(axis, "axis")
    rows = finite_array(increments, "increments", 3)
    if rows.ndim < 2:
        raise ValueError(f"increments: expected shape (..., n, 3), got shape {rows.shape}.")
    finite_arrays(increments=(rows, *rows.shape[-2:]), axis=(n, 3))
    turned = _whole_turns(rows.sum(axis=-2) / (2 * np.pi), n, count)
    length = whole = rows.shape[-2]
    if isinstance(chosen, AttitudeAlgorithm):
        if length < chosen.window:
            raise ValueError(
                f"increments: expected at least {chosen.window} rows for {chosen.name}, "
                f"got {length}."
            )
        whole -= length % chosen.samples
    attitude = integrate(rows[..., :whole, :], chosen)[..., -1, :]
    for row in range(whole, length):
        attitude = multiply(attitude, from_rotation_vector(rows[..., row, :]))
    return turn_estimate(attitude, np.sign(turned)[..., np.newaxis] * n, count)


class ErrorMatrixFit(NamedTuple):
    """Error matrix of a triad from turns in both directions; the result of `fit_error_matrix`.

    Attributes
    ----------
    error_matrix : ndarray, shape (..., 3, 3)
        M, without unit: scale-factor errors on the diagonal, cross-coupling beside it.
    covariance : ndarray, shape (..., 9, 9)
        Covariance of the nine entries, row by row.
    residuals : ndarray, shape (..., m, 3)
        Each half difference minus what M makes of its axis, without unit.
    """

    error_matrix: FloatArray
    covariance: FloatArray
    residuals: FloatArray


def fit_error_matrix(
    forward: ArrayLike,
    backward: ArrayLike,
    axes: ArrayLike,
    turns: int = 1,
    *,
    angle_noise: float,
    axis_error: float = 0.0,
) -> ErrorMatrixFit:
    r"""Fit all nine errors of a triad to the summed increments of turns in both directions.

    `recorded_turn_estimate` keeps the symmetric part of the error matrix only; the records
    determine the skew part as well, as accurately as the axes are known in the body.

    Parameters
    ----------
    forward, backward : array_like, shape (..., m, 3)
        Sums of the increments of the two turns about each axis, rad: counter-clockwise and
        clockwise about n, for the same time, with n along the same direction in space.
    axes : array_like, shape (m, 3)
        Axes n in the body, at least three that do not lie in one plane; only their directions
        count.
    turns : int
        Number k of whole turns in each direction.
    angle_noise : float
        Standard deviation, per gyro, of the noise of one sum, rad: angle random walk times the
        square root of the time.
    axis_error : float
        Standard deviation of each axis in each of the two directions across it, rad. It weights
        what is measured across the axes against what is measured along them.

    Returns
    -------
    ErrorMatrixFit
        The error matrix, its covariance, and the residuals.

    Raises
    ------
    ValueError
        If the axes lie in one plane, or the sums are not `turns` turns about them within 5 %.

    See Also
    --------
    fit_turns : The sigmas from turn estimates.

    Notes
    -----
    A table that turns at one constant rate carries the level part of the Earth's rate round, and it
    sums to zero over whole turns. The vertical part and the gyro bias add the same to both sums.
    Without noise, therefore, with A = I + M,

    .. math:: \frac{\gamma_+ - \gamma_-}{4\pi k} - n = A n - n = M n

    exactly. Three axes give all nine entries. With ramps it remains exact if both turns start at
    the same heading with the same rate profile, and the second half of the profile mirrors the
    first.

    An axis that is off by a small vector e adds :math:`A e`. Along :math:`u = A^{-T} n` this is
    :math:`u^T A e = n^T e = -e^T e/2`, because the true axis has unit length as well; across u it
    is of first order. A body that sits turned in its fixture moves all axes alike and, for small M,
    changes only the skew part to first order. Errors that differ from axis to axis spare the
    symmetric part only if six axes determine it by what is measured along u.

    Each axis is weighted by the inverse of its covariance,
    :math:`(s^2 + 2 (1 + p^2) a^4) I + a^2 A (I - n n^T) A^T`, where s is the noise of half a
    difference, a is `axis_error`, and A comes from a fit without weights. The norm p of the
    pseudo-inverse of the axes, or 1 if that is larger, allows for axes near one plane. `covariance`
    follows from this, for axis errors that are independent of each other; an error that all axes
    share goes into the skew part in full, and the covariance does not contain it. See Larin (3.3)
    for :math:`n^T \Sigma n`, the part along the axis.

    Examples
    --------
    About each body axis once in both directions, on the Earth, with a gyro bias:

    >>> from driftlab.motion import TurntableRotation
    >>> triad = 1e-4 * np.array([[4, 1, 2], [-1, 5, 3], [2, 0, 6]])
    >>> sums = []
    >>> for rate in (0.2, -0.2):
    ...     record = TurntableRotation(rate, latitude=0.9).increments(np.eye(3), 360)
    ...     sums.append((record.angle @ (np.eye(3) + triad).T + 1e-6).sum(axis=-2))
    >>> fit = fit_error_matrix(*sums, np.eye(3), angle_noise=1e-6)
    >>> fit.error_matrix.round(6) + 0.0
    array([[ 0.0004,  0.0001,  0.0002],
           [-0.0001,  0.0005,  0.0003],
           [ 0.0002,  0.    ,  0.0006]])
    """
    n, _ = nonzero_vectors(axes, "axes")
    if n.ndim != 2:
        raise ValueError(f"axes: expected shape (m, 3), got shape {n.shape}.")
    if np.linalg.matrix_rank(n) < 3:
        raise ValueError("axes: expected three that do not lie in one plane, got fewer.")
    count = whole_number(turns, "turns")
    scale = 2 * np.pi * count
    uncertain = nonnegative_number(axis_error, "axis_error")
    # The noise of two sums is independent; half of their difference has 1/sqrt(2) of it.
    noise = positive_number(angle_noise, "angle_noise") / (np.sqrt(2) * scale)
    # At second order an error e counts along the axis by -|e|^2/2, with an rms of sqrt(2) a^2, and
    # by its product with the error of u, which grows as the axes come near one plane.
    nearness = max(1.0, float(np.linalg.norm(np.linalg.pinv(n), 2)))
    noise = np.hypot(noise, np.sqrt(2 + 2 * nearness**2) * uncertain**2)
    there, back = (
        _sums(value, name, n, sense * count)
        for value, name, sense in ((forward, "forward", 1), (backward, "backward", -1))
    )
    finite_arrays(forward=(there, *there.shape[-2:]), backward=(back, *back.shape[-2:]))
    found = (there - back) / (2 * scale) - n
    # Each axis gives three equations; what an error of the axis reaches counts less.
    unweighted = np.swapaxes(np.linalg.pinv(n) @ found, -1, -2)
    across = np.eye(3) - n[:, :, np.newaxis] * n[:, np.newaxis, :]
    basis, sizes, _ = np.linalg.svd((np.eye(3) + unweighted)[..., np.newaxis, :, :] @ across)
    weights = np.swapaxes(basis / np.hypot(noise, uncertain * sizes)[..., np.newaxis, :], -1, -2)
    design = np.einsum("...mij,mk->...mijk", weights, n)
    inverse = np.linalg.pinv(design.reshape(*design.shape[:-4], -1, 9))
    weighted = np.einsum("...mij,...mj->...mi", weights, found)
    entries = np.einsum("...ij,...j->...i", inverse, weighted.reshape(*found.shape[:-2], -1))
    matrix = entries.reshape(*found.shape[:-2], 3, 3)
    residuals = found - np.einsum("...ij,mj->...mi", matrix, n)
    return ErrorMatrixFit(matrix, inverse @ np.swapaxes(inverse, -1, -2), residuals)


def _sums(value: ArrayLike, name: str, n: FloatArray, count: int) -> FloatArray:
    """Sums (..., m, 3) of increments that make `count` turns about the axes, negative backward."""
    sums = finite_array(value, name, 3)
    if sums.ndim < 2 or sums.shape[-2] != len(n):
        raise ValueError(f"{name}: expected shape (..., {len(n)}, 3), got shape {sums.shape}.")
    turned = sums / (2 * np.pi)
    off = norms(turned - count * n)
    limit = _TOLERANCE * abs(count)
    if (off > limit).any():
        worst = turned.reshape(-1, 3)[off.argmax()]
        raise ValueError(
            f"{name}: expected sums in rad of {count} turns about the axes within {limit:g}, got "
            f"({worst[0]:.4g}, {worst[1]:.4g}, {worst[2]:.4g}) turns: another axis or direction, "
            "or degrees?"
        )
    return sums


def _whole_turns(total: FloatArray, n: FloatArray, count: int) -> FloatArray:
    """Turns (...) along the axis, of increments that add up to `total` (..., 3), in turns."""
    along: FloatArray = np.einsum("...i,...i->...", total, n)
    across = norms(total - along[..., np.newaxis] * n)
    limit = _TOLERANCE * count
    off = np.abs(np.abs(along) - count)
    if (off >= min(limit, 0.5)).any():
        worst = np.ravel(along)[np.argmax(off)]
        raise ValueError(
            f"increments: expected angles in rad that add up to {count} within "
            f"{min(limit, 0.5):g}, counted in turns along the axis, got {worst:.4g}: another axis, "
            "degrees, rates, or a record that is cut?"
        )
    if (across > limit).any():
        raise ValueError(
            f"increments: expected angles in rad that add up to at most {limit:g} turns across "
            f"the axis, got {across.max():.4g}: another axis?"
        )
    return along
