"""Vectors, matrices and attitudes in the axes that other books and other instruments use.

Axes are named by three letters, the directions of the first, second and third axis. Local axes are
made of N, E, S, W (the compass) with U and D (up, down); body axes of F, B, R, L (forward, back,
right, left) with U and D. So ``"ENU"`` is East, North, Up, and ``"FRD"`` forward, right, down. Two
axes must not share a line, and the three must be right-handed.

This package has ENU in chapters 01 to 11, and NUE with body axes FUR in Part IV. Most logs and most
textbooks have NED with FRD, Chinese ones ENU with RFU, and robots ENU with FLU. Nothing in the
numbers of a log says which: `align`, fed with FRD for FUR, answers with a roll of a quarter turn
and without a word. Convert first.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from .checks import FloatArray, finite_array, shown, unit_quaternions
from .core.quaternion import conjugate, multiply

_LOCAL = {"E": (1, 0, 0), "N": (0, 1, 0), "U": (0, 0, 1), "W": (-1, 0, 0), "S": (0, -1, 0)}
_BODY = {"F": (1, 0, 0), "L": (0, 1, 0), "U": (0, 0, 1), "B": (-1, 0, 0), "R": (0, -1, 0)}
_KINDS = {"local": _LOCAL | {"D": (0, 0, -1)}, "body": _BODY | {"D": (0, 0, -1)}}
_EXAMPLES = {"local": "local axes such as 'NED' or 'ENU'", "body": "body axes such as 'FRD'"}


def _axes_rotation(from_axes: str, to_axes: str) -> FloatArray:
    """Matrix (3, 3) of 0, 1 and -1, from components in some axes to components in others."""
    kind, given = _directions(from_axes, "from_axes")
    other, wanted = _directions(to_axes, "to_axes")
    if kind != other:
        raise ValueError(
            f"to_axes: expected {_EXAMPLES[kind]}, as from_axes are {kind} axes, "
            f"got {shown(to_axes)}."
        )
    return wanted @ given.T


def convert_vectors(vectors: ArrayLike, from_axes: str, to_axes: str) -> FloatArray:
    """Components of vectors in other axes: rates, forces, increments, small rotations.

    Parameters
    ----------
    vectors : array_like, shape (..., 3)
        In any unit.
    from_axes, to_axes : str
        Three letters each; both local or both body axes.

    Returns
    -------
    ndarray, shape (..., 3)
        In the same unit.

    Raises
    ------
    ValueError
        If letters are unknown, two of them share a line, the axes are left-handed, or one argument
        names local axes and the other body axes.

    See Also
    --------
    convert_matrix : Error matrices in other axes.
    convert_attitude : Attitudes between other axes.

    Examples
    --------
    The rows of a log in forward, right, down, made ready for `align`; at rest the specific force
    points up:

    >>> convert_vectors([[0.0, 0.0, -9.8], [0.1, 0.2, -9.8]], "FRD", "FUR")
    array([[0. , 9.8, 0. ],
           [0.1, 9.8, 0.2]])
    """
    # Adding zero makes the minus zeros of a changed sign plain ones.
    return finite_array(vectors, "vectors", 3) @ _axes_rotation(from_axes, to_axes).T + 0.0


def convert_matrix(matrix: ArrayLike, from_axes: str, to_axes: str) -> FloatArray:
    """Matrix that maps vectors to vectors in the same axes, in other axes.

    Parameters
    ----------
    matrix : array_like, shape (..., 3, 3)
        An error matrix of a triad, with a sensor along each axis, or a covariance of a vector.
    from_axes, to_axes : str
        As in `convert_vectors`.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        The same map; for a triad the sensors are counted, and their signs taken, along the new
        axes.

    Examples
    --------
    The gyro along "right" feels a little of a rate about "forward". It keeps doing so:

    >>> cross_coupling = [[0, 0, 0], [1e-3, 0, 0], [0, 0, 0]]
    >>> convert_matrix(cross_coupling, "FRD", "FUR")
    array([[0.   , 0.   , 0.   ],
           [0.   , 0.   , 0.   ],
           [0.001, 0.   , 0.   ]])
    """
    rotation = _axes_rotation(from_axes, to_axes)
    return rotation @ finite_array(matrix, "matrix", 3, 3) @ rotation.T + 0.0


def convert_attitude(
    attitude: ArrayLike,
    reference: tuple[str, str] | None = None,
    body: tuple[str, str] | None = None,
) -> FloatArray:
    """Attitude of the same body between other reference axes, other body axes, or both.

    Parameters
    ----------
    attitude : array_like or Rotation, shape (..., 4)
        Quaternions, scalar last, body to reference; they need not be of unit norm.
    reference : tuple of str, optional
        Reference axes as they are and as they shall be, as ``("NED", "NUE")``; left alone if not
        given.
    body : tuple of str, optional
        The same of the body axes, as ``("FRD", "FUR")``.

    Returns
    -------
    ndarray, shape (..., 4)
        Unit quaternions, body to reference in the new axes. The quaternion q and its negative are
        one attitude; which of them comes out is not promised.

    See Also
    --------
    driftlab.conventions.scalar_first : Quaternions in the other order.

    Examples
    --------
    A ship's log has a yaw of 30 degrees to the East, pitch and roll, in NED and FRD. Part IV counts
    its heading to the West; pitch and roll are the same in both:

    >>> from driftlab.frames import to_euler_angles
    >>> log = Rotation.from_euler("ZYX", [30, 5, -2], degrees=True).as_quat()
    >>> attitude = convert_attitude(log, ("NED", "NUE"), ("FRD", "FUR"))
    >>> np.degrees(to_euler_angles(attitude)).round(9)
    array([-30.,   5.,  -2.])
    """
    turned = unit_quaternions(attitude, "attitude")
    if reference is not None:
        turned = multiply(_quaternion(reference, "reference"), turned)
    if body is not None:
        turned = multiply(turned, conjugate(_quaternion(body, "body")))
    return turned


def _quaternion(pair: tuple[str, str], name: str) -> FloatArray:
    """Quaternion of `_axes_rotation` for a pair of names."""
    try:
        old, new = pair
    except (TypeError, ValueError):
        raise ValueError(
            f"{name}: expected a pair of axes, old and new, got {shown(pair)}."
        ) from None
    wanted = {"reference": "local", "body": "body"}[name]
    for axes in (old, new):
        kind, _ = _directions(axes, name)
        if kind != wanted:
            raise ValueError(f"{name}: expected {_EXAMPLES[wanted]}, got {shown(axes)}.")
    return Rotation.from_matrix(_axes_rotation(old, new)).as_quat()


def checked_axes(axes: str, name: str, kind: str | None = None) -> str:
    """Return the name of axes, such as "NED", which must be of `kind` if one is given."""
    found, _ = _directions(axes, name)
    if kind is not None and found != kind:
        raise ValueError(
            f"{name}: expected {_EXAMPLES[kind]}, got {shown(axes)}, which are {found} axes."
        )
    return axes


def _directions(axes: str, name: str) -> tuple[str, FloatArray]:
    """Kind of axes, and their directions as rows."""
    if not isinstance(axes, str):
        axes = shown(axes)  # no three letters, so refused
    return _directions_of_letters(axes, name)


@cache
def _directions_of_letters(axes: str, name: str) -> tuple[str, FloatArray]:
    for kind, letters in _KINDS.items():
        if len(axes) == 3 and set(axes) <= letters.keys():
            rows = np.array([letters[letter] for letter in axes], float)
            handedness = np.linalg.det(rows)
            if handedness < -0.5:
                raise ValueError(
                    f"{name}: expected right-handed axes, got {shown(axes)}, which are left-handed."
                )
            if handedness > 0.5:
                rows.setflags(write=False)
                return kind, rows
    if not axes:
        got = "none: of a log, say axes= when it is read."
    elif len(axes) == 3 and axes != axes.upper():
        got = f"{shown(axes)}: in capitals, please."
    else:
        got = f"{shown(axes)}."
    raise ValueError(
        f"{name}: expected three letters for three perpendicular directions, as 'NED', 'ENU', "
        f"'FRD' or 'FLU', got {got}"
    )
