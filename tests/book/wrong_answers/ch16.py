"""Wrong answers to the exercises of chapter 16."""

import sympy as sp

K_11, K_21, K_31, gamma = sp.symbols("K_11 K_21 K_31 gamma", real=True)

WRONG = {
    "16.1": [
        ([1.41, 1.41], "tilt grows as a whole"),
        ([2, 2], "right gyro leans as well"),
        ([1, 1], "more and more of an East tilt"),
    ],
    "16.2": [
        ("abcf", r"^not yet. \(c\)"),
        ("abdf", r"\(d\)"),
        ("abef", r"\(e\)"),
        ("ab", "something else is too"),
        ("ce", "^not yet. More than one statement"),
    ],
    "16.3": [
        ([1, 2.97, 2.97], "nothing to do with the Earth"),
        ([1, 2.41, 2.41], "this part grows"),
        ([1, 0.337, 0.415], "way back to the South"),
    ],
    "16.4": [
        (-30, "right gyro makes an East tilt too"),
        (-40, "Look at the sign"),
        (20, "a turn to the East"),
    ],
    "16.5": [
        ([2.83, 0, 0], "that line turns too"),
        ([0, 0, 4], "a quarter of a turn farther"),
        ([0.68, 0.067, 0.039], "in degrees"),
    ],
    "16.6": [
        (-K_31 * gamma, "rolls too"),
        (K_21 * (1 - sp.cos(gamma)) + K_31 * sp.sin(gamma), "the other way"),
        (-K_31 * sp.sin(gamma), "leans sideways"),
        (-K_11 * gamma, "line of the bow"),
    ],
}
