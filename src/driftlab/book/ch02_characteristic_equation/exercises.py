"""Exercises of chapter 02: the characteristic equation and its roots."""

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

import numpy as np

from driftlab.book.machinery.exercise.answers import Choice, Value
from driftlab.book.machinery.exercise.exercise import Exercise
from driftlab.book.machinery.exercise.formulas import Formula
from driftlab.book.machinery.exercise.given_numbers import GivenNumbers
from driftlab.book.machinery.exercise.reading import SettingError
from driftlab.checks import FloatArray
from driftlab.drift.characteristic_equation import asymptotic_roots, exact_roots
from driftlab.drift.systematic_drift import drift_coefficient, drift_per_revolution
from driftlab.triad import measured_rate
from driftlab.vectors import direction_from_angles

AZIMUTHS = np.arange(-179.0, 181.0)
LEANS = 0.3 * np.array([[0, 1, 0], [0, 0, 0], [0, 0, 0]])
SIZES = np.array([0.1, 0.05])


def _slow_roots() -> tuple[FloatArray, FloatArray]:
    """Slow root about the axes of `AZIMUTHS`, 15 degrees up: to first order, and what it lacks."""
    axes = direction_from_angles(np.radians(AZIMUTHS), np.radians(15))
    first_order = drift_coefficient(axes, LEANS)
    return first_order, drift_per_revolution(axes, LEANS) / (2 * np.pi) - first_order


def _first_order_exact() -> FloatArray:
    return AZIMUTHS[np.abs(_slow_roots()[1]) < 1e-12]


def _first_order_zero() -> FloatArray:
    first_order, lacks = _slow_roots()
    return AZIMUTHS[(np.abs(first_order) < 1e-12) & (lacks > 1e-12)]


def _first_order_largest() -> FloatArray:
    first_order, _ = _slow_roots()
    return AZIMUTHS[first_order > first_order.max() - 1e-12]


def _one_of_two(values: Mapping[str, Any]) -> FloatArray:
    """What the panel shows is one azimuth, and two are asked: say whether it is one of them."""
    if values["shape"] != "x leans to axis 2 only":
        raise SettingError("Choose the shape `x leans to axis 2 only`.")
    if values["azimuth"] % 180:
        raise SettingError("At this azimuth the rows `exact` and `first order` differ.")
    raise SettingError("Here first order is exact. Find the other azimuth too, and give both.")


@cache
def _cubic(*, as_copied: bool = False, powers: int = 3) -> Callable[..., float]:
    """Coefficient of mu^3 in the fast root, a function of rho_1 and r.

    Of the root of (2.1) as the copy has it if asked for, or of the exact root with the binomial
    series sqrt(1 + x) = 1 + x/2 - ... cut off after a power of x.
    """
    import sympy as sp  # no other exercise of the chapter needs it

    mu, rho, r, x = sp.symbols("mu rho_1 r x", real=True)
    across = rho**2 + r**2
    if as_copied:
        sum_of_squares = 4 + 4 * mu * rho + mu**2 * across
        product = (2 * mu * rho + mu**2 * across) ** 2
        root = sp.sqrt((sum_of_squares + sp.sqrt(sum_of_squares**2 - 4 * product)) / 2)
        expansion = sp.series(root, mu, 0, 4).removeO()
    else:
        binomial = sp.series(sp.sqrt(1 + x), x, 0, powers + 1).removeO()
        expansion = 1 + binomial.subs(x, 2 * mu * rho + mu**2 * across)
    return sp.lambdify((rho, r), sp.expand(expansion).coeff(mu, 3))


def _along_and_across(T: FloatArray, omega: FloatArray) -> tuple[float, float]:
    """rho_1 and r about the axis of a rate."""
    axis = omega / np.linalg.norm(omega)
    error = T @ axis
    along = float(error @ axis)
    return along, float(np.linalg.norm(error - along * axis))


def _errors(T: FloatArray, omega: FloatArray, weight: float = 1.0) -> FloatArray:
    """Error of the fast root at `SIZES`, its mu^3 term multiplied by `weight`; rad/s."""
    term = float(np.linalg.norm(omega)) * _cubic()(*_along_and_across(T, omega))
    triad_errors = SIZES[:, np.newaxis, np.newaxis] * T
    series = asymptotic_roots(omega, triad_errors, order=2)[:, 0].imag
    exact = exact_roots(omega, measured_rate(omega, triad_errors))[:, 0].imag
    return series + weight * SIZES**3 * term - exact


def _some_triad(rng: np.random.Generator) -> dict[str, FloatArray]:
    """A triad whose series about this axis has a term in mu^3, and one in mu^4."""
    while True:
        T, omega = (np.round(rng.uniform(-1, 1, shape), 1) + 0.0 for shape in ((3, 3), 3))
        if 0.4 < np.linalg.norm(omega) < 0.8:
            along, across = np.abs(_along_and_across(T, omega))
            if along > 0.2 and along < across < 1.5 * along:
                return {"T": T, "omega": omega}


EXERCISES: dict[str, Exercise] = {
    "2.1": Choice(
        kind="predict",
        right="ace",
        wrong={
            "b": "holds to first order only. What the gyros pick up beside the axis makes the "
            "measured rate a little longer.",
            "d": "sets the size of each row, not the angles between the rows. Two axes that lean "
            "to each other report more than there is about the line between them.",
            "f": "makes every measured rate longer or shorter in one and the same proportion.",
        },
        remark="The slow root cannot tell a wrong sign from a good gyro.",
    ),
    "2.2": Value(
        kind="slide",
        right=_first_order_exact,
        unit="degrees",
        absolute=0.5,
        any_order=True,
        from_panel=_one_of_two,
        mistakes={
            "There Larin's slow root is zero, and the true one is not: compare the two rows of "
            "numbers.": _first_order_zero,
            "There the slow root is largest. Look for the place where two formulas agree, not for "
            "the largest root.": _first_order_largest,
            "One of the two belongs to Larin's slow root: he has zero there, the truth has not.": (
                lambda: np.array([0.0, 90.0])
            ),
            "One of the two is the right axis, by the name that the exercise leaves out: give "
            "azimuths from −179 degrees up.": lambda: _first_order_exact() - [0, 360],
        },
        remark="All of it is along the axis there. The elevation does not matter: a whole plane.",
    ),
    "2.3": Choice(
        kind="explain",
        right="bce",
        wrong={
            "a": "asks for too much: the determinant knows the two lengths and no direction.",
            "d": "would be so for a matrix that lacks eigenvectors. A skew matrix has a full set "
            "of them, also for equal roots.",
            "f": "confuses one solution with all. A zero root says that some errors stay; the one "
            "that starts at no error is not among them, unless the two rates are equal.",
        },
        remark="Singular is what a calibration should make it.",
    ),
    "2.4": Formula(
        kind="compute",
        arguments=("rho_1", "r"),
        draw=lambda rng: tuple(rng.uniform(0.5, 2, 2)),
        right=lambda rho, r: _cubic()(rho, r),
        mistakes={
            "The sign: the longer the part along the axis, the less the perpendicular part adds to "
            "the length.": lambda rho, r: -_cubic()(rho, r),
            "The cube in the binomial series is missing; it has a term in μ³ as well.": (
                lambda rho, r: _cubic(powers=2)(rho, r)
            ),
            "This is for an equation with one term missing. Start from the exact root.": (
                lambda rho, r: _cubic(as_copied=True)(rho, r)
            ),
            "This is the third derivative; the series divides it by a factorial.": (
                lambda rho, r: 6 * _cubic()(rho, r)
            ),
        },
        remark="It is the same for the slow root. And it is zero where r is.",
    ),
    "2.5": Value(
        kind="compute",
        given=GivenNumbers(
            book={
                "T": np.array([[0.2, 1, 0.5], [-0.4, 0, 0.8], [1, 0.3, -0.6]]),
                "omega": np.array([0.3, -0.2, 0.6]),
            },
            draw=_some_triad,
            units={"omega": "rad/s"},
        ),
        right=_errors,
        unit="rad/s",
        mistakes={
            "That is the error without the new term.": lambda **triad: _errors(**triad, weight=0),
            "The new term is added with the wrong sign.": lambda **triad: _errors(
                **triad, weight=-1
            ),
            "The new term lacks a factor: the series is in units of the rate's size.": (
                lambda T, omega: _errors(T, omega, 1 / float(np.linalg.norm(omega)))
            ),
            "This is in units of the rate's size; the roots are in radians per second.": (
                lambda T, omega: _errors(T, omega) / np.linalg.norm(omega)
            ),
        },
    ),
}
