"""The typical unit, calibrated, navigates in place with two choices of body axes; Wu Figs. 3-5."""

from typing import NamedTuple

from scipy.constants import hour

from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration.static_navigation import StaticNavigationErrors, navigate_static
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
    """

    runs: dict[tuple[str, str], StaticNavigationErrors]


def errors_at_rest() -> InPlaceErrors:
    """Let the typical unit, as `typical_trial` found it, navigate for `REST_DURATION`."""
    found = {frame: typical_trial(frame).calibration.imu_errors for frame in FRAMES}
    runs = {}
    for frame, imu_errors in found.items():
        one = one_attitude(TYPICAL_ERRORS, found["averaged"], frame)
        for start, axes in zip(STARTS, (one, TABLE_ATTITUDE), strict=True):
            runs[frame, start] = navigate_static(
                TYPICAL_ERRORS, imu_errors, TABLE_ATTITUDE, start=axes, reference=axes,
                latitude=TABLE_LATITUDE, duration=REST_DURATION,
            )  # fmt: skip
    return InPlaceErrors(runs)
