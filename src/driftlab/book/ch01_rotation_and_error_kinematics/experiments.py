"""The error quaternion in time, by closed form and by a numerical integrator; Larin (1.4)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_ivp

from driftlab.checks import FloatArray, finite_array
from driftlab.drift.error_kinematics import (
    attitude_quaternion,
    error_quaternion,
    error_rate_matrix,
)
from driftlab.quaternion import rotate, rotation_angle, to_rotation_vector

DURATION = 60.0
"""Length of a history, s."""
SAMPLES = 601
"""Times in a history."""
SPIN = 12.0
"""Rate about the third axis, degrees a second, of the presets whose true rate has one axis."""
MOMENTS = 301
"""Times of an error in space; a turn of 12 degrees a second ends at one of them."""


class ErrorMotion(NamedTuple):
    """Error quaternion over time."""

    time: FloatArray  # (m,), s
    exact: FloatArray  # (m, 4), error quaternion in closed form
    integrated_time: FloatArray  # (n,), the integrator's own steps, s
    integrated: FloatArray  # (n, 4), error quaternion as integrated
    tolerance: float  # of the integrator
    turn: float  # how long a whole turn of the body takes, s; infinity if it stands still

    @property
    def angle(self) -> FloatArray:
        """Angle (m,) of the error, rad."""
        return rotation_angle(self.exact)

    @property
    def whole_turns(self) -> FloatArray:
        """When the body has made whole turns, before the end, s."""
        last = self.time[-1]
        return np.arange(self.turn, last, self.turn) if self.turn < last else np.zeros(0)


def error_motion(
    rate: ArrayLike = (0.1, 0.2, 0.1),
    measured_rate: ArrayLike = (0.12, 0.15, 0.1),
    duration: float = DURATION,
    tolerance: float = 1e-2,
) -> ErrorMotion:
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
    exact = error_quaternion(rate, measured_rate, time)
    speed = float(np.linalg.norm(rate))
    turn = 2 * np.pi / speed if speed else np.inf
    return ErrorMotion(time, exact, solution.t, solution.y.T, tolerance, turn)


def integration_error(motion: ErrorMotion, rate: ArrayLike, measured_rate: ArrayLike) -> FloatArray:
    """Distance (n,) of the integrated quaternion from the exact one at the integrator's steps."""
    exact = error_quaternion(rate, measured_rate, motion.integrated_time)
    return np.linalg.norm(motion.integrated - exact, axis=-1)


class ErrorInSpace(NamedTuple):
    """True and computed attitude of a body, and the rotation between them, over time."""

    time: FloatArray  # (m,), s
    attitude: FloatArray  # (m, 4), true, body to reference
    apparent: FloatArray  # (m, 4), computed, body to reference
    vector: FloatArray  # (m, 3), rotation vector from the one to the other, in reference axes, rad
    # (m, 3), false rate in reference axes, rad/s: what, to first order, changes the vector
    added: FloatArray
    angle: FloatArray  # (m,), of the error, rad
    turn: float  # time of a whole turn, s; infinite without a rate

    @property
    def whole_turns(self) -> NDArray[np.intp]:
        """The moments (t,) that are nearest to whole turns, from the start on."""
        count = int(self.time[-1] / self.turn + 1e-9)
        step = self.time[1] - self.time[0]
        return np.rint(np.arange(count + 1) * (self.turn if count else 0.0) / step).astype(int)


def error_in_space(
    rate: ArrayLike, false_rate: ArrayLike, duration: float = DURATION
) -> ErrorInSpace:
    """Follow a body at a constant rate, and a computer that adds a false one, from [0, 0, 0, 1]."""
    if not finite_array(duration, "duration") > 0:
        raise ValueError(f"duration: expected a number above 0, got {duration!r}.")
    omega, false = finite_array(rate, "rate", 3), finite_array(false_rate, "false_rate", 3)
    time = np.linspace(0.0, duration, MOMENTS)
    attitude = attitude_quaternion(omega, time)
    error = error_quaternion(omega, omega + false, time)
    speed = float(np.linalg.norm(omega))
    return ErrorInSpace(
        time,
        attitude,
        attitude_quaternion(omega + false, time),
        rotate(attitude, to_rotation_vector(error)),
        rotate(attitude, false),
        rotation_angle(error),
        2 * np.pi / speed if speed else np.inf,
    )
