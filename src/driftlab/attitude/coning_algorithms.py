"""Attitude algorithms as data; Perelyaev & Chelnokov, section 2, reconstructed.

An integrating gyro delivers gamma, the integral of its rate, once a sample. Where the rate changes
direction within a step, the rotation over the step is not gamma: it differs by the *coning
correction*, which can be estimated from cross products of neighbouring increments. An algorithm
here is three choices: how many increments make a step, how the correction is estimated, and its
last stage: how corrected gamma becomes a quaternion.

The copy of the paper at hand ends where section 2 begins. The algorithms below are derived in
chapter 07: `one-step-3`, `two-step-3` and `two-step-4` after the properties that the abstract
announces, `picard-1` and `memory-4` beside them. They are a reconstruction and need not be the
authors' own forms. The two rotation-vector algorithms are the usual alternative; the weights for
three samples are Miller's (1983).

In the names, the last number is the global order, except that `picard-1` is the first iterate and
that the two rotation-vector algorithms count their samples. Wherever a name is taken, an
`Algorithm` and one's own function as in `own_algorithms` are taken as well.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from operator import itemgetter
from types import MappingProxyType
from typing import Literal, get_args

import numpy as np

from driftlab.checks import finite_array, keep, one_of, shown, whole_number
from driftlab.core.coning import ConingSteps

from .functional_iteration import FunctionalIteration
from .own_algorithms import OwnAlgorithm

Weights = Mapping[tuple[int, int], float]
"""Weights of the cross products g_i × g_j, keyed by places i < j in a row of increments."""

LastStage = Literal[
    "first iterate", "second iterate", "third iterate", "tangent", "rotation vector"
]


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
    last_stage : {"first iterate", "second iterate", "third iterate", "tangent", "rotation vector"}
        How the step's quaternion is made of its sum gamma and of f, which is gamma with the coning
        correction. The first four go by the Cayley vector k: the terms of a Picard iterate that
        its order needs (the third has f and the cube of gamma), or the first two terms of
        -tan(|f|/4) f/|f|. ``"rotation vector"`` takes f for the rotation vector.
    order : int
        Global order on a motion without symmetries: the error at a given time shrinks with this
        power of the step.
    starts : tuple of Mapping
        For algorithms with memory: the weights of the first steps, which use the increments that
        follow; place 0 is the very first increment.

    Examples
    --------
    Without and with a coning correction: drift in rad/s on a cone of 0.01 rad at 5 Hz, sampled at
    100 Hz.

    >>> from driftlab.attitude import coning_drift
    >>> plain = Algorithm("plain", samples=2, memory=0, coning={}, last_stage="tangent", order=2)
    >>> [f"{coning_drift(algorithm, 0.01, 5.0, 0.01):.1e}" for algorithm in (plain, "two-step-4")]
    ['-1.0e-04', '-5.0e-07']
    """

    name: str
    samples: int
    memory: int
    coning: Weights = field(hash=False)
    last_stage: LastStage
    order: int
    starts: tuple[Weights, ...] = field(default=(), hash=False)

    def __post_init__(self) -> None:
        keep(
            self,
            samples=whole_number(self.samples, "samples"),
            memory=whole_number(self.memory, "memory", least=0),
            order=whole_number(self.order, "order"),
        )
        if self.memory and self.samples > 1:
            raise ValueError(f"memory: expected 0 with several samples a step, got {self.memory}.")
        if not isinstance(self.starts, tuple | list):
            raise ValueError(f"starts: expected a tuple of weights, got {shown(self.starts)}.")
        if len(self.starts) != self.memory:
            raise ValueError(
                f"starts: expected one for each of {self.memory} increments of memory, "
                f"got {len(self.starts)}."
            )
        one_of(self.last_stage, get_args(LastStage), "last_stage")
        for weights in (self.coning, *self.starts):
            if not isinstance(weights, Mapping) or not all(
                isinstance(pair, tuple) and len(pair) == 2 for pair in weights
            ):
                raise ValueError(
                    "coning: expected weights of pairs of places such as {(0, 1): 2 / 3}, "
                    f"got {shown(weights)}."
                )
            if weights:
                finite_array(list(weights.values()), "coning")
            for i, j in weights:
                if not 0 <= i < j < self.window:
                    raise ValueError(
                        f"coning: expected places 0 <= i < j < {self.window}, got {(i, j)}."
                    )
        keep(self, coning=_kept(self.coning), starts=tuple(map(_kept, self.starts)))

    def __reduce__(self) -> tuple[type[Algorithm], tuple[object, ...]]:
        # Weights that nobody can change cannot be copied as they are.
        rest = self.last_stage, self.order, tuple(map(dict, self.starts))
        return Algorithm, (self.name, self.samples, self.memory, dict(self.coning), *rest)

    @property
    def window(self) -> int:
        """Number of increments that one step uses: samples plus memory."""
        return self.samples + self.memory

    @cached_property
    def steps(self) -> ConingSteps:
        """The same in arrays, for `driftlab.core`."""
        given = (self.coning, *self.starts)
        pairs = sorted(dict.fromkeys(pair for each in given for pair in each), key=itemgetter(1))
        weights = np.array([[each.get(pair, 0.0) for pair in pairs] for each in given])
        places = np.array(pairs, np.int64).reshape(-1, 2)
        for array in (weights, places):
            array.setflags(write=False)
        return ConingSteps(
            self.samples, self.memory, self.last_stage, places, weights[0], weights[1:]
        )


def _kept(weights: Weights) -> Weights:
    """The same weights in double precision, which nobody can change."""
    return MappingProxyType({(int(i), int(j)): float(w) for (i, j), w in weights.items()})


CONING_ALGORITHMS: Mapping[str, Algorithm] = MappingProxyType(
    {
        algorithm.name: algorithm
        for algorithm in (
            Algorithm("picard-1", 1, 0, {}, "first iterate", 2),
            Algorithm(
                "one-step-3", 1, 1, {(0, 1): 1 / 12}, "tangent", 3, starts=({(0, 1): 1 / 12},)
            ),
            Algorithm("two-step-3", 2, 0, {(0, 1): 2 / 3}, "second iterate", 3),
            Algorithm("two-step-4", 2, 0, {(0, 1): 2 / 3}, "tangent", 4),
            Algorithm(
                "memory-4",
                1,
                2,
                {(1, 2): 1 / 6, (0, 2): -1 / 24},
                "tangent",
                4,
                # The mirror image of the formula, then the one with a neighbour on either side.
                starts=({(0, 1): 1 / 6, (0, 2): -1 / 24}, {(0, 1): 1 / 24, (1, 2): 1 / 24}),
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
"""Algorithms with cross products by name, in the order of the tables of chapter 07."""

AttitudeAlgorithm = Algorithm | FunctionalIteration
AnyAlgorithm = str | AttitudeAlgorithm | OwnAlgorithm
"""What may stand for an algorithm: a key of `ALGORITHMS`, an algorithm, or one's own function."""

ALGORITHMS: Mapping[str, AttitudeAlgorithm] = MappingProxyType(
    {**CONING_ALGORITHMS, "functional-iteration": FunctionalIteration("functional-iteration")}
)
"""All algorithms by name: those with cross products, and functional iteration."""


def checked_algorithm(
    algorithm: AnyAlgorithm, argument: str = "algorithm"
) -> AttitudeAlgorithm | OwnAlgorithm:
    """Return the algorithm of that name in `ALGORITHMS`, or an algorithm or function unchanged."""
    if isinstance(algorithm, AttitudeAlgorithm):
        return algorithm
    # A class can be called too, but what it makes is no attitude.
    if callable(algorithm) and not isinstance(algorithm, type):
        return algorithm
    if not isinstance(algorithm, str) or algorithm not in ALGORITHMS:
        raise ValueError(
            f"{argument}: expected one of {', '.join(ALGORITHMS)}, an Algorithm or a function of "
            f"increments, got {shown(algorithm)}."
        )
    return ALGORITHMS[algorithm]


def _coning_algorithm(algorithm: AnyAlgorithm) -> Algorithm:
    """The algorithm with cross products of that name, or such an algorithm itself."""
    chosen = checked_algorithm(algorithm)
    if isinstance(chosen, FunctionalIteration):
        raise ValueError(f"algorithm: expected one with cross products, got {chosen.name}.")
    if not isinstance(chosen, Algorithm):
        raise ValueError(
            "algorithm: expected one with cross products whose weights can be read, got a "
            "function; write it as an Algorithm."
        )
    return chosen
