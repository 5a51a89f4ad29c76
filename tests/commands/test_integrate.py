"""`integrate`: attitudes of the package, a true motion, and a path that closes."""

import csv
import json

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from driftlab.attitude import integrate
from driftlab.commands import example
from driftlab.commands.example import OPTIONS
from driftlab.commands.integrate import attitude_of_angles, euler_angles, flown
from driftlab.motion import Coning
from driftlab.recordings.recording import Recording
from support import same_rotation

GYROS = OPTIONS.replace(",ax,ay,az", "").replace("deg/s,g", "deg/s")


def test_start_angles_are_those_of_ned_and_frd():
    angles = np.radians([70.0, -20.0, 35.0])
    usual = Rotation.from_euler("ZYX", angles).as_quat()
    assert same_rotation(attitude_of_angles(tuple(angles)), usual, 1e-15)
    assert euler_angles(usual[np.newaxis])[0] == pytest.approx(angles, abs=1e-14)


@pytest.mark.parametrize("algorithm", ["two-step-4", "rotation-vector-3", "functional-iteration"])
def test_attitudes_are_the_package_s(algorithm, run, example_log, tmp_path):
    words = f"integrate {example_log} {GYROS} --algorithm {algorithm} --csv a.csv --json a.json"
    assert run(words)[0] == 0
    with (tmp_path / "a.csv").open() as file:
        rows = list(csv.DictReader(file))
    end = np.array([float(rows[-1][name]) for name in ("qx", "qy", "qz", "qw")])
    angles = example.example().angles()
    step = {"two-step-4": 2, "rotation-vector-3": 3}.get(algorithm, 1)
    direct = integrate(angles[: len(angles) // step * step], algorithm)
    assert len(rows) == len(direct) + 1
    assert same_rotation(end, direct[-1], 1e-6)  # the log has eight digits
    values = json.loads((tmp_path / "a.json").read_text())["values"]
    assert values["end_attitude"] == pytest.approx(end, abs=1e-11)


def test_a_cone_is_followed():
    motion = Coning(half_angle=0.02, frequency=1.0)
    record = Recording(motion.increments(0.01, 500), None, 0.01, "increments")
    flight = flown(record, "two-step-4")
    turn = Rotation.from_quat(motion.attitude(0.0)).inv() * Rotation.from_quat(
        motion.attitude(flight.times)
    )
    assert same_rotation(flight.attitude, turn.as_quat(), 1e-8)


def test_a_closed_path_shows_the_unit_s_own_errors(run, example_log, tmp_path):
    """With the true errors taken out little is left: the Earth turns by 0.7 degrees meanwhile."""
    words = f"integrate {example_log} {GYROS} --axes FRD --closed --json a.json"
    code, out, _ = run(words)
    assert code == 0
    assert "Closing error" in out
    values = json.loads((tmp_path / "a.json").read_text())["values"]
    record = example.example()
    earth = 7.292115e-5 * record.duration
    true = (record.gyro - example.ERRORS.gyro_bias) @ np.linalg.inv(
        np.eye(3) + example.ERRORS.gyro_error_matrix
    ).T
    clean = flown(Recording(true, None, record.interval, "rates", axes="FRD"), "two-step-4")
    left = Rotation.from_quat(clean.attitude[-1]).magnitude()
    assert left == pytest.approx(earth, rel=0.01)
    assert values["closing_angle"] > 1.5 * left


def test_what_a_rest_shows_is_taken_off():
    rng = np.random.default_rng(2)
    rate = np.array([0.01, -0.02, 0.03]) + 1e-5 * rng.standard_normal((2000, 3))
    flight = flown(Recording(rate, None, 0.01, "rates"), "two-step-4", still=5.0)
    assert flight.bias == pytest.approx([0.01, -0.02, 0.03], abs=1e-5 * 5 / np.sqrt(500))
    assert Rotation.from_quat(flight.attitude[-1]).magnitude() < 1e-4


def test_a_rest_in_which_the_unit_was_moved_is_none(refused, example_log):
    assert refused(f"integrate {example_log} {GYROS} --still 70").endswith("moved at 60 s.")


def test_angles_that_are_none_are_refused(run, example_log):
    code, _, err = run(f"integrate {example_log} {GYROS} --start 1,2")
    assert code == 2
    assert "expected three angles" in err


@pytest.mark.parametrize("still", [0.0, -3.0, 1e9, np.nan])
def test_a_rest_is_a_part_of_the_log(still):
    with pytest.raises(ValueError, match=r"^--still: expected a part of the log's 1 s, got "):
        flown(Recording(np.ones((10, 3)), None, 0.1, "rates"), "two-step-4", still=still)


def test_two_step_4_loses_in_a_fast_steady_turn_what_the_help_says():
    increments = np.tile([0.0, 0.0, np.radians(8)], (44, 1))  # 400 degrees per second, 50 Hz
    for name, lost in (("two-step-4", 4.5), ("rotation-vector-2", 0.0)):
        *_, sine, cosine = integrate(increments, name)[-1]
        short = 352 - np.degrees(2 * np.arctan2(sine, cosine))
        assert short / (44 / 50 / 3600) == pytest.approx(lost, abs=0.05)
