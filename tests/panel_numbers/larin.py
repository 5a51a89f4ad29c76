"""Rows of the panels of Part I."""

import numpy as np
from scipy.constants import arcminute, arcsecond
from scipy.integrate import solve_ivp

from driftlab.book.ch04_calibration_by_turns.experiments import PLANS
from driftlab.drift.characteristic_equation import (
    asymptotic_roots,
    characteristic_polynomial,
    exact_roots,
)
from driftlab.drift.systematic_drift import drift_per_turn, principal_drifts
from driftlab.drift.turn_calibration import TurnExperiment
from driftlab.drift.weighing_designs import fit_turns, weighing
from driftlab.quaternion import from_rotation_vector, multiply, pure
from driftlab.triad import measured_rate

from .values import Rows, Values, axis_of, listed

# Larin's shapes of the deformation, once more, from his paper and the chapter.
SHAPES = {
    "symmetric": np.ones((3, 3)) - np.eye(3),
    "skew": np.cross(np.eye(3), [-1.0, -1.0, -1.0]),
    "third axis bent, as in Larin's table": np.outer([0, 0, 1], [1, -1, 0]),
    "x leans to axis 2 only": np.outer([1, 0, 0], [0, 1, 0]),
    "scale factor of all three": np.eye(3),
}


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


def roots(values: Values) -> Rows:
    rate = axis_of(values)
    triad_error = values["size"] * SHAPES[values["shape"]]
    measured = measured_rate(rate, triad_error)
    slow = np.linalg.norm(measured) - np.linalg.norm(rate)
    first, second = (asymptotic_roots(rate, triad_error, order=n).imag for n in (1, 2))
    printed = characteristic_polynomial(rate, measured, as_printed=True)
    sizes = np.sort(np.abs(np.sqrt(np.roots(printed[::2]) + 0j).imag))
    return [
        (name, f"{fast:.9f} i, {slow:.9f} i")
        for name, fast, slow in (
            ("exact", exact_roots(rate, measured).imag.max(), slow),
            ("first order, (2.2)", first[0], first[2]),
            ("with the next term", second[0], second[2]),
            ("(2.1) as printed", sizes[1], np.copysign(sizes[0], slow)),
        )
    ]


def drift(values: Values) -> Rows:
    entries = [values[f"m{row}{column}"] for row in (1, 2, 3) for column in (1, 2, 3)]
    triad_error = 1e-3 * np.reshape(entries, (3, 3))
    axis = axis_of(values)
    first_order = 2 * np.pi * axis @ triad_error @ axis
    extremes, axes = principal_drifts(triad_error, exact=True)
    largest = np.abs(extremes).argmax()
    worst = 2 * np.pi * extremes[largest]
    return [
        ("drift a turn, exact", f"{drift_per_turn(axis, triad_error) / arcminute:.3f} arcmin"),
        ("first order", f"{first_order / arcminute:.3f} arcmin"),
        ("drift a turn about the worst axis", f"{worst / arcminute:.3f} arcmin"),
        ("which is", np.array2string(axes[largest].round(3), suppress_small=True)),
    ]


def turn_calibration(values: Values) -> Rows:
    s1, s2, s3, skew, scale = 1e-3 * listed(values, "sigma1 sigma2 sigma3 skew scale")
    triad = np.array(
        [[scale, s1, s2 - skew], [s1, scale, s3 + skew], [s2 + skew, s3 - skew, scale]]
    )
    plan = PLANS[values["plan"]]
    noise = values["noise"] * arcsecond
    experiment = TurnExperiment(values["turns"], values["steps"], values["formula"], noise)
    runs = 12 if noise else 1
    axes = np.tile(plan.axes, (runs, 1, 1))
    estimates = experiment.estimate(triad, axes, np.random.default_rng(1987))
    if plan.method == "yates":
        found = weighing(estimates * [1, 1, 1, 1.5])
    else:
        found = fit_turns(estimates, plan.axes, plan.method).sigma
    suffix = f" true, found{f', mean of {runs}' if noise else ''}, 1e-3"
    return [
        (f"σ{index}{suffix}", f"{1e3 * true:.3f}, {1e3 * mean:.6f}")
        for index, true, mean in zip("₁₂₃", (s1, s2, s3), found.mean(axis=0), strict=True)
    ]
