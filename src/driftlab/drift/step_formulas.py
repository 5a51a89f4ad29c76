"""One integration step of the kinematic equation at constant rate, exact and approximate.

Each formula maps the rotation vector phi n = rate * step (..., 3) to a quaternion (..., 4)
proportional to that of the step's rotation. All keep the axis n and differ only in the tangent of
the half angle; with the angle phi of the step the exact one is tan(phi/2). The quaternion need not
be of unit norm: its direction is the rotation.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_array
from driftlab.quaternion import from_rotation_vector

StepFormula = Callable[[ArrayLike], FloatArray]


def _polynomial_step(vector_factors: list[float], scalar_factors: list[float]) -> StepFormula:
    """Step with vector part phi n/2 times one polynomial in phi^2, scalar part another."""

    def step(rotation_vector: ArrayLike) -> FloatArray:
        turn = finite_array(rotation_vector, "rotation_vector", 3)
        phi_squared = np.einsum("...i,...i->...", turn, turn)[..., np.newaxis]
        vector = 0.5 * turn * np.polynomial.polynomial.polyval(phi_squared, vector_factors)
        return np.concatenate(
            [vector, np.polynomial.polynomial.polyval(phi_squared, scalar_factors)], axis=-1
        )

    return step


STEP_FORMULAS: Mapping[str, StepFormula] = MappingProxyType(
    {
        "exact": from_rotation_vector,
        # Taylor's series of exp(phi n/2), cut off after the named power of phi. The first is also
        # the Cayley transform of the 3x3 rotation matrix, tan(angle/2) = phi/2.
        "taylor-1": _polynomial_step([1], [1]),
        "taylor-2": _polynomial_step([1], [1, -1 / 8]),
        "taylor-3": _polynomial_step([1, -1 / 24], [1, -1 / 8]),
        "taylor-4": _polynomial_step([1, -1 / 24], [1, -1 / 8, 1 / 384]),
        # Kutta and Merson's five stages, of fourth order: one more term, not quite Taylor's.
        "kutta-merson": _polynomial_step([1, -1 / 24, 1 / 2304], [1, -1 / 8, 1 / 384]),
        # Cayley transform of the 4x4 quaternion matrix, tan(angle/4) = phi/4.
        "cayley": _polynomial_step([1], [1, -1 / 16]),
        # Diagonal [2/2] Pade approximant of the 3x3 rotation matrix: (1 + X/2 + X^2/12) over the
        # same with -X; angle error -phi^5/720 a step.
        "pade": _polynomial_step([1], [1, -1 / 12]),
        # The same approximant of the 4x4 quaternion matrix; angle error -phi^5/11520 a step.
        "pade-half": _polynomial_step([1, -1 / 48], [1, -5 / 48, 1 / 2304]),
    }
)
"""Step formulas by name. At constant rate the classical Runge-Kutta method is "taylor-4"."""
