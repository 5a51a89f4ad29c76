"""The puzzle of chapter 15: a horizon is damped, and then the ship gathers way."""

from functools import cache

import numpy as np
from scipy.constants import minute

from driftlab.gyrocompass import simulate_gyrocompass

from ..machinery.exercise.puzzle import Number, Puzzle
from ..scenarios import SPEED_UP, ship_manoeuvre


@cache
def worst_after_gathering_way() -> tuple[float, float]:
    """Largest heading error, degrees, of a damped compass, and minutes after the ship is steady."""
    run = simulate_gyrocompass(ship_manoeuvre(turn=0.0), np.zeros(3), damping=0.5)
    worst = np.abs(run.heading_error).argmax()
    late = run.times[worst] - sum(SPEED_UP)
    return float(np.degrees(abs(run.heading_error[worst]))), float(late / minute)


PUZZLE = Puzzle(
    chapter="15",
    edition=1,
    questions=(
        Number(
            asks="Undamped the heading was off by 0.02° at most. How far with the damping?",
            unit="°",
            low=0.0001,
            high=100,
            truth=lambda: worst_after_gathering_way()[0],
        ),
        Number(
            asks="How long after the ship has reached its speed is that?",
            unit="minutes",
            low=1,
            high=10_000,
            truth=lambda: worst_after_gathering_way()[1],
        ),
    ),
    says=(
        "Fifty times worse than undamped, and when the ship has long been steady. The damping "
        "took the ship's acceleration for a tilt. A log can tell it which is which."
    ),
)
