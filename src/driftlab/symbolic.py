"""The objects of the book in SymPy, for derivations that end in an identity.

Quaternions and vectors are column matrices, quaternions scalar last, exactly as in the numeric
modules; the tests compare the two entry by entry.
"""

from collections.abc import Callable, Sequence
from typing import Any

import sympy as sp

from .attitude_algorithms import Algorithm

IDENTITY = sp.Matrix([0, 0, 0, 1])
"""The quaternion of no rotation: the initial value of every error."""


def vector(name: str) -> sp.Matrix:
    """Column of three real symbols name_1, name_2, name_3."""
    return sp.Matrix(sp.symbols(f"{name}_1:4", real=True))


def quaternion(name: str) -> sp.Matrix:
    """Column of four real symbols name_1, name_2, name_3, name_0: scalar last."""
    return sp.Matrix(sp.symbols(f"{name}_1:4 {name}_0", real=True))


def pure(rate: sp.Matrix) -> sp.Matrix:
    """Quaternion with the vector `rate` and scalar part zero."""
    return sp.Matrix([*rate, 0])


def conjugate(q: sp.Matrix) -> sp.Matrix:
    """Conjugate quaternion."""
    return sp.Matrix([-q[0], -q[1], -q[2], q[3]])


def multiply(p: sp.Matrix, q: sp.Matrix) -> sp.Matrix:
    """Hamilton product p∘q."""
    p_vector, q_vector = sp.Matrix(p[:3]), sp.Matrix(q[:3])
    product = p[3] * q_vector + q[3] * p_vector + p_vector.cross(q_vector)
    return sp.Matrix([*product, p[3] * q[3] - p_vector.dot(q_vector)])


def left_matrix(q: sp.Matrix) -> sp.Matrix:
    """Matrix of p -> q∘p."""
    return sp.Matrix.hstack(*(multiply(q, unit) for unit in _units()))


def right_matrix(q: sp.Matrix) -> sp.Matrix:
    """Matrix of p -> p∘q."""
    return sp.Matrix.hstack(*(multiply(unit, q) for unit in _units()))


def _units() -> list[sp.Matrix]:
    return [sp.eye(4).col(i) for i in range(4)]


def rate_matrix(rate: sp.Matrix) -> sp.Matrix:
    """Omega of Larin (1.1)."""
    return right_matrix(pure(rate))


def error_composition_matrix(attitude: sp.Matrix) -> sp.Matrix:
    """Lambda of Larin (1.3)."""
    return left_matrix(conjugate(attitude))


def error_rate_matrix(rate: sp.Matrix, measured_rate: sp.Matrix) -> sp.Matrix:
    """Omega_e of Larin (1.4)."""
    return right_matrix(pure(measured_rate)) - left_matrix(pure(rate))


def rotation_exponential(rate: sp.Matrix, time: sp.Expr) -> sp.Matrix:
    """Quaternion exp(rate time / 2) of the attitude under a constant rate."""
    norm = sp.sqrt(rate.dot(rate))
    half_angle = norm * time / 2
    return sp.Matrix([*(rate * sp.sin(half_angle) / norm), sp.cos(half_angle)])


def simplified(matrix: sp.Matrix) -> sp.Matrix:
    """Bring every entry to the normal form of a rational expression: what is zero comes out as 0.

    Square roots, sines and cosines count as symbols; ``sqrt(x)**2`` is x.
    """
    return matrix.applyfunc(sp.cancel)


def skew_operator(k: sp.Matrix, dimension: int = 4) -> sp.Matrix:
    """Skew matrix of a vector in the pattern of Perelyaev & Chelnokov (1.2), scalar last."""
    return right_matrix(pure(k))[:dimension, :dimension]


def cayley_transform(matrix: sp.Matrix) -> sp.Matrix:
    """(E - X)(E + X)^-1; Perelyaev & Chelnokov (1.2)."""
    unit = sp.eye(matrix.rows)
    return (unit - matrix) * (unit + matrix).inv()


def riccati_rate(k: sp.Matrix, rate: sp.Matrix, dimension: int = 4) -> sp.Matrix:
    """Time derivative of k; Perelyaev & Chelnokov (1.11), and its counterpart of dimension 3."""
    if dimension == 3:
        return (k.cross(rate) - k.dot(rate) * k - rate) / 2
    return (k.dot(k) * rate - 2 * k.dot(rate) * k + 2 * k.cross(rate) - rate) / 4


Series = list[sp.Matrix]
"""A vector as a power series: the coefficients of 1, h, h^2, ... up to some order."""


def picard_iterate(k: Series, rate: Series) -> Series:
    """One of Picard's approximations from the one before: the integral of `riccati_rate`.

    Parameters
    ----------
    k : list of Matrix
        Coefficients of the approximation before, in powers of time from the start of the step.
    rate : list of Matrix
        Coefficients of the rate, as many.
    """
    derivative = _sum(
        [
            (sp.Rational(1, 4), _scaled(_dot(k, k), rate)),
            (-sp.Rational(1, 2), _scaled(_dot(k, rate), k)),
            (sp.Rational(1, 2), _cross(k, rate)),
            (-sp.Rational(1, 4), rate),
        ]
    )
    return [sp.zeros(3, 1)] + [value / (n + 1) for n, value in enumerate(derivative[:-1])]


def exact_step_vector(rate: Series) -> Series:
    """Series of the true k over a step of length h, to the order of `rate`.

    Each of Picard's iterates has one more true coefficient than the one before.
    """
    k = [sp.zeros(3, 1)]
    for length in range(2, len(rate) + 1):
        k = picard_iterate([*k, sp.zeros(3, 1)], rate[:length])
    return k


def algorithm_step_vector(algorithm: Algorithm, rate: Series) -> Series:
    """Series of the k that an algorithm gives for a step of length h, to the order of `rate`."""
    part = sp.Rational(1, algorithm.samples)
    increments = [
        _increment(rate, part * (i - algorithm.memory), part * (i + 1 - algorithm.memory))
        for i in range(algorithm.window)
    ]
    gamma = _sum([(1, increment) for increment in increments[algorithm.memory :]])
    coning = _sum(
        [(0, gamma)]
        + [
            (sp.nsimplify(weight, rational=True), _cross(increments[i], increments[j]))
            for (i, j), weight in algorithm.coning.items()
        ]
    )
    if algorithm.iterate == "first":
        return _sum([(-sp.Rational(1, 4), gamma)])
    if algorithm.iterate == "rotation vector":
        return _vector_of_rotation(_sum([(1, gamma), (1, coning)]))
    terms = [
        (-sp.Rational(1, 4), gamma),
        (-sp.Rational(1, 4), coning),
        (-sp.Rational(1, 192), _scaled(_dot(gamma, gamma), gamma)),
    ]
    if algorithm.iterate == "second":
        terms.append((-sp.Rational(1, 32), _cross(gamma, coning)))
    return _sum(terms)


def _vector_of_rotation(phi: Series) -> Series:
    """-tan(phi/4) e as a series, with as many terms of the tangent as the order asks for."""
    x = sp.Symbol("x")
    # tan(x)/x has even powers of x only; x = |phi|/4 begins with the first power of h.
    tangent = sp.series(sp.tan(x) / x, x, 0, len(phi)).removeO()
    square, power = _dot(phi, phi), _one(len(phi))
    terms = []
    for n in range(0, len(phi), 2):
        terms.append((-tangent.coeff(x, n) / 4 / 16 ** (n // 2), _scaled(power, phi)))
        power = _multiplied(power, square)
    return _sum(terms)


def _increment(rate: Series, start: sp.Rational, end: sp.Rational) -> Series:
    """Integral of the rate from start to end, both in units of the step h."""
    return [sp.zeros(3, 1)] + [
        value * (end ** (n + 1) - start ** (n + 1)) / (n + 1) for n, value in enumerate(rate[:-1])
    ]


def _one(length: int) -> list[sp.Expr]:
    return [sp.Integer(1)] + [sp.Integer(0)] * (length - 1)


def _convolved(a: Sequence[Any], b: Sequence[Any], product: Callable[[Any, Any], Any]) -> list[Any]:
    """Coefficients of the product of two series, cut off at their common length."""
    return [
        sum((product(a[i], b[n - i]) for i in range(1, n + 1)), product(a[0], b[n]))
        for n in range(len(a))
    ]


def _dot(a: Series, b: Series) -> list[sp.Expr]:
    return [sp.expand(value) for value in _convolved(a, b, lambda u, v: u.dot(v))]


def _cross(a: Series, b: Series) -> Series:
    return _convolved(a, b, lambda u, v: u.cross(v))


def _scaled(scalar: list[sp.Expr], vector: Series) -> Series:
    return _convolved(scalar, vector, lambda s, v: s * v)


def _multiplied(a: list[sp.Expr], b: list[sp.Expr]) -> list[sp.Expr]:
    return _convolved(a, b, lambda s, t: s * t)


def _sum(terms: Sequence[tuple[Any, Series]]) -> Series:
    """Sum of numbers times series, each coefficient expanded."""
    return [
        sum((factor * series[n] for factor, series in terms), sp.zeros(3, 1)).applyfunc(sp.expand)
        for n in range(len(terms[0][1]))
    ]


def leading_error(algorithm: Algorithm, rate: Series) -> tuple[int, sp.Matrix]:
    """First power of h at which an algorithm's k is wrong, and the coefficient there."""
    pairs = zip(algorithm_step_vector(algorithm, rate), exact_step_vector(rate), strict=True)
    for power, (estimate, exact) in enumerate(pairs):
        error = (estimate - exact).applyfunc(sp.expand)
        if not error.is_zero_matrix:
            return power, error
    raise ValueError(f"rate: expected a longer series, got one that {algorithm.name} integrates.")


Program = list[tuple[sp.Symbol, sp.Expr]]
"""Assignments in their order, each of an expression in the symbols before it."""


def step_program(algorithm: Algorithm, *, series: bool = False) -> Program:
    """What a computer evaluates in one step, from the increments g0, g1, ... to the quaternion.

    The last four assignments are the quaternion, scalar last. With `series`, the sine and cosine of
    a rotation vector are cut off after the terms that an algorithm of fourth order needs.
    """
    program: Program = []

    def let(name: str, value: sp.Matrix) -> sp.Matrix:
        # A component that only renames another is not an operation, so it gets no symbol.
        symbols = []
        for i, entry in enumerate(value, start=1):
            if entry.is_Symbol or entry.is_zero:
                symbols.append(entry)
            else:
                symbols.append(sp.Symbol(f"{name}_{i}", real=True))
                program.append((symbols[-1], entry))
        return sp.Matrix(symbols)

    def number(name: str, value: sp.Expr) -> sp.Symbol:
        return let(name, sp.Matrix([value]))[0]

    g = [vector(f"g{i}") for i in range(algorithm.window)]
    gamma = let("gamma", sum(g[algorithm.memory :], sp.zeros(3, 1)))
    coning = sp.zeros(3, 1)
    for j in range(algorithm.window):
        left = [weight * g[i] for (i, other), weight in algorithm.coning.items() if other == j]
        coning += let(f"left{j}", sum(left, sp.zeros(3, 1))).cross(g[j])
    coning = let("coning", coning)
    corrected = let("corrected", gamma + coning)
    if algorithm.iterate == "rotation vector" and series:
        square = number("square", corrected.dot(corrected))
        scale = number("scale", sp.Rational(1, 2) - number("scaled", square / 48))
        cosine = 1 + square * number("inner", square / 384 - sp.Rational(1, 8))
        let("q", sp.Matrix([*(scale * corrected), cosine]))
        return program
    if algorithm.iterate == "rotation vector":
        norm = number("norm", sp.sqrt(corrected.dot(corrected)))
        half = number("half", norm / 2)
        scale = number("scale", sp.sin(half) / norm)
        let("q", sp.Matrix([*(scale * corrected), sp.cos(half)]))
        return program
    # Four times k with its sign changed: the sign is that of the quaternion's vector part.
    k = corrected
    if algorithm.iterate != "first":
        cubic = number("cubic", number("gamma_square", gamma.dot(gamma)) / 48)
        k = corrected + cubic * gamma
    if algorithm.iterate == "second":
        k += let("eighth", gamma / 8).cross(coning)
    k = let("k", k)
    square = number("square", number("k_square", k.dot(k)) / 16)
    inverse = number("inverse", 1 / (1 + square))
    scale = number("scale", inverse / 2)
    let("q", sp.Matrix([*(scale * k), (1 - square) * inverse]))
    return program


def operations(program: Program) -> dict[str, int]:
    """Count the operations of a program.

    Returns
    -------
    dict
        How many of ``+`` (with minus), ``×``, ``÷``, ``sqrt`` and ``sin, cos``.
    """
    count = dict.fromkeys(["+", "×", "÷", "sqrt", "sin, cos"], 0)
    for _, expression in program:
        for node in sp.preorder_traversal(expression):
            if node.is_Add:
                count["+"] += len(node.args) - 1
            elif node.is_Mul:
                inverses = [factor for factor in node.args if factor.is_Pow and factor.exp == -1]
                count["×"] += len(set(node.args) - {sp.Integer(-1), *inverses}) - 1
            elif node.is_Pow:
                kinds = {2: "×", -1: "÷", sp.Rational(1, 2): "sqrt"}
                count[kinds[node.exp]] += 1
            elif isinstance(node, sp.sin | sp.cos):
                count["sin, cos"] += 1
    return count
