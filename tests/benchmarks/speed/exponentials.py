"""Exponentials of skew 4x4 matrices: how errors go on in a step."""

from collections.abc import Iterator

import mpmath
import numpy as np
from scipy.linalg import expm

from driftlab.drift import error_rate_matrix, error_transition_matrix

from .contenders import floors_here
from .measuring import Contender, Row

COUNT = 10**5
_HELD = 20
"""Matrices whose exponentials are held against mpmath's, in forty digits."""


def cases(count: int) -> tuple[np.ndarray, np.ndarray]:
    """True and measured rates (count, 3)."""
    rng = np.random.default_rng(0)
    rate = rng.normal(size=(count, 3))
    return rate, rate + 0.1 * rng.normal(size=(count, 3))


def rows() -> Iterator[Row]:
    rate, measured = cases(COUNT)
    matrices = 0.5 * error_rate_matrix(rate, measured)
    with mpmath.workdps(40):
        exact = np.array([
            np.array(mpmath.expm(mpmath.matrix(matrix.tolist())).tolist(), dtype=float)
            for matrix in matrices[:_HELD]
        ])  # fmt: skip

    def error(found: np.ndarray) -> float:
        return float(np.abs(found[:_HELD] - exact).max())

    copies, left_out = floors_here(matrices)
    yield Row(
        "exponentials",
        f"{COUNT} exponentials of skew 4x4 matrices",
        Contender("driftlab", lambda: error_transition_matrix(rate, measured, 1.0), error),
        [Contender("scipy.linalg.expm", lambda: expm(matrices), error)],
        copies,
        [],
        left_out,
        (COUNT, "a matrix"),
        "of an entry",
    )
