"""Exercises of chapter 10: installation errors, taken apart."""

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

import numpy as np
from scipy.constants import arcsecond, micro

from driftlab.body_frames import misalignment_vector
from driftlab.book.machinery.exercise.answers import Choice, Value
from driftlab.book.machinery.exercise.exercise import Exercise
from driftlab.book.machinery.exercise.formulas import Formula
from driftlab.book.machinery.exercise.given_numbers import GivenNumbers
from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration.body_axes import attitude_error
from driftlab.checks import FloatArray
from driftlab.motion.scheme import Scheme
from driftlab.motion.trajectory import Trajectory
from driftlab.motion.turntable import turntable_trajectory
from driftlab.quaternion import from_rotation_vector, multiply, rotate
from driftlab.triad import split_error_matrix
from driftlab.vectors import cross_matrix

from .experiments import INTERVAL, computed_attitude, inertial_attitude

SCHEME = Scheme("+90X +90Y", ("Up", "East", "North"), dwell=5.0)


def _lean(K_xy: int) -> FloatArray:
    """Non-orthogonality of x and y, and the turn (3,) of the averaged axes, in arc seconds."""
    lean = K_xy * np.outer([1.0, 0, 0], [0, 1, 0])
    # The axes turn the other way than the components.
    return np.array(
        [split_error_matrix(lean).non_orthogonality[0, 1], *(0.0 - misalignment_vector(lean))]
    )


def _skew(*vector: float) -> FloatArray:
    return cross_matrix(np.array(vector)) + 0.0


@cache
def _record() -> Trajectory:
    return turntable_trajectory(SCHEME, TABLE_LATITUDE, INTERVAL, multiple_of=2)


def _error(gyro_error_matrix: FloatArray, start: FloatArray, of_earth: bool = False) -> FloatArray:
    """Attitude error (3,) in arc seconds at the end, of a computer that starts with `start` (3,).

    With `of_earth` it is counted wrongly, from axes that turn with the Earth.
    """
    record = _record()
    first = record.attitude[0]
    begin = multiply(from_rotation_vector(-start), first)
    found = computed_attitude(record, gyro_error_matrix, begin)[-1]
    true = record.attitude[-1] if of_earth else inertial_attitude(record, first)[-1]
    return attitude_error(found, true) / arcsecond


def _two_units(
    kappa: FloatArray,
    start: Callable[[FloatArray], FloatArray] = lambda kappa: -_in_table_axes(kappa),
    sense: float = 1.0,
    of_earth: bool = False,
) -> FloatArray:
    """Errors (2, 3) of the ideal unit that starts wrong and of the misaligned one."""
    vector = np.asarray(kappa) * arcsecond
    ideal = _error(np.zeros((3, 3)), start(vector), of_earth)
    return np.stack([ideal, _error(sense * cross_matrix(vector), np.zeros(3), of_earth)])


def _in_table_axes(kappa: FloatArray) -> FloatArray:
    return rotate(_record().attitude[0], kappa)


def _some_kappa(rng: np.random.Generator) -> dict[str, FloatArray]:
    sizes = rng.permutation(rng.uniform([15, 30, 50], [25, 40, 80]))
    return {"kappa": np.round(rng.choice([-1, 1], 3) * sizes)}


def _hidden(*vector: float) -> FloatArray:
    """Second order of the symmetric factor of I + [κ×]."""
    return -(_skew(*vector) @ _skew(*vector)) / 2


def _entries(values: Mapping[str, Any]) -> FloatArray:
    """Error matrix (3, 3) of a panel in arc seconds; its scale errors are in ppm."""
    entries = np.array([[values[f"k{i}{j}"] for j in "xyz"] for i in "xyz"], dtype=float)
    return np.where(np.eye(3), entries * micro / arcsecond, entries)


EXERCISES: dict[str, Exercise] = {
    "10.1": Value(
        kind="predict",
        given=GivenNumbers(
            book={"K_xy": 40},
            draw=lambda rng: {"K_xy": round(rng.uniform(15.5, 99.5))},
            units={"K_xy": "arc seconds"},
        ),
        right=_lean,
        unit="arc seconds",
        absolute=0.5,
        mistakes={
            "The last three are κ, the rotation of the components. The axes turn the other way.": (
                lambda K_xy: _lean(K_xy) * [1, -1, -1, -1]
            ),
            "The first number is the change of the angle between the two axes. The matrix has a "
            "part of it on each side of the diagonal.": lambda K_xy: _lean(K_xy) * [2, 1, 1, 1],
            "This follows gyro x alone, as the upper triangle does. Averaged axes follow both "
            "gyros, and y has stayed where it was.": lambda K_xy: 2 * _lean(K_xy),
            "Taken for a turn of the whole triad. Has gyro y turned as well?": (
                lambda K_xy: 2 * _lean(K_xy) * [0, 1, 1, 1]
            ),
            "Taken for an error of the angle alone, so that the averaged axes would stay. Which "
            "symmetric matrix would that be?": lambda K_xy: 2 * _lean(K_xy) * [1, 0, 0, 0],
            "The axis of the turn is wrong: what leans from x towards y turns about neither.": (
                lambda K_xy: _lean(K_xy)[[0, 3, 1, 2]]
            ),
        },
        remark="One wrong entry is half non-orthogonality and half misalignment.",
    ),
    "10.2": Value(
        kind="slide",
        right=lambda: _skew(40, 40, 40),
        unit="arc seconds",
        absolute=1.0,
        from_panel=_entries,
        mistakes={
            "This is non-orthogonality and nothing else: the matrix equals its transpose.": (
                lambda: -np.abs(_skew(40, 40, 40))
            ),
            "All misalignments are negative. Begin with the entry that is given, and its sign.": (
                lambda: _skew(-40, -40, -40)
            ),
            "The sensitive axis z has not moved.": lambda: _skew(0, 0, 40),
            "One misalignment is negative: the one about x.": (lambda: _skew(-40, 40, 40)),
            "One misalignment is negative: the one about y.": lambda: _skew(40, -40, 40),
        },
    ),
    "10.3": Choice(
        kind="explain",
        right="ade",
        wrong={
            "b": "names what belongs to the unit: each sum is a change of the angle between two "
            "sensitive axes, and these two travel together.",
            "c": "is the consequence of one choice of body axes. Mounted otherwise, all six "
            "entries are others, above and below the diagonal.",
            "f": "takes the question for one of accuracy. A perfect table has axes of its own, "
            "and the bracket between them and the unit remains.",
        },
        remark="Six of the nine numbers belong to the triad, three to the bracket.",
    ),
    "10.4": Value(
        kind="compute",
        given=GivenNumbers(
            book={"kappa": np.array([60.0, -30.0, 20.0])},
            draw=_some_kappa,
            units={"kappa": "arc seconds"},
        ),
        right=_two_units,
        unit="arc seconds",
        accuracy=5e-3,
        mistakes={
            "The first row has the wrong sign: the computed attitude is (I - [φ×]) C, so the "
            "rotation vector that goes before C is -φ.": (
                lambda kappa: _two_units(kappa, _in_table_axes)
            ),
            "The second row is φ - Cκ already. Give φ itself, before the comparison.": (
                lambda kappa: np.stack([_two_units(kappa)[0]] * 2)
            ),
            "The second row has the sign of the opposite misalignment: look at the matrix of the "
            "cross product, κ first.": lambda kappa: _two_units(kappa, sense=-1.0),
            "The ideal unit starts with -κ. But κ is in body axes, and φ in those of the "
            "table: C(0) is missing.": lambda kappa: _two_units(kappa, np.negative),
            "The errors contain the turn of the Earth: `integrate` stays in axes that do not turn, "
            "and the attitudes of the record are counted from axes that do.": (
                lambda kappa: _two_units(kappa, of_earth=True)
            ),
        },
        remark="The two rows differ by the carried κ, and by nothing else to first order.",
    ),
    "10.5": Formula(
        kind="compute",
        arguments=("kappa_1", "kappa_2", "kappa_3"),
        draw=lambda rng: tuple(rng.normal(size=3)),
        right=_hidden,
        mistakes={
            "Zero is (M + Mᵀ)/2 - I. But the symmetric factor of a product is not the symmetric "
            "part of a sum: S S is M Mᵀ.": lambda *vector: np.zeros((3, 3)),
            "This is M Mᵀ - I, the square of what you want: S S - I.": (
                lambda *vector: 2 * _hidden(*vector)
            ),
            "This is the second order that a true rotation has. Find what I + [κ×] "
            "has instead of it.": lambda *vector: -_hidden(*vector),
            "The lengths of the axes are right; the angles between them change as well.": (
                lambda *vector: np.diag(np.diag(_hidden(*vector)))
            ),
            "The scale is missing: what moves sideways also becomes longer.": (
                lambda *vector: _hidden(*vector) - np.diag(np.diag(_hidden(*vector)))
            ),
            "One term of [κ×][κ×] = κκᵀ - κᵀκ I is missing.": (
                lambda *vector: -np.outer(vector, vector) / 2
            ),
        },
        remark="Both hide at second order.",
    ),
}
