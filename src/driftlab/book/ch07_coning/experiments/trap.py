"""Where the error of an algorithm of third order goes on a wide cone: round, and not away."""

from collections.abc import Sequence

import numpy as np

from driftlab.attitude.coning_algorithms import AnyAlgorithm, checked_algorithm
from driftlab.attitude.integration import integrate
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import positive_number, whole_number
from driftlab.motion.profiles import Coning
from driftlab.quaternion import conjugate, multiply, to_rotation_vector


def trap_on_a_cone(
    algorithm: AnyAlgorithm = "two-step-3",
    half_angle: float = float(np.radians(60.0)),
    samples: Sequence[int] = (24, 48),
    rounds: int = 3,
) -> DataTable:
    """Follow the attitude error, in the reference frame, with so many samples a round.

    The steps of the algorithm must fit into the rounds.
    """
    motion = Coning(positive_number(half_angle, "half_angle"), 1.0)
    turns, chosen = whole_number(rounds, "rounds"), checked_algorithm(algorithm)
    after, errors = {}, {}
    for each in samples:
        count = whole_number(each, "samples")
        increments = motion.increments(1 / count, count * turns)
        found = integrate(increments, chosen, start=motion.attitude(0.0))
        ends = turns * np.arange(1, len(found) + 1) / len(found)
        error = to_rotation_vector(multiply(found, conjugate(motion.attitude(ends))))
        after[f"{count}"] = np.append(0.0, ends)
        errors[f"{count}"] = np.concatenate([np.zeros((1, 3)), error])
    directions = ("along the first tilt axis", "across it", "about the cone's axis")
    return DataTable(
        {
            "rounds": (after, "", "rounds of the cone since the start"),
            **{
                name: ({each: error[:, i] for each, error in errors.items()}, "arcsec", meaning)
                for i, (name, meaning) in enumerate(
                    zip(("first", "second", "along"), directions, strict=True)
                )
            },
        },
        {
            "samples": (tuple(errors), "", "samples a round"),
            "half_angle": (motion.half_angle, "deg", "half angle of the cone"),
        },
    )
