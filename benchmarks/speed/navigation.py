"""An hour of navigation on a turntable at 100 Hz, whose truth is known."""

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from driftlab.increments import Increments
from driftlab.motion import NINETEEN_POSITIONS, Scheme, turntable_trajectory
from driftlab.strapdown import Navigation, navigate, stationary_state

from . import floor
from .measuring import Contender, Row, and_by_numpy, copy_of, in_c

LATITUDE, INTERVAL = np.radians(37.5), 0.01
NED = np.array([[0, 1, 0], [1, 0, 0], [0, 0, -1]])
"""East, North, Up to North, East, Down, and back."""


def rows() -> Iterator[Row]:
    scheme = Scheme(NINETEEN_POSITIONS.rotations, NINETEEN_POSITIONS.start, dwell=181.0)
    record = turntable_trajectory(scheme, LATITUDE, INTERVAL, multiple_of=2)
    angle, velocity = map(np.ascontiguousarray, record.increments[1:])
    both, start = np.hstack([angle, velocity]), stationary_state(LATITUDE, record.attitude[0])

    def error(way: Navigation) -> float:
        return float(np.abs(way.velocity[:, :2]).max())

    def pyins() -> Contender:
        run = by_pyins(NED @ Rotation.from_quat(record.attitude[0]).as_matrix(), both)
        return Contender("pyins, compiled", run, lambda way: np.abs(way[["VE", "VN"]].values).max())

    row = Row(
        f"{INTERVAL * len(angle):.0f} s at {1 / INTERVAL:.0f} Hz; error of the level velocity",
        Contender(
            "driftlab", partial(navigate, start, Increments(INTERVAL, angle, velocity)), error
        ),
        [pyins],
        [copy_of(both), in_c(partial(floor.navigate, start, INTERVAL, angle, velocity), error)],
        error_in="m/s",
        rounding=1e-6,
    )
    yield from and_by_numpy(row)


def by_pyins(attitude: np.ndarray, increments: np.ndarray, **options: Any) -> Callable[[], Any]:
    """pyins along increments (n, 6) from rest; its axes are North, East, Down."""
    import pandas as pd
    from pyins import strapdown, transform, util

    # It wants one more row, for what happened before the start.
    increments = np.vstack([increments[:1], increments])
    times = INTERVAL * np.arange(len(increments))
    imu = pd.DataFrame(increments, times, [*util.GYRO_COLS, *util.ACCEL_COLS])
    place = [np.degrees(LATITUDE), *[0.0] * 5, *transform.mat_to_rph(attitude)]
    start = pd.Series(place, util.TRAJECTORY_COLS, name=0.0)

    def run() -> pd.DataFrame:
        steps = strapdown.compute_increments_from_imu(imu, "increment")
        return strapdown.Integrator(start, **options).integrate(steps)

    return run


def attitudes_of_pyins(way: Any) -> Rotation:
    """Attitudes of a table of pyins, from forward, right, down to North, East, Down."""
    from pyins import transform, util

    return Rotation.from_matrix(transform.mat_from_rph(way[util.RPH_COLS]))
