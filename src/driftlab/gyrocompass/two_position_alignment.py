"""Alignment of a unit that is turned between its rests: the biases stay behind, the Earth does not.

In the axes of the body a bias is the same in all positions, and the Earth's rate turns the other
way round. So the difference of two readings has no bias in it. Of the vectors along the axis of the
turn it has nothing either: their bias stays unknown.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_arrays, unit_quaternions
from driftlab.core.quaternion import to_matrix
from driftlab.frames import from_euler_angles

from .alignment import align

_LEAST = float(np.sin(np.radians(2.5)) ** 2)
"""Of sin(turn/2)^2; along directions that see less of a turn a bias is taken for unknown."""


class PositionsAlignment(NamedTuple):
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

    Examples
    --------
    >>> rate = [[1.1, 1.0, 0.2], [-0.9, 1.0, 0.2]]  # before and after half a turn about Up
    >>> found = align_in_positions(rate, [[0, 9.8, 0], [0, 9.8, 0]], [[0, 0, 0, 1], [0, 1, 0, 0]])
    >>> found.gyro_bias
    array([0.1, 0. , 0.2])
    """

    heading: FloatArray
    pitch: FloatArray
    roll: FloatArray
    latitude: FloatArray
    level_rate: FloatArray
    gyro_bias: FloatArray
    accelerometer_bias: FloatArray

    @property
    def attitude(self) -> FloatArray:
        """Attitude quaternion of the first position.

        Returns
        -------
        ndarray, shape (..., 4)
            Body (forward, up, right) to North, Up, East.

        Examples
        --------
        >>> rate, turn = [[1.1, 1.0, 0.2], [-0.9, 1.0, 0.2]], [[0, 0, 0, 1], [0, 1, 0, 0]]
        >>> align_in_positions(rate, [[0, 9.8, 0], [0, 9.8, 0]], turn).attitude
        array([0., 0., 0., 1.])
        """
        return from_euler_angles(self.heading, self.pitch, self.roll)


def align_in_positions(
    angular_rate: ArrayLike, specific_force: ArrayLike, turn: ArrayLike
) -> PositionsAlignment:
    """Attitude and biases of a unit at rest in two positions or more.

    Parameters
    ----------
    angular_rate, specific_force : array_like, shape (..., n, 3)
        Means of each position, in body axes forward, up, right; the units are free.
    turn : array_like, shape (..., n, 4)
        Quaternions from the body in each position to the body in the first, as a table tells them
        or as the gyros do (`driftlab.attitude.integrate`, less the Earth's turn and the bias).

    Returns
    -------
    PositionsAlignment
        By least squares with equal weights.

    Raises
    ------
    ValueError
        If there is one position only, or if none is turned by more than 5 degrees; and as `align`
        if the Earth's rate found is vertical.

    Notes
    -----
    With R for the matrix of a turn, the body in position k reads R_k^T x + c: the Earth's rate or
    gravity x in the first position, and the bias c. Least squares gives

        (I - M^T M) c = mean(reading) - M^T mean(R reading),   x = mean(R reading) - M c,

    where M is the mean of R. The eigenvalues of I - M^T M are sin(turn/2)^2 across the axis of one
    turn, and zero along it. So half a turn is the best of all.

    The axis must be known as well as the angle. An error of the axis is one of the level.

    Examples
    --------
    A unit that leans, with bad gyros, is turned by 120 degrees about its upper axis:

    >>> from driftlab.motion import static_imu
    >>> from driftlab.quaternion import from_rotation_vector, multiply
    >>> turn = from_rotation_vector(np.radians([[0.0, 0.0, 0.0], [0.0, 120.0, 0.0]]))
    >>> attitude = multiply(from_euler_angles(0.5, 0.02, -0.01), turn)
    >>> rate, force = static_imu(attitude, np.radians(60.0))
    >>> found = align_in_positions(rate + [1e-5, 0.0, -2e-5], force + [0.02, 0.0, 0.01], turn)
    >>> [round(float(angle), 6) for angle in (found.heading, found.pitch, found.roll)]
    [0.5, 0.02, -0.01]
    """
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
    seen = np.eye(3) - np.swapaxes(mean, -1, -2) @ mean
    sizes, axes = np.linalg.eigh(seen)
    if sizes[..., -1].min() < _LEAST:
        widest = 2 * np.degrees(np.arcsin(np.sqrt(max(float(sizes[..., -1].min()), 0.0))))
        raise ValueError(
            "turn: expected a turn by more than 5 degrees between two positions, got "
            f"{widest:.3g} degrees."
        )
    inverse = np.where(sizes < _LEAST, 0.0, 1 / np.maximum(sizes, _LEAST))
    solve = (axes * inverse[..., np.newaxis, :]) @ np.swapaxes(axes, -1, -2)

    def parted(readings: FloatArray) -> tuple[FloatArray, FloatArray]:
        turned = np.einsum("...kij,...kj->...i", matrices, readings) / count
        constant = readings.mean(axis=-2) - np.einsum("...ji,...j->...i", mean, turned)
        bias = np.einsum("...ij,...j->...i", solve, constant)
        return turned - np.einsum("...ij,...j->...i", mean, bias), bias

    earth, gyro_bias = parted(rate)
    up, accelerometer_bias = parted(force)
    # A bias along the axis of the turn stays in the rate, and would be warned of.
    found = align(earth, up, heading_tolerance=np.inf)
    shape = np.shape(found.heading)
    biases = (np.broadcast_to(each, (*shape, 3)).copy() for each in (gyro_bias, accelerometer_bias))
    return PositionsAlignment(*found[:5], *biases)
