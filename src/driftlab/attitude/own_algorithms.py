"""One's own attitude algorithm: a function of angle increments, wherever a named one may stand.

The function is called with all increments of a record at once, an array of shape (n, 3), in rad and
in the order in which they happen. After every k-th of them, k as it likes, it answers one of two
things:

* the attitude there, as n/k quaternions of shape (n/k, 4), scalar last, or as a stack of n/k
  rotations of SciPy; body axes to those before the first increment, which itself is left out;
* the rotation vector of the step that ends there, shape (n/k, 3), rad, in the body axes at the
  start of the step: what a coning algorithm computes before anything is multiplied.

The usual two-sample algorithm is one line of the second kind::

    def mine(g):
        return g[0::2] + g[1::2] + 2 / 3 * np.cross(g[0::2], g[1::2])

Records of several runs are handed over one by one. What comes back is checked for its shape, its
length and its numbers, and against the increments themselves. An answer far from the sums of the
increments is refused in short steps if it is one of these slips: degrees, scalar first, attitudes
that map the other way or are those of single steps, rotation vectors of the opposite sign or since
the start, and tan(phi/4) e of either sign. Numbers may be of single precision, but
`driftlab.attitude.coning_drift` needs all digits.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, checked_function, finite_array
from driftlab.core.quaternion import conjugate, from_rotation_vector, multiply, to_rotation_vector
from driftlab.core.vectors import norms

OwnAlgorithm = Callable[[FloatArray], Any]
"""A function from increments (n, 3) to attitudes (n/k, 4), to SciPy rotations, or to the steps'
rotation vectors (n/k, 3)."""


def checked_steps(algorithm: OwnAlgorithm, increments: ArrayLike) -> FloatArray:
    """Steps (..., m, 4) by one's own function, whose answer is checked, from (..., n, 3)."""
    algorithm = checked_function(algorithm, "algorithm", "increments")
    rows = finite_array(increments, "increments", 3)
    if rows.ndim < 2:
        raise ValueError(f"increments: expected shape (..., n, 3), got shape {rows.shape}.")
    runs = [_steps_of_run(algorithm, run) for run in rows.reshape(-1, *rows.shape[-2:])]
    return np.stack(runs).reshape(*rows.shape[:-2], -1, 4)


def _steps_of_run(algorithm: OwnAlgorithm, rows: FloatArray) -> FloatArray:
    """Steps (m, 4) from the increments (n, 3) of one run."""
    name = getattr(algorithm, "__name__", type(algorithm).__name__)
    count = len(rows)
    try:  # a copy, so that a function that writes into its argument spoils nothing
        answer = algorithm(rows.copy())
    except (TypeError, ValueError, IndexError) as error:
        raise ValueError(
            f"algorithm: expected {name} to take increments (n, 3), got {type(error).__name__} of "
            f"n = {count}: {error}. One of k samples a step needs n to be a multiple of k."
        ) from error
    answer = answer.as_quat() if hasattr(answer, "as_quat") else answer
    found = np.atleast_1d(finite_array(answer, f"algorithm: what {name} returned"))
    if found.ndim != 2 or found.shape[1] not in (3, 4) or count % len(found):
        before = " (leave out the attitude before the first)" if len(found) == count + 1 else ""
        raise ValueError(
            f"algorithm: expected {name} to return attitudes (n/k, 4) or rotation vectors (n/k, 3) "
            f"after every k-th of n = {count} increments, got shape {found.shape}{before}."
        )
    parts = rows.reshape(len(found), -1, 3)
    sums = parts.sum(axis=1)
    size = float(np.median(norms(sums)))
    # Rotations do not commute: those of all increments and of their sum differ by up to half the
    # square of the way they make.
    near = (size + float(np.median(norms(parts).sum(axis=1))) ** 2) / 2
    if found.shape[1] == 3:
        _refuse_other_vectors(found, sums, near, name)
        return from_rotation_vector(found)
    lengths = norms(found)
    off = int(np.argmax(np.abs(lengths - 1)))
    if abs(lengths[off] - 1) > 1e-3:
        raise ValueError(
            f"algorithm: expected quaternions of length 1 from {name}, "
            f"got one of {lengths[off]:.4g}."
        )
    found = found / lengths[:, np.newaxis]
    steps = _between(found)
    _refuse_other_attitudes(found, steps, sums, near, name)
    return steps


def _between(attitudes: FloatArray) -> FloatArray:
    """Steps (m, 4) that lead from each attitude (m, 4) to the next, the shorter way round."""
    steps = attitudes.copy()
    steps[1:] = multiply(conjugate(attitudes[:-1]), attitudes[1:])
    return np.where(steps[:, 3:] < 0, -steps, steps)


def _refuse_other_vectors(vectors: FloatArray, sums: FloatArray, near: float, name: str) -> None:
    """Refuse rotation vectors that are not near the sums of the increments because of a slip."""
    if np.median(norms(vectors - sums)) <= near:
        return
    size = np.median(norms(sums))
    for slip, mended in (
        ("degrees", np.radians(vectors)),
        ("the opposite sign", -vectors),
        ("Cayley vectors -tan(phi/4) e", -4 * vectors),
        ("vectors tan(phi/4) e", 4 * vectors),
        ("rotation vectors since the start", np.diff(vectors, axis=0, prepend=0)),
    ):
        if np.median(norms(mended - sums)) < size / 10:
            raise ValueError(
                f"algorithm: expected rotation vectors in rad from {name}, body axes at the end of "
                f"a step to those at its start, got {slip}."
            )


def _refuse_other_attitudes(
    attitudes: FloatArray, steps: FloatArray, sums: FloatArray, near: float, name: str
) -> None:
    """Refuse attitudes whose steps are not near the increments' sums because of a slip."""

    def apart(found: FloatArray, vectors: FloatArray) -> float:
        differences = multiply(conjugate(from_rotation_vector(vectors)), found)
        return float(np.median(norms(to_rotation_vector(differences))))

    if apart(steps, sums) <= near:
        return
    size = float(np.median(norms(sums)))
    degrees = np.degrees(1.0)
    for slip, found, factor in (
        ("scalar first", _between(attitudes[:, [1, 2, 3, 0]]), 1.0),
        ("reference to body", _between(conjugate(attitudes)), 1.0),
        ("the rotation of each step by itself", attitudes, 1.0),
        ("increments taken for degrees", steps, 1 / degrees),
        ("increments turned into degrees", steps, degrees),
    ):
        # Rotations are never further apart than half a turn: near a larger one is no sign.
        if factor * size < np.pi and apart(found, factor * sums) < factor * size / 10:
            raise ValueError(
                f"algorithm: expected attitudes since the start from {name}, scalar last, body to "
                f"reference, of increments in rad, got {slip}."
            )
