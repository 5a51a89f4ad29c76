"""Weights for more samples a step: made for a cone, or for a polynomial rate."""

import numpy as np

from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS, Algorithm, Weights
from driftlab.checks import FloatArray


def weights_by_distance(samples: int) -> FloatArray:
    """Weights of the cross products at distance 1, 2, ... that suit a narrow cone best.

    The drift is a series of odd powers of the angle x between two samples, from the third on;
    samples - 1 weights make as many of its terms vanish.
    """
    distance, power = np.arange(1.0, samples), np.arange(3.0, 2 * samples, 2)[:, np.newaxis]
    # 4 sin²(x/2) sin(dx) = 2 sin(dx) - sin((d+1)x) - sin((d-1)x) is to be (mx - sin(mx))/2.
    terms = (distance + 1) ** power + (distance - 1) ** power - 2 * distance**power
    return np.linalg.solve(terms, samples ** power[:, 0] / 2)


def weights_of_polynomial(samples: int) -> Weights:
    """Weights that give half the integral of γ×ω exactly if the rate is a polynomial."""
    powers = np.arange(1.0, samples + 1)  # of time, in the integral of each term of the rate
    pieces = np.diff(np.linspace(0, 1, samples + 1)[:, np.newaxis] ** powers, axis=0) / powers
    p, q = np.meshgrid(powers, powers, indexing="ij")
    # Of each pair of coefficients, once in either order; so are the weights that come out.
    products = (1 / p - 1 / q) / (p + q) / 4
    inverse = np.linalg.inv(pieces)
    half = inverse.T @ products @ inverse
    return {(i, j): 2 * float(half[i, j]) for j in range(samples) for i in range(j)}


def _spread(samples: int) -> Weights:
    """Weights for a cone, the same for all products at one distance."""
    total = weights_by_distance(samples)
    return {
        (i, j): float(total[j - i - 1]) / (samples - j + i)
        for j in range(samples)
        for i in range(j)
    }


def _one_factor(samples: int) -> Weights:
    """Weights for a cone, all products with the last increment: one cross product in all."""
    total = weights_by_distance(samples)
    return {(i, samples - 1): float(total[samples - 2 - i]) for i in range(samples - 1)}


FOUR_SAMPLES = {
    name: Algorithm(name, 4, 0, weights, "rotation vector", order)
    for name, weights, order in (
        ("four, spread", _spread(4), 4),
        ("four, one factor", _one_factor(4), 3),
        ("four, polynomial", weights_of_polynomial(4), 4),
    )
}
"""Algorithms of four samples. The first two have the same drift on a narrow cone."""
COMPARED = {**CONING_ALGORITHMS, **FOUR_SAMPLES}
"""The algorithms of the chapter and those of four samples, by name."""
