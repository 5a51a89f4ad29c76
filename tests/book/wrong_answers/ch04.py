"""Wrong answers to the exercises of chapter 04."""

import numpy as np
import sympy as sp

Y1, Y2, Y3, Y4 = sp.symbols("y_1:5")


def _least_squares_without_offset(*estimates):
    design = np.vstack([np.eye(3), np.full(3, 2 / 3)])
    return np.linalg.lstsq(design, np.array(estimates), rcond=None)[0][0]


WRONG = {
    "4.1": [
        (0.02, "does not count whole turns"),
        (0.04 / 48, "The sign"),
        (-0.08 / 48, "Half of the angle"),
        (0.96, "divides by the turns again"),
        (-0.8333, "in thousandths"),
        (0.0, "not yet"),
    ],
    "4.2": [
        (75, "still has a share"),
        (64, "taylor-4"),
        (46, "just cancels the bias"),
        (84, "^not yet. Close"),
    ],
    "4.3": [
        ([3 / 4, 1 / 4, 1 / 2], "Your turn about the space diagonal.*2/3 of it"),
        ([3 / 4, 9 / 16, 1 / 2], "The first number.*2/3 of the sum"),
        ([17 / 21, 17 / 21, 1 / 2], "gives up all pair axes"),
        ([17 / 7, 27 / 16, 3 / 2], "sums of the three variances"),
        (np.sqrt([17 / 21, 9 / 16, 1 / 2]), "standard deviations"),
    ],
    "4.4": [
        ((Y1 - Y2 - Y3 + Y4) / 2, "but it is 2/3 of it"),
        ((Y1 - Y2 - Y3 + 3 * Y4 / 2) / 2, "a quarter of it stays"),
        (lambda a, b, c, d: (a - b - c + 2 * d / 3) / 2, "upside down"),
        (_least_squares_without_offset, "least squares without an offset"),
        (Y1, "takes the offset in full"),
    ],
}
