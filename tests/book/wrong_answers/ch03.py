"""Wrong answers to the exercises of chapter 03."""

import numpy as np
from scipy.spatial.transform import Rotation

LARIN = 1e-3 * np.array([[0, 0, 0], [0, 0, 0], [2, -2, 0]])
AXES = np.array([[1, 0, 1], [0, 1, 1]]) / np.sqrt(2)


def _loop(axis):
    return Rotation.from_rotvec(2 * np.pi * (np.eye(3) + LARIN) @ axis)


def _arcmin(rotation):
    return 60 * np.degrees(rotation.as_rotvec())


WRONG = {
    "3.1": [
        ([1, -1, -1, 0, 0, 0.5], "the first, turned the other way"),
        ([1, 1, -1, 0, 0, 1], "unit vector"),
        ([1, 1, 1, 0, 1, 0.7071], "size of the whole rate error"),
        ([-1, -1, 1, 0, 0, -0.5], "sign is reversed"),
    ],
    "3.2": [
        (86.4, "six leans alone"),
        (43.2, "not at their ends"),
        (2.16, "this is in degrees"),
        (648, "after all the turns"),
    ],
    "3.3": [
        ("abd", r"\(b\) forgets"),
        ("acd", r"\(c\) counts the three entries"),
        ("ade", r"\(e\).* cone"),
        ("adf", r"\(f\) counts entries"),
        ("d", "something else is too"),
        ("bf", "^not yet. More than one statement"),
    ],
    "3.4": [
        (_arcmin(_loop(AXES[1]) * _loop(AXES[0])), "order of the two loops"),
        (21.6 * np.array([1, -1, 0]) / np.sqrt(2), "This is first order"),
        (_arcmin(_loop(AXES[0]) * _loop(-AXES[1])), "wrong sense"),
        (np.radians(_arcmin(_loop(AXES[0]) * _loop(AXES[1])) / 60), "this is in radians"),
    ],
    "3.5": [
        (lambda m: 2 * np.pi * np.linalg.eigvalsh(m)[-1], "M is not symmetric"),
        (lambda m: 2 * np.pi * np.linalg.eigvalsh(m + m.T)[-1], "The half is missing"),
        (lambda m: np.linalg.eigvalsh((m + m.T) / 2)[-1], "This is the coefficient"),
        (lambda m: 2 * np.pi * (np.linalg.norm(np.eye(3) + m, 2) - 1), "This is the exact drift"),
        (lambda m: 2 * np.pi * np.linalg.norm((m + m.T) / 2, 2), "This is the largest size"),
        (3.0e-3, "it is too small"),
    ],
    "3.6": [
        ("abdf", r"\(b\) adds angles"),
        ("acdf", r"\(c\) takes the pace"),
        ("adef", r"\(e\) would be so"),
        ("ad", "something else is too"),
        ("be", "^not yet. More than one statement"),
    ],
}
