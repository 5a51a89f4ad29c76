"""One step of an attitude algorithm as a power series, and where it leaves the true one."""

from collections.abc import Callable, Sequence
from typing import Any

import sympy as sp

from driftlab.attitude.coning_algorithms import Algorithm

Series = list[sp.Matrix]
"""A vector as a power series: the coefficients of 1, h, h^2, ... up to some order."""


def picard_iterate(k: Series, rate: Series) -> Series:
    """One of Picard's approximations from the one before, k: the integral of `riccati_rate`."""
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
    """Series of the true k over a step of length h, to the order of `rate`."""
    # Without Picard's iteration: each power of 2 dq/dt = q∘rate gives the next coefficient of q,
    # and k = -v/(1 + s) of its vector and scalar part.
    vector, scalar = [sp.zeros(3, 1)], [sp.Integer(1)]
    for n in range(len(rate) - 1):
        parts = [(vector[i], scalar[i], rate[n - i]) for i in range(n + 1)]
        growth = sum((s * w + v.cross(w) for v, s, w in parts), sp.zeros(3, 1))
        vector.append((growth / (2 * (n + 1))).applyfunc(sp.expand))
        loss = sum(v.dot(w) for v, _, w in parts)
        scalar.append(sp.expand(-loss / (2 * (n + 1))))
    k: Series = []
    for n, v in enumerate(vector):
        known = sum((k[i] * scalar[n - i] for i in range(n)), sp.zeros(3, 1))
        k.append((-(v + known) / 2).applyfunc(sp.expand))
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
            (sp.Rational(weight).limit_denominator(10**6), _cross(increments[i], increments[j]))
            for (i, j), weight in algorithm.coning.items()
        ]
    )
    if algorithm.last_stage == "first iterate":
        return _sum([(-sp.Rational(1, 4), gamma)])
    if algorithm.last_stage == "rotation vector":
        return vector_of_rotation(_sum([(1, gamma), (1, coning)]))
    corrected = _sum([(1, gamma), (1, coning)])
    cubed = corrected if algorithm.last_stage == "tangent" else gamma
    terms = [
        (-sp.Rational(1, 4), corrected),
        (-sp.Rational(1, 192), _scaled(_dot(cubed, cubed), cubed)),
    ]
    if algorithm.last_stage == "second iterate":
        terms.append((-sp.Rational(1, 32), _cross(gamma, coning)))
    return _sum(terms)


def vector_of_rotation(phi: Series) -> Series:
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
