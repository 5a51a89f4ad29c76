"""Wu et al., sections 2 and 3: a triad's error matrix taken apart, and the choice of body axes.

A triad with error matrix K measures ``(E + K) w``. Any K is a sum of three: a diagonal (scale
factors), a symmetric rest (non-orthogonality) and a skew part, the *misalignment*: the triad turned
as a whole. Who may choose the body axes may choose the misalignment of one triad, because turning
the axes takes the same rotation from both triads.

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
    """A matrix (..., 3, 3) as the sum of three."""

    scale: FloatArray  # diagonal: scale-factor errors
    non_orthogonality: FloatArray  # symmetric, zero diagonal
    misalignment: FloatArray  # skew


def split(matrix: ArrayLike) -> InstallationParts:
    """Take an error matrix (..., 3, 3) apart; Wu (7)-(15).

    Returns
    -------
    InstallationParts
        scale, non_orthogonality and misalignment, each (..., 3, 3); their sum is `matrix`.
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
    """Small rotation (..., 3) in rad of body *components* into those of the chosen axes.

    The axes themselves turn the other way: for two gyros in a plane that lean by +theta it is
    -theta. To first order. Subtracting its skew matrix from both error matrices is the change of
    axes; Wu (40), (42).

    Parameters
    ----------
    gyro_error, accelerometer_error : array_like, shape (..., 3, 3)
        The latter is needed for the frame ``accelerometers`` only.
    frame : str
        One of `BODY_FRAMES`.

    Notes
    -----
    For ``averaged`` it is the vector of the skew part, (K_zy - K_yz, K_xz - K_zx, K_yx - K_xy)/2:
    the mean of what the two triangles ask for.
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
    """Matrix (..., 3, 3) from given body components to those of the chosen axes, exactly.

    Arguments as for `misalignment_vector`, whose rotation this is up to second order. The triad
    matrix E + K times the transpose of the result is symmetric (a polar decomposition) or
    triangular with a positive diagonal (a QR decomposition).

    Raises
    ------
    ValueError
        If the triad is left-handed or its axes lie in one plane.
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
    """Error matrix (..., 3, 3) of the same triad in other body axes: (E + K) R^T - E, exactly.

    Parameters
    ----------
    matrix : array_like, shape (..., 3, 3)
        K in the given axes.
    rotation : array_like, shape (..., 3, 3)
        R, from given body components to those of the new axes.
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
    """A = E + M (..., 3, 3), rows the sensitive axes; Larin (1.5), (2.4).

    Raises
    ------
    ValueError
        If A is singular: its axes lie in one plane, and the rate across it is never measured.
    """
    triad = np.eye(3) + finite_array(misalignment, "misalignment", 3, 3)
    if (np.linalg.cond(triad) > 1e12).any():
        raise ValueError(
            "misalignment: expected three sensitive axes that span space, "
            "got a singular triad matrix E + M."
        )
    return triad


def measured_rate(rate: ArrayLike, misalignment: ArrayLike) -> FloatArray:
    """What the triad says (..., 3) of a true `rate` (..., 3), both in rad/s; Larin (1.5)."""
    rate, misalignment = finite_arrays(rate=(rate, 3), misalignment=(misalignment, 3, 3))
    return np.einsum("...ij,...j->...i", triad_matrix(misalignment), rate)


def non_orthogonality(misalignment: ArrayLike) -> FloatArray:
    """Sigma = (M + M^T)/2 (..., 3, 3), all of M that drifts to first order; Larin (2.5)."""
    misalignment = finite_array(misalignment, "misalignment", 3, 3)
    return 0.5 * (misalignment + np.swapaxes(misalignment, -1, -2))


def pairwise_non_orthogonality(axes: ArrayLike) -> FloatArray:
    """[sigma1, sigma2, sigma3] (..., 3) of three sensitive axes; Larin, remark before (2.5).

    Parameters
    ----------
    axes : array_like, shape (..., 3, 3)
        Rows i_x, i_y, i_z, unit vectors.

    Notes
    -----
    sigma1 = 1 - |i_x - i_y|/sqrt(2), and so on for (x, z) and (y, z). It equals half the cosine of
    the angle between the two axes to first order, and sees nothing but that angle.
    """
    axes = finite_array(axes, "axes", 3, 3)
    if not np.allclose(np.linalg.norm(axes, axis=-1), 1, rtol=0, atol=1e-9):
        raise ValueError("axes: expected rows of unit length, got rows of another length.")
    pairs = axes[..., [0, 0, 1], :] - axes[..., [1, 2, 2], :]
    return 1 - np.linalg.norm(pairs, axis=-1) / np.sqrt(2)
