"""Wrong answers to the exercises of chapter 04."""

import numpy as np
import sympy as sp

Y1, Y2, Y3, Y4 = sp.symbols("y_1:5")


def _least_squares_without_offset(*estimates):
    design = np.vstack([np.eye(3), np.full(3, 2 / 3)])
    return np.linalg.lstsq(design, np.array(estimates), rcond=None)[0][0]


WRONG = {
    "4.1": [
        (0, r"2/3 of \(3\.5\)"),
        (0.75e-3, "too small, not too large"),
        (-1e-3, "does not take all of it"),
        (0.5e-3, "what is found"),
        (-1 / 6 * 1e-3, "part of one sigma"),
        (-0.5, "in thousandths"),
    ],
    "4.2": [
        (75, "still has a share"),
        (64, "taylor-4"),
        (46, "just cancels the bias"),
        (84, "^not yet. Close"),
    ],
    "4.3": [
        ("abcd", r"\(c\) has only the part"),
        ("abde", r"\(e\) forgets"),
        ("abdf", r"\(f\) takes two different things"),
        ("ab", "something else is too"),
        ("cf", "^not yet. More than one statement"),
    ],
    "4.4": [
        ([3 / 4, 1 / 4, 1 / 2], r"Your turn about the space diagonal.*2/3 of \(3\.5\)"),
        ([3 / 4, 9 / 16, 1 / 2], r"The first number.*2/3 of \(3\.5\)"),
        ([17 / 21, 17 / 21, 1 / 2], "gives up all four"),
        ([17 / 7, 27 / 16, 3 / 2], "sums of the three variances"),
        (np.sqrt([17 / 21, 9 / 16, 1 / 2]), "standard deviations"),
    ],
    "4.5": [
        ((Y1 - Y2 - Y3 + Y4) / 2, r"2/3 of \(3\.5\)"),
        ((Y1 - Y2 - Y3 + 3 * Y4 / 2) / 2, "a quarter of it stays"),
        (lambda a, b, c, d: (a - b - c + 2 * d / 3) / 2, "upside down"),
        (_least_squares_without_offset, "least squares without an offset"),
        (Y1, "takes the offset in full"),
    ],
    "4.6": [
        (-24.034, "^not yet. The sign"),
        (35.77, "level part"),
        (-35.8, "^not yet. Two slips"),
        (150.9, "in one of the two turns"),
        (43.09, "whole rate of the Earth"),
        (302.0, "divides it by the angle"),
        (48.07, "the number of turns does not matter"),
        (1.1652e-4, "in arc seconds; this is in radians"),
    ],
    "4.7": [
        ([6, 0.25, 0.75], "Count all unknowns"),
        ([8, 0.25, 0.75], "Eight were enough in the text"),
        ([9, 0.25, 0.25], "do not weigh alike"),
        ([12, 0.25, 0.75], "fewer do"),
        ([10, 0.25, 0.75], "no tenth unknown"),
        ([9, 0.5, 1.5], "one sense only"),
        ([9, 0.25, 0.5], "without unknown scale factors"),
        ([9, 0.25, 2 / 3], "one common scale factor"),
        ([9, 0.5, 0.8660], "standard deviations"),
        ([9, 0.75, 0.25], "exchanged"),
    ],
}
