"""Two laboratories measure one unit, which is mounted a little differently in the second."""

import numpy as np
from numpy.typing import ArrayLike

from driftlab.body_frames import change_body_frame, misalignment_vector
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import finite_array
from driftlab.quaternion import from_rotation_vector, rotate
from driftlab.triad import split_error_matrix


def two_laboratories(
    gyro_error_matrix: ArrayLike, bracket: ArrayLike, moments: int = 181
) -> DataTable:
    """Turn a unit in its mounting, and measure it all along; Wu (37)-(42)."""
    in_a = finite_array(gyro_error_matrix, "gyro_error_matrix", 3, 3)
    turned = finite_array(bracket, "bracket", 3)
    share = np.linspace(0.0, 1.0, moments)
    turns = from_rotation_vector(share[:, np.newaxis] * turned)
    axes_of_b = rotate(turns[:, np.newaxis], np.eye(3))
    in_b = change_body_frame(in_a, axes_of_b)
    triad = np.eye(3) + in_b
    triad = triad / np.linalg.norm(triad, axis=-1, keepdims=True)
    pairs = (..., [0, 0, 1], [1, 2, 2])
    return DataTable(
        {
            "share": (share, "", "part of the bracket's rotation, 0 as in laboratory A, to 1"),
            "misalignment": (misalignment_vector(in_b), "arcsec", "of the report, about x, y, z"),
            "non_orthogonality": (split_error_matrix(in_b).non_orthogonality[pairs], "arcsec",
                                  "of the report, xy, xz, yz"),
            "lack_of_square": (np.arcsin((triad @ np.swapaxes(triad, -1, -2))[pairs]), "arcsec",
                               "of the sensitive axes xy, xz, yz, exact"),
        },
        {
            "gyro_error_matrix": (in_a, "", "error matrix K in laboratory A"),
            "bracket": (turned, "arcsec", "rotation of the table's axes against those of A"),
            "reported": (in_b, "", "error matrices K in laboratory B"),
        },
    )  # fmt: skip
