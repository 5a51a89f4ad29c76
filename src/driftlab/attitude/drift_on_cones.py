"""Drift of an attitude algorithm on a coning motion, exact for a cone of any width.

Seen from axes that go round with the cone, all steps are the same rotation. So one step tells the
drift of all: no motion is integrated, and no angle has to be small.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_arrays
from driftlab.core.attitude import step_quaternions
from driftlab.core.coning import cone_increments
from driftlab.core.quaternion import cumulative_product, from_rotation_vector, multiply

from .coning_algorithms import AttitudeAlgorithm, attitude_algorithm


def coning_drift(
    algorithm: str | AttitudeAlgorithm,
    half_angle: ArrayLike,
    frequency: ArrayLike,
    sample_interval: ArrayLike,
) -> FloatArray:
    r"""Apparent drift about the axis of a cone.

    Parameters
    ----------
    algorithm : str or Algorithm or FunctionalIteration
        A key of `driftlab.attitude.ALGORITHMS`, or a custom algorithm.
    half_angle : array_like, shape (...)
        Half the opening angle of the cone, rad, at most pi in absolute value.
    frequency : array_like, shape (...)
        Frequency of the coning motion, Hz; negative for the opposite sense.
    sample_interval : array_like, shape (...)
        Interval of one increment, s.

    Returns
    -------
    ndarray, shape (...)
        rad/s, positive about the axis of the cone. It changes sign with the frequency: an algorithm
        that corrects too little drifts against the sense of the coning motion.

    Raises
    ------
    ValueError
        If an interval is not positive, a half angle is larger than pi, or an increment is a whole
        turn, where the vector k is infinite.

    Notes
    -----
    Let Z be the rotation about the cone's axis by the angle X that the cone goes round in a step
    (for functional iteration in a window, whose steps belong together),
    and q the algorithm's quaternion of the step that begins at phase zero. The step after it is
    Z q Z*, and so on, so that n steps make (q Z)^n Z*^n. A perfect algorithm has a q Z that turns
    by X; what another q Z turns more or less, divided by the time of the step, is the drift.
    Chapter 06. Rounding leaves some 1e-16 rad a step. The axis of q Z, about which the error piles
    up, is that of the cone but for the error of one step: with few samples a round of a wide cone
    it leans by some degrees and more. A drift of more than half a turn a step is told apart from
    one the other way by nothing, and comes out between -pi and pi a step.

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
    if (np.abs(angle) > np.pi).any():
        raise ValueError(f"half_angle: expected at most pi rad, got {np.abs(angle).max():g}.")
    x = 2 * np.pi * rate * interval
    places = np.arange(chosen.window) - chosen.memory + 0.5
    sample = x[..., np.newaxis]
    increments = cone_increments(angle[..., np.newaxis], sample, sample * places)
    step = increments[..., chosen.memory : chosen.memory + chosen.samples, :]
    turned = np.linalg.norm(step.sum(axis=-2), axis=-1)
    if chosen.last_stage != "rotation vector" and (turned >= 2 * np.pi).any():
        raise ValueError(
            "half_angle, frequency, sample_interval: expected less than a whole turn a step, where "
            f"the vector k is infinite, got {turned.max():.3g} rad."
        )
    steps = step_quaternions(chosen, increments, past=chosen.memory)
    # One step, or all of a window that is computed as a whole.
    count = chosen.window - chosen.memory
    turned_in_all = cumulative_product(steps)[..., -1, :]
    return step_drift(turned_in_all, angle, count * x) / (count * interval)


def step_drift(step: FloatArray, half_angle: FloatArray, step_angle: FloatArray) -> FloatArray:
    """Drift of one step about the cone's axis, rad, from the step's quaternion.

    Parameters
    ----------
    step : ndarray, shape (..., 4)
        Computed rotation over the step that begins at phase zero, of length one.
    half_angle, step_angle : ndarray, shape (...)
        Of the cone, and how far it goes round in the step; rad.

    Returns
    -------
    ndarray, shape (...)

    Examples
    --------
    A computer that always says the same does not drift; the body comes back as well:

    >>> float(step_drift(np.array([0.0, 0.0, 0.0, 1.0]), np.array(0.1), np.array(0.2)).round(6))
    0.0
    """
    axis = np.stack([np.zeros_like(step_angle), np.zeros_like(step_angle), step_angle], axis=-1)
    turned = multiply(step, from_rotation_vector(axis))
    # The cone's axis in the body at phase zero, where the body leans about its first axis.
    along = np.sin(half_angle) * turned[..., 1] + np.cos(half_angle) * turned[..., 2]
    sine = np.copysign(np.linalg.norm(turned[..., :3], axis=-1), along)
    cosine = turned[..., 3]
    expected_sine, expected_cosine = np.sin(step_angle / 2), np.cos(step_angle / 2)
    # The difference of two half angles, without taking either.
    half = np.arctan2(
        sine * expected_cosine - cosine * expected_sine,
        cosine * expected_cosine + sine * expected_sine,
    )
    return np.remainder(2 * half + np.pi, 2 * np.pi) - np.pi
