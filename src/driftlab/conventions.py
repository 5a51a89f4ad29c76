"""Signs and orders in which books differ: attitude errors, psi angle, headings, quaternions.

Chapter 19 has the table that says which book has which; `axes` converts between axes.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .checks import FloatArray, finite_array, finite_arrays, one_of, unit_quaternions
from .core.quaternion import conjugate, rotate
from .core.vectors import wrap_angle
from .earth import checked_latitude

ATTITUDE_ERRORS = {
    "phi": (-1, "reference"),
    "titterton-weston": (-1, "reference"),
    "groves": (1, "reference"),
    "larin": (1, "body"),
}
"""Definitions of a small attitude error e, with the sign s and the axes that each has.

With C the true matrix, body to reference, and Ĉ the computed one:

``phi``: Ĉ = (I - [e×]) C, in reference axes. The book's φ in chapters 10 and 11, its δ in chapter
14, and the phi-angle error model.
``titterton-weston``: the same; the tilt and azimuth errors of Titterton and Weston.
``groves``: Ĉ = (I + [e×]) C, in reference axes. The δψ of Groves; the book's ε in chapter 13.
``larin``: Ĉ = C (I + [e×]), in body axes; e is twice the vector part of λ_e, chapters 01 to 04.
"""


def convert_attitude_error(
    error: ArrayLike, source: str, target: str, true_attitude: ArrayLike | None = None
) -> FloatArray:
    """Small attitude error by the definition of another book.

    Parameters
    ----------
    error : array_like, shape (..., 3)
        rad, by the definition `source`.
    source, target : str
        Two of `ATTITUDE_ERRORS`.
    true_attitude : array_like or Rotation, shape (..., 4), optional
        Quaternions, body to reference; needed only between an error in body axes and one in
        reference axes. The computed attitude does as well, to first order.

    Returns
    -------
    ndarray, shape (..., 3)
        rad, by the definition `target`; the same to first order.

    Raises
    ------
    ValueError
        If a definition is unknown, or the attitude is needed and not given.

    Examples
    --------
    Larin's error has the opposite sign and is in body axes. In a body that is turned by a quarter
    about Up, an error about its first axis is one about North:

    >>> quarter = [0, 0, np.sqrt(0.5), np.sqrt(0.5)]
    >>> convert_attitude_error([1e-3, 0, 0], "larin", "phi", quarter).round(9) + 0.0
    array([ 0.   , -0.001,  0.   ])
    """
    sign, axes = ATTITUDE_ERRORS[one_of(source, ATTITUDE_ERRORS, "source")]
    other_sign, other_axes = ATTITUDE_ERRORS[one_of(target, ATTITUDE_ERRORS, "target")]
    if axes == other_axes:
        return sign * other_sign * finite_array(error, "error", 3) + 0.0
    if true_attitude is None:
        raise ValueError(
            f"true_attitude: expected quaternions, as {source!r} and {target!r} have different "
            "axes, got None."
        )
    error, _ = finite_arrays(error=(error, 3), true_attitude=(true_attitude, 4))
    turn = unit_quaternions(true_attitude, "true_attitude")
    return sign * other_sign * rotate(turn if axes == "body" else conjugate(turn), error)


def position_angle(
    latitude: ArrayLike, latitude_error: ArrayLike, longitude_error: ArrayLike
) -> FloatArray:
    """Small rotation δθ from the true local axes to those at the computed position.

    Parameters
    ----------
    latitude : array_like, shape (...)
        rad, not a pole.
    latitude_error, longitude_error : array_like, shape (...)
        Computed minus true, rad.

    Returns
    -------
    ndarray, shape (..., 3)
        In East, North, Up, rad.

    Notes
    -----
    The psi-angle model counts the attitude error from the local axes at the *computed* position,
    the phi-angle model from those at the true one. So ψ = φ - δθ, with φ the error ``phi`` of
    `ATTITUDE_ERRORS`. Papers with the other sign of ψ exist; look at the sign of their gyro error.

    Examples
    --------
    A level unit whose computed position is a mile too far North has φ = 0, and a ψ of a minute of
    arc about East:

    >>> minute = np.radians(1 / 60)
    >>> psi = np.zeros(3) - position_angle(0.8, minute, 0.0)
    >>> np.degrees(60 * psi).round(9)
    array([1., 0., 0.])
    """
    place, north, east = finite_arrays(
        latitude=(latitude,),
        latitude_error=(latitude_error,),
        longitude_error=(longitude_error,),
    )
    checked_latitude(place)
    return np.stack(
        np.broadcast_arrays(-north, east * np.cos(place), east * np.sin(place)), axis=-1
    )


def mirror_heading(heading: ArrayLike) -> FloatArray:
    """Heading to the East of one that is counted to the West, and the other way about.

    Parameters
    ----------
    heading : array_like, shape (...)
        Angle from North, rad; also a heading error, which has the same two signs.

    Returns
    -------
    ndarray, shape (...)
        The angle with the other sign, from -pi to pi.

    Examples
    --------
    A compass card shows 30 degrees; Part IV of the book calls that -30:

    >>> print(f"{np.degrees(mirror_heading(np.radians(30))):.1f}")
    -30.0
    """
    return wrap_angle(-finite_array(heading, "heading")) + 0.0


def scalar_first(quaternion: ArrayLike) -> FloatArray:
    """Quaternion with the scalar part first, from one with the scalar part last.

    Parameters
    ----------
    quaternion : array_like or Rotation, shape (..., 4)

    Returns
    -------
    ndarray, shape (..., 4)

    Examples
    --------
    >>> scalar_first([0.1, 0.2, 0.3, 0.9])
    array([0.9, 0.1, 0.2, 0.3])
    """
    return np.roll(finite_array(quaternion, "quaternion", 4), 1, axis=-1)


def scalar_last(quaternion: ArrayLike) -> FloatArray:
    """Quaternion with the scalar part last, from one with the scalar part first.

    Parameters
    ----------
    quaternion : array_like, shape (..., 4)
        Not a `Rotation`, whose own order is fixed.

    Returns
    -------
    ndarray, shape (..., 4)

    Examples
    --------
    >>> scalar_last([0.9, 0.1, 0.2, 0.3])
    array([0.1, 0.2, 0.3, 0.9])
    """
    if hasattr(quaternion, "as_quat"):
        raise ValueError("quaternion: expected numbers, scalar first, got a Rotation.")
    return np.roll(finite_array(quaternion, "quaternion", 4), -1, axis=-1)
