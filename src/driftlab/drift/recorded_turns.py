"""From the record of a table's turn, simulated or real, to the turn estimate of Larin (3.3)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.attitude.coning_algorithms import (
    AnyAlgorithm,
    AttitudeAlgorithm,
    checked_algorithm,
)
from driftlab.attitude.integration import integrate
from driftlab.checks import FloatArray, finite_array, finite_arrays, nonzero_vectors, whole_number
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
