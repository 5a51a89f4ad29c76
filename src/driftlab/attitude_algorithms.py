"""Perelyaev & Chelnokov, section 2, reconstructed: attitude from the angle increments of gyros.

A gyro that integrates hands over gamma, the integral of its rate, once a sample. Where the rate
turns within a step, the rotation over the step is not gamma: it differs by the *coning correction*,
which can be estimated from cross products of neighbouring increments. An algorithm here is three
choices: how many increments make a step, how the correction is estimated, and how corrected gamma
becomes a quaternion.

The paper's section 2 is lost. The Picard algorithms below are derived from what is left of the
paper, in chapter 06; they are a reconstruction and need not be the authors' own forms. The two
rotation-vector algorithms are what a user would otherwise take; the weights for three samples are
Miller's (1983).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

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
    increments: ArrayLike,
    algorithm: str,
    *,
    history: ArrayLike | None = None,
    word: DTypeLike = np.float64,
) -> NDArray[Any]:
    """Vector of each step: k, or the rotation vector if that is the method.

    Parameters
    ----------
    increments, algorithm, history
        As in `integrate`.
    word : dtype
        The floating dtype in which to calculate, once the increments are rounded to it.

    Returns
    -------
    ndarray of `word`, shape (..., n // samples, 3)
    """
    chosen = attitude_algorithm(algorithm)
    dtype = np.dtype(word)
    if dtype.kind != "f":
        raise ValueError(f"word: expected a floating dtype, got {dtype}.")
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
    past = past if past is None else past.astype(dtype)
    return _vectors(chosen, rows.astype(dtype, copy=False), past)


def _vectors(
    algorithm: Algorithm, increments: NDArray[Any], history: NDArray[Any] | None
) -> NDArray[Any]:
    """`step_vectors` of checked arguments, in their own arithmetic."""
    kind, m = increments.dtype.type, algorithm.samples
    # Components first, so that everything but a cross product is plain arithmetic.
    rows = np.ascontiguousarray(np.moveaxis(increments, -1, 0))
    gamma = sum((rows[..., i::m] for i in range(1, m)), rows[..., 0::m])
    if algorithm.memory:
        coning = _coning_with_memory(algorithm, rows, history)
    else:
        coning = _weighted(algorithm.coning, [rows[..., i::m] for i in range(m)])
    square = (gamma**2).sum(axis=0)
    if algorithm.iterate == "rotation vector":
        vectors = gamma + coning
    elif not (square < 4 * np.pi**2).all():
        raise ValueError(
            "increments: expected less than a whole turn a step, where k is infinite, "
            f"got {float(np.sqrt(square.max())):.3g} rad."
        )
    elif algorithm.iterate == "first":
        vectors = kind(-1 / 4) * gamma
    else:
        vectors = kind(-1 / 4) * (gamma + coning) - kind(1 / 192) * square * gamma
        if algorithm.iterate == "second":
            # What the second iterate still has and the third removes.
            vectors -= kind(1 / 32) * _cross(gamma, coning)
    return np.moveaxis(vectors, 0, -1)


def _cross(a: NDArray[Any], b: NDArray[Any]) -> NDArray[Any]:
    """Cross product along the first axis."""
    return np.stack(
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    )


def _weighted(weights: Weights, places: list[NDArray[Any]]) -> NDArray[Any]:
    """Sum of weight * g_i × g_j, where `places` holds the g (3, ...) at each place of the window.

    Cross products with a common right factor are summed before they are multiplied out.
    """
    kind = places[0].dtype.type
    total = np.zeros_like(places[0])
    for j in sorted({j for _, j in weights}):
        left = sum(kind(weight) * places[i] for (i, k), weight in weights.items() if k == j)
        total += _cross(left, places[j])
    return total


def _coning_with_memory(
    algorithm: Algorithm, rows: NDArray[Any], history: NDArray[Any] | None
) -> NDArray[Any]:
    """Coning correction (3, ..., n) of an algorithm whose step is one increment."""
    if history is not None:
        past = np.moveaxis(history[..., history.shape[-2] - algorithm.memory :, :], -1, 0)
        leading = np.broadcast_shapes(rows.shape[:-1], past.shape[:-1])
        both = [np.broadcast_to(x, (*leading, x.shape[-1])) for x in (past, rows)]
        rows = np.concatenate(both, axis=-1)
    last = rows.shape[-1] - algorithm.memory
    coning = _weighted(algorithm.coning, [rows[..., i : last + i] for i in range(algorithm.window)])
    if history is not None:
        return coning
    first = [rows[..., i : i + 1] for i in range(algorithm.window)]
    starts = [_weighted(weights, first) for weights in algorithm.starts]
    return np.concatenate([*starts, coning], axis=-1)


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
