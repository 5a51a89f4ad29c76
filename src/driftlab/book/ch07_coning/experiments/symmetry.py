"""Attitude algorithms drawn at random, to try on a cone what holds for power series."""

from typing import get_args

import numpy as np

from driftlab.attitude.coning_algorithms import Algorithm, LastStage
from driftlab.attitude.drift_on_cones import coning_drift
from driftlab.attitude.integration import integrate
from driftlab.checks import FloatArray
from driftlab.quaternion import conjugate, multiply, rotation_angle

from .algorithms import SHIP


def random_algorithm(rng: np.random.Generator) -> Algorithm:
    """Draw an algorithm of third order: three to five increments, random weights and stages.

    Every last stage of the package is a power series in the increments. The weights of the cross
    products are random but for one condition: a rate that is linear in time must be integrated to
    third order.
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
    return Algorithm("random", samples, memory, coning, last_stage, 3, starts=({},) * memory)


def drift_orders(algorithm: Algorithm, half_angles: FloatArray) -> FloatArray:
    """Powers (n,) of the step with which an algorithm's drift on cones (n half angles) grows."""
    # A tenth of a radian round the cone in all increments that one step looks at, and half of it.
    interval = np.array([[0.1], [0.05]]) / algorithm.window / (2 * np.pi)
    coarse, fine = np.abs(coning_drift(algorithm, half_angles, 1.0, interval))
    return np.log2(coarse / fine)


def order_on_ship(algorithm: Algorithm) -> float:
    """Power of the step with which the largest error on the ship grows."""
    errors = []
    for steps in (512, 1024):
        memory, interval = algorithm.memory, 2.0 / (steps * algorithm.samples)
        rows = SHIP.increments(interval, memory + steps * algorithm.samples)
        found = integrate(
            rows[memory:],
            algorithm,
            start=SHIP.attitude(memory * interval),
            history=rows[:memory] if memory else None,
        )
        ends = interval * (memory + algorithm.samples * np.arange(1, steps + 1))
        errors.append(rotation_angle(multiply(conjugate(SHIP.attitude(ends)), found)).max())
    return float(np.log2(errors[0] / errors[1]))
