"""Perelyaev & Chelnokov, section 2, reconstructed: attitude algorithms as data.

A gyro that integrates hands over gamma, the integral of its rate, once a sample. Where the rate
turns within a step, the rotation over the step is not gamma: it differs by the *coning correction*,
which can be estimated from cross products of neighbouring increments. An algorithm here is three
choices: how many increments make a step, how the correction is estimated, and how corrected gamma
becomes a quaternion. What it does on a small cone follows from these choices in closed form.

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
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_array, finite_arrays, whole_number

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
