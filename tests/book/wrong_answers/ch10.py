"""Wrong answers to the exercises of chapter 10."""

import numpy as np
import sympy as sp

_X, _Y, _Z = sp.symbols("kappa_1:4")
_CROSS = sp.Matrix([[0, -_Z, _Y], [_Z, 0, -_X], [-_Y, _X, 0]])

WRONG = {
    "10.1": [
        ([20, 0, 0, -20], "rotation of the components"),
        ([40, 0, 0, 20], "each side of the diagonal"),
        ([40, 0, 0, 40], "gyro x alone"),
        ([0, 0, 0, 40], "Has gyro y turned"),
        ([20, 20, 0, 0], "axis of the turn"),
    ],
    "10.2": [
        ([[0, -40, 0], [40, 0, 0], [0, 0, 0]], "axis z has not moved"),
        ([[0, -40, -40], [-40, 0, -40], [-40, -40, 0]], "non-orthogonality and nothing else"),
        ([[0, 40, -40], [-40, 0, 40], [40, -40, 0]], "All misalignments are negative"),
    ],
    "10.3": [
        ("abde", r"\(b\)"),
        ("acde", r"\(c\)"),
        ("adef", r"\(f\)"),
        ("ad", "something else is too"),
        ("bf", "^not yet. More than one statement"),
    ],
    "10.4": [
        # By the formula of first order: C κ is (κ_y, κ_z, κ_x) at first, and κ itself at the end.
        ([[-30, 20, 60], [90, -50, -40]], "wrong sign"),
        ([[30, -20, -60], [30, -20, -60]], "already"),
        ([[-60, 30, -20], [90, -50, -40]], r"C\(0\) is missing"),
        (np.radians([[30, -20, -60], [90, -50, -40]]) / 3600, "this is in radians"),
    ],
    "10.5": [
        (sp.zeros(3, 3), "symmetric part of a sum"),
        (lambda x, y, z: np.zeros((3, 3)), "symmetric part of a sum"),
        (-_CROSS * _CROSS, "the square of what you want"),
        (_CROSS * _CROSS / 2, "true rotation"),
        (sp.diag(_Y**2 + _Z**2, _X**2 + _Z**2, _X**2 + _Y**2) / 2, "angles between them"),
    ],
}
