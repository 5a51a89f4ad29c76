"""The puzzle of chapter 11: what a velocity of zero can tell."""

import numpy as np

from driftlab.calibration import ERROR_MODELS, linearize_along, unobservable_subspace
from driftlab.motion import NINETEEN_POSITIONS, Scheme

from ..machinery.exercise.puzzle import Number, Puzzle

MODEL = ERROR_MODELS["averaged"]
STANDING_STILL = Scheme("", dwell=2400.0)


def found_by(scheme: Scheme) -> float:
    """How many unknowns a scheme of rotations tells."""
    linear = linearize_along(scheme, np.radians(37.5), MODEL)
    return float(MODEL.size - len(unobservable_subspace(linear).directions))


PUZZLE = Puzzle(
    chapter="11",
    edition=2,
    questions=(
        Number(
            asks="Forty minutes without turning the table: how many unknowns can be told?",
            unit="of 27",
            low=0,
            high=27,
            truth=lambda: found_by(STANDING_STILL),
            whole=True,
        ),
        Number(
            asks="And with eighteen quarter turns, well chosen?",
            unit="of 27",
            low=0,
            high=27,
            truth=lambda: found_by(NINETEEN_POSITIONS),
            whole=True,
        ),
    ),
    says=(
        "All that was looked at is a velocity that should be zero. What do the quarter turns do "
        "that waiting does not, and which turns will do?"
    ),
)
