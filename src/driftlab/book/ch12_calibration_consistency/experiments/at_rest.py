"""A unit, calibrated, navigates in place with two choices of body axes; Wu Figs. 3-5."""

from typing import Any

import numpy as np
from scipy.constants import hour

from driftlab.book.ch11_kalman_calibration.experiments.calibration import SEED, trial_of
from driftlab.book.ch11_kalman_calibration.experiments.starts import (
    STARTS,
    TABLE_ATTITUDE,
    one_attitude,
)
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration import (
    navigate_static,
    static_error_modes,
    static_error_sources,
    static_errors,
)
from driftlab.imu import TYPICAL_ERRORS, ImuErrors
from driftlab.motion.scheme import NINETEEN_POSITIONS, Scheme

REST_DURATION = 4 * hour
"""For which the units navigate, s."""
FRAMES = {"averaged": "averaged axes", "upper triangle": "usual axes"}
"""Choices of body axes that are compared, with their names."""
SHOWN = {
    "attitude": ("arcsec", ("East", "North", "Up")),
    "velocity": ("m_per_s", ("East", "North")),
    "position": ("km", ("East", "North")),
}
"""What is shown of the errors: unit, and components."""


def errors_at_rest(
    imu_errors: ImuErrors = TYPICAL_ERRORS,
    scheme: Scheme = NINETEEN_POSITIONS,
    duration: float = REST_DURATION,
    latitude: float = TABLE_LATITUDE,
    seed: int = SEED,
) -> DataTable:
    """Calibrate a unit with two choices of body axes, and let it navigate at rest with either.

    The analytic errors are the closed form for what the calibration of each run left over and its
    start; the last columns are the first of them without Schuler's and Foucault's swing: a
    constant, a line, and the terms of 24 hours.
    """
    found = {
        frame: trial_of(frame, imu_errors, scheme, latitude, seed).calibration.imu_errors
        for frame in FRAMES
    }
    runs, causes = {}, {}
    for frame, calibrated in found.items():
        one = one_attitude(imu_errors, found["averaged"], frame)
        for start, attitude in zip(STARTS, (one, TABLE_ATTITUDE), strict=True):
            stands = imu_errors, calibrated, TABLE_ATTITUDE
            runs[frame, start] = navigate_static(
                *stands, start=attitude, reference=attitude, latitude=latitude, duration=duration
            )
            causes[frame, start] = static_error_sources(
                *stands, start=attitude, reference=attitude, latitude=latitude
            )
    times = next(iter(runs.values())).times
    curves = {key: static_errors(times, latitude, each) for key, each in causes.items()}
    columns: dict[str, tuple[Any, ...]] = {"time": (times, "h", "since the start")}
    meanings = {"": "error by simulation", "analytic ": "error by the closed form"}
    for words, found_errors in (("", runs), ("analytic ", curves)):
        for (frame, start), errors in found_errors.items():
            for quantity, (unit, axes) in SHOWN.items():
                name = f"{words}{quantity}, {FRAMES[frame]}, start from {start}"
                values = getattr(errors, quantity).T[: len(axes)]
                columns[name] = (values, unit, meanings[words], axes)
    modes = static_error_modes(latitude)
    slow = modes.at(times)[:3].sum(axis=0) @ next(iter(causes.values()))
    rows = iter(slow.T)
    for quantity, (unit, axes) in SHOWN.items():
        values = [next(rows) for _ in axes]
        columns[f"{quantity} without its swing"] = (values, unit, "slow part of the first", axes)
    gaps = {
        key: np.linalg.norm(run.position - curves[key].position, axis=-1).max()
        for key, run in runs.items()
    }
    worst = max(gaps, key=gaps.__getitem__)
    turned = abs(modes.rates.foucault) * times[-1]
    return DataTable(columns, {
        "runs": (
            [f"{FRAMES[frame]}, start from {start}" for frame, start in runs], "",
            "axes and start of each",
        ),
        "gap": (gaps[worst], "m", "largest distance between simulated and analytic position"),
        "farthest": (
            np.linalg.norm(runs[worst].position, axis=-1).max(), "km", "position of that run"
        ),
        "turned": (turned, "deg", "by which the swing's plane turns"),
    })  # fmt: skip
