"""Error matrix of a sensor triad: its three parts, and the choice of body axes.

A triad with error matrix K measures ``(E + K) w``; Wu et al., sections 2 and 3. Any K is a sum of
three matrices: a diagonal one (scale-factor errors), a symmetric one (non-orthogonality) and a
skew one, the *misalignment*: a small rotation of the triad as a whole. The body axes can be chosen
so that one of the two triads has no misalignment, because a rotation of the axes changes the
misalignment of both triads by the same amount.

Part I calls the whole matrix of a gyro triad its misalignment, as Larin's letters suggest. From
here on whole matrices are `gyro_error` and `accelerometer_error`, and misalignment is one part.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .checks import FloatArray, finite_array, finite_arrays

BODY_FRAMES = ("averaged", "upper triangle", "lower triangle", "accelerometers")
"""Ways to fix the body axes.

``averaged``: the gyro triad has no misalignment; the choice of Wu et al.
``upper triangle``: the gyros' K is zero above the diagonal. Axis x lies along the x gyro, and the
y gyro in the plane of x and y. The paper's introduction and Fig. 2 call it the usual choice.
``lower triangle``: zero below. Axis z lies along the z gyro, the y gyro in the plane of y and z;
the paper's section 3 describes the usual choice so.
``accelerometers``: as `upper triangle`, of the accelerometers.
"""


class InstallationParts(NamedTuple):
    """An error matrix as the sum of three matrices; the result of `split`.

    Attributes
    ----------
    scale : ndarray, shape (..., 3, 3)
        Diagonal part: scale-factor errors, without unit.
    non_orthogonality : ndarray, shape (..., 3, 3)
        Symmetric part with zero diagonal, rad.
    misalignment : ndarray, shape (..., 3, 3)
        Skew part, rad.

    Examples
    --------
    >>> parts = split([[1, 2, 0], [4, 5, 0], [0, 0, 9]])
    >>> parts.non_orthogonality
    array([[0., 3., 0.],
           [3., 0., 0.],
           [0., 0., 0.]])
    """

    scale: FloatArray
    non_orthogonality: FloatArray
    misalignment: FloatArray


def split(matrix: ArrayLike) -> InstallationParts:
    """Decompose an error matrix into scale factors, non-orthogonality and misalignment.

    Parameters
    ----------
    matrix : array_like, shape (..., 3, 3)
        Error matrix K of a triad that measures ``(E + K) w``.

    Returns
    -------
    InstallationParts
        Three matrices, each of shape (..., 3, 3), whose sum is `matrix`.

    Notes
    -----
    Wu et al., (7)-(15).

    Examples
    --------
    >>> parts = split([[1, 2, 0], [4, 5, 0], [0, 0, 9]])
    >>> parts.misalignment
    array([[ 0., -1.,  0.],
           [ 1.,  0.,  0.],
           [ 0.,  0.,  0.]])
    >>> sum(parts)
    array([[1., 2., 0.],
           [4., 5., 0.],
           [0., 0., 9.]])
    """
    matrix = finite_array(matrix, "matrix", 3, 3)
    transposed = np.swapaxes(matrix, -1, -2)
    scale = matrix * np.eye(3)
    return InstallationParts(
        scale, 0.5 * matrix + 0.5 * transposed - scale, 0.5 * matrix - 0.5 * transposed
    )


def misalignment_vector(
    gyro_error: ArrayLike, accelerometer_error: ArrayLike | None = None, frame: str = "averaged"
) -> FloatArray:
    r"""Small rotation that brings body components into the chosen body axes, to first order.

    Parameters
    ----------
    gyro_error : array_like, shape (..., 3, 3)
        Error matrix K of the gyro triad.
    accelerometer_error : array_like, shape (..., 3, 3), optional
        Error matrix of the accelerometer triad; needed for the frame ``accelerometers`` only.
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
    and (42). For ``averaged`` it is the vector of the skew part, the mean of the vectors of the two
    triangles:

    .. math:: \tfrac12 (K_{zy} - K_{yz},\ K_{xz} - K_{zx},\ K_{yx} - K_{xy}).

    Examples
    --------
    >>> gyro_error = [[0, 0, 0], [4e-3, 0, 0], [0, 0, 0]]  # the y gyro leans towards x
    >>> misalignment_vector(gyro_error)
    array([0.   , 0.   , 0.002])
    >>> float(misalignment_vector(gyro_error, frame="lower triangle")[2])
    0.004
    """
    k = _matrix_for(gyro_error, accelerometer_error, frame)
    upper = np.stack([-k[..., 1, 2], k[..., 0, 2], -k[..., 0, 1]], axis=-1)
    lower = np.stack([k[..., 2, 1], -k[..., 2, 0], k[..., 1, 0]], axis=-1)
    if frame == "averaged":
        return 0.5 * upper + 0.5 * lower
    return lower if frame == "lower triangle" else upper


def body_frame_rotation(
    gyro_error: ArrayLike, accelerometer_error: ArrayLike | None = None, frame: str = "averaged"
) -> FloatArray:
    """Matrix from the given body components to those of the chosen axes, exactly.

    Parameters
    ----------
    gyro_error : array_like, shape (..., 3, 3)
        Error matrix K of the gyro triad.
    accelerometer_error : array_like, shape (..., 3, 3), optional
        Error matrix of the accelerometer triad; needed for the frame ``accelerometers`` only.
    frame : str
        One of `BODY_FRAMES`.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        Rotation matrix R, equal to that of `misalignment_vector` up to terms of second order.

    Raises
    ------
    ValueError
        If the triad is left-handed or its axes lie in one plane.

    Notes
    -----
    The matrix (E + K) R^T of the triad in the new axes is symmetric for ``averaged`` (a polar
    decomposition), and triangular with a positive diagonal for the others (a QR decomposition).

    Examples
    --------
    The triad is an orthogonal one, rotated as a whole. Every choice of axes finds this rotation:

    >>> from driftlab.quaternion import from_rotation_vector, to_matrix
    >>> rotation = to_matrix(from_rotation_vector([0.01, 0.02, 0.03]))
    >>> gyro_error = rotation - np.eye(3)
    >>> [np.allclose(body_frame_rotation(gyro_error, gyro_error, frame), rotation)
    ...  for frame in BODY_FRAMES]
    [True, True, True, True]
    """
    name = "accelerometer_error" if frame == "accelerometers" else "gyro_error"
    matrix = _matrix_for(gyro_error, accelerometer_error, frame)
    triad = np.eye(3) + matrix
    if not (np.linalg.det(triad) > 1e-12).all():
        raise ValueError(
            f"{name}: expected a right-handed triad E + K, got a left-handed or a flat one."
        )
    if frame == "averaged":
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
        (E + K) R^T - E.

    Examples
    --------
    In the averaged axes a triad has no misalignment:

    >>> matrix = [[0, 0, 0], [4e-3, 0, 0], [0, 0, 0]]
    >>> averaged = change_body_frame(matrix, body_frame_rotation(matrix))
    >>> np.allclose(split(averaged).misalignment, 0, rtol=0, atol=1e-15)
    True
    >>> float(averaged[0, 1].round(5))
    0.002
    """
    matrix, rotation = finite_arrays(matrix=(matrix, 3, 3), rotation=(rotation, 3, 3))
    return (np.eye(3) + matrix) @ np.swapaxes(rotation, -1, -2) - np.eye(3)


def _matrix_for(
    gyro_error: ArrayLike, accelerometer_error: ArrayLike | None, frame: str
) -> FloatArray:
    """Return the matrix that fixes the frame."""
    if frame not in BODY_FRAMES:
        raise ValueError(f"frame: expected one of {', '.join(BODY_FRAMES)}, got {frame!r}.")
    gyro_error = finite_array(gyro_error, "gyro_error", 3, 3)
    if frame != "accelerometers":
        return gyro_error
    if accelerometer_error is None:
        raise ValueError("accelerometer_error: expected the matrix that fixes the axes, got None.")
    return finite_array(accelerometer_error, "accelerometer_error", 3, 3)


def triad_matrix(misalignment: ArrayLike) -> FloatArray:
    """Matrix A = E + M of a triad, its rows being the sensitive axes; Larin (1.5), (2.4).

    Parameters
    ----------
    misalignment : array_like, shape (..., 3, 3)
        Matrix M of all errors of the triad, without unit.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        A, from true components to measured ones.

    Raises
    ------
    ValueError
        If A is singular: its axes lie in one plane, and the rate across it is never measured.

    Examples
    --------
    >>> triad_matrix([[0, 0.01, 0], [0, 0, 0], [0, 0, 0]])
    array([[1.  , 0.01, 0.  ],
           [0.  , 1.  , 0.  ],
           [0.  , 0.  , 1.  ]])
    """
    triad = np.eye(3) + finite_array(misalignment, "misalignment", 3, 3)
    if (np.linalg.cond(triad) > 1e12).any():
        raise ValueError(
            "misalignment: expected three sensitive axes that span space, "
            "got a singular triad matrix E + M."
        )
    return triad


def measured_rate(rate: ArrayLike, misalignment: ArrayLike) -> FloatArray:
    """Rate that a gyro triad measures, without bias and noise; Larin (1.5).

    Parameters
    ----------
    rate : array_like, shape (..., 3)
        True angular rate in body axes, rad/s.
    misalignment : array_like, shape (..., 3, 3)
        Matrix M of all errors of the triad, without unit.

    Returns
    -------
    ndarray, shape (..., 3)
        (E + M) rate, rad/s.

    Examples
    --------
    The x gyro leans towards the y axis and measures a part of the rate about it:

    >>> measured_rate([0, 2, 0], [[0, 0.01, 0], [0, 0, 0], [0, 0, 0]])
    array([0.02, 2.  , 0.  ])
    """
    rate, misalignment = finite_arrays(rate=(rate, 3), misalignment=(misalignment, 3, 3))
    return np.einsum("...ij,...j->...i", triad_matrix(misalignment), rate)


def non_orthogonality(misalignment: ArrayLike) -> FloatArray:
    """Symmetric part of a misalignment, which alone makes drift to first order; Larin (2.5).

    Parameters
    ----------
    misalignment : array_like, shape (..., 3, 3)
        Matrix M of all errors of the triad, without unit.

    Returns
    -------
    ndarray, shape (..., 3, 3)
        Sigma = (M + M^T)/2, its diagonal included.

    Examples
    --------
    >>> non_orthogonality([[0, 0.02, 0], [0, 0, 0], [0, 0, 0]])
    array([[0.  , 0.01, 0.  ],
           [0.01, 0.  , 0.  ],
           [0.  , 0.  , 0.  ]])
    """
    misalignment = finite_array(misalignment, "misalignment", 3, 3)
    return 0.5 * (misalignment + np.swapaxes(misalignment, -1, -2))


def pairwise_non_orthogonality(axes: ArrayLike) -> FloatArray:
    r"""Non-orthogonality of each pair of sensitive axes; Larin, remark before (2.5).

    Parameters
    ----------
    axes : array_like, shape (..., 3, 3)
        Sensitive axes i_x, i_y, i_z as rows, unit vectors.

    Returns
    -------
    ndarray, shape (..., 3)
        [sigma1, sigma2, sigma3] of the pairs (x, y), (x, z) and (y, z).

    Notes
    -----
    It is half the cosine of the angle between the two axes to first order, and depends on no other
    angle:

    .. math:: \sigma_1 = 1 - |i_x - i_y| / \sqrt 2.

    Examples
    --------
    >>> angle = 0.01  # of the y axis towards the x axis, rad
    >>> axes = [[1, 0, 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]
    >>> pairwise_non_orthogonality(axes).round(4)
    array([0.005, 0.   , 0.   ])
    """
    axes = finite_array(axes, "axes", 3, 3)
    if not np.allclose(np.linalg.norm(axes, axis=-1), 1, rtol=0, atol=1e-9):
        raise ValueError("axes: expected rows of unit length, got rows of another length.")
    pairs = axes[..., [0, 0, 1], :] - axes[..., [1, 2, 2], :]
    return 1 - np.linalg.norm(pairs, axis=-1) / np.sqrt(2)
