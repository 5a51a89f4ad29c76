"""The puzzle of chapter 14: a ship gathers way, and its compass follows."""

from functools import cache

import numpy as np
from scipy.constants import arcminute

from driftlab.gyrocompass import simulate_gyrocompass

from ..machinery.exercise.puzzle import Number, Puzzle
from ..scenarios import SPEED_UP, ship_manoeuvre


@cache
def after_gathering_way() -> tuple[float, float]:
    """How far the horizon (arc minutes) and the heading shown (degrees) are off by then."""
    way = ship_manoeuvre(speed=10.0, turn=0.0)
    run = simulate_gyrocompass(way, gyro_bias_body=np.zeros(3))
    after = np.searchsorted(run.times, sum(SPEED_UP))
    shown = run.heading_error + run.speed_error
    horizon = np.abs(run.tilt[after]).max() / arcminute
    return float(horizon), float(abs(np.degrees(shown[after])))


PUZZLE = Puzzle(
    chapter="14",
    edition=2,
    questions=(
        Number(
            asks="The accelerometers err by up to 55′. How far off is the horizon afterwards?",
            unit="′",
            low=0.0001,
            high=100,
            truth=lambda: after_gathering_way()[0],
        ),
        Number(
            asks="How far off is the heading that the compass shows?",
            unit="°",
            low=0.0001,
            high=100,
            truth=lambda: after_gathering_way()[1],
        ),
    ),
    says=(
        "What was corrected by wrong accelerometers stays right, and what nobody touched goes "
        "wrong. No sensor erred. By the end of this chapter each of the two is a line of algebra."
    ),
)
