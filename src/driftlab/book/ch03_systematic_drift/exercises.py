"""Exercises of chapter 03: the systematic drift."""

import itertools
from collections.abc import Mapping
from typing import Any

import numpy as np

from driftlab.book.machinery.exercise.answers import Choice, Value
from driftlab.book.machinery.exercise.exercise import Exercise
from driftlab.book.machinery.exercise.formulas import Formula
from driftlab.book.machinery.exercise.given_numbers import GivenNumbers
from driftlab.book.machinery.exercise.reading import SettingError
from driftlab.book.scenarios import LARIN_TRIAD
from driftlab.checks import FloatArray
from driftlab.drift.systematic_drift import (
    drift_coefficient,
    drift_per_revolution,
    principal_drifts,
)
from driftlab.drift.weighing_designs import PAIR_AXES
from driftlab.quaternion import from_rotation_vector, multiply, to_rotation_vector
from driftlab.triad import measured_rate
from driftlab.vectors import direction_from_angles

from .experiments import DIAGONAL, LARGEST_ENTRY, TURNS

OPPOSITE_SCALES = np.diag([1.0, -1, 0])
AXES = np.array([[1.0, 0, 0], [-1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0], [1, 0, 1]])
REACH = LARGEST_ENTRY * np.ones((3, 3))
"""All nine sliders of the panel at their upper ends."""
LOOPS = PAIR_AXES[1:]


def _by_first_powers() -> FloatArray:
    unit = AXES / np.linalg.norm(AXES, axis=1, keepdims=True)
    return (unit @ OPPOSITE_SCALES).sum(axis=1)


def _arcmin(angle: Any) -> Any:
    return 60 * np.degrees(angle)


def _loops(
    error_matrix: FloatArray, first: FloatArray = LOOPS[0], second: FloatArray = LOOPS[1]
) -> FloatArray:
    """Rotation vector from R to B after one loop about each axis, arc minutes."""
    apparent = [
        from_rotation_vector(2 * np.pi * measured_rate(axis, error_matrix))
        for axis in (first, second)
    ]
    return _arcmin(to_rotation_vector(multiply(*apparent)))


def _loops_added(error_matrix: FloatArray) -> FloatArray:
    """The same if the rotation vectors of the two loops could be added."""
    measured = measured_rate(LOOPS, error_matrix)
    directions = measured / np.linalg.norm(measured, axis=1, keepdims=True)
    return _arcmin(drift_per_revolution(LOOPS, error_matrix) @ directions)


def _largest_drift(symmetric: FloatArray) -> float:
    """Angle a turn from what stands for Sigma."""
    return float(2 * np.pi * np.linalg.eigvalsh(symmetric)[-1])


def _shown(values: Mapping[str, Any]) -> float:
    """Drift a turn, in arc minutes, of a panel that is set to the axis of the exercise."""
    if (values["azimuth"], values["elevation"]) != (45.0, 35.0):
        raise SettingError("Set the azimuth to 45 degrees and the elevation to 35.")
    places = itertools.product((1, 2, 3), repeat=2)
    error_matrix = 1e-3 * np.reshape([values[f"m{i}{j}"] for i, j in places], (3, 3))
    axis = direction_from_angles(*np.radians([45.0, 35.0]))
    return float(_arcmin(drift_per_revolution(axis, error_matrix)))


EXERCISES: dict[str, Exercise] = {
    "3.1": Value(
        kind="predict",
        right=lambda: drift_coefficient(AXES, OPPOSITE_SCALES),
        absolute=0.01,
        mistakes={
            "That would be right as a plain number; give thousandths.": (
                lambda: 1e-3 * drift_coefficient(AXES, OPPOSITE_SCALES)
            ),
            "The second axis is the first, turned the other way. Does the apparent frame then run "
            "ahead of the turn, or lag behind it?": (
                lambda: np.where(AXES[:, 0] < 0, -1, 1) * drift_coefficient(AXES, OPPOSITE_SCALES)
            ),
            "The components of the axis enter with their first power here. Each is in the "
            "coefficient twice, on the left and on the right of M.": _by_first_powers,
            "That is the size of the whole rate error Mn. Only its part along the axis drifts, and "
            "that part has a sign.": (
                lambda: (
                    np.linalg.norm(AXES @ OPPOSITE_SCALES, axis=1) / np.linalg.norm(AXES, axis=1)
                )
            ),
            "An axis is a unit vector: the last two have to be divided by their lengths.": (
                lambda: np.einsum("ki,ij,kj->k", AXES, OPPOSITE_SCALES, AXES)
            ),
        },
        remark="The map has two hills and two hollows on the equator; the planes between them do "
        "not drift.",
    ),
    "3.2": Value(
        kind="slide",
        right=lambda: _arcmin(drift_per_revolution(DIAGONAL, REACH)),
        unit="arc minutes",
        accuracy=0.005,
        from_panel=_shown,
        mistakes={
            "These are the six leans alone. A scale error drifts as well.": (
                lambda: _arcmin(drift_per_revolution(DIAGONAL, REACH - LARGEST_ENTRY * np.eye(3)))
            ),
            "More is possible: some sliders are not at their ends.": (
                lambda: _arcmin(drift_per_revolution(DIAGONAL, LARGEST_ENTRY * np.eye(3)))
            ),
            "That is the angle after all the turns of the picture; give the drift in one.": (
                lambda: TURNS * _arcmin(drift_per_revolution(DIAGONAL, REACH))
            ),
        },
    ),
    "3.3": Choice(
        kind="explain",
        right="ad",
        wrong={
            "b": "forgets that the axis enters the coefficient twice: with the opposite sign it "
            "gives the same. What the skew part adds is perpendicular to it.",
            "c": "counts the three entries off the diagonal of Σ. Scale errors are on it.",
            "e": "is not enough: what vanishes on a cone is not seen by any number of axes on it.",
            "f": "counts entries. To first order a skew part leaves no drift after a whole "
            "turn, about whichever axis.",
        },
        remark="One mounting, one number. Six numbers are the whole symmetric part.",
    ),
    "3.4": Value(
        kind="compute",
        given=GivenNumbers(
            book={"error_matrix": LARIN_TRIAD},
            draw=lambda rng: {"error_matrix": np.round(rng.uniform(5e-4, 3e-3, (3, 3)), 5)},
            units={},
        ),
        right=_loops,
        unit="arc minutes",
        accuracy=1e-4,
        mistakes={
            "The order of the two loops: what happens later about body axes multiplies on the "
            "right.": lambda error_matrix: _loops(error_matrix, LOOPS[1], LOOPS[0]),
            "This is first order. Each drift is about the measured axis, and two rotations about "
            "different axes do not add like vectors.": (
                lambda error_matrix: _arcmin(
                    2 * np.pi * drift_coefficient(LOOPS, error_matrix) @ LOOPS
                )
            ),
            "Each loop is right, but two rotations about different axes do not add like vectors.": (
                _loops_added
            ),
            "The second loop has the wrong sense.": (
                lambda error_matrix: _loops(error_matrix, LOOPS[0], -LOOPS[1])
            ),
        },
        remark="There and back cancels whatever the triad; two different axes do not.",
    ),
    "3.5": Formula(
        kind="compute",
        arguments=("error_matrix",),
        draw=lambda rng: (rng.normal(0, 1e-3, (3, 3)),),
        right=lambda error_matrix: 2 * np.pi * principal_drifts(error_matrix)[0][-1],
        mistakes={
            "M is not symmetric. A routine for symmetric matrices reads one half of it and takes "
            "the other for its mirror image; what drifts is the mean of M and its transpose.": (
                _largest_drift
            ),
            "The same with the other half: what drifts is the mean of M and its transpose.": (
                lambda error_matrix: _largest_drift(error_matrix.T)
            ),
            "The half is missing: Σ is the mean of M and its transpose, not their sum.": (
                lambda error_matrix: _largest_drift(error_matrix + error_matrix.T)
            ),
            "The half is missing off the diagonal, where Σ has the mean of two entries.": (
                lambda error_matrix: _largest_drift(
                    error_matrix + error_matrix.T - np.diag(np.diag(error_matrix))
                )
            ),
            "These are eigenvalues of M itself. Its skew part changes them, but does not drift.": (
                lambda error_matrix: 2 * np.pi * np.linalg.eigvals(error_matrix).real.max()
            ),
            "This is the coefficient; give the angle after one turn.": (
                lambda error_matrix: principal_drifts(error_matrix)[0][-1]
            ),
            "This is the exact drift; give first order.": (
                lambda error_matrix: 2 * np.pi * principal_drifts(error_matrix, exact=True)[0][-1]
            ),
            "This is the largest size. Give the largest value; some triads lag behind more "
            "than they run ahead.": (
                lambda error_matrix: 2 * np.pi * np.abs(principal_drifts(error_matrix)[0]).max()
            ),
        },
        remark="One eigenvalue answers for all axes at once.",
    ),
    "3.6": Choice(
        kind="explain",
        right="adf",
        wrong={
            "b": "adds angles about axes that move meanwhile. Carried into one frame, they need "
            "not add up to zero.",
            "c": "takes the pace into account, and there is none in the sum: twice the rate lasts "
            "half as long.",
            "e": "would be so if the rate, seen from the reference frame, added up to nothing. On "
            "a cone it adds up to the solid angle.",
        },
        remark="Only the path counts, and a path that is taken back leaves nothing.",
    ),
}
