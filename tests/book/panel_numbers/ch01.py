"""Rows of the panel of chapter 01."""

import numpy as np
from scipy.integrate import solve_ivp

from driftlab.drift.characteristic_equation import exact_roots
from driftlab.drift.error_kinematics import error_quaternion
from driftlab.quaternion import from_rotation_vector, multiply, pure

from .values import ABSENT, Rows, Values, angle, listed, three_digits


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
    after = ABSENT
    if rate.any():
        turned = error_quaternion(rate, measured, 2 * np.pi / np.linalg.norm(rate))
        after = angle(2 * np.arctan2(np.linalg.norm(turned[:3]), abs(turned[3])))
    return [
        ("error after one whole turn", after),
        ("true rate", f"{sizes[0]:.3f} °/s"),
        ("measured rate", f"{sizes[1]:.3f} °/s"),
        ("sum: the fast root", f"{fast:.3f} °/s"),
        ("difference: the slow one", f"{sizes[1] - sizes[0]:.3f} °/s"),
        ("steps of the integrator", f"{len(times) - 1}"),
        ("its largest error", three_digits(worst)),
    ]
