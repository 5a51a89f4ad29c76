"""The forms of IMU-TK and PSINS: what they hold by hand, and what is no such log."""

import re

import numpy as np
import pytest
from numpy.testing import assert_allclose

from driftlab.recordings import read_imu_tk, read_psins

ACCELEROMETER = ["0.00 0 100 9800", "0.01 0 100 9810", "0.02 0 200 9790"]
GYRO = ["0.00 5 6 7", "0.01 5 6 8", "0.02 5 7 7"]
PSINS = ["% made up", "0 0 90 0 0 0", "30 100 0 5 4 9.8", ".1 .2 .3 100 200 300", "1 -2 3 0 0 13"]


@pytest.fixture
def read(tmp_path):
    def read(accelerometer=ACCELEROMETER, gyro=GYRO, **changes):
        paths = tmp_path / "acc.mat", tmp_path / "gyro.mat"
        for path, lines in zip(paths, (accelerometer, gyro), strict=True):
            path.write_text("\n".join(lines))
        return read_imu_tk(*paths, **{"units": ("mrad/s", "1e-3 m/s^2"), "zeros": (5, 0)} | changes)

    return read


def test_counts_of_imu_tk_become_si_units(read):
    recording = read()
    assert_allclose(recording.gyro, [[0, 1e-3, 2e-3], [0, 1e-3, 3e-3], [0, 2e-3, 2e-3]])
    assert_allclose(recording.accelerometer[2], [0, 0.2, 9.79])
    assert (recording.interval, recording.times, recording.name) == (0.01, None, "gyro")


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"gyro": GYRO[:2]}, "gyro_path: expected the time stamps of acc.mat, got others"),
        ({"gyro": [*GYRO[:2], "0.03 5 7 7"]}, "gyro_path: expected the time stamps of acc.mat"),
        ({"gyro": [line[:-2] for line in GYRO]}, "gyro.mat: expected a time stamp and three"),
        ({"gyro": [*GYRO[:2], "0.02 5 7"]}, "gyro.mat, line 3: expected 4 cells as in line 1"),
        ({"units": ("rad/s",)}, "units: expected one for each of gyro, accelerometer"),
        ({"units": ("rad", "m/s^2")}, "units: expected rates with specific force"),
        ({"units": ("rad/s", "m/s^2")}, "gyro: accelerometer: expected a median size near gravity"),
    ],
)
def test_what_is_no_log_of_imu_tk_is_refused(read, changes, words):
    with pytest.raises(ValueError, match=re.escape(words)):
        read(**changes)


def stamped(stamps):
    """Two files of a unit that lies still, with these stamps."""
    return {
        "accelerometer": [f"{stamp} 0 0 9800" for stamp in stamps],
        "gyro": [f"{stamp} 5 5 5" for stamp in stamps],
    }


def test_a_step_of_one_and_a_half_is_no_gap_for_imu_tk_and_more_is(read):
    assert_allclose(read(**stamped([3, 5, 7, 10, 11])).times, [0, 2, 4, 7, 8])
    words = r"^gyro\.mat, line 4: expected no gap longer than 1\.5 times .* got 3\.01 s since"
    with pytest.raises(ValueError, match=words):
        read(**stamped([3, 5, 7, 10.01, 11.01]))
    assert len(read(**stamped([3, 5, 7, 10.01, 11.01]), longest_gap=1.6, allow=["gap"])) == 5


def test_pulses_of_psins_become_increments(tmp_path):
    path = tmp_path / "ring.imu"
    path.write_text("\n".join(PSINS))
    recording = read_psins(path)
    arcsec = np.pi / 648000
    assert_allclose(recording.gyro, [[0.1 * arcsec, -0.4 * arcsec, 0.9 * arcsec]])
    assert_allclose(recording.accelerometer, [[0, 0, 13 * 300e-6 * 9.8]])
    assert (recording.interval, recording.axes, recording.name) == (0.004, "RFU", "ring")
    assert np.degrees(recording.latitude) == pytest.approx(30)
    told = read_psins(path, gravity=9.79, licence="MIT")
    assert (told.gravity, told.licence, told.axes) == (9.79, "MIT", "RFU")


@pytest.mark.parametrize(
    ("line", "text", "words"),
    [
        (2, "30 100 0 5 0 9.8", "line 3: expected interval, gravity and scale above zero, got 0."),
        (3, ".1 .2 .3 100 200 -1", "line 4: expected interval, gravity and scale above zero"),
        (2, "3000 100 0 5 4 9.8", "latitude: expected"),
        (4, "1 -2 3 0 0", "line 5: expected 6 cells as in line 2, got 5: '1 -2 3 0 0'."),
        (
            4,
            "1 -2 3 0 0 130",
            "ring: accelerometer: expected a median size near 0.0392 m/s, gravity",
        ),
        (4, "", "ring.imu: expected three lines of header and then samples, got 3 lines."),
    ],
)
def test_what_is_no_log_of_psins_is_refused(tmp_path, line, text, words):
    path = tmp_path / "ring.imu"
    path.write_text("\n".join([*PSINS[:line], text, *PSINS[line + 1 :]]))
    with pytest.raises(ValueError, match=re.escape(words)):
        read_psins(path)
