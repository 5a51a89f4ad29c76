"""Drift of an attitude algorithm on a coning motion, measured: by running it over many steps."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, whole_number
from driftlab.core.coning import cone_increments
from driftlab.core.loops import cumulative_product
from driftlab.core.quaternion import (
    conjugate,
    from_rotation_vector,
    multiply,
    to_rotation_vector,
)

from ._swing import half_a_turn
from .coning_algorithms import AnyAlgorithm, AttitudeAlgorithm, attitude_algorithm
from .drift_on_cones import OWN_ROWS, checked_cone
from .integration import step_quaternions

MEASURED_STEPS = 60
"""Steps, or windows, over which a named algorithm is measured."""


def measured_coning_drift(
    algorithm: AnyAlgorithm,
    half_angle: ArrayLike,
    frequency: ArrayLike,
    sample_interval: ArrayLike,
    *,
    count: int | None = None,
) -> FloatArray:
    """Apparent drift about the axis of a cone, measured over many steps of an algorithm.

    Nothing is supposed of the algorithm: it is given the exact increments of the motion, and its
    attitude is held against the true one. `coning_drift` has the same without running it, but for
    the wobble below, where all steps are alike.

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
    count : int, optional
        Number of increments; by default `MEASURED_STEPS` steps, or windows, of a named algorithm,
        and `OWN_ROWS` increments for one's own function, whole steps of one to eight samples.

    Returns
    -------
    ndarray, shape (...)
        Apparent less true rate about the axis of the cone, rad/s; the sign is that of
        `coning_drift`.

    Raises
    ------
    ValueError
        As in `coning_drift`, but that steps need not repeat, and `driftlab.attitude.integrate`. If
        the error about the cone's axis changes by half a turn or more within a step.

    See Also
    --------
    coning_drift : The same by formula.
    integrate : The attitude itself.

    Notes
    -----
    The attitude's error is a rotation in the axes of the cone; its part along the cone's axis at
    the end is divided by the time, whole turns counted step by step, each step's error being the
    rotation of less than half a turn. Where an error about another axis swings the part about the
    cone's axis by half a turn and more within a step, the count would depend on where the steps
    happen to fall; more steps mend nothing, and the sum is refused. Besides the drift the result
    holds the wobble of a single step, which does not grow: a part of 1/count, wide on wide cones
    with few samples a round. An algorithm with memory is
    given increments before the first, so that its start is not measured with it; one's own function
    is not.

    References
    ----------
    - Goodman, Robinson, *Effect of finite rotations on gyroscopic sensing devices*, Journal of
      Applied Mechanics 25(2), 1958.
    - R. B. Miller, *A new strapdown attitude algorithm*, Journal of Guidance, Control, and Dynamics
      6(4), 1983.
    - P. G. Savage, *Strapdown inertial navigation integration algorithm design, part 1: Attitude
      algorithms*, Journal of Guidance, Control, and Dynamics 21(1), 1998.

    Examples
    --------
    One's own two-sample algorithm, which takes too little for the coning, in degrees an hour on a
    cone of half a degree at 10 Hz, sampled at 100 Hz; measured, and by the formula:

    >>> from driftlab.attitude import coning_drift
    >>> def mine(g):
    ...     return g[0::2] + g[1::2] + 0.6 * np.cross(g[0::2], g[1::2])
    >>> for drift in (measured_coning_drift, coning_drift):
    ...     print(f"{3600 * np.degrees(drift(mine, np.radians(0.5), 10.0, 0.01)):.1f}")
    -14.2
    -14.2
    """
    chosen = attitude_algorithm(algorithm)
    memory, length = 0, OWN_ROWS
    if isinstance(chosen, AttitudeAlgorithm):
        memory, length = chosen.memory, MEASURED_STEPS * (chosen.window - chosen.memory)
    if count is not None:
        length = whole_number(count, "count")
    angle, x, interval = checked_cone(half_angle, frequency, sample_interval)
    angle, sample = angle[..., np.newaxis], x[..., np.newaxis]
    rows = cone_increments(angle, sample, sample * (np.arange(memory + length) + 0.5))
    history = rows[..., :memory, :] if memory else None
    steps = step_quaternions(rows[..., memory:, :], chosen, history=history)
    samples = length // steps.shape[-2]
    true = _attitude(angle, sample * np.arange(memory, memory + length + 1, samples))
    found = multiply(true[..., :1, :], cumulative_product(steps))
    # In the reference axes, whose third is the cone's.
    error = multiply(found, conjugate(true[..., 1:, :]))
    # Less than half a turn; the turns before are counted step by step.
    along = to_rotation_vector(error[..., -1, :])[..., 2]
    changes = _changes_about_third(error)
    if (np.abs(changes) >= np.pi).any():
        raise half_a_turn(float(np.abs(changes).max()))
    whole = np.round((changes.sum(axis=-1) - along) / (2 * np.pi))
    return np.asarray((along + 2 * np.pi * whole) / (length * interval))[()]


def _changes_about_third(error: FloatArray) -> FloatArray:
    """Changes (..., m) of the turn about the third axis, rad, of errors (..., m, 4) after none.

    From each to the next by the shorter rotation: less than half a turn in space, and yet up to a
    whole turn about one axis of it.
    """
    before = np.concatenate([np.zeros_like(error[..., :1, :]), error[..., :-1, :]], axis=-2)
    before[..., 0, 3] = 1.0
    way = np.where((before * error).sum(axis=-1) < 0, -1.0, 1.0)
    first, second = (pair[..., 3] + 1j * pair[..., 2] for pair in (before, error))
    return np.asarray(2 * np.angle(way * second * first.conj()))


def _attitude(half_angle: FloatArray, phase: FloatArray) -> FloatArray:
    """Attitude (..., 4) on a cone, as of `Coning`."""
    around = np.cos(phase), np.sin(phase), np.zeros_like(phase)
    return from_rotation_vector(half_angle[..., np.newaxis] * np.stack(around, axis=-1))
