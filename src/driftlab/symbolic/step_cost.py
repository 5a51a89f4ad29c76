"""One step of an attitude algorithm as the operations that a computer carries out."""

import sympy as sp

from driftlab.attitude.coning_algorithms import Algorithm

from .objects import vector

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
