"""One step of an attitude algorithm as the operations that a computer carries out."""

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
import sympy as sp

from driftlab.attitude.coning_algorithms import Algorithm
from driftlab.checks import FloatArray

from .objects import vector

Program = list[tuple[sp.Symbol, sp.Expr]]
"""Assignments in their order, each of an expression in the symbols before it."""


class _Assignments:
    """A program in the making."""

    def __init__(self) -> None:
        self.program: Program = []

    def let(self, name: str, value: sp.Matrix) -> sp.Matrix:
        """Assign a vector, and return its symbols."""
        # A component that only renames another is not an operation, so it gets no symbol.
        symbols = []
        for i, entry in enumerate(value, start=1):
            if entry.is_Symbol or entry.is_zero:
                symbols.append(entry)
            else:
                symbols.append(sp.Symbol(f"{name}_{i}", real=True))
                self.program.append((symbols[-1], entry))
        return sp.Matrix(symbols)

    def result(self, quaternion: sp.Matrix) -> None:
        """Assign the quaternion: four numbers, the last of the program, named or not."""
        symbols = sp.symbols("q_1:5", real=True)
        self.program.extend(zip(symbols, quaternion, strict=True))

    def number(self, name: str, value: sp.Expr) -> sp.Symbol:
        """Assign a number, and return its symbol."""
        return self.let(name, sp.Matrix([value]))[0]


class Sums(NamedTuple):
    """What a last stage starts from: the sum of a step, its coning correction, and both."""

    gamma: sp.Matrix
    coning: sp.Matrix
    corrected: sp.Matrix


def _first_iterate(a: _Assignments, sums: Sums) -> None:
    _from_quarter_tangent(a, sums.gamma)


def _second_iterate(a: _Assignments, sums: Sums) -> None:
    cubic = a.number("cubic", a.number("gamma_square", sums.gamma.dot(sums.gamma)) / 48)
    extra = a.let("eighth", sums.gamma / 8).cross(sums.coning)
    _from_quarter_tangent(a, a.let("k", sums.corrected + cubic * sums.gamma + extra))


def _third_iterate(a: _Assignments, sums: Sums) -> None:
    cubic = a.number("cubic", a.number("gamma_square", sums.gamma.dot(sums.gamma)) / 48)
    _from_quarter_tangent(a, a.let("k", sums.corrected + cubic * sums.gamma))


def _from_quarter_tangent(a: _Assignments, k: sp.Matrix) -> None:
    """The quaternion of -k/4: the factor, and the sign, are taken along in the numbers."""
    scale = a.number("scale", 8 / a.number("sum", k.dot(k) + 16))
    a.result(sp.Matrix([*(scale * k), 4 * scale - 1]))


def _tangent(a: _Assignments, sums: Sums) -> None:
    square = a.number("square", sums.corrected.dot(sums.corrected))
    factor = a.number("factor", square + 48)  # k is -f factor/192
    below = a.number("below", square * a.number("factor_square", factor**2) + 192**2)
    scale = a.number("scale", 384 / below)
    a.result(sp.Matrix([*(a.number("both", factor * scale) * sums.corrected), 192 * scale - 1]))


def _tangent_of_dimension_3(a: _Assignments, sums: Sums) -> None:
    square = a.number("square", sums.corrected.dot(sums.corrected))
    factor = a.number("factor", sp.Rational(1, 2) + a.number("scaled", square / 24))
    k_square = a.number("k_square", square * a.number("factor_square", factor**2))
    cosine = a.number("cosine", 1 / a.number("root", sp.sqrt(1 + k_square)))
    scale = a.number("scale", factor * cosine)
    a.result(sp.Matrix([*(scale * sums.corrected), cosine]))


def _rotation_vector(a: _Assignments, sums: Sums) -> None:
    norm = a.number("norm", sp.sqrt(sums.corrected.dot(sums.corrected)))
    half = a.number("half", norm / 2)
    scale = a.number("scale", sp.sin(half) / norm)
    a.result(sp.Matrix([*(scale * sums.corrected), sp.cos(half)]))


def _sine_series(a: _Assignments, sums: Sums) -> tuple[sp.Symbol, sp.Symbol, sp.Symbol]:
    """The square of f, the sine of half of |f| over |f|, cut off, and its square."""
    square = a.number("square", sums.corrected.dot(sums.corrected))
    sine = a.number("sine", sp.Rational(1, 2) - a.number("scaled", square / 48))
    return square, sine, a.number("sine_square", sine**2)


def _series(a: _Assignments, sums: Sums) -> None:
    _, sine, sine_square = _sine_series(a, sums)
    a.result(sp.Matrix([*(sine * sums.corrected), _cosine_series(sine_square)]))


def _cosine_series(sine_square: sp.Symbol) -> sp.Expr:
    # 1 - s/8 + s²/384, if the sine is 1/2 - s/48.
    return 6 * sine_square - sp.Rational(1, 2)


def _normalised_series(a: _Assignments, sums: Sums) -> None:
    square, sine, sine_square = _sine_series(a, sums)
    cosine = a.number("cosine", _cosine_series(sine_square))
    length = a.number("length", sp.sqrt(square * sine_square + cosine**2))
    inverse = a.number("inverse", 1 / length)
    scale = a.number("scale", inverse * sine)
    a.result(sp.Matrix([*(scale * sums.corrected), inverse * cosine]))


def _sine_and_root(a: _Assignments, sums: Sums) -> None:
    square, sine, sine_square = _sine_series(a, sums)
    a.result(sp.Matrix([*(sine * sums.corrected), sp.sqrt(1 - square * sine_square)]))


LAST_STAGES: Mapping[str, Callable[[_Assignments, Sums], None]] = MappingProxyType(
    {
        "first iterate": _first_iterate,
        "second iterate": _second_iterate,
        "third iterate": _third_iterate,
        "tangent": _tangent,
        "tangent, dimension 3": _tangent_of_dimension_3,
        "rotation vector": _rotation_vector,
        "series": _series,
        "series, normalised": _normalised_series,
        "sine series and root": _sine_and_root,
    }
)
"""Ways from the sum of a step and its coning correction to the quaternion: those of `Algorithm`,
and four to compare with them, each with as few operations as were found. Dimension 3 goes by
-tan(|f|/2) f/|f|. The series are the sine and cosine of a rotation vector, cut off after the terms
that fourth order needs."""


def step_program(algorithm: Algorithm, last_stage: str | None = None) -> Program:
    """What a computer evaluates in one step, from g0, g1, ... to the quaternion, scalar last.

    `last_stage`, one of `LAST_STAGES`, replaces the algorithm's own.
    """
    stage = algorithm.last_stage if last_stage is None else last_stage
    if stage not in LAST_STAGES:
        raise ValueError(f"last_stage: expected one of {', '.join(LAST_STAGES)}, got {stage!r}.")
    a = _Assignments()
    g = [vector(f"g{i}") for i in range(algorithm.window)]
    gamma = a.let("gamma", sum(g[algorithm.memory :], sp.zeros(3, 1)))
    coning = sp.zeros(3, 1)
    for j in range(algorithm.window):
        left = [weight * g[i] for (i, other), weight in algorithm.coning.items() if other == j]
        coning += a.let(f"left{j}", sum(left, sp.zeros(3, 1))).cross(g[j])
    coning = a.let("coning", coning)
    corrected = a.let("corrected", gamma + coning)
    LAST_STAGES[stage](a, Sums(gamma, coning, corrected))
    return a.program


def run_program(program: Program, increments: FloatArray) -> FloatArray:
    """Quaternion (..., 4) of a step by a program, from increments (..., window, 3), rad."""
    values = {
        symbol: increments[..., i, j]
        for i in range(increments.shape[-2])
        for j, symbol in enumerate(vector(f"g{i}"))
    }
    for symbol, expression in program:
        used = list(expression.free_symbols)
        values[symbol] = sp.lambdify(used, expression)(*(values[name] for name in used))
    return np.stack([values[symbol] for symbol, _ in program[-4:]], axis=-1)


def operations(program: Program) -> dict[str, int]:
    """How many of ``+`` (with minus), ``×``, ``÷``, ``sqrt`` and ``sin, cos`` a program has."""
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
