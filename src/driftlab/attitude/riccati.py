"""Perelyaev & Chelnokov, section 1: the Riccati equation of a Cayley vector, through any angle."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp

from driftlab.checks import FloatArray, finite_array, finite_arrays, finite_number

from .cayley import _checked, rotation_quaternion, shadow

SWITCH = 1.2
"""Length at which the shadow takes over. Its own length is then 1/1.2: far enough from the switch
that rounding cannot send it back at once."""


_LIMIT = 1e6
"""Without the shadow switch, an integration ends where the vector has become this long."""


def riccati_rate(vector: ArrayLike, rate: ArrayLike, dimension: int = 4) -> FloatArray:
    """Time derivative of k; (1.7) and (1.11), and the equation of dimension 3 beside them.

    Parameters
    ----------
    vector : array_like, shape (..., 3)
        k, of either dimension.
    rate : array_like, shape (..., 3)
        Angular rate in body axes, rad/s.
    dimension : {4, 3}

    Returns
    -------
    ndarray, shape (..., 3)
        In 1/s. Dimension 4: ``(|k|² ω - 2 (k·ω) k + 2 k×ω - ω)/4``; dimension 3:
        ``(-(k·ω) k + k×ω - ω)/2``.
    """
    k, omega = finite_arrays(vector=(vector, 3), rate=(rate, 3))
    along = np.sum(k * omega, axis=-1, keepdims=True)
    if _checked(dimension) == 3:
        return 0.5 * (np.cross(k, omega) - along * k - omega)
    square = np.sum(k * k, axis=-1, keepdims=True)
    return 0.25 * ((square - 1) * omega - 2 * along * k + 2 * np.cross(k, omega))


class RiccatiSolution(NamedTuple):
    """What `integrate_riccati` returns."""

    time: FloatArray
    """Times (m,) in s. If the vector became too long, the last of them is when it did so."""
    vector: FloatArray
    """k (m, 3) at these times."""
    attitude: FloatArray
    """Unit quaternion (m, 4), continuous in time: each switch to the shadow changes its sign."""
    switches: FloatArray
    """Times (s,) of the switches to the shadow, in s."""
    evaluations: int
    """How often the integrator asked for the derivative."""


def integrate_riccati(
    rate: Callable[[float], ArrayLike],
    times: ArrayLike,
    *,
    shadow_switch: bool = True,
    tolerance: float = 1e-10,
) -> RiccatiSolution:
    """Integrate the Riccati equation (1.10) of dimension 4 from k = 0, through any angle.

    Parameters
    ----------
    rate : callable
        Angular rate (3,) in body axes, rad/s, at a time in s.
    times : array_like, shape (m,)
        Increasing times in s; k is zero at the first.
    shadow_switch : bool
        Whether to go on with the shadow whenever k becomes longer than 1.2. If not, the integration
        ends where k runs to infinity, at a whole turn.
    tolerance : float
        Relative and absolute tolerance of the integrator, SciPy's DOP853. Its steps are never
        longer than the widest gap of `times`, so that it sees what the rate does in between.

    Returns
    -------
    RiccatiSolution
    """
    if not callable(rate):
        raise ValueError(f"rate: expected a function of the time, got {type(rate).__name__}.")
    if finite_number(tolerance, "tolerance") <= 0:
        raise ValueError(f"tolerance: expected a positive number, got {tolerance!r}.")
    grid = finite_array(times, "times")
    if grid.ndim != 1 or len(grid) < 2 or not np.all(np.diff(grid) > 0):
        raise ValueError(f"times: expected at least two increasing times (m,), got {times!r:.60}.")
    limit = SWITCH if shadow_switch else _LIMIT

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
