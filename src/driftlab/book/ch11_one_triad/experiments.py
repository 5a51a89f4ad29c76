"""One bent triad all the way: what calibrations leave of it, and what that does to a heading."""

from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import arcsecond

from driftlab.attitude.drift_on_cones import coning_drift
from driftlab.body_frames import misalignment_vector
from driftlab.book.scenarios import QUARTER_TURN, SARATOV_LATITUDE, ship_manoeuvre
from driftlab.calibration.simulation import TableTrial
from driftlab.checks import FloatArray, finite_array, finite_number
from driftlab.drift.systematic_drift import drift_per_turn
from driftlab.drift.turn_calibration import TurnExperiment
from driftlab.drift.weighing_designs import PAIR_AXES
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass.alignment import alignment_errors
from driftlab.gyrocompass.simulation import HeadingErrors, simulate_compass
from driftlab.imu import NO_ERRORS
from driftlab.motion.vehicle import static_imu
from driftlab.quaternion import rotate
from driftlab.triad import decompose
from driftlab.vectors import cross_matrix

STAGES = ("as built", "after turns", "after the filter")
NON_ORTHOGONALITY: FloatArray = np.array([-30.0, 20.0, 30.0]) * arcsecond
"""Symmetric pairs xy, xz, yz, rad."""
MISALIGNMENT: FloatArray = np.array([20.0, 25.0, 20.0]) * arcsecond
"""Turn of the triad about x, y, z, rad."""
AXES: FloatArray = np.vstack([np.eye(3), PAIR_AXES])
"""Axes of the drift per turn: forward, up, right, and between each two."""
AXIS_NAMES = ("f", "u", "r", "f+u", "f+r", "u+r")
TURNS = TurnExperiment(turns=1, angle_noise=1.8 * arcsecond)
"""Larin's test: a turn about each pair axis, with noise of 0.005 deg/sqrt(h) for 36 s."""
CONING_FREQUENCY, SAMPLE_INTERVAL = 5.0, 0.01
"""Of the shaking mount, Hz, and of the increments, s."""
SEED = 11


class Capstone(NamedTuple):
    """What is left of one triad at three stages of its calibration, and what it does.

    Attributes
    ----------
    known : ndarray, shape (3, 6)
        Pairs and turn of the triad, rad: true, found by turns, and found by the filter. Turns say
        nothing of the misalignment, which is NaN.
    per_turn : ndarray, shape (3, 6)
        Drift in one turn about each of `AXES`, by stage, rad.
    headings : ndarray, shape (n,)
        rad.
    aligned : ndarray, shape (3, n)
        Heading error after alignment at these headings, by stage, rad.
    under_way : HeadingErrors
        Of three runs, one a stage.
    """

    known: FloatArray
    per_turn: FloatArray
    headings: FloatArray
    aligned: FloatArray
    under_way: HeadingErrors


def bent_triad(non_orthogonality: ArrayLike, misalignment: ArrayLike) -> FloatArray:
    """Return the error matrix (3, 3) of gyros from its symmetric pairs and its turn.

    Parameters
    ----------
    non_orthogonality : array_like, shape (3,)
        Pairs xy, xz, yz: entries of the symmetric part, half of what the two axes miss of a right
        angle, rad.
    misalignment : array_like, shape (3,)
        About x, y, z, rad.
    """
    xy, xz, yz = finite_array(non_orthogonality, "non_orthogonality", 3)
    symmetric = np.array([[0.0, xy, xz], [xy, 0.0, yz], [xz, yz, 0.0]])
    return symmetric + cross_matrix(finite_array(misalignment, "misalignment", 3))


def pairs_and_turn(matrix: FloatArray) -> FloatArray:
    """Return pairs xy, xz, yz and turn about x, y, z (6,) of an error matrix (3, 3), rad."""
    pairs = decompose(matrix).non_orthogonality[[0, 0, 1], [1, 2, 2]]
    return np.append(pairs, misalignment_vector(matrix))


def found_by_turns(bent: FloatArray) -> FloatArray:
    """Return the pairs xy, xz, yz (3,), rad, that one turn about each pair axis shows."""
    return TURNS.estimate(PAIR_AXES, bent, np.random.default_rng(SEED))


@cache
def filter_leftover() -> FloatArray:
    """Return what one filter calibration of the default triad leaves, (3, 3): found minus true.

    The filter works in axes that the accelerometers fix, so it finds how the gyros stand to them.
    The noise it leaves does not depend on the bend to first order, so other bends get the same.
    """
    true = bent_triad(NON_ORTHOGONALITY, MISALIGNMENT)
    imu_errors = NO_ERRORS._replace(gyro_error=true)
    trial = TableTrial(frame="accelerometers", sample_interval=0.1).run(
        np.random.default_rng(SEED), imu_errors=imu_errors
    )
    leftover: FloatArray = trial.calibration.imu_errors.gyro_error - true
    leftover.setflags(write=False)
    return leftover


def aligned_heading_error(
    gyro_error: FloatArray, headings: FloatArray, latitude: float, drift: FloatArray | float = 0.0
) -> FloatArray:
    """Return heading errors (..., n) of an aligned level compass, rad; (alignment heading).

    Parameters
    ----------
    gyro_error : ndarray, shape (..., 3, 3)
        Error matrices of the gyros.
    headings : ndarray, shape (n,)
        rad.
    latitude : float
        rad.
    drift : ndarray, shape (3,), or float
        Of the gyros in body axes, rad/s, besides what their errors make of the Earth's rate.
    """
    attitude = from_euler_angles(headings, 0.0, 0.0)
    rate, _ = static_imu(attitude, latitude)
    drifts = rotate(attitude, rate @ np.swapaxes(gyro_error, -1, -2) + drift)
    return alignment_errors(headings, 0.0, latitude, drifts, np.zeros(3)).heading


def calibration_stages(
    non_orthogonality: ArrayLike = NON_ORTHOGONALITY,
    misalignment: ArrayLike = MISALIGNMENT,
    latitude: float = SARATOV_LATITUDE,
    turn: float = QUARTER_TURN,
    half_angle: float = 0.0,
    algorithm: str = "two-step-4",
    interval: float = 16.0,
) -> Capstone:
    """Follow a triad from its bend to the heading, uncalibrated and after two calibrations.

    Parameters
    ----------
    non_orthogonality, misalignment : array_like, shape (3,)
        As for `bent_triad`, rad.
    latitude : float
        rad.
    turn : float
        Of the ship, rad, positive to the West.
    half_angle : float
        Of a coning of the mount about the right axis, rad.
    algorithm : str
        Attitude algorithm that makes a drift of the coning; one of `ALGORITHMS`.
    interval : float
        Step of the voyage, s.
    """
    bent = bent_triad(non_orthogonality, misalignment)
    sigma = found_by_turns(bent)
    leftover = filter_leftover()
    left = np.stack([bent, bent - bent_triad(sigma, np.zeros(3)), -leftover])
    cone = coning_drift(algorithm, finite_number(half_angle, "half_angle"), CONING_FREQUENCY,
                        SAMPLE_INTERVAL)  # fmt: skip
    shaken = np.array([0.0, 0.0, float(cone)])
    headings = np.radians(np.arange(-180.0, 180.1, 10.0))
    way = ship_manoeuvre(latitude, turn=turn, interval=interval)
    rates = way.increments.mean_rate
    return Capstone(
        np.stack(
            [
                pairs_and_turn(bent),
                np.append(sigma, [np.nan] * 3),
                pairs_and_turn(bent + leftover),
            ]
        ),
        drift_per_turn(AXES, left[:, np.newaxis]),
        headings,
        aligned_heading_error(left, headings, latitude, shaken),
        simulate_compass(way, rates @ np.swapaxes(left, -1, -2) + shaken, log=True),
    )
