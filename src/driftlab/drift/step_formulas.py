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

from driftlab.checks import FloatArray, finite_array, one_of
from driftlab.core.loops import cumulative_product
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


def step_formula(name: str) -> StepFormula:
    """Return the step formula of a given name.

    Parameters
    ----------
    name : str
        A key of `STEP_FORMULAS`.

    Returns
    -------
    callable
        Function from rotation vectors (..., 3), rad, to quaternions (..., 4), not of unit norm in
        general.

    Raises
    ------
    ValueError
        If the name is not known; the sentence lists the known names.

    Examples
    --------
    A step of 1 rad about the third axis, as an angle:

    >>> for name in ("exact", "taylor-1", "pade"):
    ...     step = step_formula(name)([0.0, 0.0, 1.0])
    ...     print(f"{name:8} {2 * np.arctan2(step[2], step[3]):.6f}")
    exact    1.000000
    taylor-1 0.927295
    pade     0.998693
    """
    one_of(name, STEP_FORMULAS, "name")
    return STEP_FORMULAS[name]


def integrate_steps(increments: ArrayLike, name: str = "exact") -> FloatArray:
    """Rotation over a whole row of increments, each of them taken as one step at constant rate.

    Parameters
    ----------
    increments : array_like, shape (..., n, 3)
        Integrals of the body rate over equal intervals, rad.
    name : str
        A key of `STEP_FORMULAS`.

    Returns
    -------
    ndarray, shape (..., 4)
        Unit quaternions: body axes at the end to those at the beginning.

    Examples
    --------
    >>> integrate_steps(np.tile([0.0, 0.0, 0.01], (100, 1))).round(6)
    array([0.      , 0.      , 0.479426, 0.877583])
    """
    rows = finite_array(increments, "increments", 3)
    if rows.ndim < 2:
        raise ValueError(f"increments: expected shape (..., n, 3), got shape {rows.shape}.")
    steps = step_formula(name)(rows)
    # To unit norm, or the norms of many steps would multiply up to overflow.
    steps /= np.linalg.norm(steps, axis=-1, keepdims=True)
    return cumulative_product(steps)[..., -1, :]
