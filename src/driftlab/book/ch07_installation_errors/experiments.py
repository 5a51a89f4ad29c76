"""Experiments of chapter 07: an error matrix, the choice of body axes, an equivalent start."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.attitude.integration import integrate
from driftlab.body_frames import body_frame_rotation, misalignment_vector
from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration.body_axes import attitude_error
from driftlab.checks import (
    FloatArray,
    checked_instance,
    finite_array,
    finite_number,
    nonzero_vectors,
)
from driftlab.imu import NO_ERRORS, TYPICAL_ERRORS, ImuErrors
from driftlab.increments import measure
from driftlab.motion.scheme import Scheme
from driftlab.motion.trajectory import Trajectory
from driftlab.motion.turntable import table_trajectory
from driftlab.quaternion import (
    conjugate,
    from_rotation_vector,
    multiply,
    rotate,
    rotation_angle,
)
from driftlab.strapdown import Navigation, at_rest, navigate
from driftlab.triad import decompose
from driftlab.vectors import cross_matrix

INTERVAL = 0.05
"""Between two increments on the turntable, s."""
SCHEME = Scheme("+90X +90Y +90Z " * 8, dwell=5.0)
"""Quarter turns that add up to whole turns about a diagonal, again and again."""
MISALIGNMENT_DIRECTION: FloatArray = np.array([2.0, -1.0, 2.0]) / 3
"""Axis of the misalignments whose second order is measured."""
MISALIGNMENT_SIZES: FloatArray = np.logspace(-5, -1, 17)
"""Their sizes, rad."""


class SplitTriad(NamedTuple):
    """An error matrix and its parts."""

    parts: FloatArray  # (4, 3, 3), the whole, scale, non-orthogonality, misalignment
    vector: FloatArray  # (3,), the misalignment as a small rotation, rad


class PlaneSplit(NamedTuple):
    """Angles by which an x and a y gyro lean in a plane, positive from x to y, rad."""

    whole: FloatArray  # (2,)
    misalignment: FloatArray  # (2,), its part that is the same for both gyros
    non_orthogonality: FloatArray  # (2,), its part that is opposite


class PlaneAxes(NamedTuple):
    """Angles in a plane, counted from the given axes x and y, positive from x to y, rad."""

    gyros: FloatArray  # (2,), of the x and of the y gyro
    accelerometers: FloatArray  # (2,), of the x and of the y accelerometer
    usual: float  # of the usual body axes, x along the x gyro
    averaged: float  # of the averaged body axes


class EquivalentStart(NamedTuple):
    """A misaligned unit against an ideal one that starts wrong."""

    times: FloatArray  # (n,), s
    # (4, n), attitude error of scale, of non-orthogonality, of misalignment, and what the total
    # derivative says of the last, rad
    tilts: FloatArray
    # (4, n), velocity error if the gyros are turned, the accelerometers, both, both with the start,
    # m/s
    speeds: FloatArray
    sizes: FloatArray  # (m,), misalignments, rad
    # (3, m), what the first order leaves over at the end: attitude of a skew triad and of a turned
    # one, rad; velocity of two skew ones, m/s
    left: FloatArray


def error_matrix_parts(gyro_error: ArrayLike = TYPICAL_ERRORS.gyro_error) -> SplitTriad:
    """Take an error matrix apart; Wu (7)-(15)."""
    whole = finite_array(gyro_error, "gyro_error", 3, 3)
    return SplitTriad(np.stack([whole, *decompose(whole)]), misalignment_vector(whole))


def plane_split(gyros: ArrayLike = (0.30, 0.10)) -> PlaneSplit:
    """Take the installation errors of two gyros in a plane apart; Wu Fig. 1, (43), (44)."""
    x, y = whole = finite_array(gyros, "gyros", 2)
    parts = decompose(np.array([[0, x, 0], [-y, 0, 0], [0, 0, 0]]))
    # Row x leans to y by its entry, and row y to x by its own, which is the other way round.
    turned, closed = (
        np.array([matrix[0, 1], -matrix[1, 0]])
        for matrix in (parts.misalignment, parts.non_orthogonality)
    )
    return PlaneSplit(whole, turned, closed)


def plane_body_axes(
    gyros: ArrayLike = (0.30, 0.10), accelerometers: ArrayLike = (0.20, -0.12)
) -> PlaneAxes:
    """Compute both choices of body axes in a plane; Wu Fig. 2, (43), (44)."""
    x, y = leaning = finite_array(gyros, "gyros", 2)
    triad = np.array([[np.cos(x), np.sin(x), 0], [-np.sin(y), np.cos(y), 0], [0, 0, 1]])
    usual, averaged = (
        np.arctan2(turn[0, 1], turn[0, 0])
        for frame in ("upper triangle", "averaged")
        for turn in [body_frame_rotation(triad - np.eye(3), None, frame)]
    )
    others = finite_array(accelerometers, "accelerometers", 2)
    return PlaneAxes(leaning, others, float(usual), float(averaged))


def equivalent_start(
    gyro_error: ArrayLike = TYPICAL_ERRORS.gyro_error,
    scheme: Scheme = SCHEME,
    latitude: float = TABLE_LATITUDE,
    direction: ArrayLike = MISALIGNMENT_DIRECTION,
) -> EquivalentStart:
    """Run units with installation errors through a scheme; Wu (16)-(36), not linearised."""
    whole = finite_array(gyro_error, "gyro_error", 3, 3)
    about, _ = nonzero_vectors(direction, "direction")
    place = finite_number(latitude, "latitude")
    motion = table_trajectory(
        checked_instance(scheme, Scheme, "scheme"), place, INTERVAL, multiple_of=2
    )
    steps = len(motion.increments.angle) // 2
    times: FloatArray = 2 * INTERVAL * np.arange(1.0, steps + 1)
    right = motion.attitude[0]
    inertial = inertial_attitude(motion, right)
    tilts = [
        np.linalg.norm(attitude_error(computed_attitude(motion, part, right), inertial), axis=-1)
        for part in decompose(whole)
    ]
    vector = misalignment_vector(whole)
    tilts.append(np.linalg.norm(rotate(inertial, vector) - rotate(right, vector), axis=-1))
    turned = cross_matrix(vector)
    none = np.zeros((3, 3))
    with_axes = multiply(right, from_rotation_vector(-vector))
    speeds = [
        np.linalg.norm(_navigated(motion, place, gyro, accelerometer, start).velocity, axis=-1)
        for gyro, accelerometer, start in (
            (turned, none, right),
            (none, turned, right),
            (turned, turned, right),
            (turned, turned, with_axes),
        )
    ]
    left = np.array([_left(motion, place, size * about) for size in MISALIGNMENT_SIZES]).T
    return EquivalentStart(times, np.array(tilts), np.array(speeds), MISALIGNMENT_SIZES, left)


def inertial_attitude(motion: Trajectory, start: FloatArray) -> FloatArray:
    """Attitude (n, 4) of an ideal unit against axes that do not turn with the Earth."""
    return integrate(motion.increments.angle, "two-step-4", start=start)


def computed_attitude(motion: Trajectory, gyro_error: FloatArray, start: FloatArray) -> FloatArray:
    """Attitude (n, 4) that a unit computes whose gyros have an error matrix (3, 3).

    Like that of `inertial_attitude`, it is against axes that do not turn with the Earth.
    """
    measured = measure(motion.increments, NO_ERRORS._replace(gyro_error=gyro_error))
    return integrate(measured.angle, "two-step-4", start=start)


def _navigated(
    motion: Trajectory, latitude: float, gyro_error: FloatArray, accelerometer_error: FloatArray,
    start: FloatArray,
) -> Navigation:  # fmt: skip
    imu_errors = ImuErrors(np.zeros(3), gyro_error, np.zeros(3), accelerometer_error)
    return navigate(at_rest(latitude, start), measure(motion.increments, imu_errors))


def _left(motion: Trajectory, latitude: float, vector: FloatArray) -> tuple[float, float, float]:
    """How far apart the two units of the chapter are at the end, in three comparisons."""
    start = motion.attitude[0]
    turn = from_rotation_vector(vector)
    # An ideal unit that starts turned, seen in axes turned back.
    ideal = inertial_attitude(motion, multiply(start, turn))[-1]
    expected = multiply(ideal, conjugate(turn))
    gaps = []
    for matrix in (cross_matrix(vector), rotate(turn, np.eye(3)).T - np.eye(3)):
        found = computed_attitude(motion, matrix, start)[-1]
        gaps.append(float(rotation_angle(multiply(conjugate(expected), found))))
    skew = cross_matrix(vector)
    moved = _navigated(motion, latitude, skew, skew, multiply(start, conjugate(turn)))
    return gaps[0], gaps[1], float(np.linalg.norm(moved.velocity[-1]))
