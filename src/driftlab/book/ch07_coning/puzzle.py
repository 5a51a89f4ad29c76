"""The puzzle of chapter 07: perfect gyros on a bracket that shakes."""

import numpy as np
from scipy.constants import arcminute

from driftlab.attitude import integrate
from driftlab.motion import Coning
from driftlab.quaternion import conjugate, multiply, rotation_angle

from ..machinery.exercise.puzzle import Number, Puzzle

SECONDS, RATE = 60, 100


def error_after_a_minute() -> float:
    """Angle of the error when small rotations are multiplied together, arc minutes."""
    shaking = Coning(half_angle=np.radians(1.0), frequency=5.0)
    increments = shaking.increments(1 / RATE, SECONDS * RATE)
    computed = integrate(increments, "picard-1", start=shaking.attitude(0.0))[-1]
    return float(
        rotation_angle(multiply(computed, conjugate(shaking.attitude(SECONDS)))) / arcminute
    )


PUZZLE = Puzzle(
    chapter="07",
    edition=2,
    questions=(
        Number(
            asks="How far off is the computed attitude after a minute?",
            unit="′",
            low=0.001,
            high=1000,
            truth=error_after_a_minute,
        ),
    ),
    says=(
        "That is a drift faster than the Earth turns, out of perfect data. Another way of "
        "combining the same data leaves a fiftieth of it. So the truth was in them. Where?"
    ),
)
