"""Sculling: what velocity increments lose while the body turns, by the weights of coning.

Where a body swings about one axis and is shaken along another at the same frequency, the push that
the accelerometers sum up points another way at each moment, and a part of it does not average out.
The correction is the coning correction with one increment of angle in each product replaced by one
of velocity (Savage 1998).
"""

from __future__ import annotations

from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_array, finite_arrays
from driftlab.core import sculling as core
from driftlab.core.coning import ConingSteps

from .coning_algorithms import Algorithm, coning_algorithm


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
    A quarter turn about the third axis while a constant force acts along the body's first: the
    chord of a quarter of a circle, 2/pi of the push along each of the two axes.

    >>> import numpy as np
    >>> from driftlab.attitude import integrate
    >>> from driftlab.quaternion import rotate
    >>> turn, push = np.tile([0, 0, np.pi / 400], (200, 1)), np.tile([1 / 200, 0, 0], (200, 1))
    >>> before = np.concatenate([[[0, 0, 0, 1]], integrate(turn)[:-1]])
    >>> rotate(before, step_velocities(turn, push)).sum(axis=0).round(6)
    array([0.63662, 0.63662, 0.     ])
    """
    return core.velocity_of_steps(*_checked(angle, velocity, algorithm))


def _checked(
    angle: ArrayLike, velocity: ArrayLike, algorithm: str | Algorithm
) -> tuple[ConingSteps, FloatArray, FloatArray]:
    chosen = coning_algorithm(algorithm)
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
