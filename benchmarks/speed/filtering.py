"""A Kalman filter's step with 27 states and 3 measurements, along a calibration."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from driftlab.calibration import (
    ERROR_MODELS,
    covariance_analysis,
    kalman,
    linearize_along,
)
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.motion import NINETEEN_POSITIONS

from . import floor
from .measuring import Contender, Row, and_by_numpy, copy_of, in_c


def rows() -> Iterator[Row]:
    # As `calibrate` has it: of 27 states the first six move, and of those the last three are seen.
    model = ERROR_MODELS["averaged"]
    way = linearize_along(NINETEEN_POSITIONS, np.radians(37.5), model)
    start = covariance_analysis(way, ImuNoise(), PriorStandardDeviations())
    moving, small = np.ascontiguousarray(way.transitions[:, :6]), 1e-15 * np.eye(6)
    seen, seen_noise, innovation = np.eye(3, 27, 3), 1e-4 * np.eye(3), np.full(3, 1e-3)
    given = moving, small, seen, seen_noise, innovation
    # Peers are given the states that stay as they are, too.
    transitions, noise = np.tile(np.eye(27), (len(moving), 1, 1)), np.zeros((27, 27))
    transitions[:, :6], noise[:6, :6] = moving, small
    exact = extended_covariance(start, transitions, noise)
    scale = np.sqrt(np.outer(np.diagonal(exact), np.diagonal(exact)))

    def error(after: np.ndarray) -> float:
        return float(np.abs((after - exact) / scale).max())

    def ours() -> np.ndarray:
        after = start
        for transition in moving:
            after = kalman.predict(after, transition, small)
            after = kalman.correct(after, innovation, seen, seen_noise).covariance
        return after

    def filterpy() -> Contender:
        from filterpy.kalman import KalmanFilter

        def run() -> np.ndarray:
            kalman_filter = KalmanFilter(dim_x=27, dim_z=3)
            kalman_filter.P = start.copy()
            kalman_filter.H, kalman_filter.R = seen, seen_noise
            for transition in transitions:
                kalman_filter.predict(F=transition, Q=noise)
                kalman_filter.update(innovation[:, np.newaxis])
            return kalman_filter.P

        return Contender("filterpy", run, error)

    def pyins() -> Contender:
        from pyins.kalman import correct

        def run() -> np.ndarray:
            state, after = np.zeros(27), start
            for transition in transitions:
                after = transition @ after @ transition.T + noise
                after = correct(state, after, innovation, seen, seen_noise)[1]
            return after

        return Contender("pyins.kalman, NumPy predicts", run, error)

    def navtk() -> Contender:
        from navtk.filtering import EkfStrategy, StandardDynamicsModel, StandardMeasurementModel

        def run() -> np.ndarray:
            strategy = EkfStrategy()
            strategy.on_fusion_engine_state_block_added(np.zeros(27), start)
            for transition in transitions:
                strategy.propagate(StandardDynamicsModel(transition, noise))
                strategy.update(StandardMeasurementModel(innovation, seen, seen_noise))
            return strategy.get_covariance()

        return Contender("navtk EkfStrategy", run, error)

    row = Row(
        "predict and correct, with all arguments checked",
        Contender("driftlab", ours, error),
        [filterpy, pyins, navtk],
        [copy_of(moving), in_c(partial(floor.filter_steps, start, *given), error)],
        (len(transitions), "a step"),
        "of the covariance, in units of the deviations",
        1e-10,
    )
    yield from and_by_numpy(row)


def extended_covariance(
    start: np.ndarray, transitions: np.ndarray, noise: np.ndarray
) -> np.ndarray:
    """The covariance after all steps in extended precision, corrected by one state at a time."""
    after = start.astype(np.longdouble)
    for transition in transitions.astype(np.longdouble):
        after = transition @ after @ transition.T + noise
        for state in range(3, 6):
            after = after - np.outer(after[state], after[state]) / (after[state, state] + 1e-4)
    return after
