"""Wrong answers to the exercises of chapter 14."""

import sympy as sp

U, g = sp.symbols("U g", positive=True)
phi, v_1, v_3 = sp.symbols("varphi v_1 v_3", real=True)

WRONG = {
    "14.1": [
        ([119, 0, 0.2], "way North turns the level rate"),
        ([0, 55, 0.2], "does not follow it"),
        ([0, 0, 0], "a part of it looks like a tilt"),
        ([0, 0, 0.4], "about the middle"),
        ([0, 0, 1], "first and second are right. The third is too large"),
    ],
    "14.2": [
        ("abcd", r"^not yet. \(c\)"),
        ("abde", r"\(e\)"),
        ("abdf", r"\(f\)"),
        ("ab", "something else is too"),
        ("cf", "^not yet. More than one statement"),
    ],
    "14.3": [
        (297, "swings out twice as far"),
        (0.00168, "the other one"),
        (472, "Not the sine"),
    ],
    "14.4": [
        ([0, 0.116], "the other way round"),
        ([0.1224, 0], "makes the horizon swing"),
        ([0.0973, 0], "Sine for cosine"),
        ([0.02, 0], "angle by which the gyro has drifted"),
    ],
    "14.5": [
        (1, "Schuler's own"),
        (1.05, "at the end"),
        (0.8, "too far"),
    ],
    "14.6": [
        (U * sp.sin(phi) * v_3 / g, "Look at the sign"),
        (-2 * U * sp.sin(phi) * v_3 / g, "whole Coriolis force"),
        (-U * sp.cos(phi) * v_3 / g, "about Up"),
        (-U * sp.sin(phi) * v_1 / g, "tilts about North"),
    ],
}
