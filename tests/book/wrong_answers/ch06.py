"""Wrong answers to the exercises of chapter 06."""

import numpy as np
import sympy as sp

from driftlab.quaternion import multiply

phi = sp.Symbol("phi")


def closed_formula(cross_sign):
    """Composition of two vectors in closed form; the sign -1 of the cross product is right."""

    def compose(k1, k2):
        s1, s2 = k1 @ k1, k2 @ k2
        above = (1 - s2) * k1 + (1 - s1) * k2 + cross_sign * 2 * np.cross(k1, k2)
        return above / (1 + s1 * s2 - 2 * k1 @ k2)

    return compose


def with_scalar_first(k1, k2):
    def quaternion(k):
        return np.array([1 - k @ k, *(-2 * k)]) / (1 + k @ k)

    scalar, *vector = multiply(quaternion(k1), quaternion(k2))
    return -np.array(vector) / (1 + scalar)


WRONG = {
    "6.1": [
        ("abcd", r"^not yet. \(c\)"),
        ("abde", r"\(e\) takes what is wise"),
        ("abdf", r"from one end of the swing to the other"),
        ("ab", "something else is too"),
        ("cf", "^not yet. More than one statement"),
    ],
    "6.2": [
        (180, "no length is twice another"),
        (4.19, "in radians. And in the right unit: There the two are equally long"),
        (240, "equally long"),
        (263.6, "exchanged"),
        (141, "as the shadow"),
        (109.5, "angle and its half"),
        (np.radians(219), "asked in degrees; this is in radians"),
    ],
    "6.3": [
        ("abde", r"\(b\) is what no three numbers"),
        ("acde", r"\(c\) is false"),
        ("adef", r"\(f\)"),
        ("ad", "something else is too"),
        ("bf", "^not yet. More than one statement"),
    ],
    "6.4": [
        (-sp.tan(phi / 4), "without the squares"),
        (sp.tan(phi / 8), "The size is right"),
        (lambda angle: -np.sin(angle / 8) / np.cos(angle / 8) / 2, "a constant factor is not"),
        (-sp.tan(sp.Symbol("x") / 8), "found also x"),
    ],
    "6.5": [
        ("abcd", r"\(b\).*denominator"),
        ("acde", r"\(e\) looks at the length"),
        ("acdf", r"\(f\)"),
        ("ac", "something else is too"),
        ("bf", "^not yet. More than one statement"),
    ],
    "6.6": [
        (closed_formula(+1), "factors are exchanged"),
        (lambda k1, k2: k1 + k2, "small angles only"),
        (
            lambda k1, k2: (k1 + k2 - np.cross(k1, k2)) / (1 - k1 @ k2),
            "vectors of dimension 3",
        ),
        (with_scalar_first, "scalar is first"),
    ],
}
