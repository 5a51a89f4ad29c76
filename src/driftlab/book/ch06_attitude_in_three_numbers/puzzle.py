"""The puzzle of chapter 06: three numbers for an attitude, and a whole turn."""

import numpy as np

from driftlab.attitude import shadow
from driftlab.quaternion import from_rotation_vector

from ..machinery.exercise.puzzle import Choice, Number, Puzzle

AXIS = np.array([2, -1, 2]) / 3
HISTORY, ANGLE_AND_AXIS, ONLY_NUMBERS, NEVER = (
    "the whole flight so far",
    "the angle and the axis",
    "the three numbers alone",
    "it cannot step over in flight",
)


def three_numbers(angle: float) -> np.ndarray:
    """The vector part of a quaternion over one plus its scalar part, with the sign changed.

    The angle of the rotation is in degrees.
    """
    quaternion = from_rotation_vector(np.radians(angle) * AXIS)
    return -quaternion[:3] / (1 + quaternion[3])


def what_it_needs() -> str:
    """Whether a function of the three numbers alone gives the other three."""
    found = shadow(three_numbers(359.0))
    return ONLY_NUMBERS if np.allclose(found, three_numbers(-1.0), rtol=1e-9) else ANGLE_AND_AXIS


PUZZLE = Puzzle(
    chapter="06",
    edition=2,
    questions=(
        Number(
            asks="How long are the three numbers, as a vector, one degree before the whole turn?",
            unit="",
            low=0.001,
            high=100000,
            truth=lambda: float(np.linalg.norm(three_numbers(359.0))),
        ),
        Choice(
            asks="What must the computer know to step over to the small ones?",
            options=(HISTORY, ANGLE_AND_AXIS, ONLY_NUMBERS, NEVER),
            truth=what_it_needs,
        ),
    ),
    says=(
        "The other three numbers of the same attitude are short. Multiply the two lengths, and "
        "you may find the rule by which a computer steps over. When would you let it?"
    ),
)
