"""Plotnikov et al.: heading from gravity and the Earth's rotation, at rest, and its errors.

Axes and angles are those of `driftlab.frames`, which are the paper's. The paper's formulas
have no numbers. They are called by their subject here: (alignment heading), (alignment pitch),
(alignment roll); and in other modules (heading), (operating heading).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_arrays, nonzero_vectors
from driftlab.core.vectors import norms
from driftlab.earth import EARTH_RATE, checked_gravity, checked_latitude, gravity as normal_gravity
from driftlab.frames import from_euler_angles, pitch_and_roll, refuse_vertical

_LEAST_COLATITUDE = np.radians(0.1)


class Alignment(NamedTuple):
    """Heading, pitch, roll and latitude of a body at rest, from its own sensors; each (...).

    Attributes
    ----------
    heading, pitch, roll, latitude : ndarray, shape (...)
        rad.
    level_rate : ndarray, shape (...)
        Horizontal component of the angular rate, in the unit of that rate. Without errors it is
        U cos(latitude), where U is the Earth's rate.

    Examples
    --------
    >>> found = align([1.0, 1.0, 0.0], [0.0, 9.8, 0.0])  # the Earth turns about North and Up
    >>> float(np.degrees(found.latitude).round(6)), float(found.level_rate)
    (45.0, 1.0)
    """

    heading: FloatArray
    pitch: FloatArray
    roll: FloatArray
    latitude: FloatArray
    level_rate: FloatArray

    @property
    def attitude(self) -> FloatArray:
        """Attitude quaternion, well defined in every attitude, the vertical included.

        Returns
        -------
        ndarray, shape (..., 4)
            Body (forward, up, right) to North, Up, East.

        Examples
        --------
        >>> align([1.0, 1.0, 0.0], [0.0, 9.8, 0.0]).attitude  # level, and headed North
        array([0., 0., 0., 1.])
        """
        return from_euler_angles(self.heading, self.pitch, self.roll)


class AlignmentErrors(NamedTuple):
    """First-order errors of an alignment, computed minus true.

    Attributes
    ----------
    heading, pitch, roll, latitude : ndarray, shape (...)
        rad.
    heading_terms : ndarray, shape (..., 4)
        Terms of `heading` in the paper's order, rad: east gyro; east accelerometer by tan(pitch);
        north accelerometer by tan(pitch); east accelerometer by tan(latitude).

    Examples
    --------
    A bias of 1e-4 g of the east accelerometer at 60 degrees:

    >>> bias = [0.0, 0.0, 9.8e-4]
    >>> found = alignment_errors(0.0, 0.0, np.radians(60.0), np.zeros(3), bias, gravity=9.8)
    >>> f"{found.heading:.2e} {found.roll:.2e}"  # rad
    '-1.73e-04 -1.00e-04'
    """

    heading: FloatArray
    pitch: FloatArray
    roll: FloatArray
    latitude: FloatArray
    heading_terms: FloatArray


def align(angular_rate: ArrayLike, specific_force: ArrayLike) -> Alignment:
    """Heading, pitch, roll and latitude of a body at rest, from its own sensors alone.

    Parameters
    ----------
    angular_rate, specific_force : array_like, shape (..., 3)
        Means over the time of alignment, in body axes forward, up, right. The angles depend on the
        directions only, so the units are free.

    Returns
    -------
    Alignment
        Angles (...) in rad, and the level rate (...) in the unit of `angular_rate`.

    Raises
    ------
    ValueError
        If either vector is zero, or if they are parallel within 0.1 degrees, as at a pole, where
        the Earth's rate has no horizontal component.

    Notes
    -----
    Plotnikov, trigonometric alignment. The heading is positive from North to West. Two directions
    do not tell in which axes they are given: a log in forward, right, down must be converted first
    by `driftlab.axes.convert_vectors`, or the roll comes out wrong by a quarter turn.

    The body must not turn meanwhile. A body that leans about East by a small angle more at the end
    than at the start turns the heading by this angle over T U cos(latitude), where T is the time of
    the means: an arc minute in five minutes by about a degree. The latitude that comes out gives
    alarm, if it is known. `driftlab.gyrocompass.inertial_alignment` aligns a body that sways.

    Examples
    --------
    At 45 degrees of latitude, with the bow to the West:

    >>> found = align([0.0, 1.0, 1.0], [0.0, 9.8, 0.0])
    >>> [float(np.degrees(angle).round(6)) for angle in (found.heading, found.latitude)]
    [90.0, 45.0]
    """
    rate, force = finite_arrays(angular_rate=(angular_rate, 3), specific_force=(specific_force, 3))
    turn, size = nonzero_vectors(rate, "angular_rate")
    up, _ = nonzero_vectors(force, "specific_force")
    across = norms(np.cross(turn, up))
    if across.min() < np.sin(_LEAST_COLATITUDE):
        raise ValueError(
            "angular_rate, specific_force: expected directions more than 0.1 degrees from parallel,"
            " because nothing points North at a pole, got an angle of "
            f"{np.degrees(np.arcsin(across.min())):.3g} degrees."
        )
    latitude = np.arctan2(np.einsum("...i,...i->...", turn, up), across)
    pitch, roll = pitch_and_roll(up)
    along = turn[..., 1] * np.cos(roll) - turn[..., 2] * np.sin(roll)
    forward = turn[..., 0] * np.cos(pitch) - along * np.sin(pitch)
    right = turn[..., 1] * np.sin(roll) + turn[..., 2] * np.cos(roll)
    found = np.broadcast_arrays(np.arctan2(right, forward), pitch, roll, latitude, size * across)
    return Alignment(*(np.array(angle)[()] for angle in found))


def alignment_errors(
    heading: ArrayLike,
    pitch: ArrayLike,
    latitude: ArrayLike,
    gyro_bias_nue: ArrayLike,
    accelerometer_bias_nue: ArrayLike,
    gravity: ArrayLike | None = None,
) -> AlignmentErrors:
    """First-order errors of `align`; (alignment heading), (alignment pitch), (alignment roll).

    Parameters
    ----------
    heading, pitch, latitude : array_like, shape (...)
        rad. The roll does not matter.
    gyro_bias_nue : array_like, shape (..., 3)
        Gyro biases resolved in North, Up, East, rad/s.
    accelerometer_bias_nue : array_like, shape (..., 3)
        Accelerometer biases resolved in North, Up, East, m/s^2.
    gravity : array_like, shape (...), optional
        m/s^2; normal gravity of the latitude if not given.

    Returns
    -------
    AlignmentErrors
        Errors (...) in rad, and the terms of the heading error.

    Raises
    ------
    ValueError
        Within 0.1 degrees of a pole, or of a vertical body: there heading and roll are not two
        angles. `alignment_attitude_error` has no limit in pitch.

    Notes
    -----
    The third term of the paper's heading error carries a factor tan(latitude) that does not belong
    there; it is left out. The error of the latitude is not in the paper.

    Examples
    --------
    An east gyro with a bias of 0.01 degrees per hour, at 60 degrees, in arc minutes:

    >>> bias = np.radians([0.0, 0.0, 0.01]) / 3600
    >>> found = alignment_errors(0.0, 0.0, np.radians(60.0), bias, np.zeros(3))
    >>> round(60 * float(np.degrees(found.heading)), 2)
    4.57
    """
    heading, pitch, place, gyro_bias, accelerometer_bias, pull = _alignment_arguments(
        latitude, gyro_bias_nue, accelerometer_bias_nue, gravity, heading=(heading,), pitch=(pitch,)
    )
    refuse_vertical(pitch)
    north, _, east = np.moveaxis(accelerometer_bias / pull[..., np.newaxis], -1, 0)
    cosine, sine = np.cos(heading), np.sin(heading)
    terms = np.stack(
        np.broadcast_arrays(
            gyro_bias[..., 2] / (EARTH_RATE * np.cos(place)),
            east * cosine * np.tan(pitch),
            north * sine * np.tan(pitch),
            -east * np.tan(place),
        ),
        axis=-1,
    )
    across = gyro_bias[..., 1] * np.cos(place) - gyro_bias[..., 0] * np.sin(place)
    total = terms.sum(axis=-1)
    shape = np.broadcast_shapes(total.shape, north.shape, across.shape, pitch.shape)
    heading_error, pitch_error, roll_error, latitude_error = (
        np.array(np.broadcast_to(error, shape))[()]
        for error in (
            total,
            north * cosine - east * sine,
            -(east * cosine + north * sine) / np.cos(pitch),
            north + across / EARTH_RATE,
        )
    )
    return AlignmentErrors(
        heading_error,
        pitch_error,
        roll_error,
        latitude_error,
        np.array(np.broadcast_to(terms, (*shape, 4))),
    )


def alignment_attitude_error(
    latitude: ArrayLike,
    gyro_bias_nue: ArrayLike,
    accelerometer_bias_nue: ArrayLike,
    gravity: ArrayLike | None = None,
) -> FloatArray:
    """First-order attitude error of `align`, as a rotation vector; it holds in every attitude.

    Parameters
    ----------
    latitude : array_like, shape (...)
        rad.
    gyro_bias_nue : array_like, shape (..., 3)
        Gyro biases resolved in North, Up, East, rad/s.
    accelerometer_bias_nue : array_like, shape (..., 3)
        Accelerometer biases resolved in North, Up, East, m/s^2.
    gravity : array_like, shape (...), optional
        m/s^2; normal gravity of the latitude if not given.

    Returns
    -------
    ndarray, shape (..., 3)
        Rotation in North, Up, East that leads from the true to the computed attitude, rad.

    Raises
    ------
    ValueError
        Within 0.1 degrees of a pole.

    Examples
    --------
    Biases of the North and East accelerometers of 1e-4 g and 2e-4 g at 45 degrees:

    >>> bias = [9.8e-4, 0.0, 19.6e-4]
    >>> alignment_attitude_error(np.radians(45.0), np.zeros(3), bias, gravity=9.8).round(6)
    array([-0.0002, -0.0002,  0.0001])
    """
    place, gyro_bias, accelerometer_bias, pull = _alignment_arguments(
        latitude, gyro_bias_nue, accelerometer_bias_nue, gravity
    )
    north, _, east = np.moveaxis(accelerometer_bias / pull[..., np.newaxis], -1, 0)
    up = gyro_bias[..., 2] / (EARTH_RATE * np.cos(place)) - east * np.tan(place)
    return np.stack(np.broadcast_arrays(-east, up, north), axis=-1)


def _alignment_arguments(
    latitude: ArrayLike,
    gyro_bias_nue: ArrayLike,
    accelerometer_bias_nue: ArrayLike,
    gravity: ArrayLike | None,
    **angles: tuple[ArrayLike],
) -> list[FloatArray]:
    pull = normal_gravity(latitude) if gravity is None else gravity
    arguments = finite_arrays(
        **angles,
        latitude=(latitude,),
        gyro_bias_nue=(gyro_bias_nue, 3),
        accelerometer_bias_nue=(accelerometer_bias_nue, 3),
        gravity=(pull,),
    )
    checked_latitude(arguments[-4])
    checked_gravity(arguments[-1])
    return arguments
