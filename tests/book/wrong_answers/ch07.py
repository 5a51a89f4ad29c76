"""Wrong answers to the exercises of chapter 07."""

import numpy as np
import sympy as sp

from driftlab.quaternion import from_rotation_vector, multiply

x = sp.Symbol("x")
G1, G2 = np.array([0.3, -0.1, 0.4]), np.array([0.35, 0.15, 0.25])


def quaternion(k):
    return np.array([*(-2 * k), 1 - k @ k]) / (1 + k @ k)


def step(coning):
    """Quaternion of the step by hand, from a coning correction, scalar last."""
    f = G1 + G2 + coning
    return quaternion(-(1 / 4 + f @ f / 192) * f)


def with_the_cube_of_the_sum():
    gamma, coning = G1 + G2, 2 / 3 * np.cross(G1, G2)
    return quaternion(-(gamma + coning) / 4 - (gamma @ gamma) * gamma / 192)


def by_half_angle():
    f = G1 + G2 + 2 / 3 * np.cross(G1, G2)
    k = -(1 / 4 + f @ f / 192) * f
    return np.array([*-k, 1]) / np.sqrt(1 + k @ k)


RIGHT_STEP = step(2 / 3 * np.cross(G1, G2))

WRONG = {
    "7.1": [
        ([4, 16], "powers of the global order"),
        ([2, 2], "each leaves more"),
        ([32, 8], "exchanged"),
        ([16, 62], "the first is too large"),
        ([4, 32], "The second is right. The first is too small"),
        ([16, 4], "order is not the one that is asked"),
    ],
    "7.2": [
        (48, "A lower rate is enough"),
        (12, "There none is below"),
        (96, "not yet"),
    ],
    "7.3": [
        (269, "look at the order"),
        (215, "goes by the local order"),
        (162, "higher, not lower"),
    ],
    "7.4": [
        ("acef", r"\(e\).*widest cone"),
        ("abcf", r"\(b\) confuses the two orders"),
        ("acdf", r"\(d\) draws the wrong lesson"),
        ("af", "something else is too"),
        ("be", "^not yet. More than one statement"),
    ],
    "7.5": [
        (sp.Rational(1, 12), "limit for a cone"),
        ((x - sp.sin(x)) / (2 * x**2 * sp.sin(x)), "arc for the chord"),
        ((x - sp.sin(x)) / (4 * sp.sin(x / 2) ** 2 * sp.sin(x)), "a constant factor is not"),
        (-(x - sp.sin(x)) / (8 * sp.sin(x / 2) ** 2 * sp.sin(x)), "sign is reversed"),
    ],
    "7.6": [
        (np.roll(RIGHT_STEP, 1), "scalar stands first"),
        (RIGHT_STEP * [-1, -1, -1, 1], "k points against the axis"),
        (step(2 / 3 * np.cross(G2, G1)), "factors exchanged"),
        (by_half_angle(), "quarter of the angle"),
        (step(np.zeros(3)), "cross product is missing"),
        (with_the_cube_of_the_sum(), "takes the corrected sum"),
        (
            multiply(from_rotation_vector(G2), from_rotation_vector(G1)),
            "the first of the two has to be on the left",
        ),
    ],
}
