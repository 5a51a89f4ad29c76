"""Rows of the panel of chapter 01."""

import numpy as np
from scipy.integrate import solve_ivp

from driftlab.drift.characteristic_equation import exact_roots
from driftlab.quaternion import from_rotation_vector, multiply, pure

from .values import Rows, Values, listed


def error_motion(values: Values) -> Rows:
    rate = np.radians(listed(values, "rate1 rate2 rate3"))
    measured = rate + np.radians(listed(values, "error1 error2 error3"))
    fast = np.degrees(exact_roots(rate, measured).imag.max())
    sizes = np.degrees(np.linalg.norm([rate, measured], axis=-1))
    # (1.4) as a product of quaternions, and its solution as a product of two rotations.
    true, false = pure(rate), pure(measured)
    found = solve_ivp(
        lambda _, error: 0.5 * (multiply(error, false) - multiply(true, error)),
        *((0, 60), [0, 0, 0, 1]),
        rtol=values["tolerance"],
        atol=values["tolerance"],
    )
    times = found.t[:, np.newaxis]
    exact = multiply(from_rotation_vector(-times * rate), from_rotation_vector(times * measured))
    worst = np.linalg.norm(found.y.T - exact, axis=-1).max()
    return [
        ("true rate", f"{sizes[0]:.3f} deg/s"),
        ("measured rate", f"{sizes[1]:.3f} deg/s"),
        ("their sum, fast", f"{fast:.3f} deg/s"),
        ("their difference, slow", f"{sizes[1] - sizes[0]:.3f} deg/s"),
        ("RK45 steps", f"{len(times) - 1}"),
        ("its worst error", f"{worst:.1e}"),
    ]
