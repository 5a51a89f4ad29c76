"""The SymPy objects are the NumPy ones, entry by entry."""

import numpy as np
import pytest
import sympy as sp
from scipy.spatial.transform import Rotation

from driftlab import quaternion, symbolic
from driftlab.attitude import cayley, riccati
from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS
from driftlab.attitude.integration import step_quaternions, step_rotation_vectors
from driftlab.drift import error_kinematics
from driftlab.symbolic.step_series import Series, algorithm_step_vector
from driftlab.vectors import cross_matrix
from support import EPS

# Quaternions of length one, after some dozen operations in two orders.
STEP = 8 * EPS
RATE, MEASURED = np.array([0.3, -0.2, 0.7]), np.array([0.31, -0.25, 0.6])
ATTITUDE = np.array([0.1, -0.5, 0.3, 0.8])


def numbers(matrix: sp.Matrix) -> np.ndarray:
    return np.array(matrix, dtype=float).squeeze()


@pytest.mark.parametrize(
    ("symbolic_matrix", "numeric"),
    [
        (symbolic.rate_matrix(sp.Matrix(RATE)), error_kinematics.rate_matrix(RATE)),
        (
            symbolic.error_rate_matrix(sp.Matrix(RATE), sp.Matrix(MEASURED)),
            error_kinematics.error_rate_matrix(RATE, MEASURED),
        ),
        *(
            (symbolic.skew_operator(sp.Matrix(RATE), n), cayley.skew_operator(RATE, n))
            for n in (3, 4)
        ),
        *(
            (
                symbolic.riccati_rate(sp.Matrix(RATE), sp.Matrix(MEASURED), n),
                riccati.riccati_rate(RATE, MEASURED, n),
            )
            for n in (3, 4)
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


# Rates over a step whose series have numbers for coefficients, in powers of time / step.
SERIES = np.random.default_rng(9).normal(size=(4, 3))


def series_of_numbers(length: int) -> Series:
    """`SERIES` as exact fractions, filled up with zeros."""
    rows = [sp.Matrix([sp.nsimplify(round(x, 6)) for x in row]) for row in SERIES]
    return rows + [sp.zeros(3, 1)] * (length - len(rows))


def value(series: Series, h: float) -> np.ndarray:
    return sum(numbers(coefficient) * h**i for i, coefficient in enumerate(series))


def test_exact_series_obeys_the_riccati_equation() -> None:
    rate = series_of_numbers(7)
    k = symbolic.exact_step_vector(rate)
    t = sp.Symbol("t")
    k_of_t, rate_of_t = (
        sum((c * t**i for i, c in enumerate(series)), sp.zeros(3, 1)) for series in (k, rate)
    )
    residual = (k_of_t.diff(t) - symbolic.riccati_rate(k_of_t, rate_of_t)).expand()
    # The sixth power of k is the last one known, so the fifth of its derivative is.
    assert all(entry.coeff(t, i) == 0 for entry in residual for i in range(6))


@pytest.mark.parametrize("name", CONING_ALGORITHMS)
def test_series_of_an_algorithm_is_what_it_computes(name: str) -> None:
    algorithm, rate, h = CONING_ALGORITHMS[name], series_of_numbers(8), 0.01
    piece = h / algorithm.samples
    edges = piece * np.arange(-algorithm.memory, algorithm.samples + 1)
    coefficients = np.round(SERIES, 6)
    integral = sum(
        coefficients[i] * (edges[:, None] ** (i + 1)) / (i + 1) for i in range(len(SERIES))
    )
    increments = np.diff(integral, axis=0)
    found = step_rotation_vectors(
        increments[algorithm.memory :],
        name,
        history=increments[: algorithm.memory] if algorithm.memory else None,
    )[0]
    if algorithm.last_stage == "rotation vector":
        found = cayley.cayley_vector(quaternion.from_rotation_vector(found))
    # The series ends before h^8; its coefficients and those of the rate are of order one.
    expected = value(algorithm_step_vector(algorithm, rate), h)
    np.testing.assert_allclose(found, expected, rtol=0, atol=100 * h**8 + 1e-17)


def test_leading_error_of_an_exact_algorithm_is_refused() -> None:
    steady = [symbolic.vector("w")] + [sp.zeros(3, 1)] * 4
    # At a constant rate a rotation vector is exact, whatever the order.
    with pytest.raises(ValueError, match=r"^rate: expected a longer series, got one that rotation"):
        symbolic.leading_error(CONING_ALGORITHMS["rotation-vector-2"], steady)


def test_another_last_stage_is_refused() -> None:
    with pytest.raises(ValueError, match=r"^last_stage: expected one of first iterate, .*'sine'"):
        symbolic.step_program(CONING_ALGORITHMS["two-step-4"], "sine")


@pytest.mark.parametrize(
    ("stage", "fifth"),
    [
        ("third iterate", -1 / 1920),
        ("tangent", -1 / 1920),
        ("tangent, dimension 3", -1 / 120),
        ("series", -1 / 1920),
        ("series, normalised", -1 / 1920),
        ("sine series and root", -1 / 1920),
        ("rotation vector", 0.0),
    ],
)
def test_last_stages_err_at_the_fifth_power_of_a_step(stage: str, fifth: float) -> None:
    """About a fixed axis the angle is f + fifth f^5 + ..., as its series in the chapter says."""
    program = symbolic.step_program(CONING_ALGORITHMS["two-step-4"], stage)
    angles = np.array([0.05, 0.1, 0.2])
    halves = angles[:, np.newaxis, np.newaxis] / 2 * np.array([[0.6, 0, 0.8]] * 2)
    step = symbolic.run_program(program, halves)
    found = 2 * np.arctan2(np.linalg.norm(step[:, :3], axis=-1), step[:, 3]) - angles
    # The seventh power follows, with a factor below 1/100.
    assert np.all(np.abs(found - fifth * angles**5) <= 0.01 * angles**7 + 2 * EPS)
    if stage != "series":
        np.testing.assert_allclose(np.linalg.norm(step, axis=-1), 1, rtol=0, atol=STEP)


@pytest.mark.parametrize("name", CONING_ALGORITHMS)
def test_carried_out_program_is_the_step_of_the_package(name: str) -> None:
    algorithm = CONING_ALGORITHMS[name]
    rows = 0.1 * np.random.default_rng(4).normal(size=(5, algorithm.window, 3))
    found = symbolic.run_program(symbolic.step_program(algorithm), rows)
    past = rows[:, : algorithm.memory] if algorithm.memory else None
    expected = step_quaternions(rows[:, algorithm.memory :], name, history=past)[:, 0]
    np.testing.assert_allclose(found, expected, rtol=0, atol=STEP)


def test_operations_are_counted() -> None:
    x, y = sp.symbols("x y", positive=True)
    program = [
        (sp.Symbol("a"), x + y - 1),
        (sp.Symbol("b"), 3 * x * y),
        (sp.Symbol("c"), -x / y),
        (sp.Symbol("d"), x**2 * sp.sin(y)),
        (sp.Symbol("e"), sp.sqrt(x) + 1 / x),
        (sp.Symbol("f"), sp.cos(y)),
    ]
    expected = {"+": 3, "×": 4, "÷": 2, "sqrt": 1, "sin, cos": 2}
    assert symbolic.operations(program) == expected


def test_cross_matrix_is_the_cross_product() -> None:
    v, u = symbolic.vector("v"), symbolic.vector("u")
    assert symbolic.cross_matrix(v) * u == v.cross(u)
    np.testing.assert_array_equal(
        numbers(symbolic.cross_matrix(sp.Matrix(RATE))), cross_matrix(RATE)
    )


def test_rotation_matrix_is_that_of_the_cayley_vector() -> None:
    k = symbolic.vector("k")
    matrix = symbolic.rotation_matrix(k)
    assert symbolic.simplified(matrix * matrix.T) == sp.eye(3)
    found = numbers(matrix.subs(dict(zip(k, RATE, strict=True))))
    expected = quaternion.rotate(cayley.rotation_quaternion(RATE, dimension=3), np.eye(3)).T
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-15)


def test_identity_shows_what_it_proved() -> None:
    p, q = symbolic.quaternion("p"), symbolic.quaternion("q")
    shown = symbolic.identity(symbolic.left_matrix(p) * q, symbolic.multiply(p, q), "L(p)q", "p q")
    assert repr(shown) == "L(p)q = p q for every p, q: proved"
    assert r"\checkmark" in shown._repr_latex_()
    x = sp.Symbol("x")
    assert repr(symbolic.identity((x + 1) ** 2, x**2 + 2 * x + 1)).endswith("for every x: proved")
    assert symbolic.identity(symbolic.pure(sp.zeros(3, 1)), 0).right == "0"
    assert symbolic.identity(sp.sin(x) ** 2 + sp.cos(x) ** 2, 1).free == ("x",)


def test_identity_refuses_what_differs() -> None:
    p, q = symbolic.quaternion("p"), symbolic.quaternion("q")
    with pytest.raises(AssertionError, match=r"^The sides differ by \[\[2\*p_2\*q_3"):
        symbolic.identity(symbolic.multiply(p, q), symbolic.multiply(q, p))
    with pytest.raises(ValueError, match=r"^right: expected the shape \(4, 1\) of left, got \(\)"):
        symbolic.identity(p, sp.Integer(1))


def test_identity_says_where_a_side_may_not_exist() -> None:
    x = sp.Symbol("x")
    shown = symbolic.identity((x**2 - 1) / (x - 1), x + 1, "left", "right")
    assert repr(shown) == "left = right for every x for which both exist: proved"
    assert "which both exist" in shown._repr_latex_()
    assert symbolic.identity(sp.tan(x) * sp.cos(x), sp.sin(x)).has_poles
    assert not symbolic.identity(sp.exp(-x) * sp.exp(x), sp.Integer(1)).has_poles
    with pytest.raises(AssertionError):
        symbolic.identity(sp.sqrt(x**2), x)


def test_sines_and_cosines_need_no_guesses_of_simplify(monkeypatch) -> None:
    """It takes minutes for some seeds of Python's hashes: a derivative of chapter 14."""
    speed, ground, course = sp.symbols("v g Psi", real=True)
    north, east = speed * sp.cos(course), ground - speed * sp.sin(course)
    below = speed**2 - 2 * speed * ground * sp.sin(course) + ground**2
    growth = sp.cos(course) * (ground**2 - speed**2) / below**2

    def refuse(_: sp.Expr) -> sp.Expr:
        raise RuntimeError("simplify was asked")

    monkeypatch.setattr(sp, "simplify", refuse)
    symbolic.identity((north / (north**2 + east**2)).diff(speed), growth)
    with pytest.raises(RuntimeError, match="simplify was asked"):
        symbolic.identity(sp.sin(2 * course), 2 * sp.sin(course) * sp.cos(course))
