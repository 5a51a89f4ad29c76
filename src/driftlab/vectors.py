"""Vectors of three components, and angles."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .checks import FloatArray, finite_array, finite_arrays
from .core import vectors as core


def cross_matrix(vector: ArrayLike) -> FloatArray:
    """Skew matrix of the cross product: ``cross_matrix(a) @ b`` is a×b.

    Parameters
    ----------
    vector : array_like, shape (..., 3)

    Returns
    -------
    ndarray, shape (..., 3, 3)

    Examples
    --------
    >>> cross_matrix([1, 0, 0]) @ [0, 1, 0]
    array([0., 0., 1.])
    """
    return core.cross_matrix(finite_array(vector, "vector", 3))


def direction_from_angles(azimuth: ArrayLike, elevation: ArrayLike) -> FloatArray:
    """Unit vector from its azimuth and elevation.

    Parameters
    ----------
    azimuth : array_like, shape (...)
        Angle about axis 3, counted from axis 1, rad.
    elevation : array_like, shape (...)
        Angle above the plane of axes 1 and 2, rad.

    Returns
    -------
    ndarray, shape (..., 3)

    Examples
    --------
    >>> direction_from_angles(0.0, np.pi / 6).round(3)
    array([0.866, 0.   , 0.5  ])
    """
    azimuth, elevation = np.broadcast_arrays(
        *finite_arrays(azimuth=(azimuth,), elevation=(elevation,))
    )
    level = np.cos(elevation)
    return np.stack([level * np.cos(azimuth), level * np.sin(azimuth), np.sin(elevation)], axis=-1)


def wrap_angle(angle: ArrayLike) -> FloatArray:
    """Angles brought to -pi to pi.

    Parameters
    ----------
    angle : array_like, shape (...)
        rad.

    Returns
    -------
    ndarray, shape (...)

    Examples
    --------
    >>> wrap_angle([0.0, 6.0, -4.0]).round(4)
    array([ 0.    , -0.2832,  2.2832])
    """
    return core.wrap_angle(finite_array(angle, "angle"))
