"""Perelyaev & Chelnokov, section 2, reconstructed: attitude from the angle increments of gyros.

A gyro that integrates hands over gamma, the integral of its rate, once a sample. Where the rate
turns within a step, the rotation over the step is not gamma: it differs by the *coning correction*,
which can be estimated from cross products of neighbouring increments. An algorithm here is three
choices: how many increments make a step, how the correction is estimated, and how corrected gamma
becomes a quaternion.

The copy of the paper at hand ends where section 2 begins. The algorithms below are derived in
chapter 06 from what is left: `one-step-3`, `two-step-3` and `two-step-4` after the promises of the
abstract, `picard-1` and `memory-4` beside them. They are a reconstruction and need not be the
authors' own forms. The two rotation-vector algorithms are what a user would otherwise take; the
weights for three samples are Miller's (1983).

In the names, the last number is the global order, except that `picard-1` is the first iterate and
that the two rotation-vector algorithms count their samples.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from .cayley import rotation_quaternion
from .checks import FloatArray, finite_array, finite_arrays, unit_quaternions, whole_number
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

    def __post_init__(self) -> None:
        whole_number(self.samples, "samples")
        whole_number(self.memory, "memory", least=0)
        if self.memory and self.samples > 1:
            raise ValueError(f"memory: expected 0 with several samples a step, got {self.memory}.")
        if len(self.starts) != self.memory:
            raise ValueError(
                f"starts: expected one for each of {self.memory} increments of memory, "
                f"got {len(self.starts)}."
            )
        if self.iterate not in get_args(Iterate):
            raise ValueError(
                f"iterate: expected one of {', '.join(get_args(Iterate))}, got {self.iterate!r}."
            )
        for weights in (self.coning, *self.starts):
            if weights:
                finite_array(list(weights.values()), "coning")
        for i, j in (pair for weights in (self.coning, *self.starts) for pair in weights):
            if not 0 <= i < j < self.window:
                raise ValueError(
                    f"coning: expected places 0 <= i < j < {self.window}, got {(i, j)}."
                )

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
"""Algorithms by name, in the order of the tables of chapter 06."""


def attitude_algorithm(algorithm: str | Algorithm) -> Algorithm:
    """Return the algorithm of that name, or `algorithm` itself; an unknown name is refused."""
    if isinstance(algorithm, Algorithm):
        return algorithm
    if not isinstance(algorithm, str) or algorithm not in ALGORITHMS:
        raise ValueError(f"algorithm: expected one of {', '.join(ALGORITHMS)}, got {algorithm!r}.")
    return ALGORITHMS[algorithm]


def integrate(
    increments: ArrayLike,
    algorithm: str | Algorithm = "two-step-4",
    *,
    start: ArrayLike = (0.0, 0.0, 0.0, 1.0),
    history: ArrayLike | None = None,
) -> FloatArray:
    """Attitude after each step, from angle increments.

    Parameters
    ----------
    increments : array_like, shape (..., n, 3)
        Integrals of the body rate over equal intervals, rad, in the order in which they happen.
        They must be true integrals, as from an integrating gyro. Sampled rates times the interval
        are not: the coning between two samples is lost in them, see chapter 06.
    algorithm : str or Algorithm
        A key of `ALGORITHMS`, or an algorithm of one's own.
    start : array_like, shape (..., 4)
        Attitude before the first increment; brought to unit norm.
    history : array_like, shape (..., m, 3), optional
        The increments before the first, as many as the algorithm's memory; earlier ones, and any
        history of an algorithm without memory, are not looked at.
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
        without a history, or, where k is used, turn by a whole turn in one step. All
        algorithms want steps that turn by much less than 1 rad.
    """
    first = unit_quaternions(start, "start")
    steps = cumulative_product(step_quaternions(increments, algorithm, history=history))
    finite_arrays(increments=(steps, *steps.shape[-2:]), start=(first, 4))
    return multiply(first[..., np.newaxis, :], steps)


def step_quaternions(
    increments: ArrayLike, algorithm: str | Algorithm, *, history: ArrayLike | None = None
) -> FloatArray:
    """Rotations over the single steps, (..., n // samples, 4); arguments as in `integrate`."""
    vectors = step_vectors(increments, algorithm, history=history)
    if attitude_algorithm(algorithm).iterate == "rotation vector":
        return from_rotation_vector(vectors)
    return rotation_quaternion(vectors)


def step_vectors(
    increments: ArrayLike,
    algorithm: str | Algorithm,
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
        float16, float32 or float64: the arithmetic, once the increments are rounded to it.

    Returns
    -------
    ndarray of `word`, shape (..., n // samples, 3)
    """
    chosen = attitude_algorithm(algorithm)
    dtype = _checked_word(word)
    rows = finite_array(increments, "increments")
    if rows.ndim < 2 or rows.shape[-1] != 3:
        raise ValueError(f"increments: expected shape (..., n, 3), got shape {rows.shape}.")
    largest = float(np.abs(rows).max())
    if largest >= 2 * np.pi and chosen.iterate != "rotation vector":
        raise _too_far(largest)
    if largest > 1e12:  # not even the rounding of such an angle is small
        raise ValueError(f"increments: expected angles in rad, got {largest:.3g}.")
    count, left_over = rows.shape[-2], rows.shape[-2] % chosen.samples
    if left_over:
        raise ValueError(
            f"increments: expected a multiple of {chosen.samples} for {chosen.name}, got {count}; "
            f"keep the last {left_over} for the next call."
        )
    if history is None or not chosen.memory:
        if chosen.memory and count < chosen.window:
            raise ValueError(
                f"increments: expected at least {chosen.window} for {chosen.name} to start without "
                f"a history, got {count}."
            )
        return _vectors(chosen, _in_word(rows, dtype), past=0)
    past = finite_array(history, "history", 3)
    if past.ndim < 2 or past.shape[-2] < chosen.memory:
        raise ValueError(
            f"history: expected shape (..., m, 3) with m at least {chosen.memory} for "
            f"{chosen.name}, got shape {past.shape}."
        )
    finite_arrays(increments=(rows, count, 3), history=(past, *past.shape[-2:]))
    leading = np.broadcast_shapes(rows.shape[:-2], past.shape[:-2])
    both = [
        np.broadcast_to(part, (*leading, *part.shape[-2:]))
        for part in (past[..., -chosen.memory :, :], rows)
    ]
    return _vectors(chosen, _in_word(np.concatenate(both, axis=-2), dtype), past=chosen.memory)


def _checked_word(word: DTypeLike) -> np.dtype[Any]:
    try:
        dtype = np.dtype(word)
    except TypeError:
        dtype = np.dtype(object)
    if dtype not in (np.float16, np.float32, np.float64):
        raise ValueError(f"word: expected float16, float32 or float64, got {word!r}.")
    return dtype


def _in_word(rows: FloatArray, dtype: np.dtype[Any]) -> NDArray[Any]:
    with np.errstate(over="ignore"):
        rounded = rows.astype(dtype, copy=False)
    if not np.isfinite(rounded).all():
        raise ValueError(f"increments: expected numbers that {dtype} can hold, got larger ones.")
    return rounded


def _too_far(angle: float) -> ValueError:
    return ValueError(
        "increments: expected less than a whole turn a step, where the true k is infinite, "
        f"got {angle:.3g} rad."
    )


def _vectors(algorithm: Algorithm, increments: NDArray[Any], past: int) -> NDArray[Any]:
    """`step_vectors` of checked increments, the first `past` of which are history."""
    kind, m = increments.dtype.type, algorithm.samples
    # Components first, so that everything but a cross product is plain arithmetic.
    rows = np.ascontiguousarray(np.moveaxis(increments, -1, 0))
    if algorithm.memory:
        gamma, coning = rows[..., past:], _coning_with_memory(algorithm, rows, past)
    else:
        places = [rows[..., i::m] for i in range(m)]
        gamma, coning = sum(places[1:], places[0]), _weighted(algorithm.coning, places)
    if algorithm.iterate == "rotation vector":
        return np.moveaxis(gamma + coning, 0, -1)
    square = (gamma**2).sum(axis=0)
    if not (square < 4 * np.pi**2).all():
        raise _too_far(float(np.sqrt(square.max())))
    if algorithm.iterate == "first":
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


def _coning_with_memory(algorithm: Algorithm, rows: NDArray[Any], past: int) -> NDArray[Any]:
    """Coning correction (3, ..., n) of an algorithm whose step is one increment."""
    last = rows.shape[-1] - algorithm.memory
    coning = _weighted(algorithm.coning, [rows[..., i : last + i] for i in range(algorithm.window)])
    if past:
        return coning
    first = [rows[..., i : i + 1] for i in range(algorithm.window)]
    starts = [_weighted(weights, first) for weights in algorithm.starts]
    return np.concatenate([*starts, coning], axis=-1)


def coning_drift(
    algorithm: str | Algorithm,
    half_angle: ArrayLike,
    frequency: ArrayLike,
    sample_interval: ArrayLike,
) -> FloatArray:
    """Apparent drift about the axis of a small cone, rad/s; closed form.

    Parameters
    ----------
    algorithm : str or Algorithm
        A key of `ALGORITHMS`, or an algorithm of one's own.
    half_angle : array_like, shape (...)
        Half the opening angle of the cone, rad; terms of its fourth power are left out.
    frequency : array_like, shape (...)
        Turns of the axis round the cone in a second, Hz; negative for the other sense.
    sample_interval : array_like, shape (...)
        Interval of one increment, s.

    Returns
    -------
    ndarray, shape (...)
        Positive about the axis of the cone. It changes its sign with the frequency, so an algorithm
        that corrects too little drifts against the sense in which the axis runs round.

    Notes
    -----
    With x = 2 pi f h, the angle of coning in one interval, an increment and the one d later have
    the cross product 4 sin(x/2)^2 sin(d x) sin(a)^2 about the axis. The true correction over a step
    of m intervals is sin(a)^2 (m x - sin(m x))/2. Derived in chapter 06. The two nearly cancel when
    x is small: rounding leaves an error of about 1e-16 m x sin(a)^2 in the drift of a step.
    """
    chosen = attitude_algorithm(algorithm)
    angle, rate, interval = finite_arrays(
        half_angle=(half_angle,), frequency=(frequency,), sample_interval=(sample_interval,)
    )
    if (interval <= 0).any():
        raise ValueError(f"sample_interval: expected positive times, got {interval.min():g}.")
    x = 2 * np.pi * rate * interval
    step = chosen.samples * x
    estimate = np.zeros_like(x)
    for (i, j), weight in chosen.coning.items():
        estimate += weight * 4 * np.sin(x / 2) ** 2 * np.sin((j - i) * x)
    drift_per_step = np.sin(angle) ** 2 * (estimate - (step - np.sin(step)) / 2)
    return drift_per_step / (chosen.samples * interval)
