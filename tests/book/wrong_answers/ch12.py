"""Wrong answers to the exercises of chapter 12."""

import numpy as np
import sympy as sp

_M, _N = sp.symbols("m N", positive=True)

WRONG = {
    "12.1": [
        (2 / (_M * _N), "variance of the mean"),
        (sp.sqrt(2 / _M) / _N, "fall like the number of runs"),
        (sp.sqrt(2 * _M / _N), "divided by the number of states"),
        (1 / sp.sqrt(_M * _N), "square of a normal number"),
    ],
    "12.2": [
        (2.0, "Twice the deviation"),
        (4.0, "were all"),
        (1.0, "told the truth"),
        (11.4, "three components"),
    ],
    "12.3": [
        (lambda r, omega: r * omega**2, "acceleration of one"),
        (lambda r, omega: r * omega, "stops with the table"),
        (lambda r, omega: np.sqrt(2) * r * omega, "one accelerometer alone"),
        (lambda r, omega: 0.0, "would leave nothing"),
    ],
}
