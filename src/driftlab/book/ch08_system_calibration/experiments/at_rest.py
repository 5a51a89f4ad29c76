"""A unit, calibrated, navigates in place with two choices of body axes; Wu Figs. 3-5."""

from typing import NamedTuple

import numpy as np
from scipy.constants import hour

from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration.static_error_curves import static_causes, static_errors
from driftlab.calibration.static_error_growth import static_error_modes
from driftlab.calibration.static_navigation import StaticNavigationErrors, navigate_static
from driftlab.checks import FloatArray
from driftlab.imu import TYPICAL_ERRORS, ImuErrors
from driftlab.motion.scheme import NINETEEN_POSITIONS, Scheme

from .calibration import SEED, trial_of
from .starts import STARTS, TABLE_ATTITUDE, one_attitude

REST_DURATION = 4 * hour
"""For which the units navigate, s."""
FRAMES = {"averaged": "averaged axes", "upper triangle": "usual axes"}
"""Choices of body axes that are compared, with their names."""


class InPlaceErrors(NamedTuple):
    """Errors of a unit at rest."""

    latitude: float  # rad
    # by choice of body axes in `FRAMES` and by start in `STARTS`
    runs: dict[tuple[str, str], StaticNavigationErrors]
    # the same in closed form, from what the calibration of each run left over and its start
    curves: dict[tuple[str, str], StaticNavigationErrors]
    # (k, 7), what the first of these curves is without Schuler's and Foucault's swing: a constant,
    # a line, and the terms of 24 hours
    slow: FloatArray

    def gap(self, key: tuple[str, str]) -> FloatArray:
        """Distance (k,) between simulated and analytic position of a run, m."""
        return np.linalg.norm(self.runs[key].position - self.curves[key].position, axis=-1)


def errors_at_rest(
    imu_errors: ImuErrors = TYPICAL_ERRORS,
    scheme: Scheme = NINETEEN_POSITIONS,
    duration: float = REST_DURATION,
    latitude: float = TABLE_LATITUDE,
    seed: int = SEED,
) -> InPlaceErrors:
    """Calibrate a unit with two choices of body axes, and let it navigate at rest with either."""
    found = {
        frame: trial_of(frame, imu_errors, scheme, latitude, seed).calibration.imu_errors
        for frame in FRAMES
    }
    runs, causes = {}, {}
    for frame, calibrated in found.items():
        one = one_attitude(imu_errors, found["averaged"], frame)
        for start, axes in zip(STARTS, (one, TABLE_ATTITUDE), strict=True):
            unit = imu_errors, calibrated, TABLE_ATTITUDE
            runs[frame, start] = navigate_static(
                *unit, start=axes, reference=axes, latitude=latitude, duration=duration
            )
            causes[frame, start] = static_causes(
                *unit, start=axes, reference=axes, latitude=latitude
            )
    times = next(iter(runs.values())).times
    curves = {key: static_errors(times, latitude, each) for key, each in causes.items()}
    modes = static_error_modes(latitude).at(times)
    return InPlaceErrors(
        latitude, runs, curves, modes[:3].sum(axis=0) @ next(iter(causes.values()))
    )
