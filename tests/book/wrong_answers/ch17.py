"""Wrong answers to the exercises of chapter 17."""

import numpy as np

T = np.array([[1, 0.006, 0.001], [0.008, 1, -0.054], [0.025, -0.003, 1]])
SCALES = np.diag([0.000209, 0.000210, 0.000209])

WRONG = {
    "17.1": [
        ([-7.20, 6.40], "do not add up"),
        ([-367.20, 6.40], "a whole turn of it is true"),
        ([7.255, -0.126], "negative sense"),
        ([0, 0], "About x more is left"),
    ],
    "17.2": [
        ([0.000347, 0.302], "The mean of both"),
        ([0.5778, 0.302], "part of the turn"),
        ([0.01167, 0.302], "One turn alone"),
        ([0.001605, -0.302], "look at its sign"),
        ([0.01008, 0.302], "over 2π"),
    ],
    "17.3": [
        (169.7, "root of three"),
        (32, "square of the quantisation"),
        (918.6, "later crossing"),
        (50, "factor of two"),
    ],
    "17.4": [
        (T @ SCALES * 4778 - np.eye(3), "Ours goes the other way"),
        (np.eye(3) - T @ SCALES * 4778, "invert the matrix"),
        (np.linalg.inv(SCALES @ T) / 4778 - np.eye(3), "the other way round"),
        (np.linalg.inv(T @ SCALES).T / 4778 - np.eye(3), "changed places"),
        (np.linalg.inv(T @ SCALES) / 4778, "unit matrix is still in it"),
        (np.linalg.inv(T) - np.eye(3), "scales have errors too"),
    ],
    "17.5": [
        (2.303, "lean alone"),
        (0.2112, "noise alone"),
        (1.9786, "only its level part"),
        (3.626, "sine of the latitude"),
        (3.116, "squares add up"),
        (8690, "asked in h"),
    ],
    "17.6": [
        ("abcd", r"\(b\)"),
        ("acde", r"\(e\)"),
        ("acdf", r"\(f\)"),
        ("ac", "something else is too"),
        ("bf", "^not yet. More than one statement"),
    ],
}
