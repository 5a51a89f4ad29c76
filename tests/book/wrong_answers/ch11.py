"""Wrong answers to the exercises of chapter 11."""

import sympy as sp

from driftlab.motion.scheme import Scheme

_Q, _T = sp.symbols("q T", positive=True)

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
    "11.5": [
        ("abde", r"\(b\)"),
        ("acde", r"\(c\)"),
        ("adef", r"\(f\)"),
        ("ad", "something else is too"),
        ("bf", "^not yet. More than one statement"),
    ],
}
