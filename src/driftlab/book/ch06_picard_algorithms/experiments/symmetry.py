"""Attitude algorithms drawn at random, to try what should hold for all of them on a cone."""

from typing import get_args

import numpy as np

from driftlab.attitude.coning_algorithms import Algorithm, LastStage


def random_algorithm(rng: np.random.Generator) -> Algorithm:
    """Draw an algorithm of third order: any number of increments, any weights, any last stage.

    The weights of the cross products are random but for one condition: a rate that is linear in
    time must be integrated to third order.

    Parameters
    ----------
    rng : numpy.random.Generator

    Returns
    -------
    Algorithm
        Of three to five samples a step, or of two to four increments of memory.
    """
    with_memory, window = bool(rng.integers(2)), int(rng.integers(3, 6))
    samples = 1 if with_memory else window
    pairs = [(i, j) for j in range(window) for i in range(j)]
    weights = rng.normal(size=len(pairs))
    # Of a linear rate, increments at a distance d have the product d ω0×ω1, and a step of m
    # samples needs m³/12 of it.
    distances = np.array([j - i for i, j in pairs])
    weights += (samples**3 / 12 - weights @ distances) / (distances @ distances) * distances
    coning = dict(zip(pairs, weights.tolist(), strict=True))
    # The first iterate takes no correction, so it is of second order, which is not odd.
    stages = [stage for stage in get_args(LastStage) if stage != "first iterate"]
    last_stage: LastStage = stages[rng.integers(len(stages))]
    memory = window - samples
    return Algorithm("random", samples, memory, coning, last_stage, 3, ({},) * memory)
