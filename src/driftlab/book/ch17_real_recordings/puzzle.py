"""The puzzle of chapter 17: perfect sensors in a parked car, and somebody gets out."""

import numpy as np

from driftlab.frames import from_euler_angles
from driftlab.gyrocompass import align
from driftlab.motion import static_imu

from ..machinery.exercise.puzzle import Number, Puzzle

LATITUDE = np.radians(34.2)
LEAN = np.radians(0.1)
"""By how much less the car leans to its right side at the end."""
STANDS = 300.0
"""How long the means are taken, s."""


def parked_car_error(lean: float = LEAN, stands: float = STANDS) -> float:
    """Of the heading found from means, while a car that heads East slowly rolls, rad."""
    east = -np.pi / 2
    rate, force = static_imu(from_euler_angles(east, 0.0, 0.0), LATITUDE)
    rolling = np.array([-lean / stands, 0.0, 0.0])  # about forward, in the mean
    return abs(float(align(rate + rolling, force).heading) - east)


PUZZLE = Puzzle(
    chapter="17",
    edition=2,
    questions=(
        Number(
            asks="How far off is the heading that the five minutes give?",
            unit="°",
            low=0.001,
            high=100,
            truth=lambda: float(np.degrees(parked_car_error())),
        ),
    ),
    says=(
        "{0}, from a tenth of a degree and from sensors without any error. A mean takes a lean for "
        "a turn of the Earth. What will real sensors in a real car do, and can anything be done?"
    ),
)
