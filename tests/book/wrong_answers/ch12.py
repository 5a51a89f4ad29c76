"""Wrong answers to the exercises of chapter 12."""

import numpy as np
import sympy as sp

_M, _N = sp.symbols("m N", positive=True)

WRONG = {
    "12.1": [
        ("acf", r"\(a\)"),
        ("bcf", r"\(b\)"),
        ("cdf", r"\(d\)"),
        ("cef", r"\(e\)"),
        ("c", "something else is too"),
        ("ab", "^not yet. More than one statement"),
    ],
    "12.2": [
        ([30, 268], "Squares are compared"),
        ([64, 8], "exchanged"),
    ],
    "12.3": [
        (2 / (_M * _N), "variance of the mean"),
        (sp.sqrt(2 / _M) / _N, "fall like the number of runs"),
        (sp.sqrt(2 * _M / _N), "divided by the number of states"),
        (1 / sp.sqrt(_M * _N), "square of a normal number"),
    ],
    "12.4": [
        (2.0, "Twice the deviation"),
        (4.0, "were all"),
        (1.0, "told the truth"),
        (11.4, "three components"),
    ],
    "12.5": [
        (lambda r, omega: r * omega**2, "acceleration of one"),
        (lambda r, omega: r * omega, "stops with the table"),
        (lambda r, omega: np.sqrt(2) * r * omega, "one accelerometer alone"),
        (lambda r, omega: 0.0, "would leave nothing"),
    ],
    "12.6": [
        ("abcd", r"\(c\)"),
        ("abde", r"\(e\)"),
        ("abdf", r"\(f\)"),
        ("ab", "something else is too"),
        ("cef", "^not yet. More than one statement"),
    ],
}
