"""Two laboratories measure one unit, which is mounted a little differently in the second."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.body_frames import change_body_frame, misalignment_vector
from driftlab.checks import FloatArray, finite_array
from driftlab.quaternion import from_rotation_vector, rotate
from driftlab.triad import decompose


class TwoLaboratories(NamedTuple):
    """What the second laboratory reports while the unit is turned in its mounting."""

    share: FloatArray  # (m,), part of the bracket's rotation, 0 as in laboratory A, to 1
    gyro_error: FloatArray  # (3, 3), K in laboratory A
    # (3,), by how much the table's axes are turned against those of A in the end, rad
    bracket: FloatArray
    reported: FloatArray  # (m, 3, 3), K of the same gyros in laboratory B
    misalignment: FloatArray  # (m, 3), of `reported`, about x, y, z, rad
    non_orthogonality: FloatArray  # (m, 3), of `reported`, xy, xz, yz, rad
    # (m, 3), by how much the angles of the sensitive axes xy, xz, yz lack of a right angle, rad,
    # exact
    lack_of_square: FloatArray


def two_laboratories(
    gyro_error: ArrayLike, bracket: ArrayLike, moments: int = 181
) -> TwoLaboratories:
    """Turn a unit in its mounting, and measure it all along; Wu (37)-(42)."""
    in_a = finite_array(gyro_error, "gyro_error", 3, 3)
    turned = finite_array(bracket, "bracket", 3)
    share = np.linspace(0.0, 1.0, moments)
    turns = from_rotation_vector(share[:, np.newaxis] * turned)
    axes_of_b = rotate(turns[:, np.newaxis], np.eye(3))
    in_b = change_body_frame(in_a, axes_of_b)
    triad = np.eye(3) + in_b
    triad = triad / np.linalg.norm(triad, axis=-1, keepdims=True)
    pairs = (..., [0, 0, 1], [1, 2, 2])
    return TwoLaboratories(
        share,
        in_a,
        turned,
        in_b,
        misalignment_vector(in_b),
        decompose(in_b).non_orthogonality[pairs],
        np.arcsin((triad @ np.swapaxes(triad, -1, -2))[pairs]),
    )
