"""The error over turns, what part of M drifts, and about which axis."""

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import LARIN_TRIAD, OBLIQUE_AXIS, SKEW, SYMMETRIC
from driftlab.checks import FloatArray, finite_array, nonzero_vectors, positive_number, whole_number
from driftlab.drift.error_kinematics import error_quaternion
from driftlab.drift.systematic_drift import (
    drift_coefficient,
    drift_per_revolution,
    principal_drifts,
)
from driftlab.quaternion import to_rotation_vector
from driftlab.triad import measured_rate
from driftlab.vectors import direction_from_angles

TURNS = 5
"""Whole turns of a drift history."""
LARGEST_ENTRY = 2e-3
"""Largest entry of a triad error that the panel offers, and that its picture has room for."""
EXAGGERATION = 150
"""The triad is shown with its error this many times too large."""
DIAGONAL: FloatArray = np.ones(3) / np.sqrt(3)
ACROSS: FloatArray = np.array([1.0, -1, 0]) / np.sqrt(2)


def drift_history(
    error_matrix: ArrayLike = LARGEST_ENTRY * SYMMETRIC,
    direction: ArrayLike = OBLIQUE_AXIS,
    samples_per_turn: int = 60,
    turns: int = TURNS,
    exaggeration: float = EXAGGERATION,
) -> DataTable:
    """Error of a bent triad over some turns at a constant rate, exact; Larin (2.3)."""
    samples = whole_number(samples_per_turn, "samples_per_turn")
    count = whole_number(turns, "turns")
    factor = positive_number(exaggeration, "exaggeration")
    n, _ = nonzero_vectors(direction, "direction")
    error_matrix = finite_array(error_matrix, "error_matrix", 3, 3)
    measured = measured_rate(n, error_matrix)
    # At unit rate, one turn takes 2 pi seconds.
    time = 2 * np.pi * np.arange(count * samples + 1) / samples
    error = to_rotation_vector(error_quaternion(n, measured, time))
    coefficients, axes = principal_drifts(error_matrix, exact=True)
    worst = np.abs(coefficients).argmax()
    along = error @ n
    across = np.linalg.norm(error - along[:, np.newaxis] * n, axis=-1)
    whole_turns = np.arange(count + 1.0)
    per_turn = float(2 * np.pi * drift_coefficient(n, error_matrix))
    return DataTable(
        {
            "turns": (time / (2 * np.pi), "", "how far the body has turned"),
            "along": (along, "deg", "error along the axis of the turns"),
            "across": (across, "arcmin", "size of the error across it"),
            "whole_turns": (whole_turns, "", "counted from 0"),
            "first_order": (per_turn * whole_turns, "deg", "error along the axis, to first order"),
        },
        {
            "error": (error, "rad", "rotation vector from R to B"),
            "direction": (n, "", "unit axis of the turns"),
            "samples_per_turn": (samples, "", "rows in one turn"),
            "triad": (np.eye(3) + factor * error_matrix, "", "sensitive axes as rows, exaggerated"),
            "exaggeration": (factor, "", "exaggeration of the triad"),
            "exact_per_turn": (
                float(drift_per_revolution(n, error_matrix)), "arcmin", "drift in one turn"
            ),
            "first_order_per_turn": (per_turn, "arcmin", "to first order"),
            "worst_per_turn": (
                float(2 * np.pi * coefficients[worst]), "arcmin", "about the worst axis"
            ),
            "worst_axis": (axes[worst], "", "unit axis with the largest drift in size"),
        },
    )  # fmt: skip


def drift_by_symmetry(
    mixed_size: float = 1e-3,
    symmetric: ArrayLike = SYMMETRIC,
    skew: ArrayLike = SKEW,
    symmetric_axis: ArrayLike = DIAGONAL,
    skew_axis: ArrayLike = ACROSS,
) -> DataTable:
    """Exact drift a turn against the size of either part, and of mixtures of one size.

    Only the symmetric part drifts to first order; Larin, remark after (2.4).
    """
    size = positive_number(mixed_size, "mixed_size")
    even = finite_array(symmetric, "symmetric", 3, 3)
    odd = finite_array(skew, "skew", 3, 3)
    for name, matrix, sign in (("symmetric", even, 1), ("skew", odd, -1)):
        if not np.allclose(matrix, sign * matrix.T):
            raise ValueError(f"{name}: expected a {name} matrix, got {matrix.tolist()!r}.")
    along, _ = nonzero_vectors(symmetric_axis, "symmetric_axis")
    across, _ = nonzero_vectors(skew_axis, "skew_axis")
    sizes = np.geomspace(1e-6, 1e-1, 41)
    mixing = np.linspace(0, np.pi, 73)
    cosine, sine = np.cos(mixing)[:, None, None], np.sin(mixing)[:, None, None]
    mixture = size * (cosine * even + sine * odd)
    return DataTable(
        {
            "sizes": (sizes, "", "size of the deformation"),
            "symmetric": (
                np.abs(drift_per_revolution(along, sizes[:, None, None] * even)), "rad",
                "drift per turn of the symmetric one about its axis, without sign",
            ),
            "skew": (
                np.abs(drift_per_revolution(across, sizes[:, None, None] * odd)), "rad",
                "drift per turn of the skew one",
            ),
            "mixing": (mixing, "deg", "angle, from the symmetric one to the skew one and on"),
            "mixed_per_size": (
                drift_per_revolution(along, mixture) / size, "",
                "drift per turn, rad, about the axis of the symmetric one, divided by the size",
            ),
            "first_order_per_size": (
                2 * np.pi * drift_coefficient(along, mixture) / size, "", "the same to first order"
            ),
        },
        {"mixed_size": (size, "", "size of the mixture")},
    )  # fmt: skip


def drift_map(error_matrix: ArrayLike = LARIN_TRIAD) -> DataTable:
    """Drift coefficient for every axis of rotation, and its extremes; Larin (2.2), before (2.6)."""
    azimuth, elevation = np.meshgrid(
        np.radians(np.linspace(-180, 180, 121)), np.radians(np.linspace(-90, 90, 61))
    )
    coefficient = drift_coefficient(direction_from_angles(azimuth, elevation), error_matrix)
    principal, axes = principal_drifts(error_matrix)
    x, y, z = np.stack([axes, -axes], axis=1).reshape(-1, 3).T
    return DataTable(
        {
            "azimuth": (azimuth.ravel(), "deg", "of the axis of rotation"),
            "elevation": (elevation.ravel(), "deg", "of the axis of rotation"),
            "drift_coefficient": (coefficient.ravel(), "1e-3", "drift rate divided by turn rate"),
            "principal_azimuth": (np.arctan2(y, x), "deg", "of both ends of each principal axis"),
            "principal_elevation": (np.arcsin(z), "deg", "of the same"),
            "principal_coefficient": (np.repeat(principal, 2), "1e-3", "of the same, rising"),
        },
        {"axes": (axes, "", "unit principal axes as rows")},
    )
