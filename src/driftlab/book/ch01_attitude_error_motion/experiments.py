"""The error quaternion in time, by closed form and by a numerical integrator; Larin (1.4)."""

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import finite_array
from driftlab.drift.error_kinematics import error_quaternion, error_rate_matrix
from driftlab.quaternion import from_rotation_vector, rotate, rotation_angle, to_rotation_vector

DURATION = 60.0
"""Length of a history, s."""
SAMPLES = 601
"""Times in a history."""
SPIN = 12.0
"""Rate about the third axis, degrees a second, of the presets whose true rate has one axis."""
COMPONENTS = tuple("1230")
"""Of an error quaternion, as Larin numbers them, the scalar last."""
MOMENTS = 301
"""Times of an error in space; a turn of 12 degrees a second ends at one of them."""


def error_motion(
    rate: ArrayLike = (0.1, 0.2, 0.1),
    measured_rate: ArrayLike = (0.12, 0.15, 0.1),
    duration: float = DURATION,
    tolerance: float = 1e-2,
) -> DataTable:
    """Solve (1.4) from [0, 0, 0, 1], in closed form and with a Runge-Kutta integrator."""
    for name, value in (("duration", duration), ("tolerance", tolerance)):
        if not finite_array(value, name) > 0:
            raise ValueError(f"{name}: expected a number above 0, got {value!r}.")
    matrix = error_rate_matrix(rate, measured_rate)
    time = np.linspace(0.0, duration, SAMPLES)
    solution = solve_ivp(
        lambda _, error: 0.5 * matrix @ error,
        (0.0, duration),
        [0.0, 0.0, 0.0, 1.0],
        rtol=tolerance,
        atol=tolerance,
    )
    exact, at_steps = (error_quaternion(rate, measured_rate, t) for t in (time, solution.t))
    angle, turn = rotation_angle(exact), _turn(rate)
    whole_turns = np.arange(turn, duration, turn) if turn < duration else np.zeros(0)
    after = np.nan
    if np.isfinite(turn):
        after = float(rotation_angle(error_quaternion(rate, measured_rate, turn)))
    speed, measured = (float(np.linalg.norm(each)) for each in (rate, measured_rate))
    worst = float(np.linalg.norm(solution.y.T - at_steps, axis=-1).max())
    return DataTable(
        {
            "time": (time, "s", "from the start"),
            "error": (exact.T, "", "components of the error quaternion, closed form", COMPONENTS),
            "integrated_time": (solution.t, "s", "at the steps of the integrator"),
            "integrated": (solution.y, "", "components as integrated", COMPONENTS),
            "angle": (angle, "deg", "of the error"),
            "whole_turns": (whole_turns, "s", "when the body has made whole turns, before the end"),
            "angle_after_turns": (np.interp(whole_turns, time, angle), "deg", "of the error then"),
        },
        {
            "tolerance": (tolerance, "", "tolerance of the integrator"),
            "after_one_turn": (after, "deg", "error after one whole turn"),
            "true_rate": (speed, "deg_per_s", "true rate"),
            "measured_rate": (measured, "deg_per_s", "measured rate"),
            "sum": (measured + speed, "deg_per_s", "sum: the fast root"),
            "difference": (measured - speed, "deg_per_s", "difference: the slow one"),
            "steps": (len(solution.t) - 1, "", "steps of the integrator"),
            "largest_error": (worst, "", "its largest error"),
        },
    )


def error_in_space(rate: ArrayLike, false_rate: ArrayLike, duration: float = DURATION) -> DataTable:
    """Follow a body at a constant rate, and a computer that adds a false one, from [0, 0, 0, 1]."""
    if not finite_array(duration, "duration") > 0:
        raise ValueError(f"duration: expected a number above 0, got {duration!r}.")
    omega, false = finite_array(rate, "rate", 3), finite_array(false_rate, "false_rate", 3)
    time = np.linspace(0.0, duration, MOMENTS)
    attitude, apparent = (
        from_rotation_vector(each * time[:, np.newaxis]) for each in (omega, omega + false)
    )
    error = error_quaternion(omega, omega + false, time)
    vector, added = (rotate(attitude, each) for each in (to_rotation_vector(error), false))
    turn = _turn(omega)
    count = int(duration / turn + 1e-9)
    whole_turns = np.rint(np.arange(count + 1) * (turn if count else 0.0) / time[1]).astype(int)
    return DataTable(
        {"time": (time, "s", "from the start"), "angle": (rotation_angle(error), "deg", "error")},
        {
            "attitude": (attitude, "", "true, body to reference"),
            "apparent": (apparent, "", "computed, body to reference"),
            "vector": (vector, "deg", "rotation vector from one to the other, in reference axes"),
            # to first order, what changes the vector
            "added": (added, "rad_per_s", "false rate in reference axes"),
            "turn": (turn, "s", "time of a whole turn"),
            "whole_turns": (whole_turns, "", "moments nearest to whole turns, from the start on"),
        },
    )


def _turn(rate: ArrayLike) -> float:
    """Return the time of a whole turn, s; infinity if the body stands still."""
    speed = float(np.linalg.norm(rate))
    return 2 * np.pi / speed if speed else np.inf
