"""Perelyaev & Chelnokov, section 2, reconstructed: attitude algorithms as data.

An integrating gyro delivers gamma, the integral of its rate, once a sample. Where the rate changes
direction within a step, the rotation over the step is not gamma: it differs by the *coning
correction*, which can be estimated from cross products of neighbouring increments. An algorithm
here is three choices: how many increments make a step, how the correction is estimated, and how
corrected gamma becomes a quaternion. Its error on a small cone follows from them in closed form.

The copy of the paper at hand ends where section 2 begins. The algorithms below are derived in
chapter 06 from what is left: `one-step-3`, `two-step-3` and `two-step-4` after the properties that
the abstract announces, `picard-1` and `memory-4` beside them. They are a reconstruction and need
not be the authors' own forms. The two rotation-vector algorithms are the usual alternative; the
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
"""Weights of the cross products g_i × g_j, keyed by places i < j in a row of increments."""

Iterate = Literal["first", "second", "third", "rotation vector"]


@dataclass(frozen=True)
class Algorithm:
    """An attitude algorithm: how angle increments become the rotation over a step.

    Attributes
    ----------
    name : str
        As it appears in error messages.
    samples : int
        Number of increments that make one step.
    memory : int
        Number of increments before the step that are used as well.
    coning : Mapping
        Weights of the coning correction; place 0 is the oldest increment of the memory.
    iterate : {"first", "second", "third", "rotation vector"}
        Picard iterate from which the Cayley vector k of the step is taken, or ``"rotation vector"``
        to use the rotation vector in place of k.
    order : int
        Global order on a motion without symmetries: the error at a given time shrinks with this
        power of the step. Derived in chapter 06.
    starts : tuple of Mapping
        For algorithms with memory: the weights of the first steps, which have no increments before
        them. They use the increments that follow; place 0 is the very first increment.

    Examples
    --------
    A two-sample algorithm without coning correction, beside one that has it: drift in rad/s on a
    cone of 0.01 rad at 5 Hz, sampled at 100 Hz.

    >>> plain = Algorithm("plain", samples=2, memory=0, coning={}, iterate="third", order=2)
    >>> [f"{coning_drift(algorithm, 0.01, 5.0, 0.01):.1e}" for algorithm in (plain, "two-step-4")]
    ['-1.0e-04', '-5.0e-07']
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
        """Number of increments that one step uses.

        Returns
        -------
        int
            Samples plus memory.

        Examples
        --------
        >>> ALGORITHMS["memory-4"].window
        3
        """
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
    """Return an algorithm by its name, or an algorithm itself.

    Parameters
    ----------
    algorithm : str or Algorithm
        A key of `ALGORITHMS`, or a custom algorithm.

    Returns
    -------
    Algorithm
        The one of that name, or `algorithm` unchanged.

    Raises
    ------
    ValueError
        If the name is unknown.

    Examples
    --------
    >>> attitude_algorithm("rotation-vector-3").samples
    3
    """
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
    r"""Apparent drift about the axis of a small cone, in closed form.

    Parameters
    ----------
    algorithm : str or Algorithm
        A key of `ALGORITHMS`, or a custom algorithm.
    half_angle : array_like, shape (...)
        Half the opening angle of the cone, rad; terms of its fourth power are neglected.
    frequency : array_like, shape (...)
        Frequency of the coning motion, Hz; negative for the opposite sense.
    sample_interval : array_like, shape (...)
        Interval of one increment, s.

    Returns
    -------
    ndarray, shape (...)
        rad/s, positive about the axis of the cone. It changes sign with the frequency: an algorithm
        that corrects too little drifts against the sense of the coning motion.

    Notes
    -----
    Let x = 2 pi f h be the coning angle of one interval h, a the half-angle of the cone, m the
    number of intervals in a step and w_ij the weights of the algorithm. The drift is the estimated
    minus the true coning correction over a step, divided by the time of the step:

    .. math:: \frac{\sin^2 a}{m h} \Bigl(\sum_{i<j} 4 w_{ij} \sin^2\tfrac{x}{2} \sin((j - i) x)
              - \tfrac{1}{2} (m x - \sin m x)\Bigr)

    Derived in chapter 06. The two terms nearly cancel when x is small: rounding leaves an error of
    about 1e-16 m x sin(a)^2 in the drift of a step.

    Examples
    --------
    Degrees per hour on a cone of half a degree at 10 Hz, sampled at 100 Hz:

    >>> for name in ("picard-1", "two-step-4", "rotation-vector-3"):
    ...     drift = coning_drift(name, np.radians(0.5), 10.0, 0.01)
    ...     print(f"{name}: {np.degrees(drift) * 3600:.2f}")
    picard-1: -31.83
    two-step-4: -2.45
    rotation-vector-3: -0.20
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
