"""Drift of an attitude algorithm on a coning motion, exact for a cone of any width.

Seen from axes that go round with the cone, all steps are the same rotation. So one step tells the
drift of all: no motion is integrated, and no angle has to be small. `measured_drift` has what an
algorithm makes of many steps, whether they are alike or not. Where an error swings by half a turn
and more within a step, as it may with a few samples a round of a wide cone, neither is a drift, and
both refuse.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_arrays
from driftlab.core.attitude import step_quaternions
from driftlab.core.coning import cone_increments
from driftlab.core.loops import cumulative_product
from driftlab.core.quaternion import from_rotation_vector, multiply, to_rotation_vector
from driftlab.core.vectors import norms

from ._swing import half_a_turn, largest_change
from .coning_algorithms import AnyAlgorithm, AttitudeAlgorithm, attitude_algorithm
from .own_algorithms import OwnAlgorithm, own_steps

OWN_ROWS = 840
"""Increments of a cone that one's own function is given: whole steps of one to eight samples."""
_WHOLE_ROUNDS = 1e-3
"""rad: how near to whole rounds a period is taken for some."""


def coning_drift(
    algorithm: AnyAlgorithm,
    half_angle: ArrayLike,
    frequency: ArrayLike,
    sample_interval: ArrayLike,
) -> FloatArray:
    r"""Apparent drift about the axis of a cone.

    Parameters
    ----------
    algorithm : str or Algorithm or FunctionalIteration or callable
        A key of `driftlab.attitude.ALGORITHMS`, a custom algorithm, or one's own function as in
        `driftlab.attitude.own_algorithms`.
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
        turn, where the vector k is infinite. If the error about the cone's axis may change by half
        a turn or more within a step, and nothing tells which way. If one's own function makes steps
        that do not come again to the digits of double precision, as one that smooths over a whole
        record or computes in single precision; `measured_coning_drift` has its drift.

    See Also
    --------
    measured_coning_drift : The same by running the algorithm.
    driftlab.attitude.integrate : The attitude itself.

    Notes
    -----
    Let Z be the rotation about the cone's axis by the angle X that the cone goes round in a step
    (for functional iteration in a window, whose steps belong together),
    and q the algorithm's quaternion of the step that begins at phase zero. The step after it is
    Z q Z*, and so on, so that n steps make (q Z)^n Z*^n. A perfect algorithm has a q Z that turns
    by X; what another q Z turns more or less, divided by the time of the step, is the drift.
    Chapter 06. Rounding leaves some 1e-16 rad a step.

    The axis of q Z, about which the error piles up, is that of the cone but for the error of one
    step: with few samples a round of a wide cone it leans by some degrees and more. Let it lean by
    l, let q Z turn by 2 h, and K = tan^2(l/2). The error about the cone's axis then wobbles, and
    within a step grows by the drift of a step and something from
    -4 arctan(K sin h/(1 + K cos h)) to 4 arctan(K sin h/(1 - K cos h)). Where this reaches half a
    turn, the number is refused. A drift that is itself of more than half a turn a step is told
    apart from one the other way by nothing, and comes out between -pi and pi a step.

    Steps that make whole rounds may pile up an error about any axis, as a constant drift of the
    body does. Of one's own function the drift is then the part of this error about the cone's axis,
    as long as `OWN_ROWS` increments make less than half a turn of it. A step or a window of a named
    algorithm that by itself makes whole rounds keeps all of its error.

    One's own function is given `OWN_ROWS` increments. The last of its steps are turned back and
    compared, and the smallest number of them that repeats, but for the rounding of double
    precision, stands for the step; what a memory makes of the start is forgotten by then.

    References
    ----------
    - Goodman, Robinson, *Effect of finite rotations on gyroscopic sensing devices*, Journal of
      Applied Mechanics 25(2), 1958.
    - R. B. Miller, *A new strapdown attitude algorithm*, Journal of Guidance, Control, and Dynamics
      6(4), 1983.
    - M. B. Ignagni, *Efficient class of optimized coning compensation algorithms*, Journal of
      Guidance, Control, and Dynamics 19(2), 1996.
    - P. G. Savage, *Strapdown inertial navigation integration algorithm design, part 1: Attitude
      algorithms*, Journal of Guidance, Control, and Dynamics 21(1), 1998.

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
    angle, x, interval = checked_cone(half_angle, frequency, sample_interval)
    if isinstance(chosen, AttitudeAlgorithm):
        return _drift_of_step(chosen, angle, x) / interval
    shape = np.broadcast_shapes(angle.shape, x.shape)
    cases = zip(*(np.broadcast_to(a, shape).ravel() for a in (angle, x)), strict=True)
    drifts = np.reshape([_drift_of_own(chosen, *case) for case in cases], shape)
    return (drifts / interval)[()]


def checked_cone(
    half_angle: ArrayLike, frequency: ArrayLike, sample_interval: ArrayLike
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the half angle of a cone, the angle it turns in one sample, and the sample interval.

    The angles are in rad, the frequency in Hz, the interval in s. An interval that is not
    positive and a half angle above pi are refused.
    """
    angle, rate, interval = finite_arrays(
        half_angle=(half_angle,), frequency=(frequency,), sample_interval=(sample_interval,)
    )
    if (interval <= 0).any():
        raise ValueError(f"sample_interval: expected positive times, got {interval.min():g}.")
    if (np.abs(angle) > np.pi).any():
        raise ValueError(f"half_angle: expected at most pi rad, got {np.abs(angle).max():g}.")
    return angle, np.asarray(2 * np.pi * rate * interval), interval


def _drift_of_step(chosen: AttitudeAlgorithm, angle: FloatArray, x: FloatArray) -> FloatArray:
    """Drift of a sample (...), rad, from one step; `x` is how far the cone goes round in it."""
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
    steps = step_quaternions(chosen.steps, increments, past=chosen.memory)
    # One step, or all of a window that is computed as a whole.
    count = chosen.window - chosen.memory
    turned_in_all = cumulative_product(steps)[..., -1, :]
    return _settled_drift(turned_in_all, angle, count * x) / count


def _drift_of_own(function: OwnAlgorithm, half_angle: FloatArray, x: FloatArray) -> float:
    """Drift of a sample, rad, from the steps of one's own function that repeat."""
    phases = x * (np.arange(OWN_ROWS) + 0.5)
    steps = own_steps(function, cone_increments(half_angle, x, phases))
    samples = OWN_ROWS // len(steps)
    # Turned back about the cone's axis, to what they would be had they begun at phase zero.
    cosine, sine = (f(x * samples * np.arange(len(steps))) for f in (np.cos, np.sin))
    alike = steps.copy()
    alike[:, 0] = cosine * steps[:, 0] + sine * steps[:, 1]
    alike[:, 1] = cosine * steps[:, 1] - sine * steps[:, 0]
    late = alike[len(alike) // 2 :]
    apart = [np.abs(late[p:] - late[:-p]).max() for p in range(1, len(late) // 2 + 1)]
    # Phases of so many rad are rounded, and attitudes that are products of so many steps.
    rounding = 4 * float(np.finfo(float).eps) * OWN_ROWS * (1 + abs(float(x)))
    if not apart or min(apart) > rounding:
        raise ValueError(
            "algorithm: expected steps that repeat as a cone goes round, to the digits of double "
            f"precision, got a function whose steps {_unlike(apart)}; measured_coning_drift runs "
            "it as it is."
        )
    period = 1 + int(np.argmax(np.array(apart) <= rounding))
    whole = period * samples
    first = len(steps) - period
    # Of all steps of a period, seen from the phase at which the first of them begins.
    back = np.array([0.0, 0.0, -x * samples * first])
    turn = from_rotation_vector(back)
    turned = cumulative_product(steps[first:])[-1]
    turned = multiply(multiply(turn, turned), turn * [-1, -1, -1, 1])
    by_part = _part_after_whole_rounds(turned, half_angle, whole * x, whole)
    if by_part is not None:
        return by_part / whole
    return float(_settled_drift(turned, half_angle, whole * x)) / whole


def _part_after_whole_rounds(
    turned: FloatArray, half_angle: FloatArray, around: FloatArray, samples: int
) -> float | None:
    """What is left about the cone's axis after whole rounds, rad, as long as it is little."""
    rounds = np.round(around / (2 * np.pi))
    left = around - 2 * np.pi * rounds
    if rounds == 0 or abs(left) > _WHOLE_ROUNDS:
        return None
    error = _error(turned, around)
    little = float(norms(error)) * OWN_ROWS < np.pi * samples
    return float(_along(error, half_angle) - left) if little else None


def _unlike(apart: list[float]) -> str:
    return f"differ by {min(apart):.1g} rad at least" if apart else "are too few to be compared"


def _settled_drift(step: FloatArray, half_angle: FloatArray, step_angle: FloatArray) -> FloatArray:
    """Drift of a step as of `step_drift`, refused where it is none."""
    turned = _error(step, step_angle)
    drift = step_drift(step, half_angle, step_angle)
    swings = largest_change(drift, norms(turned), _along(turned, half_angle))
    if (swings >= np.pi).any():
        raise half_a_turn(float(swings.max()))
    return drift


def _error(step: FloatArray, step_angle: FloatArray) -> FloatArray:
    """Rotation vector of a step and the turn of the cone after it: after whole rounds, of error."""
    axis = np.stack([np.zeros_like(step_angle), np.zeros_like(step_angle), step_angle], axis=-1)
    return to_rotation_vector(multiply(step, from_rotation_vector(axis)))


def _along(vector: FloatArray, half_angle: FloatArray) -> FloatArray:
    """Part about the cone's axis, in the body at phase zero, which leans about its first axis."""
    return np.asarray(np.sin(half_angle) * vector[..., 1] + np.cos(half_angle) * vector[..., 2])


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
    sine = np.copysign(np.linalg.norm(turned[..., :3], axis=-1), _along(turned, half_angle))
    cosine = turned[..., 3]
    expected_sine, expected_cosine = np.sin(step_angle / 2), np.cos(step_angle / 2)
    # The difference of two half angles, without taking either.
    half = np.arctan2(
        sine * expected_cosine - cosine * expected_sine,
        cosine * expected_cosine + sine * expected_sine,
    )
    return np.remainder(2 * half + np.pi, 2 * np.pi) - np.pi
