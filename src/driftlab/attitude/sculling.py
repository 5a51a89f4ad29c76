"""Sculling: what velocity increments lose while the body turns, by the weights of coning.

Where a body swings about one axis and is shaken along another at the same frequency, a part of the
force does not average out. The correction is the coning correction with one increment of angle in
each product replaced by one of velocity (Savage 1998).
"""

from __future__ import annotations

from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_array, finite_arrays
from driftlab.core import sculling as core
from driftlab.core.coning import ConingSteps

from .coning_algorithms import Algorithm, _coning_algorithm


def sculling_correction(
    angle: ArrayLike, velocity: ArrayLike, algorithm: str | Algorithm = "two-step-4"
) -> FloatArray:
    """Sculling correction of each step: half the integral of γ×a + v×ω, from increments.

    Parameters
    ----------
    angle, velocity : array_like, shape (..., n, 3)
        Integrals of the rate, rad, and of the specific force, m/s, over equal intervals.
    algorithm : str or Algorithm
        One without memory; its weights of the coning correction are taken.

    Returns
    -------
    ndarray, shape (..., n // samples, 3)
        m/s, body axes at the start of each step.

    Raises
    ------
    ValueError
        If the algorithm has a memory, or the increments do not make whole steps.

    Examples
    --------
    A turn about the first axis, then a push along the second:

    >>> sculling_correction([[0.01, 0, 0], [0, 0, 0]], [[0, 0, 0], [0, 0.3, 0]]).round(6)
    array([[0.   , 0.   , 0.002]])
    """
    return core.sculling_correction(*_checked(angle, velocity, algorithm))


def step_velocities(
    angle: ArrayLike, velocity: ArrayLike, algorithm: str | Algorithm = "two-step-4"
) -> FloatArray:
    """Velocity that a body gains in each step, with the rotation and the sculling correction.

    This is what `driftlab.strapdown.navigate` adds up, with `two-step-4`.

    Parameters
    ----------
    angle, velocity : array_like, shape (..., n, 3)
        Integrals of the rate, rad, and of the specific force, m/s, over equal intervals.
    algorithm : str or Algorithm
        One without memory.

    Returns
    -------
    ndarray, shape (..., n // samples, 3)
        m/s, body axes at the start of each step.

    Raises
    ------
    ValueError
        If the algorithm has a memory, or the increments do not make whole steps.

    Examples
    --------
    A constant force along the first axis of a body that turns about its third:

    >>> step_velocities([[0, 0, 0.05], [0, 0, 0.05]], [[1, 0, 0], [1, 0, 0]]).round(4)
    array([[1.9967, 0.0999, 0.    ]])
    """
    return core.velocity_of_steps(*_checked(angle, velocity, algorithm))


def _checked(
    angle: ArrayLike, velocity: ArrayLike, algorithm: str | Algorithm
) -> tuple[ConingSteps, FloatArray, FloatArray]:
    chosen = _coning_algorithm(algorithm)
    if chosen.memory:
        raise ValueError(f"algorithm: expected one without memory, got {chosen.name}.")
    angles, velocities = finite_array(angle, "angle", 3), finite_array(velocity, "velocity", 3)
    count = angles.shape[-2] if angles.ndim > 1 else 0
    if not count or count % chosen.samples:
        raise ValueError(
            f"angle: expected shape (..., n, 3) with n a multiple of {chosen.samples} for "
            f"{chosen.name}, got shape {angles.shape}."
        )
    finite_arrays(angle=(angles, count, 3), velocity=(velocities, count, 3))
    return chosen.steps, angles, velocities
