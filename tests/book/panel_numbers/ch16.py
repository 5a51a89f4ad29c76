"""Rows of the panel of chapter 16."""

from functools import cache

import numpy as np
from scipy.constants import arcminute, arcsecond

from driftlab.attitude.drift_on_cones import coning_drift
from driftlab.book.scenarios import ship_manoeuvre
from driftlab.calibration.simulation import TurntableTrial
from driftlab.drift.recorded_turns import recorded_turn_estimate
from driftlab.drift.systematic_drift import drift_per_revolution
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass.alignment import alignment_errors
from driftlab.gyrocompass.simulation import simulate_gyrocompass
from driftlab.imu import TYPICAL_ERRORS, ImuErrors, ImuNoise
from driftlab.increments import Increments, measure
from driftlab.motion.turntable_rotation import TurntableRotation
from driftlab.motion.vehicle import static_imu
from driftlab.quaternion import rotate
from driftlab.vectors import cross_matrix

from .values import Rows, Values, listed


def capstone(values: Values) -> Rows:
    xy, xz, yz = listed(values, "pair_0 pair_1 pair_2") * arcsecond
    turned = cross_matrix(listed(values, "turn_forward turn_up turn_right") * arcsecond)
    bent = np.array([[0, xy, xz], [xy, 0, yz], [xz, yz, 0]]) + turned
    sxy, sxz, syz = pairs_by_turns(unit_with(bent))
    left = {
        "as built": bent,
        "after turns": bent - [[0, sxy, sxz], [sxy, 0, syz], [sxz, syz, 0]],
        "after the filter": -filter_leftover(),
    }
    cone = coning_drift(values["algorithm"], values["cone"] * arcminute, 5.0, 0.01)
    shaken = np.array([0, 0, cone])
    latitude, turn = np.radians(listed(values, "latitude turn"))
    headings = np.radians(np.arange(-180.0, 181.0, 10.0))
    attitude = from_euler_angles(headings, 0.0, 0.0)
    rate, _ = static_imu(attitude, latitude)
    way = ship_manoeuvre(latitude, 10.0, 0.0, turn, 16.0)
    rates = way.increments.mean_rate
    rows = []
    for stage, error in left.items():
        drift_a_turn = np.abs(drift_per_revolution(SIX_AXES, error)).max()
        drifts = rotate(attitude, rate @ error.T + shaken)
        aligned = alignment_errors(headings, 0.0, latitude, drifts, np.zeros(3)).heading
        run = simulate_gyrocompass(way, rates @ error.T + shaken, speed_log=True)
        rows += [
            (f"{stage}: drift in a turn", f"{drift_a_turn / arcsecond:.1f}″"),
            (f"{stage}: aligned heading", f"{np.abs(aligned).max() / arcminute:.3f}′"),
            (f"{stage}: under way", f"{np.degrees(np.abs(run.heading_error).max()):.4f}°"),
        ]
    return [("heading error under way, as built", rows[2][1]), *rows]


SIX_AXES = np.vstack([np.eye(3), [[1, 1, 0], [1, 0, 1], [0, 1, 1]] / np.sqrt(2)])


def unit_with(gyro_error_matrix: np.ndarray) -> ImuErrors:
    """The unit that is calibrated: typical biases, and accelerometers that are square."""
    square = np.zeros((3, 3))
    return TYPICAL_ERRORS._replace(
        gyro_error_matrix=gyro_error_matrix, accelerometer_error_matrix=square
    )


def pairs_by_turns(unit: ImuErrors) -> np.ndarray:
    """Pairs of the unit's gyros, by turns at ten degrees a second about six axes, both ways."""
    turns = [
        TurntableRotation(rate, latitude=np.radians(37.5)) for rate in np.radians([10.0, -10.0])
    ]
    true = np.stack([turn.increments(SIX_AXES, 180).angle for turn in turns])
    seconds = 36.0 / 180
    record = Increments(seconds, true, np.zeros_like(true))
    record = measure(record, unit, ImuNoise(), np.random.default_rng(11))
    x, y, z, xy, xz, yz = recorded_turn_estimate(record.angle, SIX_AXES).mean(axis=0)
    # About a body axis there is its gyro's scale error; about one between two, half of theirs.
    return np.array([xy - (x + y) / 2, xz - (x + z) / 2, yz - (y + z) / 2])


@cache
def filter_leftover() -> np.ndarray:
    """What the filter leaves in the gyros of the unit with which the panel opens."""
    true = np.array([[0, -30, 20], [-30, 0, 30], [20, 30, 0]]) * arcsecond
    true = true + cross_matrix(np.array([20, 25, 20]) * arcsecond)
    trial = TurntableTrial(frame="accelerometers", sample_interval=0.1)
    found = trial.run(np.random.default_rng(11), imu_errors=unit_with(true)).calibration.imu_errors
    return found.gyro_error_matrix - true
