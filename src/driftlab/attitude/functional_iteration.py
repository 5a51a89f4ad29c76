"""Attitude by functional iteration: Picard's idea without an end at a power of the step.

The algorithms of `coning_algorithms` keep of Picard's iterates what their order needs. Here nothing
is cut off. A window of increments determines a polynomial for the rate, and the linear equation of
the quaternion is iterated with it until nothing changes but the last digits. What is left as an
error is that of the polynomial; inside a window of few increments that turns by more than two
whole turns also that of the nodes, 5e-8 rad and less.

The method is Wu's: RodFIter for the Rodrigues vector, QuatFIter for the quaternion (Y. Wu, G. Yan,
*Attitude reconstruction from inertial measurements: QuatFIter and its comparison with RodFIter*,
arXiv:1901.03468). The form is that of chapter 06: Legendre's polynomials and the nodes of a Gauss
rule in place of Chebyshev's polynomials and their truncation.
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
        Number N of increments that a polynomial of degree N - 1 is fitted to; `WIDEST` at most.
    iterations : int, optional
        How often to iterate from the constant quaternion; by default until it settles. Where the
        fitted rate turns by theta in a window, to and fro counted in full, iterate j errs by
        (theta/2)^(j+1)/(j+1)! at most.
    samples, memory : int
        One increment makes a step, and none is needed before the first. Of any algorithm.
    last_stage : str
        ``"functional iteration"``: tells the kind of algorithm.

    References
    ----------
    - Y. Wu and others, *Fast RodFIter for attitude reconstruction from inertial measurements*,
      arXiv:1808.03817, 2018.
    - Y. Wu, G. Yan, *Attitude reconstruction from inertial measurements: QuatFIter and its
      comparison with RodFIter*, arXiv:1901.03468, 2019.

    Examples
    --------
    Drift in degrees per hour on a cone of 10 degrees at 5 Hz, sampled at 100 Hz:

    >>> import numpy as np
    >>> from driftlab.attitude import coning_drift
    >>> own = FunctionalIteration("own", window=8)
    >>> for algorithm in ("two-step-4", own, "functional-iteration"):
    ...     drift = coning_drift(algorithm, np.radians(10.0), 5.0, 0.01)
    ...     print(f"{3600 * np.degrees(drift):9.5f}")
    -30.86446
      0.00834
      0.00004
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
        """Global order on a motion without symmetries, if iterated until it settles.

        Returns
        -------
        int
            N + 1, and N + 2 for an even N, where the error is odd about the middle of the window.

        Examples
        --------
        >>> FunctionalIteration("own", window=3).order, FunctionalIteration("own", window=4).order
        (4, 6)
        """
        return self.window + 2 - self.window % 2

    @property
    def steps(self) -> WindowSteps:
        """The same as numbers, for `driftlab.core`."""
        return WindowSteps(self.window, self.iterations)
