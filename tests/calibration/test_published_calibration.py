"""The toolbox PSINS made a record from known constants; the filter finds them without being told.

`sysclbt.m` passes over it five times. Here the first pass has all, and a second changes nothing
that counts: the constants are small, and the states contain what the record contains.
"""

import numpy as np
import pytest
from scipy.constants import arcsecond, degree, hour, micro
from scipy.spatial.transform import Rotation

from driftlab.calibration.calibration_history import InconsistentCalibrationWarning
from driftlab.calibration.error_model import ERROR_MODELS
from driftlab.calibration.filter import calibrate
from driftlab.diagnosis import diagnose
from driftlab.higher_order_errors import HigherOrderErrors
from driftlab.imu import ImuErrors, ImuNoise, PriorStandardDeviations
from driftlab.increments import Increments
from support import recording_or_skip

MODEL = ERROR_MODELS["accelerometers"]  # PSINS ties its axes to the accelerometers
GROUPS = ("lever arms", "time skew", "accelerometer quadratic")
G0 = 9.7803267715  # glvf.m

# The defaults of imuclbt.m before 2024-08 (the file's later ones are of another record). It takes
# ``Kg w - eb``, ``Ka f - (db + Ka2 f^2 + arms + tGA w x f)`` of ideal readings, as if it
# corrected them: every constant is an error of the record with the other sign.
TRUE = ImuErrors(
    -np.array([0.1, 0.2, 0.3]) * degree / hour,
    -np.diag([10, 20, 30]) * micro + np.array([[0, 10, 20], [30, 0, 40], [50, 60, 0]]) * arcsecond,
    -np.array([10, 20, 30]) * micro * G0,
    -np.diag([10, 20, 30]) * micro + np.array([[0, 0, 0], [10, 0, 0], [20, 30, 0]]) * arcsecond,
)
TRUE_BESIDES = HigherOrderErrors(
    -np.array([[1, 2, 3], [4, 5, 6], [0, 0, 0]]) / 100,
    np.array(-1e-3),
    -np.array([10, 20, 30]) * micro / G0,
    np.zeros((3, 3)),
)
# att0 of the demo: pitch, roll and yaw, turned about z, then x, then y.
START = Rotation.from_euler("ZXY", [-91, 1, -91], degrees=True).as_quat()


@pytest.fixture(scope="module")
def passes():
    """A pass of 27 states, and two that look for arms, skew and g^2 as well; errors of each."""
    recording = recording_or_skip("nineteen-positions")
    count = 100 * (len(recording.gyro) // 100)  # whole seconds

    def found(groups, linearization_point=None):
        model = MODEL.with_states(*groups)
        one = calibrate(
            Increments(recording.interval, recording.gyro[:count], recording.accelerometer[:count]),
            np.zeros((count // 100, 3)),
            latitude=recording.latitude,
            start=START,
            model=model,
            prior=PriorStandardDeviations(lever_arm=0.1, attitude=1e-3),
            noise=ImuNoise(1e-4 * degree / 60, micro * G0, 1e-3),
            keep=10**6,
            linearization_point=linearization_point,
        )
        return one, model.state(TRUE, TRUE_BESIDES) - one.state[-1]

    first, errors = found(GROUPS)
    with pytest.warns(InconsistentCalibrationWarning):
        doubted, without = found(())
    assert "lever arms" in str(diagnose(doubted))
    return without, errors, found(GROUPS, linearization_point=first)[1]


def test_constants_are_found_without_being_told_arms_and_skew(passes):
    names = MODEL.with_states(*GROUPS).names
    # What both passes leave, rounded up. The record has no noise and the filter expects some: by
    # that alone each error should be well below the deviation that the filter states.
    bounds = {
        "gyro bias": 1e-4 * degree / hour,
        "gyro scale": 0.1 * micro,
        "gyro installation": 0.03 * arcsecond,
        "accelerometer bias": 0.1 * micro * G0,
        "accelerometer scale": 0.15 * micro,
        "accelerometer installation": 0.03 * arcsecond,
        "accelerometer lever arm": 2e-4,
        "accelerometer time skew": 1e-6,
        "accelerometer quadratic": 0.2 * micro / G0,
    }
    for errors in passes[1:]:
        for kind, bound in bounds.items():
            rows = [i for i, name in enumerate(names) if name.startswith(kind)]
            assert np.abs(errors[rows]).max() < bound, kind
    assert len(errors) == 40


def test_without_these_states_angles_are_wrong_by_many_arc_seconds(passes):
    angles = [i for i, name in enumerate(MODEL.names) if name.startswith("gyro installation")]
    assert 15 < np.abs(passes[0][angles]).max() / arcsecond < 25
