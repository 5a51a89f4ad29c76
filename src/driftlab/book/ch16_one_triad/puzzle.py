"""The puzzle of chapter 16: thirty arc seconds, and a ship that turns."""

import numpy as np
from scipy.constants import arcsecond, minute

from driftlab.gyrocompass import simulate_gyrocompass

from ..machinery.exercise.puzzle import Number, Puzzle
from ..scenarios import TURN, ship_manoeuvre

LEAN = 30 * arcsecond


def heading_error() -> float:
    """Of the heading half an hour after the turn, arc seconds."""
    leaning = np.zeros((3, 3))
    leaning[0, 1] = -LEAN  # the forward gyro feels a little of the turn about Up
    way = ship_manoeuvre(speed=0.0, turn=np.radians(90.0))
    run = simulate_gyrocompass(way, way.increments.mean_rate @ leaning.T, speed_log=True)
    here = np.searchsorted(run.times, sum(TURN) + 30 * minute)
    return float(abs(run.heading_error[here])) / arcsecond


PUZZLE = Puzzle(
    chapter="16",
    edition=2,
    questions=(
        Number(
            asks="How wrong is the heading half an hour after the turn?",
            unit="″",
            low=1,
            high=10000,
            truth=heading_error,
        ),
    ),
    says=(
        "Thirty arc seconds have become hundreds. Nothing is broken, and no formula of the first "
        "three parts says so. Where does the factor come from?"
    ),
)
