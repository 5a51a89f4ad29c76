"""Calibration by poses of real units, held against what their publishers found."""

from functools import cache

import numpy as np
import pytest

from driftlab.body_frames import body_frame_rotation, change_body_frame
from driftlab.book.ch17_real_recordings.experiments.publishers_numbers import IMU_TK
from driftlab.calibration.multi_position import calibrate_multi_position
from driftlab.recordings.static_detection import static_intervals
from driftlab.vectors import cross_matrix
from support import largest, recording_or_skip

# IMU-TK's result on its own record, with zeros below the diagonal and with zeros above.
XSENS = dict(zip(("lower triangle accelerometers", "accelerometers"), IMU_TK, strict=True))


def published_xsens(body_axes):
    """Error matrices of accelerometers and gyros."""
    errors = XSENS[body_axes].imu_errors
    return errors.accelerometer_error_matrix, errors.gyro_error_matrix


@cache
def xsens():
    recording = recording_or_skip("xsens-mti")
    return recording, static_intervals(recording, multiple=6)


def test_xsens_is_as_published():
    """With IMU-TK's bias, the mean of the first rest. The entries' own deviations are 2e-3."""
    recording, found = xsens()
    begin, end = found.rows[0]
    bias = recording.gyro[begin:end].mean(axis=0)
    unit = calibrate_multi_position(recording, found, gyro_bias=bias)
    ours = unit.imu_errors.accelerometer_error_matrix, unit.imu_errors.gyro_error_matrix
    turn = body_frame_rotation(ours[0], frame="lower triangle")
    lower, upper = XSENS
    for one, here, there in zip(ours, published_xsens(upper), published_xsens(lower), strict=True):
        assert largest(one - here) < 5e-4
        assert largest(change_body_frame(one, turn) - there) < 5e-4
    assert not unit.consistency["rates"].holds


def test_xsens_gyros_feel_gravity():
    """Nine numbers more take the residual of the moves from half a degree to an eighth."""
    recording, found = xsens()
    plain = calibrate_multi_position(recording, found)
    felt = calibrate_multi_position(recording, found, sensitivity=True)
    rms = [np.sqrt(np.mean(unit.turn_residuals**2)) for unit in (plain, felt)]
    assert rms[1] < rms[0] / 3
    assert largest(felt.sensitivity / felt.sensitivity_standard_deviations) > 20
    ratios = [
        u.consistency["rates"].chi_square / u.consistency["rates"].degrees_of_freedom
        for u in (plain, felt)
    ]
    assert ratios[0] > 20
    assert ratios[1] < 2
    # The published matrix is one that gravity has bent.
    _, gyros = published_xsens("accelerometers")
    assert (
        largest(felt.imu_errors.gyro_error_matrix - gyros)
        > 2 * felt.standard_deviations.gyro_error_matrix.max()
    )


# Scales in percent, angles in degrees: sx sy sz myz mxy mxz of each triad, and epsilon.
MPU9150 = {
    1: ([0.363, 0.315, 0.647, 0.123, 0.020, 0.317],
        [0.041, 0.457, 0.826, -0.034, -0.120, 0.806], [0.030, -0.364, -0.074]),
    2: ([0.471, 0.482, 0.932, -0.284, -0.010, 0.145],
        [0.007, 0.260, -0.179, -0.639, 0.210, 0.262], [-0.565, 0.013, 0.069]),
    3: ([0.382, 0.355, 0.780, 0.260, -0.012, 0.282],
        [-0.058, 0.277, 0.242, 0.150, -0.072, 0.876], [0.142, -0.482, -0.079]),
    4: ([0.263, 0.448, 0.721, -0.009, -0.028, -0.104],
        [0.227, 0.599, 0.308, -0.105, 0.025, 0.072], [-0.102, -0.129, 0.015]),
    5: ([0.251, 0.286, 0.804, 0.056, 0.000, 0.191],
        [0.226, 0.570, 0.853, 0.080, 0.178, 0.497], [0.077, -0.223, 0.075]),
}  # fmt: skip


def published_mpu9150(number):
    """Error matrices; the gyros' epsilon leads from their axes to those of the accelerometers."""
    *triads, epsilon = MPU9150[number]
    found = []
    for sx, sy, sz, *angles in triads:
        yz, xy, xz = np.radians(angles)
        scales = np.diag([sx, sy, sz]) / 100
        found.append(np.eye(3) + scales + [[0, xy, xz], [0, 0, yz], [0, 0, 0]])
    turn = np.eye(3) + cross_matrix(np.radians(epsilon))
    return found[0] - np.eye(3), turn @ found[1] - np.eye(3)


@pytest.mark.parametrize("number", MPU9150)
def test_five_units_are_as_published_but_for_the_gyros_of_two(number):
    """Deviations are 3e-4 and 1e-3; a tenth unit would leave three of them once in ten."""
    recording = recording_or_skip(f"mpu9150-{number}")
    unit = calibrate_multi_position(
        recording, static_intervals(recording), body_axes="lower triangle accelerometers"
    )
    accelerometers, gyros = published_mpu9150(number)
    assert largest(unit.imu_errors.accelerometer_error_matrix - accelerometers) < 4e-4
    difference = largest(unit.imu_errors.gyro_error_matrix - gyros)
    low, high = {2: (4e-3, 6e-3), 4: (2.5e-3, 3.5e-3)}.get(number, (0.0, 1.5e-3))
    assert low < difference < high
    for test in unit.consistency.values():  # noise of the rests explains all that is left
        assert test.chi_square < 1.5 * test.degrees_of_freedom
