"""The Riccati equation of a Cayley vector, through any angle; Perelyaev & Chelnokov, section 1."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp

from driftlab.checks import (
    FloatArray,
    checked_function,
    chosen_number,
    finite_array,
    finite_arrays,
    positive_number,
    shown,
    truth_value,
)

from .cayley import rotation_quaternion, shadow

# Far enough from the shadow's length, 1/1.2, that rounding cannot cause a second switch at once.
SWITCH = 1.2
"""Length of k at which `integrate_riccati` continues with the shadow."""

_LEAST_TOLERANCE = 100 * float(np.finfo(float).eps)
"""Less is asked of SciPy's integrators in vain, and they say so in a warning."""
_LIMIT = 1e6
"""Without the shadow switch, an integration ends where the vector has become this long."""


def riccati_rate(vector: ArrayLike, rate: ArrayLike, dimension: int = 4) -> FloatArray:
    r"""Time derivative of a Cayley vector k; (1.7), (1.11).

    Parameters
    ----------
    vector : array_like, shape (..., 3)
        k = -tan(phi/4) e for dimension 4, -tan(phi/2) e for dimension 3.
    rate : array_like, shape (..., 3)
        Angular rate in body axes, rad/s.
    dimension : {4, 3}
        Of the matrices whose Cayley transform the vector describes.

    Returns
    -------
    ndarray, shape (..., 3)
        In 1/s.

    Notes
    -----
    For dimension 4, as in the paper, and for dimension 3

    .. math:: 4 \dot k = |k|^2 \omega - 2 (k \cdot \omega) k + 2 k \times \omega - \omega,
              \qquad 2 \dot k = -(k \cdot \omega) k + k \times \omega - \omega

    Examples
    --------
    Half a turn about the first axis is k = -e1 in dimension 4, with the rate -(1 + k²)/4:

    >>> riccati_rate([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0])
    array([-0.5,  0. ,  0. ])
    """
    k, omega = finite_arrays(vector=(vector, 3), rate=(rate, 3))
    along = np.sum(k * omega, axis=-1, keepdims=True)
    if chosen_number(dimension, (3, 4), "dimension") == 3:
        return 0.5 * (np.cross(k, omega) - along * k - omega)
    square = np.sum(k * k, axis=-1, keepdims=True)
    return 0.25 * ((square - 1) * omega - 2 * along * k + 2 * np.cross(k, omega))


class RiccatiSolution(NamedTuple):
    """Result of `integrate_riccati`.

    Attributes
    ----------
    time : ndarray, shape (m,)
        Times, s. If the integration ended because k became too long, the last is the time of that.
    vector : ndarray, shape (m, 3)
        k at these times, without unit.
    attitude : ndarray, shape (m, 4)
        Unit quaternion at these times, body to reference, continuous in time.
    switches : ndarray, shape (s,)
        Times of the switches to the shadow, s.
    evaluations : int
        Number of evaluations of the derivative.
    """

    time: FloatArray
    vector: FloatArray
    attitude: FloatArray
    switches: FloatArray
    evaluations: int


def integrate_riccati(
    rate: Callable[[float], ArrayLike],
    times: ArrayLike,
    *,
    shadow_switch: bool = True,
    tolerance: float = 1e-10,
) -> RiccatiSolution:
    """Integrate the Riccati equation of dimension 4 from k = 0, through any angle; (1.10).

    Parameters
    ----------
    rate : callable
        Angular rate (3,) in body axes, rad/s, as a function of the time in s.
    times : array_like, shape (m,)
        Increasing times, s; k is zero at the first.
    shadow_switch : bool
        Whether to continue with the shadow of k whenever k becomes longer than `SWITCH`. Otherwise
        the integration ends where k tends to infinity, at a whole turn.
    tolerance : float
        Relative and absolute tolerance of the integrator, SciPy's DOP853, at least 2.3e-14. Its
        steps are never longer than the widest gap of `times`.

    Returns
    -------
    RiccatiSolution
        k and the attitude at `times`, and the times of the switches.

    Raises
    ------
    ValueError
        If `times` does not increase, or `rate` does not return finite vectors of shape (3,).
    RuntimeError
        If the integrator fails.

    Examples
    --------
    Two whole turns about the third axis, past two infinities of k:

    >>> found = integrate_riccati(lambda time: [0.0, 0.0, 1.0], np.linspace(0, 4 * np.pi, 9))
    >>> found.switches.round(4)
    array([3.5042, 9.7874])
    """
    checked_function(rate, "rate", "the time")
    tolerance = positive_number(tolerance, "tolerance")
    if tolerance < _LEAST_TOLERANCE:
        raise ValueError(
            f"tolerance: expected at least {_LEAST_TOLERANCE:.2g}, got {shown(tolerance)}."
        )
    grid = finite_array(times, "times")
    if grid.ndim != 1 or len(grid) < 2 or not np.all(np.diff(grid) > 0):
        raise ValueError(f"times: expected at least two increasing times (m,), got {shown(times)}.")
    limit = SWITCH if truth_value(shadow_switch, "shadow_switch") else _LIMIT

    def derivative(time: float, k: FloatArray) -> FloatArray:
        value = finite_array(rate(time), "rate", 3)
        if value.ndim != 1:
            raise ValueError(f"rate: expected shape (3,) at a time, got shape {value.shape}.")
        return riccati_rate(k, value)

    def too_long(_: float, k: FloatArray) -> float:
        # The logarithm is as smooth near the limit as far below it; 1e-300 keeps it finite at 0.
        return float(np.log((k @ k + 1e-300) / limit**2))

    too_long.terminal = True  # type: ignore[attr-defined]
    too_long.direction = 1.0  # type: ignore[attr-defined]

    reached, vectors, turns = [grid[:1]], [np.zeros((1, 3))], [np.zeros(1)]
    switches: list[float] = []
    start, k, evaluations = grid[0], np.zeros(3), 0
    while start < grid[-1]:
        answer: Any = solve_ivp(
            derivative,
            (start, grid[-1]),
            k,
            method="DOP853",
            t_eval=grid[grid > start],
            events=too_long,
            rtol=tolerance,
            atol=tolerance,
            max_step=np.diff(grid).max(),
        )
        evaluations += answer.nfev
        if answer.status < 0:
            raise RuntimeError(f"The integration after {start:.6g} s failed: {answer.message}")
        if len(answer.t):
            reached.append(answer.t)
            vectors.append(answer.y.T)
            turns.append(np.full(len(answer.t), len(switches)))
        if answer.status == 0:
            break
        start, k = answer.t_events[0][0], answer.y_events[0][0]
        if not shadow_switch:
            reached.append(np.array([start]))
            vectors.append(k[np.newaxis])
            turns.append(np.zeros(1))
            break
        k = shadow(k)
        switches.append(start)
    vector = np.concatenate(vectors)
    signs = 1.0 - 2.0 * (np.concatenate(turns)[:, np.newaxis] % 2)
    return RiccatiSolution(
        np.concatenate(reached),
        vector,
        signs * rotation_quaternion(vector),
        np.array(switches),
        evaluations,
    )
