"""Benchmarks of Part III: navigation against pyins, the filter, and a Monte Carlo."""

import warnings
from concurrent.futures import ProcessPoolExecutor
from time import perf_counter

import numpy as np
from scipy.spatial.transform import Rotation
from timing import best
from tqdm import tqdm

from driftlab.calibration.covariance import covariance_analysis
from driftlab.calibration.error_model import ERROR_MODELS
from driftlab.calibration.linearization import linearize_along
from driftlab.calibration.simulation import TableTrial
from driftlab.core import kalman
from driftlab.imu import ImuNoise, PriorDeviations
from driftlab.increments import Increments
from driftlab.monte_carlo import sweep
from driftlab.motion.scheme import NINETEEN_POSITIONS, Scheme
from driftlab.motion.trajectory import Trajectory
from driftlab.motion.turntable import table_trajectory
from driftlab.strapdown import at_rest, navigate


def navigation() -> None:
    """An hour of turntable at 100 Hz, whose truth is known: navigated here and by pyins."""
    rate, latitude = 100.0, np.radians(37.5)
    scheme = Scheme(NINETEEN_POSITIONS.rotations, NINETEEN_POSITIONS.start, dwell=181.0)
    record = table_trajectory(scheme, latitude, 1 / rate, multiple_of=2)
    increments = record.increments.angle, record.increments.velocity
    start = at_rest(latitude, record.attitude[0])
    count = len(increments[0])
    ours = best(lambda: navigate(start, Increments(1 / rate, *increments)), repeats=3)
    way = navigate(start, Increments(1 / rate, *increments))
    print(f"navigate, {count / rate:.0f} s at {rate:.0f} Hz:          {1e3 * ours:8.0f} ms")
    attitude = Rotation.from_quat(way.attitude)
    print_navigation_errors("ours", record, attitude, way.velocity[:, :2], 2)
    try:
        theirs, attitude, velocity = pyins_on_the_table(record, latitude)
    except ImportError as missing:
        print(f"  pyins, same: left out: {missing}")
    else:
        print(f"  pyins, same:                       {1e3 * theirs:8.0f} ms {theirs / ours:8.1f} x")
        print_navigation_errors("pyins", record, attitude, velocity, 1)


def print_navigation_errors(
    name: str, record: Trajectory, attitude: Rotation, velocity: np.ndarray, every: int
) -> None:
    true = Rotation.from_quat(record.attitude[every::every])
    angle = (true.inv() * attitude).magnitude().max()
    level = np.abs(velocity).max()
    print(f"  largest error, {name:6} {angle:8.1e} rad, level velocity {level:8.1e} m/s")


def pyins_on_the_table(record: Trajectory, latitude: float) -> tuple[float, Rotation, np.ndarray]:
    """Time, attitudes against East, North, Up and level velocities, after each increment."""
    import pandas as pd
    from pyins import strapdown, transform, util

    warnings.filterwarnings("ignore", message="The copy keyword is deprecated")
    # Its results are angles; where heading and roll are one, it says so and goes on.
    warnings.filterwarnings("ignore", message="Gimbal lock detected")
    # It wants one more row, for what happened before the start: nothing but standing.
    rows = np.hstack([record.increments.angle, record.increments.velocity])
    rows = np.vstack([rows[:1], rows])
    index = record.increments.interval * np.arange(len(rows))
    imu = pd.DataFrame(rows, index=index, columns=[*util.GYRO_COLS, *util.ACCEL_COLS])
    swap = np.array([[0, 1, 0], [1, 0, 0], [0, 0, -1]])  # East, North, Up and North, East, Down
    begin = transform.mat_to_rph(swap @ Rotation.from_quat(record.attitude[0]).as_matrix())
    place = pd.Series(
        [np.degrees(latitude), 0.0, 0.0, 0.0, 0.0, 0.0, *begin],
        index=util.TRAJECTORY_COLS,
        name=0.0,
    )

    def run() -> pd.DataFrame:
        steps = strapdown.compute_increments_from_imu(imu, "increment")
        return strapdown.Integrator(place).integrate(steps)

    way = run().iloc[1:]
    attitude = Rotation.from_matrix(swap @ transform.mat_from_rph(way[util.RPH_COLS]))
    return best(run, repeats=3), attitude, way[["VE", "VN"]].to_numpy()


def calibration() -> None:
    model = ERROR_MODELS["averaged"]
    way = linearize_along(NINETEEN_POSITIONS, np.radians(37.5), model)
    covariance = covariance_analysis(way, ImuNoise(), PriorDeviations())
    noise, seen = 1e-15 * np.eye(6), np.full(3, 1e-3)
    observed, spread = np.eye(3, model.size, 3), 1e-4 * np.eye(3)

    def steps() -> None:
        p = covariance
        for matrix in way.transitions:
            p = kalman.predict(p, matrix[:6], noise)
            p = kalman.correct(p, seen, observed, spread)[1]

    each = 1e6 * best(steps) / len(way.transitions)
    print(f"predict and correct, {model.size} states:         {each:8.1f} µs")
    start = perf_counter()
    with ProcessPoolExecutor(2) as pool, tqdm(total=50, unit="run") as bar:
        sweep(TableTrial().run, 50, seed=1, batch=25, executor=pool, progress=bar.update)
    print(f"50 calibrations, two processes:      {perf_counter() - start:8.1f} s")
