"""Units that stop now and then: alone, with resets, and with zero-velocity updates."""

import numpy as np
from scipy.constants import arcminute, arcsecond, degree, g, hour, micro, minute
from scipy.linalg import expm

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.calibration import correct, predict, static_error_modes
from driftlab.checks import FloatArray, positive_number, whole_number

from .position_error import MIDDLE_LATITUDE

STEPS = 10
"""Results between two stops."""
SEEN = 0.01
"""Standard deviation of the velocity in a stop, m/s."""
ARW, VRW = 0.002 * degree / hour**0.5, 5 * micro * g
START = np.array(
    [*[10 * arcsecond] * 2, 2 * arcminute, *[0.0] * 4, *[0.01 * degree / hour] * 3,
     *[50 * micro * g] * 2]
)  # fmt: skip
"""Standard deviations at the start, in the order of `STATIC_ERROR_SOURCES`."""


def stops(
    latitude: float = MIDDLE_LATITUDE, every: float = 5 * minute, duration: float = 4 * hour
) -> DataTable:
    """Standard deviations of the position with a stop `every` so many seconds, by three ways.

    They are covariances carried along, without random numbers: the reset is a correction with a
    gain of its own, the update one with the gain of the Kalman filter.
    """
    count = whole_number(
        round(positive_number(duration, "duration") / positive_number(every, "every")),
        "duration / every",
        least=1,
    )
    step = every / STEPS
    matrix = np.zeros((12, 12))
    matrix[:7] = static_error_modes(latitude).matrix
    transition = expm(matrix * step)
    noise = np.diag([*[ARW**2] * 3, *[VRW**2] * 2, *[0.0] * 7]) * step
    rows = {name: [np.diag(START**2)] for name in ("alone", "reset", "ZUPT")}
    seen = np.eye(12)[3:5]
    keep = np.diag(1.0 - seen.sum(axis=0))
    for k in range(1, count * STEPS + 1):
        for name, covariances in rows.items():
            after = predict(covariances[-1], transition, noise)
            if k % STEPS == 0 and name == "reset":
                after = keep @ after @ keep
            elif k % STEPS == 0 and name == "ZUPT":
                after = correct(after, np.zeros(2), seen, np.eye(2) * SEEN**2).covariance
            covariances.append(after)
    return DataTable(
        {
            "time": (step * np.arange(count * STEPS + 1), "h", "since the start"),
            "distance": (
                {name: _distance(np.array(found)) for name, found in rows.items()},
                "m",
                "root mean square of the position error",
            ),
        },
        {
            "every": (every, "min", "from stop to stop"),
            "last": (
                [float(_distance(found[-1])) for found in rows.values()],
                "m",
                "of the three at the end",
            ),
        },
    )


def _distance(covariance: FloatArray) -> FloatArray:
    """Root mean square (...) of the distance of covariances (..., 12, 12), m."""
    return np.sqrt(covariance[..., 5, 5] + covariance[..., 6, 6])
