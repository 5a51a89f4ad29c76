"""The puzzle of chapter 05: a perfect triad on a perfect table."""

import numpy as np
from scipy.constants import arcsecond

from driftlab.drift import recorded_turn_estimate
from driftlab.motion import TurntableRotation

from ..ch04_calibration_by_turns.experiments import LATITUDE, TABLE_RATE
from ..machinery.exercise.puzzle import Choice, Number, Puzzle

AXIS = [1, 1, 0]
"""The diagonal between the first two gyros."""

LESS, SAME, OTHER_SIGN, NOTHING = (
    "the same kind of error, but less of it",
    "the same error again",
    "the same error with the other sign",
    "no error at all",
)


def seeming_error(rate: float) -> float:
    """Angle that the first two gyros seem to miss of a right angle, arc seconds.

    A negative rate (rad/s) is clockwise.
    """
    record = TurntableRotation(rate, latitude=LATITUDE).increments(AXIS, samples=360)
    # A turn estimates half of what the two axes miss.
    return 2 * float(recorded_turn_estimate(record.angle, AXIS)) / arcsecond


def other_way() -> str:
    """What the clockwise turn shows."""
    there, back = seeming_error(TABLE_RATE), seeming_error(-TABLE_RATE)
    if np.isclose(back, -there, rtol=1e-3):
        return OTHER_SIGN
    if np.isclose(back, there, rtol=1e-3):
        return SAME
    return LESS if abs(back) > 1e-3 * abs(there) else NOTHING


PUZZLE = Puzzle(
    chapter="05",
    edition=1,
    questions=(
        Number(
            asks="How far do two perfect gyros seem to be from a right angle?",
            unit="″",
            low=0.1,
            high=10000,
            truth=lambda: seeming_error(TABLE_RATE),
        ),
        Choice(
            asks="You turn it once more, clockwise. What do you find?",
            options=(LESS, SAME, OTHER_SIGN, NOTHING),
            truth=other_way,
        ),
    ),
    says=(
        "Nothing is wrong with the gyros, the table or the computer. And yet everybody who does "
        "this sees it. So what did the gyros feel, and how would you get rid of it?"
    ),
)
