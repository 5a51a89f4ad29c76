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
from driftlab.earth import EARTH_RATE, checked_gravity, checked_latitude
from driftlab.earth import gravity as normal_gravity
from driftlab.frames import attitude_from_angles, pitch_and_roll, refuse_vertical

_LEAST_COLATITUDE = np.radians(0.1)


class Alignment(NamedTuple):
    """What a body at rest can tell of itself, each (...).

    Attributes
    ----------
    heading, pitch, roll, latitude : ndarray
        rad.
    level_rate : ndarray
        Level part of the angular rate, in its unit: U cos(latitude) but for errors.
    """

    heading: FloatArray
    pitch: FloatArray
    roll: FloatArray
    latitude: FloatArray
    level_rate: FloatArray

    @property
    def attitude(self) -> FloatArray:
        """Quaternion (..., 4), body to North, Up, East: well defined in every attitude."""
        return attitude_from_angles(self.heading, self.pitch, self.roll)


class AlignmentErrors(NamedTuple):
    """First-order errors, computed minus true, each (...) unless said otherwise, rad.

    Attributes
    ----------
    heading, pitch, roll, latitude : ndarray
    heading_terms : ndarray, shape (..., 4)
        The summands of `heading` in the paper's order: east gyro; east accelerometer by tan pitch;
        north accelerometer by tan pitch; east accelerometer by tan latitude.
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
        Means over the time of alignment, in body axes forward, up, right. Units do not matter to
        the angles: only directions count.

    Raises
    ------
    ValueError
        If either is zero, or if they are parallel within 0.1 degrees as at a pole, where nothing
        points North.
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
    return Alignment(*map(np.array, found))


def alignment_errors(
    heading: ArrayLike,
    pitch: ArrayLike,
    latitude: ArrayLike,
    rate_error: ArrayLike,
    force_error: ArrayLike,
    gravity: ArrayLike | None = None,
) -> AlignmentErrors:
    """First-order errors of `align`; (alignment heading), (alignment pitch), (alignment roll).

    The third term of the paper's heading error carries a factor tan(latitude) that does not belong
    there; it is left out. The error of the latitude is not in the paper.

    Parameters
    ----------
    heading, pitch, latitude : array_like, shape (...)
        rad. The roll does not matter.
    rate_error : array_like, shape (..., 3)
        Drift rates of the gyros resolved in North, Up, East, rad/s.
    force_error : array_like, shape (..., 3)
        Zero offsets of the accelerometers, so resolved, m/s^2.
    gravity : array_like, shape (...), optional
        m/s^2; normal gravity of the latitude if not given.

    Raises
    ------
    ValueError
        Within 0.1 degrees of a pole, or of a vertical body: there heading and roll are not two
        angles. `alignment_attitude_error` has no limit in pitch.
    """
    heading, pitch, place, drift, offset, pull = _alignment_arguments(
        latitude, rate_error, force_error, gravity, heading=(heading,), pitch=(pitch,)
    )
    refuse_vertical(pitch)
    north, _, east = np.moveaxis(offset / pull[..., np.newaxis], -1, 0)
    cosine, sine = np.cos(heading), np.sin(heading)
    terms = np.stack(
        np.broadcast_arrays(
            drift[..., 2] / (EARTH_RATE * np.cos(place)),
            east * cosine * np.tan(pitch),
            north * sine * np.tan(pitch),
            -east * np.tan(place),
        ),
        axis=-1,
    )
    across = drift[..., 1] * np.cos(place) - drift[..., 0] * np.sin(place)
    heading_error, pitch_error, roll_error, latitude_error = np.broadcast_arrays(
        terms.sum(axis=-1),
        north * cosine - east * sine,
        -(east * cosine + north * sine) / np.cos(pitch),
        north + across / EARTH_RATE,
    )
    return AlignmentErrors(
        heading_error.copy(),
        pitch_error.copy(),
        roll_error.copy(),
        latitude_error.copy(),
        np.broadcast_to(terms, (*heading_error.shape, 4)).copy(),
    )


def alignment_attitude_error(
    latitude: ArrayLike,
    rate_error: ArrayLike,
    force_error: ArrayLike,
    gravity: ArrayLike | None = None,
) -> FloatArray:
    """First-order attitude error of `align`, as a rotation vector (..., 3) in North, Up, East, rad.

    The computed attitude is the true one, then turned by this vector. It holds in every attitude,
    the vertical included. Arguments as for `alignment_errors`.

    Parameters
    ----------
    latitude : array_like, shape (...)
    rate_error, force_error : array_like, shape (..., 3)
    gravity : array_like, shape (...), optional
    """
    place, drift, offset, pull = _alignment_arguments(latitude, rate_error, force_error, gravity)
    north, _, east = np.moveaxis(offset / pull[..., np.newaxis], -1, 0)
    up = drift[..., 2] / (EARTH_RATE * np.cos(place)) - east * np.tan(place)
    return np.stack(np.broadcast_arrays(-east, up, north), axis=-1)


def _alignment_arguments(
    latitude: ArrayLike,
    rate_error: ArrayLike,
    force_error: ArrayLike,
    gravity: ArrayLike | None,
    **angles: tuple[ArrayLike],
) -> list[FloatArray]:
    pull = normal_gravity(latitude) if gravity is None else gravity
    arguments = finite_arrays(
        **angles,
        latitude=(latitude,),
        rate_error=(rate_error, 3),
        force_error=(force_error, 3),
        gravity=(pull,),
    )
    checked_latitude(arguments[-4])
    checked_gravity(arguments[-1])
    return arguments
