"""Attitude by functional iteration: Picard's idea without an end at a power of the step.

The algorithms of `coning_algorithms` keep of Picard's iterates what their order needs. Here nothing
is cut off. A window of increments determines a polynomial for the rate, and the linear equation of
the quaternion is iterated with it until nothing changes but the last digits. The error left is that
of the polynomial; inside a window of few increments that turns by more than two whole turns also
that of the nodes, 5e-8 rad and less.

The method is Wu's, with Legendre's polynomials and the nodes of a Gauss rule instead of Chebyshev's
polynomials and their truncation; see chapter 18.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from driftlab.checks import keep, whole_number
from driftlab.core.functional_iteration import WindowSteps

WIDEST = 20
"""Increments in a window at most. A polynomial through equally spaced data magnifies their errors
by nearly two with each increment more; from here on the rounding shows."""


@dataclass(frozen=True)
class FunctionalIteration:
    """An attitude algorithm that fits the rate over a window and iterates the quaternion.

    It gives the attitude after each increment. As it looks ahead within a window, in real time it
    is late by a window.

    Attributes
    ----------
    name : str
        As it appears in error messages.
    window : int
        Number N of increments that a polynomial of degree N - 1 is fitted to; 20 at most.
    iterations : int, optional
        How often to iterate from the constant quaternion; by default until it settles. Where the
        fitted rate turns by theta in a window, to and fro counted in full, iterate j errs by
        (theta/2)^(j+1)/(j+1)! at most.
    samples, memory : int
        One increment makes a step, and none is needed before the first.
    last_stage : str
        ``"functional iteration"``.

    References
    ----------
    - Y. Wu and others, *Fast RodFIter for attitude reconstruction from inertial measurements*,
      arXiv:1808.03817, 2018.
    - Y. Wu, G. Yan, *Attitude reconstruction from inertial measurements: QuatFIter and its
      comparison with RodFIter*, arXiv:1901.03468, 2019.

    Examples
    --------
    Drift in rad/s on a cone of 0.2 rad at 5 Hz, sampled at 100 Hz:

    >>> from driftlab.attitude import coning_drift
    >>> own = FunctionalIteration("own", window=8)
    >>> [f"{coning_drift(algorithm, 0.2, 5.0, 0.01):.0e}" for algorithm in ("two-step-4", own)]
    ['-2e-04', '5e-08']
    """

    name: str
    window: int = 12
    iterations: int | None = None
    samples: ClassVar[int] = 1
    memory: ClassVar[int] = 0
    last_stage: ClassVar[Literal["functional iteration"]] = "functional iteration"

    def __post_init__(self) -> None:
        keep(self, window=whole_number(self.window, "window"))
        if self.window > WIDEST:
            raise ValueError(f"window: expected at most {WIDEST} increments, got {self.window}.")
        if self.iterations is not None:
            keep(self, iterations=whole_number(self.iterations, "iterations"))

    @property
    def order(self) -> int:
        """Global order on a motion without symmetries, if iterated until it settles."""
        # For an even number of increments the error is odd about the middle of the window.
        return self.window + 2 - self.window % 2

    @property
    def steps(self) -> WindowSteps:
        """The same as numbers, for `driftlab.core`."""
        return WindowSteps(self.window, self.iterations)
