"""Attitude from the angle increments of gyros, by a named algorithm or one's own."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from driftlab.checks import (
    FloatArray,
    UnusualWarning,
    finite_array,
    finite_arrays,
    shown,
    unit_quaternions,
)
from driftlab.core import attitude as core
from driftlab.core.attitude import turns_too_far
from driftlab.core.loops import attitudes, cumulative_product
from driftlab.core.quaternion import multiply

from .coning_algorithms import AnyAlgorithm, AttitudeAlgorithm, checked_algorithm
from .own_algorithms import OwnAlgorithm, checked_steps


def integrate(
    increments: ArrayLike,
    algorithm: AnyAlgorithm = "two-step-4",
    *,
    start: ArrayLike = (0.0, 0.0, 0.0, 1.0),
    history: ArrayLike | None = None,
) -> FloatArray:
    r"""Attitude after each step, from angle increments.

    Parameters
    ----------
    increments : array_like, shape (..., n, 3)
        Integrals of the body rate over equal intervals, rad, in the order in which they happen,
        as from an integrating gyro. Sampled rates times the interval lose the coning between two
        samples, see chapter 08; for these there is `increments_from_rates`.
    algorithm : str or Algorithm or FunctionalIteration or callable
        A key of `ALGORITHMS`, a custom algorithm, or one's own function as in `own_algorithms`.
        `one-step-3`, `two-step-3` and `two-step-4` are reconstructed from the abstract of
        Perelyaev and Chelnokov, and need not be the authors' own forms.
    start : array_like or Rotation, shape (..., 4)
        Attitude before the first increment; brought to unit norm.
    history : array_like, shape (..., m, 3), optional
        The increments before the first, rad, at least as many as the algorithm's memory. Without
        it an algorithm with memory starts by a formula of the same order that uses the increments
        that follow. One's own function is handed history and increments together, and its steps
        of the history, which must be whole, are left out.

    Returns
    -------
    ndarray, shape (..., n // samples, 4)
        Attitude at the end of each step, body to reference. The last one is the `start` of the next
        call, whose `history` is the last increments of this one.

    Raises
    ------
    ValueError
        If the algorithm is unknown, or if the increments do not make whole steps, are too few to
        start without a history, or (unless the rotation vector is used) turn by a whole turn in one
        step. All algorithms are meant for steps that turn by much less than 1 rad. Functional
        iteration refuses fewer increments than a window has, and such that it does not settle on.
        What one's own function returns is checked as in `own_algorithms`.

    Warns
    -----
    UnusualWarning
        If an increment, or one of the history that counts, is more than a whole turn.

    See Also
    --------
    increments_from_rates : Increments from sampled rates.
    driftlab.attitude.simulated_coning_drift : What an algorithm loses on a cone.
    driftlab.strapdown.navigate : Velocity and position as well.

    Notes
    -----
    Solved is the kinematic equation of the attitude q with the rate :math:`\omega` in body axes,
    by the rotation vector :math:`\varphi_k` of each step that the algorithm makes of increments:

    .. math:: \dot q = \tfrac12\, q \circ \omega, \qquad
        q_{k+1} = q_k \circ \left( \frac{\varphi_k}{|\varphi_k|} \sin\frac{|\varphi_k|}{2},\;
        \cos\frac{|\varphi_k|}{2} \right).

    An algorithm in quaternions or Cayley vectors makes the factor on the right directly. The
    Cayley vectors of `two-step-4` are a series cut off: about a fixed axis a step by f rad turns
    :math:`f^5/1920` too little, which is 4.5 degrees per hour at 400 degrees per second and 50 Hz.
    For a body that keeps turning fast, `rotation-vector-2` has the same corrections and no such
    error.

    Functional iteration gives an attitude after every increment. If the last window is not full, it
    is moved back until it is. A stream that is handed over in whole windows gives the same
    attitudes as all at once.

    References
    ----------
    - P. G. Savage, *Strapdown inertial navigation integration algorithm design, part 1: Attitude
      algorithms*, Journal of Guidance, Control, and Dynamics 21(1), 1998.
    - M. B. Ignagni, *Efficient class of optimized coning compensation algorithms*, Journal of
      Guidance, Control, and Dynamics 19(2), 1996.
    - J. E. Bortz, *A new mathematical formulation for strapdown inertial navigation*, IEEE
      Transactions on Aerospace and Electronic Systems AES-7(1), 1971.

    Examples
    --------
    A steady rotation of 1 rad about the third axis:

    >>> integrate(np.tile([0.0, 0.0, 0.01], (100, 1)))[-1].round(6)
    array([0.      , 0.      , 0.479426, 0.877583])
    """
    first = unit_quaternions(start, "start")
    chosen = checked_algorithm(algorithm)
    if isinstance(chosen, AttitudeAlgorithm):
        rows, past, largest = _checked(increments, chosen, history)
        if first.ndim > 1:
            finite_arrays(increments=(rows, *rows.shape[-2:]), start=(first, 4))
        found = attitudes(chosen.steps, rows, past, first)
    else:
        rows = finite_array(increments, "increments", 3)
        largest = _largest(rows)
        steps = cumulative_product(_own_steps(chosen, rows, history))
        finite_arrays(increments=(steps, *steps.shape[-2:]), start=(first, 4))
        found = multiply(first[..., np.newaxis, :], steps)
    if largest > 2 * np.pi:
        warnings.warn(
            f"increments: {largest:.3g} rad between two samples is more than a whole turn. "
            "If degrees were meant, np.radians; if rates, times the interval.",
            UnusualWarning,
            stacklevel=2,
        )
    return found


def step_quaternions(
    increments: ArrayLike, algorithm: AnyAlgorithm, *, history: ArrayLike | None = None
) -> FloatArray:
    """Quaternion of the rotation over each single step.

    Parameters
    ----------
    increments : array_like, shape (..., n, 3)
        Integrals of the body rate over equal intervals, rad.
    algorithm : str or Algorithm or FunctionalIteration or callable
        A key of `ALGORITHMS`, a custom algorithm, or one's own function as in `own_algorithms`.
    history : array_like, shape (..., m, 3), optional
        The increments before the first, rad; as in `integrate`.

    Returns
    -------
    ndarray, shape (..., n // samples, 4)
        Body axes at the end of each step to those at its beginning.

    Raises
    ------
    ValueError
        As in `integrate`.

    Examples
    --------
    >>> step_quaternions([[0.0, 0.0, 0.1], [0.0, 0.0, 0.1]], "two-step-4").round(4)
    array([[0.    , 0.    , 0.0998, 0.995 ]])
    """
    chosen = checked_algorithm(algorithm)
    if not isinstance(chosen, AttitudeAlgorithm):
        return _own_steps(chosen, finite_array(increments, "increments", 3), history)
    rows, past, _ = _checked(increments, chosen, history)
    return core.step_quaternions(chosen.steps, rows, past)


def step_rotation_vectors(
    increments: ArrayLike,
    algorithm: AnyAlgorithm,
    *,
    history: ArrayLike | None = None,
    word: DTypeLike = np.float64,
) -> NDArray[Any]:
    """Cayley vector k of each step, or its rotation vector if a named algorithm computes that.

    Parameters
    ----------
    increments : array_like, shape (..., n, 3)
        Integrals of the body rate over equal intervals, rad.
    algorithm : str or Algorithm or FunctionalIteration or callable
        A key of `ALGORITHMS`, a custom algorithm, or one's own function as in `own_algorithms`.
    history : array_like, shape (..., m, 3), optional
        The increments before the first, rad; as in `integrate`.
    word : dtype
        Precision of the computation: float16, float32 or float64. One's own function is given
        increments in float64 that are rounded to it, and its steps are rounded.

    Returns
    -------
    ndarray, shape (..., n // samples, 3)
        k = -tan(phi/4) e, without unit, or the rotation vector, rad. Of dtype `word`.

    Raises
    ------
    ValueError
        As in `integrate`, if `word` is another dtype, or if an increment overflows in it.

    Examples
    --------
    >>> increments = [[0.0, 0.0, 0.1], [0.0, 0.1, 0.0]]
    >>> step_rotation_vectors(increments, "two-step-4").round(4)
    array([[ 0.0017, -0.025 , -0.025 ]])
    >>> step_rotation_vectors(increments, "rotation-vector-2").round(4)
    array([[-0.0067,  0.1   ,  0.1   ]])
    """
    chosen = checked_algorithm(algorithm)
    dtype = _checked_word(word)
    if not isinstance(chosen, AttitudeAlgorithm):
        rows = _rows(increments)
        rounded = _in_word(rows, dtype).astype(np.float64)
        return _cayley_vectors(_own_steps(chosen, rounded, history)).astype(dtype)
    rows, past, _ = _checked(increments, chosen, history)
    return core.step_rotation_vectors(chosen.steps, _in_word(rows, dtype), past=past)


def _rows(increments: ArrayLike) -> FloatArray:
    """Increments (..., n, 3)."""
    rows = finite_array(increments, "increments")
    if rows.ndim < 2 or rows.shape[-1] != 3:
        raise ValueError(f"increments: expected shape (..., n, 3), got shape {rows.shape}.")
    return rows


def _largest(rows: FloatArray) -> float:
    """Largest size of a number; two looks are sooner than a copy."""
    return max(float(rows.max()), -float(rows.min()))


def _checked(
    increments: ArrayLike, chosen: AttitudeAlgorithm, history: ArrayLike | None
) -> tuple[FloatArray, int, float]:
    """History and increments in one array, how many are history, and the largest increment."""
    rows = _rows(increments)
    largest = _largest(rows)
    if largest >= 2 * np.pi and chosen.last_stage != "rotation vector":
        raise turns_too_far(largest)
    if largest > 1e12:  # not even the rounding of such an angle is small
        raise ValueError(f"increments: expected angles in rad, got {largest:.3g}.")
    count, left_over = rows.shape[-2], rows.shape[-2] % chosen.samples
    if left_over:
        raise ValueError(
            f"increments: expected a multiple of {chosen.samples} for {chosen.name}, got {count}; "
            f"keep the last {left_over} for the next call."
        )
    if history is None or not chosen.memory:
        if count < chosen.window:
            why = " to start without a history" if chosen.memory else ""
            raise ValueError(
                f"increments: expected at least {chosen.window} for {chosen.name}{why}, "
                f"got {count}."
            )
        return rows, 0, largest
    past = finite_array(history, "history", 3)
    if past.ndim < 2 or past.shape[-2] < chosen.memory:
        raise ValueError(
            f"history: expected shape (..., m, 3) with m at least {chosen.memory} for "
            f"{chosen.name}, got shape {past.shape}."
        )
    past = past[..., -chosen.memory :, :]
    return _joined(past, rows), chosen.memory, max(largest, _largest(past))


def _joined(past: FloatArray, rows: FloatArray) -> FloatArray:
    """History (..., m, 3) and increments (..., n, 3) in one array."""
    finite_arrays(increments=(rows, *rows.shape[-2:]), history=(past, *past.shape[-2:]))
    leading = np.broadcast_shapes(rows.shape[:-2], past.shape[:-2])
    both = [np.broadcast_to(part, (*leading, *part.shape[-2:])) for part in (past, rows)]
    return np.concatenate(both, axis=-2)


def _own_steps(function: OwnAlgorithm, rows: FloatArray, history: ArrayLike | None) -> FloatArray:
    """Steps (..., m, 4) by one's own function, without those of the history."""
    if history is None:
        return checked_steps(function, rows)
    past = finite_array(history, "history", 3)
    if past.ndim < 2:
        raise ValueError(f"history: expected shape (..., m, 3), got shape {past.shape}.")
    joined = _joined(past, rows)
    steps = checked_steps(function, joined)
    samples, earlier = joined.shape[-2] // steps.shape[-2], past.shape[-2]
    if earlier % samples:
        raise ValueError(
            f"history: expected whole steps of {samples} increments for one's own function, "
            f"got {earlier}."
        )
    return steps[..., earlier // samples :, :]


def _cayley_vectors(steps: FloatArray) -> FloatArray:
    """Cayley vectors -tan(phi/4) e (..., 3) of unit quaternions (..., 4)."""
    shorter = np.where(steps[..., 3:] < 0, -steps, steps)
    return -shorter[..., :3] / (1 + shorter[..., 3:])


def _checked_word(word: DTypeLike) -> np.dtype[Any]:
    try:
        dtype = np.dtype(word)
    except TypeError:
        dtype = np.dtype(object)
    if dtype not in (np.float16, np.float32, np.float64):
        raise ValueError(f"word: expected float16, float32 or float64, got {shown(word)}.")
    return dtype


def _in_word(rows: FloatArray, dtype: np.dtype[Any]) -> NDArray[Any]:
    with np.errstate(over="ignore"):
        rounded = rows.astype(dtype, copy=False)
    if not np.isfinite(rounded).all():
        raise ValueError(f"increments: expected numbers that {dtype} can hold, got larger ones.")
    return rounded
