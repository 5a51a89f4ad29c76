"""Two-position alignment, or in more positions: a unit is turned between its rests.

In the axes of the body a bias is the same in all positions, and the Earth's rate turns the other
way round. So the difference of two readings has no bias in it. Of the vectors along the axis of the
turn it has nothing either: their bias stays unknown.

J. G. Lee, C. G. Park and H. W. Park (Multiposition alignment of strapdown inertial navigation
system, IEEE Transactions on Aerospace and Electronic Systems 29, 1993) show which errors a turn
makes visible. The least squares here are this book's.
"""

from __future__ import annotations

import warnings
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import (
    FloatArray,
    finite_arrays,
    positive_number,
    unit_quaternions,
)
from driftlab.core.quaternion import to_matrix
from driftlab.frames import from_euler_angles

from ._contradictions import checked_tolerance, rate_contradiction
from .alignment import InconsistentAlignmentWarning, align

_LEAST = float(np.sin(np.radians(2.5)) ** 2)
"""Of sin(turn/2)^2; along directions that see less of a turn a bias is taken for unknown."""


class MultiPositionAlignment(NamedTuple):
    """Attitude in the axes of the first position, and the biases; leading axes (...).

    Attributes
    ----------
    heading, pitch, roll, latitude : ndarray, shape (...)
        rad; of the body whose axes the turns lead to, so in the first position if its turn is none.
    level_rate : ndarray, shape (...)
        Horizontal component of the Earth's rate as found, in the unit of the rate.
    gyro_bias, accelerometer_bias : ndarray, shape (..., 3)
        In body axes, in the units of rate and force. Along an axis about which all turns are there
        is nothing to be known, and the bias is zero.
    rate_residual, force_residual : ndarray, shape (...)
        What the readings leave: root of the sum of the squares over the degrees of freedom, in the
        units of rate and force. Two positions have one, along the axis of their turn, so this does
        not tell whether its angle was as told; more positions do.
    heading_uncertainty : ndarray, shape (...)
        By how much what contradicts the Earth's rate can turn the heading, rad: the level rate, and
        with turns about two axes the whole of it. NaN if nothing is known.
    """

    heading: FloatArray
    pitch: FloatArray
    roll: FloatArray
    latitude: FloatArray
    level_rate: FloatArray
    gyro_bias: FloatArray
    accelerometer_bias: FloatArray
    rate_residual: FloatArray
    force_residual: FloatArray
    heading_uncertainty: FloatArray

    @property
    def attitude(self) -> FloatArray:
        """Quaternion (..., 4) of the first position, body to North, Up, East."""
        return from_euler_angles(self.heading, self.pitch, self.roll)


def align_multi_position(
    angular_rate: ArrayLike,
    specific_force: ArrayLike,
    turn: ArrayLike,
    *,
    latitude: ArrayLike | None = None,
    rate_unit: float | None = 1.0,
    heading_tolerance: float = float(np.radians(0.5)),
) -> MultiPositionAlignment:
    """Attitude and biases of a unit at rest in two positions or more.

    Parameters
    ----------
    angular_rate, specific_force : array_like, shape (..., n, 3)
        Means of each position, in body axes forward, up, right; the unit of force is free.
    turn : array_like or Rotation, shape (..., n, 4)
        Quaternions from the body in each position to the body in the first, as a table tells them
        or as the gyros do (`driftlab.attitude.integrate`, less the Earth's turn and the bias).
        Scalar last: [1, 0, 0, 0], which is no turn if the scalar comes first, is half a turn about
        forward here, and gives a roll near 180 degrees.
    latitude : array_like, shape (...), optional
        Known latitude, rad. The level rate, in which a bias about Up does not count, is held
        against U cos(latitude).
    rate_unit, heading_tolerance : float
        As in `align`.

    Returns
    -------
    MultiPositionAlignment
        By least squares with equal weights.

    Raises
    ------
    ValueError
        If there is one position only, or if none is turned by more than 5 degrees; and as `align`
        if the Earth's rate found is vertical.

    Warns
    -----
    InconsistentAlignmentWarning
        If the turns told are hardly those that were made. It looks at the level rate, or with turns
        about two axes at the whole of it; at the residual of more than two positions; and whether
        the biases of the gyros come out larger than the Earth's level rate. Gyros that are as bad
        give this warning too: for them heading_tolerance is infinity.

    See Also
    --------
    align : One position.
    two_position_standard_deviation : How well it can do.

    Notes
    -----
    With R for the matrix of a turn, the body in position k reads R_k^T x + c: the Earth's rate or
    gravity x in the first position, and the bias c. Least squares gives

        (I - M^T M) c = mean(reading) - M^T mean(R reading),   x = mean(R reading) - M c,

    where M is the mean of R. The eigenvalues of I - M^T M are sin(turn/2)^2 across the axis of one
    turn, and zero along it. So half a turn is the best of all.

    The axis must be known as well as the angle. An error of the axis is one of the level.

    Of a turn about Up by a, told as b, the level rate comes out sin(a/2)/sin(b/2) times as large,
    and the heading errs by (a - b)/2. So a right angle told as half a turn is seen, with the
    latitude, and a wrong sign makes a large bias. But a turn of 170 degrees told as 180 has a ratio
    of 0.996 and a heading off by 5 degrees: this stays unseen. A third position shows it.

    References
    ----------
    - J. G. Lee, C. G. Park, H. W. Park, *Multiposition alignment of strapdown inertial navigation
      system*, IEEE Transactions on Aerospace and Electronic Systems 29(4), 1993.

    Examples
    --------
    A unit that leans, with bad gyros, is turned by 120 degrees about its upper axis:

    >>> from driftlab.motion import static_imu
    >>> from driftlab.quaternion import from_rotation_vector, multiply
    >>> turn = from_rotation_vector(np.radians([[0.0, 0.0, 0.0], [0.0, 120.0, 0.0]]))
    >>> attitude = multiply(from_euler_angles(0.5, 0.02, -0.01), turn)
    >>> rate, force = static_imu(attitude, np.radians(60.0))
    >>> found = align_multi_position(rate + [1e-5, 0.0, -2e-5], force + [0.02, 0.0, 0.01], turn)
    >>> [round(float(angle), 6) for angle in (found.heading, found.pitch, found.roll)]
    [0.5, 0.02, -0.01]

    Told that it was half a turn, this is what it can do to the heading, in degrees:

    >>> half, place = [[0, 0, 0, 1], [0, 1, 0, 0]], {"latitude": np.radians(60.0)}
    >>> told = align_multi_position(rate, force, half, heading_tolerance=np.inf, **place)
    >>> round(float(np.degrees(told.heading_uncertainty)), 1)
    7.7
    """
    tolerance = checked_tolerance(heading_tolerance)
    turns = unit_quaternions(turn, "turn")
    count = turns.shape[-2] if turns.ndim > 1 else 1
    if count < 2:
        raise ValueError(f"turn: expected at least two positions, got {count}.")
    rate, force, turns = finite_arrays(
        angular_rate=(angular_rate, count, 3),
        specific_force=(specific_force, count, 3),
        turn=(turns, count, 4),
    )
    matrices = to_matrix(turns)
    mean = matrices.mean(axis=-3)
    sizes, axes = np.linalg.eigh(np.eye(3) - np.swapaxes(mean, -1, -2) @ mean)
    if sizes[..., -1].min() < _LEAST:
        widest = 2 * np.degrees(np.arcsin(np.sqrt(max(float(sizes[..., -1].min()), 0.0))))
        raise ValueError(
            "turn: expected a turn by more than 5 degrees between two positions, got "
            f"{widest:.3g} degrees."
        )
    unseen = sizes < _LEAST
    inverse = np.where(unseen, 0.0, 1 / np.maximum(sizes, _LEAST))
    solve = (axes * inverse[..., np.newaxis, :]) @ np.swapaxes(axes, -1, -2)
    freedom = 3 * count - 6 + unseen.sum(axis=-1)

    def parted(readings: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        turned = np.einsum("...kij,...kj->...i", matrices, readings) / count
        constant = readings.mean(axis=-2) - np.einsum("...ji,...j->...i", mean, turned)
        bias = np.einsum("...ij,...j->...i", solve, constant)
        vector = turned - np.einsum("...ij,...j->...i", mean, bias)
        seen = np.einsum("...kji,...j->...ki", matrices, vector) + bias[..., np.newaxis, :]
        return vector, bias, np.sqrt(((readings - seen) ** 2).sum(axis=(-2, -1)) / freedom)

    earth, gyro_bias, rate_residual = parted(rate)
    up, accelerometer_bias, force_residual = parted(force)
    # A bias along the axis of the turn stays in the rate, and would be warned of.
    found = align(earth, up, latitude=latitude, rate_unit=rate_unit, heading_tolerance=np.inf)
    unit = 1.0 if rate_unit is None else positive_number(rate_unit, "rate_unit")
    doubt = found.heading_uncertainty
    if unseen.any():
        doubt = rate_contradiction(
            unit * found.level_rate, None, latitude, size_known=rate_unit is not None
        ).heading_uncertainty
    # Of what is seen worst, as the mean of the noise of one reading.
    least = np.sqrt(count * np.where(unseen, 1.0, sizes).min(axis=-1))
    scatter = np.arcsin(np.minimum(rate_residual / (found.level_rate * least), 1.0))
    _warn_of_turns(
        found.level_rate,
        np.linalg.norm(gyro_bias, axis=-1),
        doubt,
        scatter if count > 2 else np.zeros_like(scatter),
        tolerance,
    )
    shape = np.shape(found.heading)
    biases = (np.broadcast_to(each, (*shape, 3)).copy() for each in (gyro_bias, accelerometer_bias))
    others = np.broadcast_arrays(rate_residual, force_residual, doubt, found.heading)[:3]
    return MultiPositionAlignment(*found[:5], *biases, *(np.array(each)[()] for each in others))


def _warn_of_turns(
    level: FloatArray, bias: FloatArray, doubt: FloatArray, scatter: FloatArray, tolerance: float
) -> None:
    """Warn of turns that are not those that were made, in one sentence."""
    part = bias / level
    reasons = []
    if np.any(doubt > tolerance):
        reasons.append(
            "a level rate that is not the Earth's and can turn the heading by "
            f"{np.degrees(np.nanmax(doubt)):.2g} degrees"
        )
    if np.any(scatter > tolerance):
        reasons.append(
            "readings that do not fit each other and leave the heading open by "
            f"{np.degrees(scatter.max()):.2g} degrees"
        )
    if np.isfinite(tolerance) and np.any(part > 1):
        reasons.append(f"biases of the gyros {part.max():.3g} times the Earth's level rate")
    if reasons:
        warnings.warn(
            "angular_rate, turn: expected the Earth's rate as it is seen after the turns told, got "
            f"{' and '.join(reasons)}. Was each turn made as told, with this sign, and does it "
            "lead from the body in its position to the body in the first? Is the rate in rad/s "
            "(otherwise tell rate_unit)?",
            InconsistentAlignmentWarning,
            stacklevel=3,
        )
