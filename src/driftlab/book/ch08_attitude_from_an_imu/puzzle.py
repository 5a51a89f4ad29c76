"""The puzzle of chapter 08: a body that shakes about one axis, and a gyro that answers late."""

from scipy.constants import degree, hour

from ..machinery.exercise.puzzle import Choice, Number, Puzzle
from .experiments import LATE, pseudo_drift

PLAIN, CORRECTED, ALIKE = (
    "the one that multiplies small rotations",
    "the one that corrects for coning",
    "both alike",
)


def drift(algorithm: str) -> float:
    """Apparent drift of the computer with this algorithm, deg/h."""
    return abs(pseudo_drift(algorithm, LATE)) * hour / degree


def more() -> str:
    """Which of the two computers drifts more."""
    plain, corrected = drift("picard-1"), drift("two-step-4")
    if abs(plain / corrected - 1) < 0.02:
        return ALIKE
    return PLAIN if plain > corrected else CORRECTED


PUZZLE = Puzzle(
    chapter="08",
    edition=1,
    questions=(
        Number(
            asks="How fast does the attitude of the corrected computer drift?",
            unit="deg/h",
            low=0.001,
            high=1000,
            truth=lambda: drift("two-step-4"),
        ),
        Choice(
            asks="Which computer drifts more?",
            options=(PLAIN, CORRECTED, ALIKE),
            truth=more,
        ),
    ),
    says=(
        "That is more than the Earth's rate, from a tenth of a millisecond. The better computer is "
        "the worse one. What did it see in the data, and can an algorithm know better?"
    ),
)
