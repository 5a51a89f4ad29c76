"""One record of one unit, calibrated and published twice, with gyro matrices a degree apart."""

from typing import NamedTuple

import numpy as np
from numpy.linalg import inv
from scipy.ndimage import uniform_filter1d
from scipy.spatial.transform import Rotation

from driftlab.body_frames import body_frame_rotation, change_body_frame
from driftlab.calibration.poses import calibrate_by_poses
from driftlab.checks import FloatArray
from driftlab.recordings.publishers import published
from driftlab.recordings.recording import Recording
from driftlab.recordings.rest_detection import rests

from .force_and_gravity import force_and_gravity
from .publishers_numbers import TRIANGLES, imu_tk_triads
from .tilt_fit import calibrated, fit_accelerometers, fit_gyros

_STILL = 5000
"""Rows at the begin of the record during which the unit lies still: 50 s."""
_MULTIPLE = 6
"""How many times the variance of that time a window of a rest may have; IMU-TK's own choice."""
_WINDOW = 101
_LEADING = 100
"""Rows of a rest from which IMU-TK takes its gravity, and the least number in a rest."""


class TwoCalibrations(NamedTuple):
    """First index 0: upper triangle, 1: lower triangle, where there is one."""

    # (2, 3, 3), K of measured = (I + K) true + bias, from the published numbers
    published_gyro: FloatArray
    published_accelerometer: FloatArray  # (2, 3, 3), L, likewise
    gyro: FloatArray  # (2, 3, 3), K by IMU-TK's method, from the record
    accelerometer: FloatArray  # (2, 3, 3), L, likewise
    deviation: FloatArray  # (3, 3), of the gyro matrix, by the scatter of its residuals
    # (3, 3), the gyro matrix in the first axes by rests and weights of this book
    by_poses: FloatArray
    by_poses_deviation: FloatArray  # (3, 3), its standard deviations
    # (3,), rotation vector of the body axes from the first choice to the second, rad
    rotation: FloatArray
    # (2, 3, 3), the first published matrices in the axes of the second: gyros, accelerometers
    carried: FloatArray
    # (2, 3, 3), (I + K) (I + L)^-1 - I: the gyros against the accelerometers, whatever the axes
    relative: FloatArray
    # (2,), half the sums of squares of forces, (m/s^2)^2, and of tilts, rad^2; compare
    # `IMU_TK_COSTS`
    costs: FloatArray
    # (37,), angle of gravity left after each move with the scale of the first gyro for all, rad
    before: FloatArray
    after: FloatArray  # (37,), the same, calibrated


def two_calibrations() -> TwoCalibrations:
    """Calibrate the Xsens record as IMU-TK does; compare with what was published of it twice."""
    log = published("xsens-mti", download=False)
    triads = [imu_tk_triads(triangle) for triangle in range(len(TRIANGLES))]
    accelerometers = np.array([triad[0].error for triad in triads])
    gyros = np.array([triad[1].error for triad in triads])
    turn = _to_lower_triangle(gyros[0], accelerometers[0])
    carried = change_body_frame(np.array([gyros[0], accelerometers[0]]), turn)

    cuts = imu_tk_rests(log)
    force, gravity = force_and_gravity(log)
    still = np.concatenate([force[begin : begin + _LEADING] for begin, _ in cuts])
    ours = fit_accelerometers(still, gravity)
    bias = log.gyro[:_STILL].mean(axis=0)
    how = {"fixed_bias": bias, "leading": _LEADING}
    fit = fit_gyros(log, cuts, ours, **how)
    nominal = fit_gyros(log, cuts, ours, **how, fixed_error=np.zeros((3, 3)))
    ours_turn = _to_lower_triangle(fit.gyros.error, ours.error)
    weighted = calibrate_by_poses(log, rests(log), body_axes="lower triangle accelerometers")
    surplus = np.linalg.norm(calibrated(still, ours), axis=1) - gravity
    return TwoCalibrations(
        gyros,
        accelerometers,
        np.array([fit.gyros.error, change_body_frame(fit.gyros.error, ours_turn)]),
        np.array([ours.error, change_body_frame(ours.error, ours_turn)]),
        fit.deviation,
        weighted.imu_errors.gyro_error,
        weighted.deviations.gyro_error,
        Rotation.from_matrix(turn.T).as_rotvec(),
        carried,
        (np.eye(3) + gyros) @ inv(np.eye(3) + accelerometers) - np.eye(3),
        np.array([(surplus**2).sum(), (fit.residuals**2).sum()]) / 2,
        nominal.residuals,
        fit.residuals,
    )


def _to_lower_triangle(gyro: FloatArray, accelerometer: FloatArray) -> FloatArray:
    """Rotation matrix to body axes in which nothing is above the accelerometers' diagonal."""
    return body_frame_rotation(gyro, accelerometer, "accelerometers")


def imu_tk_rests(log: Recording) -> list[tuple[int, int]]:
    """Rests as IMU-TK finds them: where the accelerometers vary no more than a few times.

    The log begins with 50 s at rest.
    """
    force = force_and_gravity(log)[0]
    force = force - force[:_STILL].mean(axis=0)
    mean, square = (uniform_filter1d(rows, _WINDOW, axis=0) for rows in (force, force**2))
    variance = np.linalg.norm(square - mean**2, axis=1) * _WINDOW / (_WINDOW - 1)
    quiet = variance < _MULTIPLE * np.linalg.norm(force[:_STILL].var(axis=0, ddof=1))
    quiet[: _WINDOW // 2] = quiet[-(_WINDOW // 2) :] = False
    edges = np.flatnonzero(np.diff(quiet)) + 1
    pairs = zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True)
    return [(begin, end) for begin, end in pairs if end - begin >= _LEADING]
