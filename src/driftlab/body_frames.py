"""Choice of body axes for a unit with two non-orthogonal triads; Wu et al., section 2.3.

The body axes can be chosen so that one of the two triads has no misalignment, because a rotation of
the axes changes the misalignment of both triads by the same amount. What is
left between these axes and those of the vehicle is the unit's boresight or mounting error.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .checks import FloatArray, finite_array, finite_arrays, one_of

GYRO_FRAMES = ("averaged", "upper triangle", "lower triangle")
"""Those of `BODY_FRAMES` that the gyros fix."""
_ACCELEROMETER_FRAMES = ("accelerometers", "averaged accelerometers")
"""Those that the accelerometers fix."""
BODY_FRAMES = (*GYRO_FRAMES, *_ACCELEROMETER_FRAMES)
"""Ways to fix the body axes.

``averaged``: the gyro triad has no misalignment; the choice of Wu et al.
``upper triangle``: the gyros' K is zero above the diagonal. Axis x lies along the x gyro, and the
y gyro in the plane of x and y. The paper's introduction and Fig. 2 call it the usual choice.
``lower triangle``: zero below. Axis z lies along the z gyro, the y gyro in the plane of y and z;
the paper's section 3 describes the usual choice so.
``accelerometers``: as `upper triangle`, of the accelerometers.
``averaged accelerometers``: as `averaged`, of the accelerometers; the other of the two skew parts
of which the paper says that one must be zero.
"""
_SYMMETRIC = ("averaged", "averaged accelerometers")
"""Those in which the matrix that fixes them has no skew part."""


def misalignment_vector(
    gyro_error_matrix: ArrayLike,
    accelerometer_error_matrix: ArrayLike | None = None,
    frame: str = "averaged",
) -> FloatArray:
    r"""Small rotation that brings body components into the chosen body axes, to first order.

    Parameters
    ----------
    gyro_error_matrix : array_like, shape (..., 3, 3)
        Error matrix K of the gyro triad.
    accelerometer_error_matrix : array_like, shape (..., 3, 3), optional
        Error matrix of the accelerometer triad; needed only for the axes that it fixes.
    frame : str
        One of `BODY_FRAMES`.

    Returns
    -------
    ndarray, shape (..., 3)
        Rotation vector of the *components*, rad. The axes themselves turn the other way: if two
        gyros are both rotated by +theta in their plane, it is -theta.

    Notes
    -----
    Subtracting its cross-product matrix from both error matrices changes the axes; Wu et al., (40)
    and (42). For the averaged axes it is the vector of the skew part:

    .. math:: \tfrac12 (K_{zy} - K_{yz},\ K_{xz} - K_{zx},\ K_{yx} - K_{xy}).

    Examples
    --------
    >>> gyro_error_matrix = [[0, 0, 0], [4e-3, 0, 0], [0, 0, 0]]  # the y gyro leans towards x
    >>> misalignment_vector(gyro_error_matrix)
    array([0.   , 0.   , 0.002])
    >>> float(misalignment_vector(gyro_error_matrix, frame="lower triangle")[2])
    0.004
    """
    k = _matrix_for(gyro_error_matrix, accelerometer_error_matrix, frame)
    upper = np.stack([-k[..., 1, 2], k[..., 0, 2], -k[..., 0, 1]], axis=-1)
    lower = np.stack([k[..., 2, 1], -k[..., 2, 0], k[..., 1, 0]], axis=-1)
    if frame in _SYMMETRIC:
        return 0.5 * upper + 0.5 * lower
    return lower if frame == "lower triangle" else upper


def body_frame_rotation(
    gyro_error_matrix: ArrayLike,
    accelerometer_error_matrix: ArrayLike | None = None,
    frame: str = "averaged",
) -> FloatArray:
    """Matrix from the given body components to those of the chosen axes, exactly.

    Parameters
    ----------
    gyro_error_matrix : array_like, shape (..., 3, 3)
        Error matrix K of the gyro triad.
    accelerometer_error_matrix : array_like, shape (..., 3, 3), optional
        Error matrix of the accelerometer triad; needed only for the axes that it fixes.
    frame : str
        One of `BODY_FRAMES`.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        Rotation matrix R, equal to that of `misalignment_vector` up to terms of second order. In
        the new axes (I + K) R^T is symmetric if they are averaged, else triangular with a positive
        diagonal.

    Raises
    ------
    ValueError
        If the triad is left-handed or its axes lie in one plane.

    Examples
    --------
    Every choice of axes finds the rotation of an orthogonal triad that is turned as a whole:

    >>> from driftlab.quaternion import from_rotation_vector, to_matrix
    >>> rotation = to_matrix(from_rotation_vector([0.01, 0.02, 0.03]))
    >>> np.allclose(body_frame_rotation(rotation - np.eye(3), frame="lower triangle"), rotation)
    True
    """
    name = "accelerometer_error_matrix" if frame in _ACCELEROMETER_FRAMES else "gyro_error_matrix"
    matrix = _matrix_for(gyro_error_matrix, accelerometer_error_matrix, frame)
    triad = np.eye(3) + matrix
    if not (np.linalg.det(triad) > 1e-12).all():
        raise ValueError(
            f"{name}: expected a right-handed triad I + K, got a left-handed or a flat one."
        )
    if frame in _SYMMETRIC:  # a polar decomposition
        left, _, right = np.linalg.svd(triad)
        return left @ right
    # Zero below the diagonal is zero above it with the axes counted backwards.
    order = np.s_[::-1] if frame == "lower triangle" else np.s_[:]
    columns, rest = np.linalg.qr(np.swapaxes(triad[..., order, :], -1, -2))
    signs = np.sign(np.einsum("...ii->...i", rest))
    rows = np.swapaxes(columns * signs[..., np.newaxis, :], -1, -2)
    return rows[..., order, :]


def change_body_frame(matrix: ArrayLike, rotation: ArrayLike) -> FloatArray:
    """Error matrix of the same triad in other body axes, exactly.

    Parameters
    ----------
    matrix : array_like, shape (..., 3, 3)
        Error matrix K in the given axes.
    rotation : array_like, shape (..., 3, 3)
        Rotation matrix R from the given body components to those of the new axes.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        (I + K) R^T - I.

    Examples
    --------
    In the averaged axes a triad has no misalignment:

    >>> matrix = [[0, 0, 0], [4e-3, 0, 0], [0, 0, 0]]
    >>> averaged = change_body_frame(matrix, body_frame_rotation(matrix))
    >>> averaged[0, 1].round(5), averaged[1, 0].round(5)
    (np.float64(0.002), np.float64(0.002))
    """
    matrix, rotation = finite_arrays(matrix=(matrix, 3, 3), rotation=(rotation, 3, 3))
    return (np.eye(3) + matrix) @ np.swapaxes(rotation, -1, -2) - np.eye(3)


def _matrix_for(
    gyro_error_matrix: ArrayLike, accelerometer_error_matrix: ArrayLike | None, frame: str
) -> FloatArray:
    """Return the matrix that fixes the frame."""
    one_of(frame, BODY_FRAMES, "frame")
    gyro_error_matrix = finite_array(gyro_error_matrix, "gyro_error_matrix", 3, 3)
    if accelerometer_error_matrix is not None:
        accelerometer_error_matrix = finite_array(
            accelerometer_error_matrix, "accelerometer_error_matrix", 3, 3
        )
    if frame not in _ACCELEROMETER_FRAMES:
        return gyro_error_matrix
    if accelerometer_error_matrix is None:
        raise ValueError(
            "accelerometer_error_matrix: expected the matrix that fixes the axes, got None."
        )
    return accelerometer_error_matrix
