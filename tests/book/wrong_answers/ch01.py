"""Wrong answers to the exercises of chapter 01."""

import numpy as np
import sympy as sp

w, m, t = sp.symbols("w m t")

WRONG = {
    "1.1": [
        ([180, 360, 720], "a whole turn more or less"),
        ([90, 180, 360], "how far the body has turned"),
        (np.radians([180, 0, 0]), "asked in degrees"),
        ([180, 360, 0], "After half a turn"),
        ([180, 0, 360], "look at the last of the three"),
        ([90, 180, 0], "third is right, the first and second not yet"),
        (["180", "0", "0"], "without quotation marks"),
    ],
    "1.2": [
        (0.3, "the two sizes"),
        (-2.67, "sign"),
        (0.0465, "asked in degrees per second"),
        (2.5, "Too small"),
        (3, "Too large"),
    ],
    "1.3": [
        ("abce", r"^not yet. \(a\)"),
        ("bcde", r"\(d\)"),
        ("be", "something else is too"),
        ("ad", "^not yet. More than one statement"),
    ],
    "1.4": [
        ([0.9999896, 0.0037533, -0.0000140, 0.0025795], "scalar stands first"),
        ([-0.0028260, 0.0003542, -0.0035538, 0.9999896], "seen from the fixed frame"),
    ],
    "1.5": [
        ([m * w * t, 0, 0], "false rate times the time"),
        ([m * sp.sin(w * t), m * (1 - sp.cos(w * t)), 0], "seen from the reference frame"),
        ([w * m * sp.sin(w * t), w * m * (sp.cos(w * t) - 1), 0], "divides by w again"),
        ([m * sp.sin(w * t) / 2, m * (sp.cos(w * t) - 1) / 2, 0], "half of the rotation vector"),
        ([m * (1 - sp.cos(w * t)), m * sp.sin(w * t), 0], "second gyro picked up"),
        ([m * sp.cos(w * t), -m * sp.sin(w * t), 0], "1 of 3 parts"),
        ("30 degrees", "not readable"),
    ],
}
