"""The puzzle of chapter 04: a whole turn made by hand, in jerks."""

import numpy as np
from scipy.constants import arcsecond
from scipy.spatial.transform import Rotation

from ..machinery.exercise.puzzle import Choice, Number, Puzzle

LEAN = 2e-3
"""What the third gyro takes from the first axis; by this angle the two miss a right angle."""
AXIS = np.array([1.0, 0, 1]) / np.sqrt(2)
"""The axis of the turn, between the two gyros."""
DEGREES = (0, 50, 20, 110, 90, 230, 225, 300, 260, 360)
"""Where the hand stops on the way."""

TENTH, SAME, ROOT, TENFOLD = (
    "a tenth of it",
    "the same",
    "divided by the square root of ten",
    "ten times as much",
)


def missed(turns: int = 1) -> float:
    """By how much the angle found between the gyros is wrong, arc seconds."""
    triad = np.eye(3)
    triad[2, 0] = LEAN
    attitude = Rotation.identity()
    for step in np.tile(np.diff(np.radians(DEGREES)), turns):
        attitude = attitude * Rotation.from_rotvec(triad @ AXIS * step)
    *vector, scalar = attitude.as_quat()
    sigma = np.arctan(vector @ AXIS / scalar) / (turns * np.pi)
    return float(2 * sigma - LEAN) / arcsecond


def after_ten_turns() -> str:
    """What becomes of it with ten turns."""
    ratio = missed(10) / missed()
    candidates = {TENTH: 0.1, SAME: 1.0, ROOT: 0.1**0.5, TENFOLD: 10.0}
    return min(candidates, key=lambda name: abs(candidates[name] - ratio))


PUZZLE = Puzzle(
    chapter="04",
    edition=2,
    questions=(
        Number(
            asks="How far is the angle found from the true one?",
            unit="″",
            low=0.01,
            high=1000,
            truth=missed,
        ),
        Choice(
            asks="You make ten turns instead of one. The error of the angle becomes",
            options=(TENTH, SAME, ROOT, TENFOLD),
            truth=after_ten_turns,
        ),
    ),
    says=(
        "The pace was uneven, nobody measured it, and nothing on board showed a direction. So what "
        "exactly does a whole turn measure, and why does it never become quite right?"
    ),
)
