"""Wrong answers to the exercises of chapter 02."""

import numpy as np
import sympy as sp

RHO, ACROSS, MU = sp.symbols("rho_1 r mu", real=True)


def _root(shape, rate, size):
    rate = np.array(rate)
    return np.linalg.norm(rate + size * np.array(shape) @ rate) + np.linalg.norm(rate)


def _second_order(shape, rate, size):
    rate = np.array(rate)
    speed = np.linalg.norm(rate)
    error = np.array(shape) @ rate / speed
    along = error @ rate / speed
    across = error @ error - along**2
    return speed * (2 + size * along + size**2 * across / 2), size**3 * along * across / 2


def _errors(*, weight):
    """Formula minus root: without the new term (0), or with it in units of the speed (-1)."""
    shape = [[0.2, 1, 0.5], [-0.4, 0, 0.8], [1, 0.3, -0.6]]
    rate = [0.3, -0.2, 0.6]
    found = []
    for size in (0.1, 0.05):
        series, term = _second_order(shape, rate, size)
        found.append(series + weight * term - _root(shape, rate, size))
    return found


WRONG = {
    "2.1": [
        ("abce", r"\(b\) holds to first order only"),
        ("acde", r"\(d\)"),
        ("acef", r"one and the same proportion"),
        ("ac", "something else is too"),
        ("bf", "^not yet. More than one statement"),
    ],
    "2.2": [
        ([-90, 90], "Larin's slow root is zero"),
        ([-135, 45], "where the slow root is largest|where two formulas agree"),
        ([0, -180], "from −179 degrees up"),
        (np.radians([0, 180]), "asked in degrees"),
        (0, "Expected 2 numbers"),
    ],
    "2.3": [
        ("abce", r"\(a\) asks for too much"),
        ("bcde", r"\(d\)"),
        ("bcef", r"\(f\) confuses"),
        ("bc", "something else is too"),
        ("af", "^not yet. More than one statement"),
    ],
    "2.4": [
        (RHO * ACROSS**2, "the sign and a constant factor are not"),
        (-ACROSS * RHO**2 / 2, "Two of the arguments have changed places"),
        (RHO * ACROSS**2 / 2, "The sign"),
        (-RHO * (RHO**2 + ACROSS**2) / 2, "cube in the binomial series"),
        (lambda rho, r: -3 * rho * r**2, "third derivative"),
        (-(MU**3) * RHO * ACROSS**2 / 2, "found also mu"),
    ],
    "2.5": [
        (_errors(weight=0), "without the new term"),
        (_errors(weight=-1), "lacks a factor"),
        ([-4.17479e-5, -5.24829e-6], "wrong sign"),
        ([6.5176e-7, 3.88960e-8], "in units of the rate's size"),
    ],
}
