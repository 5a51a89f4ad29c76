"""One record of one unit, calibrated and published twice, with gyro matrices a degree apart."""

import numpy as np
from scipy.ndimage import uniform_filter1d
from scipy.spatial.transform import Rotation

from driftlab.body_frames import body_frame_rotation, change_body_frame
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.calibration.multi_position import calibrate_multi_position
from driftlab.checks import FloatArray
from driftlab.recordings.publishers import published
from driftlab.recordings.recording import Recording
from driftlab.recordings.static_detection import static_intervals

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


def two_calibrations() -> DataTable:
    """Calibrate the Xsens record as IMU-TK does; compare with what was published of it twice.

    Matrices K are those of measured = (I + K) true + bias; of two, the first is that of the upper
    triangle.
    """
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
    weighted = calibrate_multi_position(
        log, static_intervals(log), body_axes="lower triangle accelerometers"
    )
    surplus = np.linalg.norm(calibrated(still, ours), axis=1) - gravity
    moves = np.arange(1, len(fit.residuals) + 1)
    of_two = "of both choices of axes"
    our_gyros = [fit.gyros.error, change_body_frame(fit.gyros.error, ours_turn)]
    our_accelerometers = [ours.error, change_body_frame(ours.error, ours_turn)]
    costs = np.array([(surplus**2).sum(), (fit.residuals**2).sum()]) / 2
    poses = "by rests and weights of this book, in the first axes"
    return DataTable(
        {
            "move": (moves, "", "number of the move"),
            "before": (nominal.residuals, "deg", "tilt left after it, one scale for all gyros"),
            "calibrated": (fit.residuals, "deg", "the same, calibrated"),
            "rms_over_moves": ([0, len(moves) + 1], "", "where the root mean squares are drawn"),
            "before_rms": ([_rms(nominal.residuals)] * 2, "deg", "root mean square before"),
            "calibrated_rms": ([_rms(fit.residuals)] * 2, "deg", "root mean square, calibrated"),
        },
        {
            "published_gyro": (gyros, "", f"K {of_two}, published"),
            "published_accelerometer": (accelerometers, "", f"L {of_two}, published"),
            "gyro": (np.array(our_gyros), "", f"K {of_two}, by IMU-TK's method"),
            "accelerometer": (np.array(our_accelerometers), "", f"L {of_two}, likewise"),
            "deviation": (fit.deviation, "", "of K, by the scatter of its residuals"),
            "by_poses": (weighted.imu_errors.gyro_error_matrix, "", f"K {poses}"),
            "by_poses_deviation": (
                weighted.standard_deviations.gyro_error_matrix, "", "its standard deviations"
            ),
            "rotation": (
                Rotation.from_matrix(turn.T).as_rotvec(), "rad", "from the first axes to the second"
            ),
            "carried": (carried, "", "the first published K and L in the second axes"),
            # half the sums of squares of forces, (m/s^2)^2, and of tilts, rad^2
            "costs": (costs, "", "of the two fits; compare IMU_TK_COSTS"),
        },
    )  # fmt: skip


def _rms(angles: FloatArray) -> float:
    return float(np.sqrt((angles**2).mean()))


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
