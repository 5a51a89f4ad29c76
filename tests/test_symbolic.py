"""The SymPy objects are the NumPy ones, entry by entry."""

import numpy as np
import pytest
import sympy as sp
from scipy.spatial.transform import Rotation

from driftlab import kinematics, quaternion, symbolic

RATE, MEASURED = np.array([0.3, -0.2, 0.7]), np.array([0.31, -0.25, 0.6])
ATTITUDE = np.array([0.1, -0.5, 0.3, 0.8])


def numbers(matrix: sp.Matrix) -> np.ndarray:
    return np.array(matrix, dtype=float).squeeze()


@pytest.mark.parametrize(
    ("symbolic_matrix", "numeric"),
    [
        (symbolic.rate_matrix(sp.Matrix(RATE)), kinematics.rate_matrix(RATE)),
        (
            symbolic.error_rate_matrix(sp.Matrix(RATE), sp.Matrix(MEASURED)),
            kinematics.error_rate_matrix(RATE, MEASURED),
        ),
        (
            symbolic.error_composition_matrix(sp.Matrix(ATTITUDE)),
            kinematics.error_composition_matrix(ATTITUDE),
        ),
        (symbolic.left_matrix(sp.Matrix(ATTITUDE)), quaternion.left_matrix(ATTITUDE)),
        (symbolic.right_matrix(sp.Matrix(ATTITUDE)), quaternion.right_matrix(ATTITUDE)),
        (
            symbolic.rotation_exponential(sp.Matrix(RATE), sp.Float(2)),
            Rotation.from_rotvec(2 * RATE).as_quat(),
        ),
    ],
)
def test_agrees_with_numpy(symbolic_matrix: sp.Matrix, numeric: np.ndarray) -> None:
    np.testing.assert_allclose(numbers(symbolic_matrix), numeric, rtol=0, atol=1e-15)


def test_symbols_are_ordered_scalar_last() -> None:
    assert [str(s) for s in symbolic.quaternion("q")] == ["q_1", "q_2", "q_3", "q_0"]
    assert [str(s) for s in symbolic.vector("w")] == ["w_1", "w_2", "w_3"]


def test_simplified_finds_a_hidden_zero() -> None:
    x = sp.symbols("x", positive=True)
    hidden = sp.Matrix([sp.sqrt(x) ** 2 - x, (x**2 - 1) / (x - 1) - x - 1, x / x - 2])
    assert symbolic.simplified(hidden) == sp.Matrix([0, 0, -1])
