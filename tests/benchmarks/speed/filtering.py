"""One step of a Kalman filter with 27 states and 3 measurements, along a calibration."""

from collections.abc import Callable, Iterator
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np

from driftlab.calibration import ERROR_MODELS, covariance_analysis, kalman, linearize_along
from driftlab.core import loops as core
from driftlab.imu import ImuNoise, PriorDeviations
from driftlab.motion import NINETEEN_POSITIONS

from . import floor
from .contenders import IN_C, and_compiled, floors_here, those_here
from .measuring import Contender, Row, Target


class Steps(NamedTuple):
    """What a filter is given: arrays of n = 27 states, of which k = 6 move."""

    covariance: np.ndarray  # (n, n)
    transitions: np.ndarray  # (steps, k, n)
    noise: np.ndarray  # (k, k)
    observation: np.ndarray  # (3, n)
    observation_noise: np.ndarray  # (3, 3)
    innovation: np.ndarray  # (3,)


def steps_of_calibration() -> Steps:
    model = ERROR_MODELS["averaged"]
    way = linearize_along(NINETEEN_POSITIONS, np.radians(37.5), model)
    return Steps(
        covariance_analysis(way, ImuNoise(), PriorDeviations()),
        np.ascontiguousarray(way.transitions[:, :6]),
        1e-15 * np.eye(6),
        np.eye(3, model.size, 3),
        1e-4 * np.eye(3),
        np.full(3, 1e-3),
    )


def rows() -> Iterator[Row]:
    steps = steps_of_calibration()
    exact = extended_covariance(steps)
    deviations = np.sqrt(np.diagonal(exact))
    scale = np.outer(deviations, deviations)

    def error(after: np.ndarray) -> float:
        return float(np.abs((after - exact) / scale).max())

    peers, left_out = those_here(
        {
            "filterpy": lambda: Contender("filterpy", _filterpy(steps), error),
            "pyins": lambda: Contender("pyins.kalman, NumPy predicts", _pyins(steps), error),
            "navtk": lambda: Contender("navtk EkfStrategy", _navtk(steps), error),
        }
    )
    floors, without = floors_here(steps.transitions, lambda: floor.filter_steps(*steps)[0], error)
    for title, module in (
        ("predict and correct, as `calibrate` calls them", core),
        ("predict and correct, with all arguments checked", kalman),
    ):
        row = Row(
            "filter",
            title,
            Contender("driftlab", _ours(module, steps), error),
            peers,
            floors,
            [Target(3.0, IN_C)],
            left_out + without,
            (len(steps.transitions), "a step"),
            "of the covariance, in units of the deviations",
            1e-10,
        )
        yield from and_compiled(row)


def _ours(module: ModuleType, steps: Steps) -> Callable[[], np.ndarray]:
    def run() -> np.ndarray:
        after = steps.covariance
        for transition in steps.transitions:
            after = module.predict(after, transition, steps.noise)
            after = module.correct(
                after, steps.innovation, steps.observation, steps.observation_noise
            )[1]
        return after

    return run


def _whole(steps: Steps) -> tuple[np.ndarray, np.ndarray]:
    """Transitions (steps, n, n) and noise (n, n) with the states that stay as they are."""
    moving, size = steps.transitions.shape[1:]
    transitions = np.tile(np.eye(size), (len(steps.transitions), 1, 1))
    transitions[:, :moving] = steps.transitions
    noise = np.zeros((size, size))
    noise[:moving, :moving] = steps.noise
    return transitions, noise


def _filterpy(steps: Steps) -> Callable[[], np.ndarray]:
    from filterpy.kalman import KalmanFilter

    transitions, noise = _whole(steps)

    def run() -> np.ndarray:
        kalman_filter = KalmanFilter(dim_x=len(noise), dim_z=3)
        kalman_filter.P = steps.covariance.copy()
        kalman_filter.H, kalman_filter.R = steps.observation, steps.observation_noise
        measured = steps.innovation[:, np.newaxis]
        for transition in transitions:
            kalman_filter.predict(F=transition, Q=noise)
            kalman_filter.update(measured)
        return kalman_filter.P

    return run


def _pyins(steps: Steps) -> Callable[[], np.ndarray]:
    from pyins.kalman import correct

    transitions, noise = _whole(steps)

    def run() -> np.ndarray:
        state, after = np.zeros(len(noise)), steps.covariance
        for transition in transitions:
            after = transition @ after @ transition.T + noise
            _, after, _ = correct(
                state, after, steps.innovation, steps.observation, steps.observation_noise
            )
        return after

    return run


def _navtk(steps: Steps) -> Callable[[], np.ndarray]:
    from navtk.filtering import EkfStrategy, StandardDynamicsModel, StandardMeasurementModel

    transitions, noise = _whole(steps)

    def run() -> np.ndarray:
        strategy = EkfStrategy()
        strategy.on_fusion_engine_state_block_added(np.zeros(len(noise)), steps.covariance)
        for transition in transitions:
            strategy.propagate(StandardDynamicsModel(transition, noise))
            strategy.update(
                StandardMeasurementModel(
                    steps.innovation, steps.observation, steps.observation_noise
                )
            )
        return strategy.get_covariance()

    return run


def extended_covariance(steps: Steps) -> np.ndarray:
    """The covariance after all steps by Joseph's form, in NumPy's longest floating point."""
    transitions, noise, start, observation, observation_noise = (
        each.astype(np.longdouble) for each in (*_whole(steps), steps.covariance, *steps[3:5])
    )
    after: Any = start
    one = np.eye(len(noise), dtype=np.longdouble)
    for transition in transitions:
        after = transition @ after @ transition.T + noise
        seen = observation @ after
        gain = seen.T @ _inverse(seen @ observation.T + observation_noise)
        left = one - gain @ observation
        after = left @ after @ left.T + gain @ observation_noise @ gain.T
    return after


def _inverse(matrix: np.ndarray) -> np.ndarray:
    """Inverse (3, 3), which LAPACK has in double precision only."""
    first, second, third = matrix
    columns = [np.cross(second, third), np.cross(third, first), np.cross(first, second)]
    return np.stack(columns, axis=-1) / (first @ columns[0])
