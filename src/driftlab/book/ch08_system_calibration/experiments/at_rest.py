"""The typical unit, calibrated, navigates in place with two choices of body axes; Wu Figs. 3-5."""

from typing import NamedTuple

import numpy as np
from scipy.constants import hour

from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration.static_error_curves import static_causes, static_errors
from driftlab.calibration.static_error_growth import static_error_modes
from driftlab.calibration.static_navigation import StaticNavigationErrors, navigate_static
from driftlab.checks import FloatArray
from driftlab.imu import TYPICAL_ERRORS

from .calibration import typical_trial
from .starts import STARTS, TABLE_ATTITUDE, one_attitude

REST_DURATION = 4 * hour
"""For which the units navigate, s."""
FRAMES = {"averaged": "averaged axes", "upper triangle": "usual axes"}
"""Choices of body axes that are compared, with their names."""


class InPlaceErrors(NamedTuple):
    """Errors of the typical unit at rest.

    Attributes
    ----------
    runs : dict of (str, str) to StaticNavigationErrors
        By choice of body axes in `FRAMES` and by start in `STARTS`.
    curves : dict of (str, str) to StaticNavigationErrors
        The same in closed form, from what the calibration of each run left over and its start.
    slow : ndarray, shape (k, 7)
        What the first of these curves is without Schuler's and Foucault's swing: a constant, a
        line, and the terms of 24 hours.
    """

    runs: dict[tuple[str, str], StaticNavigationErrors]
    curves: dict[tuple[str, str], StaticNavigationErrors]
    slow: FloatArray

    def gap(self, key: tuple[str, str]) -> FloatArray:
        """Distance (k,) between simulated and analytic position of a run, m."""
        return np.linalg.norm(self.runs[key].position - self.curves[key].position, axis=-1)


def errors_at_rest() -> InPlaceErrors:
    """Let the typical unit, as `typical_trial` found it, navigate for `REST_DURATION`."""
    found = {frame: typical_trial(frame).calibration.imu_errors for frame in FRAMES}
    runs, causes = {}, {}
    for frame, imu_errors in found.items():
        one = one_attitude(TYPICAL_ERRORS, found["averaged"], frame)
        for start, axes in zip(STARTS, (one, TABLE_ATTITUDE), strict=True):
            unit = TYPICAL_ERRORS, imu_errors, TABLE_ATTITUDE
            runs[frame, start] = navigate_static(
                *unit, start=axes, reference=axes, latitude=TABLE_LATITUDE, duration=REST_DURATION
            )
            causes[frame, start] = static_causes(
                *unit, start=axes, reference=axes, latitude=TABLE_LATITUDE
            )
    times = next(iter(runs.values())).times
    curves = {key: static_errors(times, TABLE_LATITUDE, each) for key, each in causes.items()}
    modes = static_error_modes(TABLE_LATITUDE).at(times)
    return InPlaceErrors(runs, curves, modes[:3].sum(axis=0) @ next(iter(causes.values())))
