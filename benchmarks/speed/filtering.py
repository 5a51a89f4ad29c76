"""A Kalman filter with 27 states and 3 measurements: the covariance along a calibration."""

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from driftlab.calibration import ERROR_MODELS, covariance_analysis, kalman, linearize_along
from driftlab.calibration.error_dynamics import process_noise
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.motion import NINETEEN_POSITIONS

from . import floor
from .measuring import Contender, Row, and_by_numpy, copy_of, in_c

ROUNDS = 10
"""Times that the scheme is gone through."""


def rows() -> Iterator[Row]:
    # Of 27 states the first six move, and of those the last three are seen.
    model, noise, prior = ERROR_MODELS["averaged"], ImuNoise(), PriorStandardDeviations()
    rotations = " ".join(ROUNDS * [NINETEEN_POSITIONS.rotations])
    scheme = replace(NINETEEN_POSITIONS, rotations=rotations)
    way = linearize_along(scheme, np.radians(37.5), model)
    start, observation = model.covariance(prior, way.start), np.eye(3, 27, 3)
    moving = np.ascontiguousarray(way.transitions[:, :6])
    added = process_noise(noise, moving[:, 3:, :3], way.durations)
    spread = np.multiply.outer(noise.reference_velocity**2 / way.durations, np.eye(3))
    # Peers are given the states that stay as they are, too, and a measurement.
    steps = len(moving)
    transitions, noises = np.tile(np.eye(27), (steps, 1, 1)), np.zeros((steps, 27, 27))
    transitions[:, :6], noises[:, :6, :6], innovation = moving, added, np.full(3, 1e-3)
    along = list(zip(transitions, noises, spread, strict=True))
    exact = extended_covariance(start, along)
    scale = np.sqrt(np.outer(np.diagonal(exact), np.diagonal(exact)))

    def error(after: np.ndarray) -> float:
        return float(np.abs((after - exact) / scale).max())

    def step_by_step() -> np.ndarray:
        after = start
        for transition, small, seen_noise in zip(moving, added, spread, strict=True):
            after = kalman.predict(after, transition, small)
            after = kalman.correct(after, innovation, observation, seen_noise).covariance
        return after

    def filterpy() -> Contender:
        from filterpy.kalman import KalmanFilter

        def run() -> np.ndarray:
            kalman_filter = KalmanFilter(dim_x=27, dim_z=3)
            kalman_filter.P, kalman_filter.H = start.copy(), observation
            for transition, small, seen_noise in along:
                kalman_filter.predict(F=transition, Q=small)
                kalman_filter.update(innovation[:, np.newaxis], R=seen_noise)
            return kalman_filter.P

        why = "Step by step, driftlab checks seven arrays for their shapes and for NaN each time."
        return Contender("filterpy", run, error, why=why)

    def pyins() -> Contender:
        from pyins.kalman import correct

        def run() -> np.ndarray:
            state, after = np.zeros(27), start
            for transition, small, seen_noise in along:
                after = transition @ after @ transition.T + small
                after = correct(state, after, innovation, observation, seen_noise)[1]
            return after

        return Contender("pyins.kalman, NumPy predicts", run, error)

    def navtk() -> Contender:
        from navtk.filtering import EkfStrategy, StandardDynamicsModel, StandardMeasurementModel

        def run() -> np.ndarray:
            strategy = EkfStrategy()
            strategy.on_fusion_engine_state_block_added(np.zeros(27), start)
            for transition, small, seen_noise in along:
                strategy.propagate(StandardDynamicsModel(transition, small))
                strategy.update(StandardMeasurementModel(innovation, observation, seen_noise))
            return strategy.get_covariance()

        return Contender("navtk EkfStrategy", run, error)

    # The floor has one noise for all steps, which costs the same.
    given = start, moving, added[0], observation, spread[0], innovation
    row = Row(
        f"covariance along a calibration of {steps} steps",
        Contender("driftlab", partial(covariance_analysis, way, noise, prior), error),
        [filterpy, pyins, navtk],
        [copy_of(moving), in_c(partial(floor.filter_steps, *given))],
        (steps, "a step"),
        "of the covariance, in units of the deviations",
        1e-6,
    )
    yield from and_by_numpy(row)
    one = Contender("driftlab", step_by_step, error)
    yield replace(row, title="step by step, with all arguments checked each time", ours=one)


def extended_covariance(start: np.ndarray, along: list[tuple[np.ndarray, ...]]) -> np.ndarray:
    """The covariance after all steps in extended precision, corrected by one state at a time."""
    after = start.astype(np.longdouble)
    for transition, small, spread in along:
        after = transition.astype(np.longdouble) @ after @ transition.T + small
        for state in range(3, 6):
            seen = after[state, state] + spread[state - 3, state - 3]
            after = after - np.outer(after[state], after[state]) / seen
    return after
