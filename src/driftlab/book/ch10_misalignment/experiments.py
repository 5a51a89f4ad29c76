"""Experiments of chapter 10: an error matrix, the choice of body axes, an equivalent start."""

import numpy as np
from numpy.typing import ArrayLike

from driftlab.attitude.integration import integrate
from driftlab.body_frames import body_frame_rotation, misalignment_vector
from driftlab.book.machinery.figure.data_table import DataTable
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
from driftlab.motion.turntable import turntable_trajectory
from driftlab.quaternion import conjugate, from_rotation_vector, multiply, rotate, rotation_angle
from driftlab.strapdown import Navigation, navigate, stationary_state
from driftlab.triad import split_error_matrix
from driftlab.vectors import cross_matrix

INTERVAL = 0.05
"""Between two increments on the turntable, s."""
TILTS = ("scale", "non-orthogonality", "misalignment", "misalignment by its derivative")
"""Parts of the gyros' errors, and the last one by the total derivative."""
SPEEDS = ("gyros turned", "accelerometers", "both", "both and the start")
SCHEME = Scheme("+90X +90Y +90Z " * 8, dwell=5.0)
"""Quarter turns that add up to whole turns about a diagonal, again and again."""
MISALIGNMENT_DIRECTION: FloatArray = np.array([2.0, -1.0, 2.0]) / 3
"""Axis of the misalignments whose second order is measured."""
MISALIGNMENT_SIZES: FloatArray = np.logspace(-5, -1, 17)
"""Their sizes, rad."""
POINTS = 700
"""Of a curve over time that are kept, about: the moments lie close together."""
LEAST = 1e-17
"""What stands where nothing is left, for a logarithmic axis."""


def error_matrix_parts(
    gyro_error_matrix: ArrayLike = TYPICAL_ERRORS.gyro_error_matrix,
) -> DataTable:
    """Take an error matrix apart; Wu (7)-(15)."""
    whole = finite_array(gyro_error_matrix, "gyro_error_matrix", 3, 3)
    parts = np.stack([whole, *split_error_matrix(whole)])
    names = ("whole", "scale", "non_orthogonality", "misalignment")
    return DataTable(
        {"parts": (parts, "", "the error matrix and its parts, row by row", names)},
        {"vector": (misalignment_vector(whole), "arcsec", "misalignment about x, y, z")},
    )


def plane_split(gyros: ArrayLike = (0.30, 0.10)) -> DataTable:
    """Take the installation errors of two gyros in a plane apart; Wu Fig. 1, (43), (44)."""
    x, y = whole = finite_array(gyros, "gyros", 2)
    parts = split_error_matrix(np.array([[0, x, 0], [-y, 0, 0], [0, 0, 0]]))
    # Row x leans to y by its entry, and row y to x by its own, which is the other way round.
    turned, closed = (
        np.array([matrix[0, 1], -matrix[1, 0]])
        for matrix in (parts.misalignment, parts.non_orthogonality)
    )
    return DataTable(
        {
            "gyro": (("x", "y"), "", "axis of the gyro"),
            "whole": (whole, "rad", "angle by which it leans, positive from x to y"),
            "misalignment": (turned, "rad", "the part that is the same for both"),
            "non_orthogonality": (closed, "rad", "the part that is opposite"),
        }
    )


def plane_body_axes(
    gyros: ArrayLike = (0.30, 0.10), accelerometers: ArrayLike = (0.20, -0.12)
) -> DataTable:
    """Compute both choices of body axes in a plane; Wu Fig. 2, (43), (44)."""
    x, y = leaning = finite_array(gyros, "gyros", 2)
    triad = np.array([[np.cos(x), np.sin(x), 0], [-np.sin(y), np.cos(y), 0], [0, 0, 1]])
    usual, averaged = (
        float(np.arctan2(turn[0, 1], turn[0, 0]))
        for frame in ("upper triangle", "averaged")
        for turn in [body_frame_rotation(triad - np.eye(3), None, frame)]
    )
    others = finite_array(accelerometers, "accelerometers", 2)
    names = [f"{axis} {kind}" for kind in ("gyro", "accelerometer") for axis in "xy"]
    return DataTable(
        {
            "direction": ([*names, "usual axes", "averaged axes"], "", "what is turned"),
            "angle": (np.array([*leaning, *others, usual, averaged]), "rad",
                      "from the given axes, positive from x to y"),
        },
        {
            "gyros": (leaning, "rad", "angles of the gyros"),
            "accelerometers": (others, "rad", "angles of the accelerometers"),
            "usual": (usual, "rad", "usual body axes, x along the x gyro"),
            "averaged": (averaged, "rad", "averaged body axes"),
        },
    )  # fmt: skip


def equivalent_start(
    gyro_error_matrix: ArrayLike = TYPICAL_ERRORS.gyro_error_matrix,
    scheme: Scheme = SCHEME,
    latitude: float = TABLE_LATITUDE,
    direction: ArrayLike = MISALIGNMENT_DIRECTION,
) -> DataTable:
    """Run units with installation errors through a scheme; Wu (16)-(36), not linearised."""
    whole = finite_array(gyro_error_matrix, "gyro_error_matrix", 3, 3)
    about, _ = nonzero_vectors(direction, "direction")
    place = finite_number(latitude, "latitude")
    motion = turntable_trajectory(
        checked_instance(scheme, Scheme, "scheme"), place, INTERVAL, multiple_of=2
    )
    steps = len(motion.increments.angle) // 2
    times: FloatArray = 2 * INTERVAL * np.arange(1.0, steps + 1)
    right = motion.attitude[0]
    inertial = inertial_attitude(motion, right)
    tilts = [
        np.linalg.norm(attitude_error(computed_attitude(motion, part, right), inertial), axis=-1)
        for part in split_error_matrix(whole)
    ]
    vector = misalignment_vector(whole)
    tilts.append(np.linalg.norm(rotate(inertial, vector) - rotate(right, vector), axis=-1))
    turned = cross_matrix(vector)
    none = np.zeros((3, 3))
    with_axes = multiply(right, from_rotation_vector(-vector))
    speeds = [
        np.linalg.norm(_navigated(motion, place, gyro, accelerometer, start).velocity, axis=-1)
        for gyro, accelerometer, start in (
            (turned, none, right), (none, turned, right), (turned, turned, right),
            (turned, turned, with_axes),
        )
    ]  # fmt: skip
    left = np.array([_left(motion, place, size * about) for size in MISALIGNMENT_SIZES])
    skew_triad, turned_triad, two_skew_triads = np.maximum(left, LEAST).T
    rows = slice(None, None, max(len(times) // POINTS, 1))
    return DataTable(
        {
            "time": (times[rows], "min", "since the start"),
            "attitude_error": (np.array(tilts)[:, rows], "arcsec",
                               "of a part of the gyros' errors", TILTS),
            "velocity_error": (np.array(speeds)[:, rows], "m_per_s", "if these are turned", SPEEDS),
            "size": (MISALIGNMENT_SIZES, "rad", "of a misalignment"),
            "skew_triad": (skew_triad, "rad", "attitude left by the first order, skew matrix"),
            "turned_triad": (turned_triad, "rad", "the same, true rotation"),
            "two_skew_triads": (two_skew_triads, "m_per_s",
                                "velocity left, skew matrices of gyros and accelerometers"),
        },
        {
            "largest": (np.max(tilts, axis=1), "arcsec", "largest attitude error of each part"),
            "derivative_gap": (np.abs(tilts[2] - tilts[3]).max(), "arcsec",
                               "misalignment and its total derivative differ by at most"),
        },
    )  # fmt: skip


def inertial_attitude(motion: Trajectory, start: FloatArray) -> FloatArray:
    """Attitude (n, 4) of an ideal unit against axes that do not turn with the Earth."""
    return integrate(motion.increments.angle, "two-step-4", start=start)


def computed_attitude(
    motion: Trajectory, gyro_error_matrix: FloatArray, start: FloatArray
) -> FloatArray:
    """Attitude (n, 4) that a unit computes whose gyros have an error matrix (3, 3).

    Like that of `inertial_attitude`, it is against axes that do not turn with the Earth.
    """
    measured = measure(motion.increments, NO_ERRORS._replace(gyro_error_matrix=gyro_error_matrix))
    return integrate(measured.angle, "two-step-4", start=start)


def _navigated(
    motion: Trajectory, latitude: float, gyro_error_matrix: FloatArray,
    accelerometer_error_matrix: FloatArray, start: FloatArray,
) -> Navigation:  # fmt: skip
    imu_errors = ImuErrors(np.zeros(3), gyro_error_matrix, np.zeros(3), accelerometer_error_matrix)
    return navigate(stationary_state(latitude, start), measure(motion.increments, imu_errors))


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
