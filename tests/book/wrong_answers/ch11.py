"""Wrong answers to the exercises of chapter 11."""

import numpy as np
import sympy as sp

from driftlab.motion.scheme import Scheme

_Q, _T, _M, _N = sp.symbols("q T m N", positive=True)
_EN, _EU, _ELL = sp.symbols("e_N e_U ell", real=True)

WRONG = {
    "11.1": [
        ("abde", r"\(b\)"),
        ("acde", r"\(c\)"),
        ("adef", r"\(f\)"),
        ("de", "something else is too"),
        ("bf", "^not yet. More than one statement"),
    ],
    "11.2": [
        ([[1.16, 2.0, 8.0], [9.3, 5.0, 1.05]], "exchanged"),
        ([[86, 25, 1.1], [1.3, 4, 64]], "ratios of variances"),
        ([[10, 10, 1], [1, 1, 10]], "one noise alone"),
    ],
    "11.3": [
        (_Q * sp.sqrt(_T), "deviation of the angle"),
        (_Q / _T, "random walk"),
        (lambda q, time: q, "grow like the time"),
        (_Q**2 / _T, "variance"),
    ],
    "11.4": [
        (2 / (_M * _N), "variance of the mean"),
        (sp.sqrt(2 / _M) / _N, "fall like the number of runs"),
        (sp.sqrt(2 * _M / _N), "divided by the number of states"),
        (1 / sp.sqrt(_M * _N), "square of a normal number"),
    ],
    "11.5": [
        ("+90Z +90Z +90Z +90Z +90Z", "Unobservable stay 9 among accelerometer bias x"),
        ("+90X +90Y +90Z +90X +90Y +90Z", "7 positions"),
        ("+90X +90Y +90Z +90X +90Y", "Nothing stays unobservable. But accelerometer scale y"),
        # All six faces up, but never a turn about y.
        ("-90X -90Z -180Z +90Z +90X", "gyro scale y"),
        (Scheme("+180X"), "2 positions"),
        ("90X", "not readable. rotations: expected words"),
        (Scheme("+360X +360Y +360Z +360X +360Y", rate=0.01), "not readable. The turns alone"),
        (6, "not readable. Expected a Scheme"),
    ],
    "11.6": [
        ("abde", r"\(b\)"),
        ("acde", r"\(c\)"),
        ("adef", r"\(f\)"),
        ("ad", "something else is too"),
        ("bf", "^not yet. More than one statement"),
    ],
    "11.7": [
        (2.0, "Twice the deviation"),
        (4.0, "were all"),
        (1.0, "told the truth"),
        (11.4, "three components"),
    ],
    "11.8": [
        (lambda r, omega: r * omega**2, "acceleration of one"),
        (lambda r, omega: r * omega, "stops with the table"),
        (lambda r, omega: np.sqrt(2) * r * omega, "one accelerometer alone"),
        (lambda r, omega: 0.0, "would leave nothing"),
    ],
    "11.9": [
        (-_EN * sp.cos(_ELL) - _EU * sp.sin(_ELL), "The sign"),
        (_EN * sp.sin(_ELL) + _EU * sp.cos(_ELL), "exchanged"),
        (_EN * sp.sin(_ELL) - _EU * sp.cos(_ELL), "comes back"),
        ((_EN * sp.cos(_ELL) + _EU * sp.sin(_ELL)) * sp.cos(_ELL), "degree of longitude"),
        (_EN / sp.cos(_ELL), "how it begins"),
        (_EN + _EU * sp.tan(_ELL), "already"),
        (_EN * sp.cos(_ELL) - _EU * sp.sin(_ELL), "sign of the vertical bias"),
    ],
}
