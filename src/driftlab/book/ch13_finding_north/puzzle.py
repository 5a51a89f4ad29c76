"""The puzzle of chapter 13: North from inside a closed box."""

import numpy as np
from scipy.constants import arcminute, degree, hour

from driftlab.frames import from_euler_angles
from driftlab.gyrocompass import align
from driftlab.motion import static_imu

from ..machinery.exercise.puzzle import Choice, Number, Puzzle

DRIFT = np.array([0.0, 0.0, 0.01]) * degree / hour
"""Of the gyro that points to the right."""

PLACES = {"at the equator": 0.0, "at 45°": 45.0, "at 85°": 85.0}
NO_MATTER = "it is the same everywhere"


def heading_error(latitude: float) -> float:
    """Heading error of a level box that points North, arc minutes, at a latitude in degrees."""
    rate, force = static_imu(from_euler_angles(0.0, 0.0, 0.0), np.radians(latitude))
    return float(abs(align(rate + DRIFT, force).heading)) / arcminute


def best_place() -> str:
    """Where the heading errs least."""
    errors = {name: heading_error(latitude) for name, latitude in PLACES.items()}
    if np.ptp([*errors.values()]) < 1e-3 * max(errors.values()):
        return NO_MATTER
    return min(errors, key=errors.__getitem__)


PUZZLE = Puzzle(
    chapter="13",
    edition=2,
    questions=(
        Number(
            asks="At latitude 85°, how far off is North?",
            unit="′",
            low=0.01,
            high=1000,
            truth=lambda: heading_error(85.0),
        ),
        Choice(
            asks="Where would the box find North best?",
            options=(*PLACES, NO_MATTER),
            truth=best_place,
        ),
    ),
    says=(
        "The Earth turns everywhere at the same rate. So why does the place matter to a box that "
        "only listens to it? And that was one sensor of six: which of the others harm the heading?"
    ),
)
