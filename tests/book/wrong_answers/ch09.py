"""Wrong answers to the exercises of chapter 09."""

import numpy as np
import sympy as sp

_H0, _G, _R = sp.symbols("h_0 g R", positive=True)
_Q, _T = sp.symbols("q T", positive=True)
_EN, _EU, _ELL = sp.symbols("e_N e_U ell", real=True)

WRONG = {
    "9.1": [
        ("abde", r"\(b\)"),
        ("acde", r"\(c\)"),
        ("adef", r"\(f\)"),
        ("de", "something else is too"),
        ("bf", "^not yet. More than one statement"),
    ],
    "9.2": [
        (0.01**2 / 0.0256, "exchanged in the ratio"),
        (2.56, "ratio of the two amplitudes"),
        (1.24e-7, "radians per second"),
    ],
    "9.3": [
        (_H0 * sp.cosh(_T * sp.sqrt(_G / _R)), "distance from the centre is squared"),
        (_H0 * sp.exp(_T * sp.sqrt(2 * _G / _R)), "half of it belongs"),
        (_H0 * sp.exp(_T * sp.sqrt(2 * _G / _R)) / 2, "In the end this is right"),
        (lambda h_0, T, g, R: h_0 * np.cos(T * np.sqrt(2 * g / R)), "swing"),
    ],
    "9.4": [
        (_Q * sp.sqrt(_T), "standard deviation of the velocity"),
        (_Q * _T ** sp.Rational(3, 2), "from the beginning"),
        (_Q**2 * _T**3 / 3, "variance"),
        (_Q * _T ** sp.Rational(3, 2) / 2, "constant acceleration"),
        (lambda q, T: q * T**2 / 2, "square of their sum"),
    ],
    "9.5": [
        (-_EN * sp.cos(_ELL) - _EU * sp.sin(_ELL), "The sign"),
        (_EN * sp.sin(_ELL) + _EU * sp.cos(_ELL), "exchanged"),
        (_EN * sp.sin(_ELL) - _EU * sp.cos(_ELL), "comes back"),
        ((_EN * sp.cos(_ELL) + _EU * sp.sin(_ELL)) * sp.cos(_ELL), "degree of longitude"),
        (_EN / sp.cos(_ELL), "how it begins"),
        (_EN + _EU * sp.tan(_ELL), "already"),
        (_EN * sp.cos(_ELL) - _EU * sp.sin(_ELL), "sign of the vertical bias"),
    ],
    "9.6": [
        ("abde", r"\(b\)"),
        ("acde", r"\(c\)"),
        ("adef", r"\(f\)"),
        ("ae", "something else is too"),
        ("bf", "^not yet. More than one statement"),
    ],
}
