"""Drift of an attitude algorithm on a coning motion: by formula, and by running the algorithm.

Seen from axes that go round with the cone, all steps are the same rotation. So one step tells the
drift of all, exactly for a cone of any width: no motion is integrated. Where an error swings by
half a turn and more within a step, as it may with a few samples a round of a wide cone, there is no
drift, and both functions refuse.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_arrays, whole_number
from driftlab.core import attitude as core
from driftlab.core.coning import along_axis, cone_increments, step_drift
from driftlab.core.loops import cumulative_product
from driftlab.core.quaternion import (
    conjugate,
    from_rotation_vector,
    multiply,
    to_rotation_vector,
)
from driftlab.core.vectors import norms

from .coning_algorithms import AnyAlgorithm, AttitudeAlgorithm, checked_algorithm
from .integration import step_quaternions
from .own_algorithms import OwnAlgorithm, checked_steps

SIMULATED_STEPS = 60
"""Steps, or windows, over which a named algorithm is measured."""
_OWN_ROWS = 840
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
        a turn or more within a step. If one's own function makes steps that do not repeat to the
        digits of double precision; `simulated_coning_drift` has its drift.

    See Also
    --------
    simulated_coning_drift : The same by running the algorithm.
    driftlab.attitude.integrate : The attitude itself.

    Notes
    -----
    Let Z be the rotation about the cone's axis by the angle X that the cone goes round in a step
    (in a window, for functional iteration), and q the algorithm's quaternion of the step that
    begins at phase zero. The step after it is Z q Z*, so n steps make (q Z)^n Z*^n. A perfect q Z
    turns by X; what another turns more or less, divided by the time of the step, is the drift.
    Chapter 07. Rounding leaves some 1e-16 rad a step.

    The axis of q Z, about which the error piles up, leans from that of the cone by an angle l. Let
    q Z turn by 2 h, and K = tan^2(l/2). Within a step the error about the cone's axis grows by the
    drift of a step and something from -4 arctan(K sin h/(1 + K cos h)) to
    4 arctan(K sin h/(1 - K cos h)). Where this reaches half a turn, the number is refused. A drift
    of more than half a turn a step comes out between -pi and pi a step.

    One's own function is given 840 increments. The smallest number of its last steps that repeats
    stands for the step. Steps that make whole rounds may pile up an error about any axis, as a
    constant drift of the body does; of one's own function its part about the cone's axis counts.

    References
    ----------
    - Goodman, Robinson, *Effect of finite rotations on gyroscopic sensing devices*, Journal of
      Applied Mechanics 25(2), 1958.
    - R. B. Miller, *A new strapdown attitude algorithm*, Journal of Guidance, Control, and Dynamics
      6(4), 1983.

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
    chosen = checked_algorithm(algorithm)
    angle, x, interval = _checked_cone(half_angle, frequency, sample_interval)
    if isinstance(chosen, AttitudeAlgorithm):
        return _drift_of_step(chosen, angle, x) / interval
    shape = np.broadcast_shapes(angle.shape, x.shape)
    cases = zip(*(np.broadcast_to(a, shape).ravel() for a in (angle, x)), strict=True)
    drifts = np.reshape([_drift_of_own(chosen, *case) for case in cases], shape)
    return (drifts / interval)[()]


def _checked_cone(
    half_angle: ArrayLike, frequency: ArrayLike, sample_interval: ArrayLike
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Half angle of a cone, rad, the angle it goes round in a sample, rad, and the interval, s."""
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
    steps = core.step_quaternions(chosen.steps, increments, past=chosen.memory)
    # One step, or all of a window that is computed as a whole.
    count = chosen.window - chosen.memory
    turned_in_all = cumulative_product(steps)[..., -1, :]
    return _settled_drift(turned_in_all, angle, count * x) / count


def _drift_of_own(function: OwnAlgorithm, half_angle: FloatArray, x: FloatArray) -> float:
    """Drift of a sample, rad, from the steps of one's own function that repeat."""
    phases = x * (np.arange(_OWN_ROWS) + 0.5)
    steps = checked_steps(function, cone_increments(half_angle, x, phases))
    samples = _OWN_ROWS // len(steps)
    # Turned back about the cone's axis, to what they would be had they begun at phase zero.
    cosine, sine = (f(x * samples * np.arange(len(steps))) for f in (np.cos, np.sin))
    alike = steps.copy()
    alike[:, 0] = cosine * steps[:, 0] + sine * steps[:, 1]
    alike[:, 1] = cosine * steps[:, 1] - sine * steps[:, 0]
    late = alike[len(alike) // 2 :]
    apart = [np.abs(late[p:] - late[:-p]).max() for p in range(1, len(late) // 2 + 1)]
    # Phases of so many rad are rounded, and attitudes that are products of so many steps.
    rounding = 4 * float(np.finfo(float).eps) * _OWN_ROWS * (1 + abs(float(x)))
    if not apart or min(apart) > rounding:
        raise ValueError(
            "algorithm: expected steps that repeat as a cone goes round, to the digits of double "
            f"precision, got a function whose steps {_unlike(apart)}; simulated_coning_drift runs "
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
    little = float(norms(error)) * _OWN_ROWS < np.pi * samples
    return float(along_axis(error, half_angle) - left) if little else None


def _unlike(apart: list[float]) -> str:
    return f"differ by {min(apart):.1g} rad at least" if apart else "are too few to be compared"


def _settled_drift(step: FloatArray, half_angle: FloatArray, step_angle: FloatArray) -> FloatArray:
    """Drift of a step, refused where it is none."""
    turned = _error(step, step_angle)
    drift = step_drift(step, half_angle, step_angle)
    _refuse_half_a_turn(_largest_change(drift, norms(turned), along_axis(turned, half_angle)))
    return drift


def _error(step: FloatArray, step_angle: FloatArray) -> FloatArray:
    """Rotation vector of a step and the turn of the cone after it: after whole rounds, of error."""
    axis = np.stack([np.zeros_like(step_angle), np.zeros_like(step_angle), step_angle], axis=-1)
    return to_rotation_vector(multiply(step, from_rotation_vector(axis)))


def _largest_change(drift: FloatArray, size: FloatArray, along: FloatArray) -> FloatArray:
    """How much the error about the cone's axis may change in a step that turns by `size`, rad."""
    lean = np.abs(along) / np.where(size > 0, size, 1.0)
    ratio = np.where(size > 0, (1 - lean) / (1 + lean), 0.0)
    sine, cosine = ratio * np.sin(size / 2), ratio * np.cos(size / 2)
    sign = np.where(along < 0, -1.0, 1.0)
    more, less = (4 * np.arctan2(sine, 1 + way * cosine) for way in (-1, 1))
    return np.maximum(np.abs(drift + sign * more), np.abs(drift - sign * less))


def _refuse_half_a_turn(changes: FloatArray) -> None:
    """Refuse an error that changes by half a turn or more in a step, of the changes in rad."""
    if (changes >= np.pi).any():
        raise ValueError(
            "half_angle, frequency, sample_interval: expected a cone on which the algorithm's "
            "error about the axis changes by less than half a turn a step, got "
            f"{float(changes.max()):.3g} rad."
        )


def simulated_coning_drift(
    algorithm: AnyAlgorithm,
    half_angle: ArrayLike,
    frequency: ArrayLike,
    sample_interval: ArrayLike,
    *,
    count: int | None = None,
) -> FloatArray:
    """Apparent drift about the axis of a cone, measured over many steps of an algorithm.

    Parameters
    ----------
    algorithm : str or Algorithm or FunctionalIteration or callable
        As in `coning_drift`.
    half_angle, frequency, sample_interval : array_like, shape (...)
        Of the cone and of one increment, in rad, Hz and s, as in `coning_drift`.
    count : int, optional
        Number of increments; by default `SIMULATED_STEPS` steps, or windows, of a named algorithm,
        and 840 increments for one's own function, whole steps of one to eight samples.

    Returns
    -------
    ndarray, shape (...)
        Apparent less true rate about the axis of the cone, rad/s.

    Raises
    ------
    ValueError
        As in `integrate` and in `coning_drift`, except that steps need not repeat.

    See Also
    --------
    coning_drift : The same by formula.
    integrate : The attitude itself.

    Notes
    -----
    The algorithm is given the exact increments of the motion. The error of its attitude is a
    rotation in the axes of the cone; its part along the cone's axis at the end is divided by the
    time, whole turns counted step by step. Besides the drift the result holds the wobble of a
    single step, which does not grow: a part of 1/count, wide on wide cones with few samples a
    round. An algorithm with memory is given increments before the first; one's own function is not.

    Examples
    --------
    One's own algorithm, in degrees per hour on a cone of half a degree at 10 Hz, sampled at 100 Hz:

    >>> def mine(g):
    ...     return g[0::2] + g[1::2] + 0.6 * np.cross(g[0::2], g[1::2])
    >>> for drift in (simulated_coning_drift, coning_drift):
    ...     print(f"{3600 * np.degrees(drift(mine, np.radians(0.5), 10.0, 0.01)):.1f}")
    -14.2
    -14.2
    """
    chosen = checked_algorithm(algorithm)
    memory, length = 0, _OWN_ROWS
    if isinstance(chosen, AttitudeAlgorithm):
        memory, length = chosen.memory, SIMULATED_STEPS * (chosen.window - chosen.memory)
    if count is not None:
        length = whole_number(count, "count")
    angle, x, interval = _checked_cone(half_angle, frequency, sample_interval)
    angle, sample = angle[..., np.newaxis], x[..., np.newaxis]
    rows = cone_increments(angle, sample, sample * (np.arange(memory + length) + 0.5))
    history = rows[..., :memory, :] if memory else None
    steps = step_quaternions(rows[..., memory:, :], chosen, history=history)
    samples = length // steps.shape[-2]
    true = _attitude_on_cone(angle, sample * np.arange(memory, memory + length + 1, samples))
    found = multiply(true[..., :1, :], cumulative_product(steps))
    # In the reference axes, whose third is the cone's.
    error = multiply(found, conjugate(true[..., 1:, :]))
    # Less than half a turn; the turns before are counted step by step.
    along = to_rotation_vector(error[..., -1, :])[..., 2]
    changes = _changes_about_third(error)
    _refuse_half_a_turn(np.abs(changes))
    whole = np.round((changes.sum(axis=-1) - along) / (2 * np.pi))
    return np.asarray((along + 2 * np.pi * whole) / (length * interval))[()]


def _changes_about_third(error: FloatArray) -> FloatArray:
    """Changes (..., m) of the turn about the third axis, rad, of errors (..., m, 4) after none."""
    # By the shorter rotation: less than half a turn in space, up to a whole one about an axis.
    before = np.concatenate([np.zeros_like(error[..., :1, :]), error[..., :-1, :]], axis=-2)
    before[..., 0, 3] = 1.0
    way = np.where((before * error).sum(axis=-1) < 0, -1.0, 1.0)
    first, second = (pair[..., 3] + 1j * pair[..., 2] for pair in (before, error))
    return np.asarray(2 * np.angle(way * second * first.conj()))


def _attitude_on_cone(half_angle: FloatArray, phase: FloatArray) -> FloatArray:
    """Attitude (..., 4) on a cone, as of `Coning`."""
    around = np.cos(phase), np.sin(phase), np.zeros_like(phase)
    return from_rotation_vector(half_angle[..., np.newaxis] * np.stack(around, axis=-1))
