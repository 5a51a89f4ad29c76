"""One bent triad all the way: what calibrations leave of it, and what that does to a heading."""

from functools import cache

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import arcsecond

from driftlab.attitude.coning_algorithms import AnyAlgorithm
from driftlab.attitude.drift_on_cones import coning_drift
from driftlab.body_frames import misalignment_vector
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import QUARTER_TURN, SARATOV_LATITUDE, TABLE_LATITUDE, ship_manoeuvre
from driftlab.calibration.calibration_history import Calibration
from driftlab.calibration.simulation import TurntableTrial
from driftlab.checks import FloatArray, finite_array, finite_number
from driftlab.drift.recorded_turns import recorded_turn_estimate
from driftlab.drift.systematic_drift import drift_per_revolution
from driftlab.drift.weighing_designs import PAIR_AXES, TurnFit, fit_turns
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass.alignment import alignment_errors
from driftlab.gyrocompass.simulation import simulate_gyrocompass
from driftlab.imu import TYPICAL_ERRORS, ImuErrors, ImuNoise
from driftlab.increments import Increments, measure
from driftlab.motion.turntable_rotation import TurntableRotation
from driftlab.motion.vehicle import static_imu
from driftlab.quaternion import rotate
from driftlab.triad import split_error_matrix
from driftlab.vectors import cross_matrix

STAGES = ("as built", "after turns", "after the filter")
FOUND = ("true", "by turns", "by the filter")
"""How the bend is known at each of them."""
PARTS = ("forward- up", "forward- right", "up- right", "about forward", "about up", "about right")
"""Pairs of axes, and axes that the whole triad is turned about."""
NON_ORTHOGONALITY: FloatArray = np.array([-30.0, 20.0, 30.0]) * arcsecond
"""Symmetric pairs xy, xz, yz, rad."""
MISALIGNMENT: FloatArray = np.array([20.0, 25.0, 20.0]) * arcsecond
"""Turn of the triad about x, y, z, rad."""
AXES: FloatArray = np.vstack([np.eye(3), PAIR_AXES])
"""Axes of the drift per turn: forward, up, right, and between each two."""
AXIS_NAMES = ("f", "u", "r", "f+u", "f+r", "u+r")
TURNS = tuple(
    TurntableRotation(sense * 2 * np.pi / 36, latitude=TABLE_LATITUDE) for sense in (1, -1)
)
"""A turn in each sense on the table of the filter's calibration; 36 s, or 10 degrees a second."""
TURN_SAMPLES = 180
"""Increments of a turn, one each 2 degrees."""
CONING_FREQUENCY, SAMPLE_INTERVAL = 5.0, 0.01
"""Of the shaking mount, Hz, and of the increments, s."""
SEED = 11


def bent_triad(non_orthogonality: ArrayLike, misalignment: ArrayLike) -> FloatArray:
    """Return the error matrix (3, 3) of gyros from its symmetric pairs and its turn, rad.

    The pairs xy, xz, yz are half of what the two axes miss of a right angle.
    """
    xy, xz, yz = finite_array(non_orthogonality, "non_orthogonality", 3)
    symmetric = np.array([[0.0, xy, xz], [xy, 0.0, yz], [xz, yz, 0.0]])
    return symmetric + cross_matrix(finite_array(misalignment, "misalignment", 3))


def pairs_and_turn(matrix: FloatArray) -> FloatArray:
    """Return pairs xy, xz, yz and turn about x, y, z (6,) of an error matrix (3, 3), rad."""
    pairs = split_error_matrix(matrix).non_orthogonality[[0, 0, 1], [1, 2, 2]]
    return np.append(pairs, misalignment_vector(matrix))


def bent_unit(bent: FloatArray) -> ImuErrors:
    """Return the unit that both calibrations get: typical biases, and gyros with these errors.

    Its accelerometers are square to each other and say how the axes of the body lie.
    """
    return TYPICAL_ERRORS._replace(
        gyro_error_matrix=bent, accelerometer_error_matrix=np.zeros((3, 3))
    )


@cache
def _true_turns() -> Increments:
    """True increments (2, 6, n, 3) of the turns: senses, and `AXES`."""
    both = [turn.increments(AXES, TURN_SAMPLES) for turn in TURNS]
    angle, velocity = (
        np.stack([getattr(one, part) for one in both]) for part in ("angle", "velocity")
    )
    return Increments(both[0].interval, angle, velocity)


def turn_estimates(bent: FloatArray, *, noise: ImuNoise | None = None) -> FloatArray:
    """Return what the unit shows after a turn about each of `AXES`, in both directions: (2, 6)."""
    rng = np.random.default_rng(SEED)
    record = measure(_true_turns(), bent_unit(bent), noise, rng)
    return recorded_turn_estimate(record.angle, AXES)


def found_by_turns(bent: FloatArray) -> TurnFit:
    """Return what twelve turns show: the pairs xy, xz, yz, scale factors, biases, and the Earth."""
    rates = [turn.mean_rate for turn in TURNS]
    return fit_turns(
        turn_estimates(bent, noise=ImuNoise()).ravel(), np.tile(AXES, (2, 1)), scale_factor="each",
        table_rates=np.repeat(rates, len(AXES)), gyro_bias=True, earth_rate="unknown",
    )  # fmt: skip


@cache
def filter_calibration() -> Calibration:
    """Calibrate the default triad by the filter, in axes that the accelerometers fix."""
    trial = TurntableTrial(latitude=TABLE_LATITUDE, frame="accelerometers", sample_interval=0.1)
    unit = bent_unit(bent_triad(NON_ORTHOGONALITY, MISALIGNMENT))
    return trial.run(np.random.default_rng(SEED), imu_errors=unit).calibration


@cache
def filter_leftover() -> FloatArray:
    """Return what the filter's calibration of the default triad leaves, (3, 3): found minus true.

    The noise it leaves does not depend on the bend to first order, so other bends get the same.
    """
    true = bent_triad(NON_ORTHOGONALITY, MISALIGNMENT)
    leftover: FloatArray = filter_calibration().imu_errors.gyro_error_matrix - true
    leftover.setflags(write=False)
    return leftover


def left_over(bent: FloatArray, stage: str) -> FloatArray:
    """Return the error matrix (3, 3) that the computer does not know of."""
    if stage == STAGES[0]:
        return bent
    if stage == STAGES[1]:
        return bent - bent_triad(found_by_turns(bent).sigma, np.zeros(3))
    return -filter_leftover()


def turn_deviations() -> FloatArray:
    """Return the standard deviations (3,) of the pairs, rad, after twelve turns."""
    angle_noise = ImuNoise().angle_random_walk * np.sqrt(TURNS[0].duration)
    # Formula (3.3) takes half of the angle along the axis, over pi.
    covariance = found_by_turns(np.zeros((3, 3))).covariance
    return angle_noise / (2 * np.pi) * np.sqrt(np.diag(covariance)[:3])


def aligned_heading_error(
    gyro_error_matrix: FloatArray,
    headings: FloatArray,
    latitude: float,
    drift: FloatArray | float = 0.0,
) -> FloatArray:
    """Return heading errors (..., n) of an aligned level compass, rad; (alignment heading).

    `drift` (rad/s) comes on top of what the gyro errors make of the Earth's rate.
    """
    attitude = from_euler_angles(headings, 0.0, 0.0)
    rate, _ = static_imu(attitude, latitude)
    drifts = rotate(attitude, rate @ np.swapaxes(gyro_error_matrix, -1, -2) + drift)
    return alignment_errors(headings, 0.0, latitude, drifts, np.zeros(3)).heading


def calibration_stages(
    non_orthogonality: ArrayLike = NON_ORTHOGONALITY,
    misalignment: ArrayLike = MISALIGNMENT,
    latitude: float = SARATOV_LATITUDE,
    turn: float = QUARTER_TURN,
    half_angle: float = 0.0,
    algorithm: AnyAlgorithm = "two-step-4",
    interval: float = 16.0,
) -> DataTable:
    """Follow a triad from its bend to the heading, uncalibrated and after two calibrations.

    `half_angle` is that of a coning of the mount about the right axis; a turn is positive to the
    West.
    """
    bent = bent_triad(non_orthogonality, misalignment)
    left = np.stack([left_over(bent, stage) for stage in STAGES])
    cone = coning_drift(algorithm, finite_number(half_angle, "half_angle"), CONING_FREQUENCY,
                        SAMPLE_INTERVAL)  # fmt: skip
    shaken = np.array([0.0, 0.0, float(cone)])
    headings = np.radians(np.arange(-180.0, 180.1, 10.0))
    way = ship_manoeuvre(latitude, turn=turn, interval=interval)
    rates = way.increments.mean_rate
    run = simulate_gyrocompass(way, rates @ np.swapaxes(left, -1, -2) + shaken, speed_log=True)
    # Turns say nothing of the misalignment.
    by_turns = np.append(pairs_and_turn(bent - left[1])[:3], [np.nan] * 3)
    known = np.stack([pairs_and_turn(bent), by_turns, pairs_and_turn(bent - left[2])])
    return DataTable(
        {
            "part": (PARTS, "", "pair of axes, or axis of a turn of the triad"),
            "bend": (known, "arcsec", "of the triad", FOUND),
            "axis": (AXIS_NAMES, "", "of a turn"),
            "drift": (
                drift_per_revolution(AXES, left[:, np.newaxis]), "arcsec", "in one turn", STAGES
            ),
            "headings": (headings, "deg", "of the ship during alignment"),
            "aligned_error": (aligned_heading_error(left, headings, latitude, shaken), "arcmin",
                              "heading error after it", STAGES),
            "time": (run.times, "min", "under way"),
            "heading_error": (run.heading_error, "deg", "of the ship under way", STAGES),
        },
        {"turn": (turn, "deg", "turn of the ship")},
    )  # fmt: skip


def remaining_part(ratio: ArrayLike) -> FloatArray:
    """Return the largest impulse response of the damped horizon over that without damping."""
    ratio = finite_array(ratio, "ratio")
    arc, root = np.abs(np.emath.arccos(ratio)), np.abs(np.emath.sqrt(1 - ratio**2))
    # At one, 0 / 0 comes to 1.
    part: FloatArray = np.exp(-ratio * np.divide(arc, root, np.ones_like(root), where=root > 0))
    return part


def damped_turn(
    ratios: ArrayLike = (0.0, 0.3, 0.5, 0.9, 5.0), latitude: float = SARATOV_LATITUDE
) -> DataTable:
    """Follow the heading error of the default triad through a turn, for some damping ratios."""
    each = np.atleast_1d(finite_array(ratios, "ratios"))
    way = ship_manoeuvre(latitude, interval=16.0)
    drift = way.increments.mean_rate @ bent_triad(NON_ORTHOGONALITY, MISALIGNMENT).T
    runs = [simulate_gyrocompass(way, drift, damping=x, speed_log=True) for x in (0.0, *each)]
    errors = np.stack([run.heading_error for run in runs])
    worst = np.abs(errors).max(axis=1)
    grid = np.arange(0.0, max(5.0, each.max()) + 0.01, 0.05)
    return DataTable(
        {
            "time": (runs[0].times, "min", "under way"),
            "heading_error": (errors[1:], "deg", "with damping", [f"{x:.3g}" for x in each]),
            "ratio": (each, "", "damping ratio"),
            "remaining": (worst[1:] / worst[0], "", "largest error over that without damping"),
            "any_ratio": (grid, "", "damping ratio of the formula"),
            "by_formula": (remaining_part(grid), "", "the same by the impulse response"),
        },
        {"undamped": (worst[0], "deg", "largest error without damping")},
    )
