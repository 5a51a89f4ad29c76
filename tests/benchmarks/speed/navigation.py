"""An hour of navigation on a turntable at 100 Hz, whose truth is known."""

import warnings
from collections.abc import Iterator
from functools import partial

import numpy as np
from scipy.spatial.transform import Rotation

from driftlab.increments import Increments
from driftlab.motion import NINETEEN_POSITIONS, Scheme, Trajectory, table_trajectory
from driftlab.strapdown import Navigation, at_rest, navigate

from . import floor
from .contenders import IN_C, and_compiled, floors_here, largest_angle, those_here
from .measuring import Contender, Row, Target

LATITUDE, INTERVAL = np.radians(37.5), 0.01
SWAP = np.array([[0, 1, 0], [1, 0, 0], [0, 0, -1]])
"""East, North, Up to North, East, Down, and back."""


def table_hour() -> Trajectory:
    scheme = Scheme(NINETEEN_POSITIONS.rotations, NINETEEN_POSITIONS.start, dwell=181.0)
    return table_trajectory(scheme, LATITUDE, INTERVAL, multiple_of=2)


def rows() -> Iterator[Row]:
    record = table_hour()
    angle, velocity = map(np.ascontiguousarray, record.increments[1:])
    increments = Increments(INTERVAL, angle, velocity)
    start = at_rest(LATITUDE, record.attitude[0])
    true = record.attitude[2::2]

    def attitude_error(way: Navigation) -> float:
        return largest_angle(way.attitude, true)

    def velocity_error(way: Navigation) -> float:
        return float(np.abs(way.velocity[:, :2]).max())

    for quantity, error, unit in (
        ("attitude", attitude_error, "rad"),
        ("level velocity", velocity_error, "m/s"),
    ):

        def pyins(quantity: str = quantity) -> Contender:
            return _pyins(record, quantity)

        peers, left_out = those_here({"pyins": pyins})
        in_c = partial(floor.navigate, start, INTERVAL, angle, velocity)
        floors, without = floors_here(np.hstack([angle, velocity]), in_c, error)
        row = Row(
            "navigation",
            f"{INTERVAL * len(angle):.0f} s at {1 / INTERVAL:.0f} Hz; error of the {quantity}",
            Contender("driftlab", partial(navigate, start, increments), error),
            peers,
            floors,
            [Target(3.0, IN_C)],
            left_out + without,
            error_in=unit,
            rounding=1e-10 if quantity == "attitude" else 1e-6,
        )
        yield from and_compiled(row)


def _pyins(record: Trajectory, quantity: str) -> Contender:
    """pyins on the same increments, held against the same truth."""
    import pandas as pd
    from pyins import strapdown, transform, util

    warnings.filterwarnings("ignore", message="The copy keyword is deprecated")
    # Its results are angles; where heading and roll are one, it says so and goes on.
    warnings.filterwarnings("ignore", message="Gimbal lock detected")
    # It wants one more row, for what happened before the start: nothing but standing.
    increments = np.hstack(record.increments[1:])
    increments = np.vstack([increments[:1], increments])
    index = INTERVAL * np.arange(len(increments))
    imu = pd.DataFrame(increments, index=index, columns=[*util.GYRO_COLS, *util.ACCEL_COLS])
    begin = transform.mat_to_rph(SWAP @ Rotation.from_quat(record.attitude[0]).as_matrix())
    place = pd.Series(
        [np.degrees(LATITUDE), 0.0, 0.0, 0.0, 0.0, 0.0, *begin],
        index=util.TRAJECTORY_COLS,
        name=0.0,
    )

    def run() -> pd.DataFrame:
        steps = strapdown.compute_increments_from_imu(imu, "increment")
        return strapdown.Integrator(place).integrate(steps)

    def error(way: pd.DataFrame) -> float:
        way = way.iloc[1:]
        if quantity == "level velocity":
            return float(np.abs(way[["VE", "VN"]].to_numpy()).max())
        attitude = Rotation.from_matrix(SWAP @ transform.mat_from_rph(way[util.RPH_COLS]))
        return largest_angle(attitude.as_quat(), record.attitude[1:])

    return Contender("pyins, compiled", run, error)
