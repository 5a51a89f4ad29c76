"""Perelyaev & Chelnokov, section 2, reconstructed: attitude from the angle increments of gyros.

A gyro that integrates hands over gamma, the integral of its rate, once a sample. Where the rate
turns within a step, the rotation over the step is not gamma: it differs by the *coning correction*,
which can be estimated from cross products of neighbouring increments. An algorithm here is three
choices: how many increments make a step, how the correction is estimated, and how corrected gamma
becomes a quaternion.

The paper's section 2 is lost. The Picard algorithms below are derived from what is left of the
paper, in chapter 06; they are a reconstruction and need not be the authors' own forms. The two
rotation-vector algorithms are Miller's (1983) and are what a user would otherwise take.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .cayley import rotation_quaternion
from .checks import FloatArray, finite_array, finite_arrays
from .quaternion import cumulative_product, from_rotation_vector, multiply

Weights = Mapping[tuple[int, int], float]
"""Weights of the cross products g_i × g_j, by places i < j in a row of neighbouring increments."""

Iterate = Literal["first", "second", "third", "rotation vector"]


@dataclass(frozen=True)
class Algorithm:
    """How the increments of a step, and some before it, become the rotation over the step.

    Attributes
    ----------
    name : str
    samples : int
        Increments that make one step.
    memory : int
        Increments before the step that are used as well.
    coning : Mapping
        Weights of the coning correction; place 0 is the oldest increment of the memory.
    iterate : {"first", "second", "third", "rotation vector"}
        Which of Picard's iterates is taken for the vector k of the step, or that the rotation
        vector takes its place.
    order : int
        Global order on a motion without symmetries: the error at a given time shrinks with this
        power of the step. Derived in chapter 06.
    starts : tuple of Mapping
        For algorithms with memory: the weights at the first steps, where nothing came before. They
        use the increments that follow; place 0 is the very first increment.
    """

    name: str
    samples: int
    memory: int
    coning: Weights
    iterate: Iterate
    order: int
    starts: tuple[Weights, ...] = ()

    @property
    def window(self) -> int:
        """Increments that one step looks at."""
        return self.samples + self.memory


ALGORITHMS: Mapping[str, Algorithm] = MappingProxyType(
    {
        algorithm.name: algorithm
        for algorithm in (
            Algorithm("picard-1", 1, 0, {}, "first", 2),
            Algorithm("one-step-3", 1, 1, {(0, 1): 1 / 12}, "third", 3, ({(0, 1): 1 / 12},)),
            Algorithm("two-step-3", 2, 0, {(0, 1): 2 / 3}, "second", 3),
            Algorithm("two-step-4", 2, 0, {(0, 1): 2 / 3}, "third", 4),
            Algorithm(
                "memory-4",
                1,
                2,
                {(1, 2): 1 / 6, (0, 2): -1 / 24},
                "third",
                4,
                # The mirror image of the formula, then the one with a neighbour on either side.
                ({(0, 1): 1 / 6, (0, 2): -1 / 24}, {(0, 1): 1 / 24, (1, 2): 1 / 24}),
            ),
            Algorithm("rotation-vector-2", 2, 0, {(0, 1): 2 / 3}, "rotation vector", 4),
            Algorithm(
                "rotation-vector-3",
                3,
                0,
                {(0, 2): 9 / 20, (0, 1): 27 / 40, (1, 2): 27 / 40},
                "rotation vector",
                4,
            ),
        )
    }
)
"""Algorithms by name: `one-step-3` is A of the derivation, `two-step-4` B, `memory-4` C."""


def attitude_algorithm(name: str) -> Algorithm:
    """Return the algorithm called `name`, or refuse an unknown name with the list of known ones."""
    if name not in ALGORITHMS:
        raise ValueError(f"algorithm: expected one of {', '.join(ALGORITHMS)}, got {name!r}.")
    return ALGORITHMS[name]


def integrate(
    increments: ArrayLike,
    algorithm: str = "two-step-4",
    *,
    start: ArrayLike = (0.0, 0.0, 0.0, 1.0),
    history: ArrayLike | None = None,
) -> FloatArray:
    """Attitude after each step, from angle increments.

    Parameters
    ----------
    increments : array_like, shape (..., n, 3)
        Integrals of the body rate over equal intervals, rad, in the order in which they happen.
    algorithm : str
        A key of `ALGORITHMS`.
    start : array_like, shape (..., 4)
        Attitude before the first increment.
    history : array_like, shape (..., m, 3), optional
        The increments before the first, as many as the algorithm's memory; more are ignored.
        Without it an algorithm with memory starts by a formula of the same order that uses the
        increments that follow.

    Returns
    -------
    ndarray, shape (..., n // samples, 4)
        Attitude at the end of each step. The last one, with the last increments as `history`, is
        where a next call goes on.

    Raises
    ------
    ValueError
        If the algorithm is unknown; the increments do not make whole steps, are too few to start
        without a history, or turn by a whole turn in one step, where k is infinite.
    """
    start = finite_array(start, "start", 4)
    steps = cumulative_product(step_quaternions(increments, algorithm, history=history))
    finite_arrays(increments=(steps, *steps.shape[-2:]), start=(start, 4))
    return multiply(start[..., np.newaxis, :], steps)


def step_quaternions(
    increments: ArrayLike, algorithm: str, *, history: ArrayLike | None = None
) -> FloatArray:
    """Rotations over the single steps, (..., n // samples, 4); arguments as in `integrate`."""
    vectors = step_vectors(increments, algorithm, history=history)
    if ALGORITHMS[algorithm].iterate == "rotation vector":
        return from_rotation_vector(vectors)
    return rotation_quaternion(vectors)


def step_vectors(
    increments: ArrayLike, algorithm: str, *, history: ArrayLike | None = None
) -> FloatArray:
    """Vector of each step, (..., n // samples, 3): k, or the rotation vector if that is the method.

    Arguments as in `integrate`.
    """
    chosen = attitude_algorithm(algorithm)
    rows = finite_array(increments, "increments", 3)
    if rows.ndim < 2:
        raise ValueError(f"increments: expected shape (..., n, 3), got shape {rows.shape}.")
    count = rows.shape[-2]
    if count % chosen.samples:
        raise ValueError(
            f"increments: expected a multiple of {chosen.samples} for {algorithm}, got {count}."
        )
    past = None
    if history is not None:
        past = finite_array(history, "history", 3)
        if past.ndim < 2 or past.shape[-2] < chosen.memory:
            raise ValueError(
                f"history: expected shape (..., m, 3) with m at least {chosen.memory} for "
                f"{algorithm}, got shape {past.shape}."
            )
        finite_arrays(increments=(rows, count, 3), history=(past, *past.shape[-2:]))
    elif chosen.memory and count < chosen.window:
        raise ValueError(
            f"increments: expected at least {chosen.window} for {algorithm} to start without a "
            f"history, got {count}."
        )
    return vectors_of_steps(chosen, rows, past)


def vectors_of_steps(
    algorithm: Algorithm, increments: NDArray[Any], history: NDArray[Any] | None = None
) -> NDArray[Any]:
    """`step_vectors` in the arithmetic of its arguments, which are not checked.

    Parameters
    ----------
    algorithm : Algorithm
    increments : ndarray, shape (..., n, 3)
        Of any floating dtype; all calculations are done in it.
    history : ndarray, shape (..., m, 3), optional
    """
    kind = increments.dtype.type
    # Components apart: x, y, z are arrays (..., n) of their own, and cross products plain formulas.
    columns = _columns(increments)
    m = algorithm.samples
    places = [[column[..., i::m] for column in columns] for i in range(m)]
    gamma = [np.add.reduce([place[axis] for place in places]) for axis in range(3)]
    if algorithm.memory:
        correction = _correction_with_memory(algorithm, columns, history)
    else:
        correction = _weighted(algorithm.coning, places, kind)
    corrected = [a + b for a, b in zip(gamma, correction, strict=True)]
    if algorithm.iterate == "rotation vector":
        return np.stack(corrected, axis=-1)
    square = gamma[0] ** 2 + gamma[1] ** 2 + gamma[2] ** 2
    if not (square < 4 * np.pi**2).all():
        angle = float(np.sqrt(square.max()))
        raise ValueError(
            "increments: expected less than a whole turn a step, where k is infinite, "
            f"got {angle:.3g} rad."
        )
    if algorithm.iterate == "first":
        return np.stack([kind(-0.25) * a for a in gamma], axis=-1)
    cubic = kind(-1 / 192) * square
    k = [kind(-0.25) * a + cubic * b for a, b in zip(corrected, gamma, strict=True)]
    if algorithm.iterate == "second":
        # What the second iterate still has and the third removes.
        residue = _cross(gamma, correction)
        k = [a - kind(1 / 32) * b for a, b in zip(k, residue, strict=True)]
    return np.stack(k, axis=-1)


Vector = list[Any]
"""Three components, each an array (...)."""


def _columns(vectors: NDArray[Any]) -> Vector:
    return [np.ascontiguousarray(vectors[..., axis]) for axis in range(3)]


def _cross(a: Vector, b: Vector) -> Vector:
    return [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]


def _weighted(weights: Weights, places: list[Vector], kind: type[Any]) -> Vector:
    """Sum of weight * g_i × g_j, where `places` holds the g at each place of the window.

    Cross products with a common right factor are summed before they are multiplied out.
    """
    total: Vector = [kind(0)] * 3
    for j in sorted({j for _, j in weights}):
        left: Vector = [kind(0)] * 3
        for (i, other), weight in weights.items():
            if other == j:
                left = [a + kind(weight) * b for a, b in zip(left, places[i], strict=True)]
        total = [a + b for a, b in zip(total, _cross(left, places[j]), strict=True)]
    return total


def _correction_with_memory(
    algorithm: Algorithm, columns: Vector, history: NDArray[Any] | None
) -> Vector:
    """Coning correction (..., n) of an algorithm whose step is one increment with some before."""
    kind, memory = columns[0].dtype.type, algorithm.memory
    if history is not None:
        past = _columns(history[..., history.shape[-2] - memory :, :])
        leading = np.broadcast_shapes(columns[0].shape[:-1], past[0].shape[:-1])
        columns = [
            np.concatenate(
                [np.broadcast_to(x, (*leading, x.shape[-1])) for x in (before, column)], axis=-1
            )
            for before, column in zip(past, columns, strict=True)
        ]
    count = columns[0].shape[-1]

    def windows(first: int, last: int, width: int) -> list[Vector]:
        """The increments at each place of the windows that begin at first, ..., last - 1."""
        return [[column[..., first + i : last + i] for column in columns] for i in range(width)]

    correction = _weighted(algorithm.coning, windows(0, count - memory, algorithm.window), kind)
    if history is not None:
        return correction
    starts = [
        _weighted(weights, windows(0, 1, algorithm.window), kind) for weights in algorithm.starts
    ]
    return [
        np.concatenate([*(start[axis] for start in starts), correction[axis]], axis=-1)
        for axis in range(3)
    ]


def coning_drift(
    algorithm: str, half_angle: ArrayLike, frequency: ArrayLike, sample_interval: ArrayLike
) -> FloatArray:
    """Apparent drift about the axis of a small cone, rad/s; closed form.

    Parameters
    ----------
    algorithm : str
        A key of `ALGORITHMS`.
    half_angle : array_like, shape (...)
        Half the opening angle of the cone, rad; terms of its fourth power are left out.
    frequency : array_like, shape (...)
        Turns of the axis round the cone in a second, Hz.
    sample_interval : array_like, shape (...)
        Interval of one increment, s.

    Returns
    -------
    ndarray, shape (...)
        Positive about the axis about which the coning turns. Zero means no error.

    Notes
    -----
    With x = 2 pi f h, the angle of coning in one interval, an increment and the one d later have
    the cross product 4 sin(x/2)^2 sin(d x) sin(a)^2 about the axis. The true correction over a step
    of m intervals is sin(a)^2 (m x - sin(m x))/2. Derived in chapter 06.
    """
    chosen = attitude_algorithm(algorithm)
    angle, rate, interval = finite_arrays(
        half_angle=(half_angle,), frequency=(frequency,), sample_interval=(sample_interval,)
    )
    if (interval <= 0).any():
        raise ValueError(f"sample_interval: expected positive times, got {interval.min()!r}.")
    x = 2 * np.pi * rate * interval
    step = chosen.samples * x
    estimate = np.zeros_like(x)
    for (i, j), weight in chosen.coning.items():
        estimate += weight * 4 * np.sin(x / 2) ** 2 * np.sin((j - i) * x)
    drift_per_step = np.sin(angle) ** 2 * (estimate - (step - np.sin(step)) / 2)
    return drift_per_step / (chosen.samples * interval)
