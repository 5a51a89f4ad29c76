"""Records compute in double precision and in whole numbers of Python, whatever kind came."""

import copy
import dataclasses
import inspect
import pickle

import numpy as np
import pytest

from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS, Algorithm
from driftlab.attitude.functional_iteration import FunctionalIteration
from driftlab.calibration.matrix_conventions import NominalReadings
from driftlab.calibration.scheme_design import DesignTask
from driftlab.calibration.simulation import TurntableTrial
from driftlab.drift.turn_calibration import TurnExperiment
from driftlab.gyrocompass.noise import GyroNoise
from driftlab.gyrocompass.type_test import Gyrocompass
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.motion import Coning, FixedAxis, Scheme, Sway, TurntableRotation
from driftlab.noise_terms import NoiseTerms
from driftlab.recordings import Layout, Recording
from support import helper_modules

TOLD = {
    Algorithm: {
        **{"name": "plain", "samples": 2, "memory": 0, "order": 2},
        **{"coning": {}, "last_stage": "tangent"},
    },
    Coning: {"half_angle": 0.25, "frequency": 0.5},
    Sway: {"amplitude": 0.25, "frequency": 0.5},
    FixedAxis: {"amplitude": 0.25, "frequency": 0.5, "axis": (1, 2, 2)},
    TurntableRotation: {"rate": 0.5, "latitude": 0.75},
    Scheme: {"rotations": "+90X"},
    Recording: {
        **{"gyro": np.zeros((2, 3)), "accelerometer": None, "interval": 0.5, "kind": "rates"},
        **{"latitude": 0.75, "gravity": 9.8125},
    },
    Layout: {"gyro": (1, 2, 3), "rate": 0.5, "latitude": 0.75, "gravity": 9.8125},
    FunctionalIteration: {"name": "mine", "window": 4, "iterations": 2},
    TurntableTrial: {"sample_interval": 0.0625},
    **{kind: {} for kind in (DesignTask, TurnExperiment, GyroNoise, Gyrocompass)},
    **{kind: {} for kind in (ImuNoise, NominalReadings, PriorStandardDeviations, NoiseTerms)},
}
"""What has no default, in numbers that single precision has exactly."""


def narrow(value: object) -> object:
    """The same number in a kind that is too narrow to compute in."""
    if isinstance(value, bool):
        return np.bool_(value)
    if isinstance(value, int):
        return np.int8(value) if value < 128 else np.int16(value)
    if isinstance(value, float):
        return np.float32(value)
    if isinstance(value, tuple) and value and all(isinstance(v, int | float) for v in value):
        return np.array(value, np.float32)
    return value


def numbers_in(value: object) -> list[object]:
    if isinstance(value, tuple | list):
        return [number for each in value for number in numbers_in(each)]
    return [value] if isinstance(value, int | float | np.generic | np.ndarray) else []


def test_all_records_of_numbers_are_asked():
    found = {
        kind
        for module in helper_modules()
        for _, kind in inspect.getmembers(module, inspect.isclass)
        if kind.__module__ == module.__name__
        and dataclasses.is_dataclass(kind)
        and "__post_init__" in vars(kind)
    }
    assert found == set(TOLD)


@pytest.mark.parametrize("kind", TOLD, ids=lambda kind: kind.__name__)
def test_a_record_holds_plain_numbers_of_the_same_value(kind):
    plain = kind(**TOLD[kind])
    fields = {field.name: getattr(plain, field.name) for field in dataclasses.fields(kind)}
    told = {
        name: narrow(value)
        for name, value in fields.items()
        if name not in ("gyro", "coning", "starts", "angles", "start")
    }
    rest = {name: value for name, value in fields.items() if name not in told}
    held = kind(**told, **rest)
    for name in told:
        for number in numbers_in(getattr(held, name)):
            assert type(number) in (int, float, bool), (name, number)
    for name, value in told.items():
        if not (value is None or dataclasses.is_dataclass(value)):
            np.testing.assert_array_equal(getattr(held, name), value, err_msg=name)


def test_three_hundred_steps_are_three_hundred():
    narrowed = TurnExperiment(np.int8(3), np.int8(100))
    assert narrowed == TurnExperiment(3, 100)
    perfect = narrowed.error_quaternion([0.0, 0.0, 1.0], np.zeros((3, 3)))
    np.testing.assert_allclose(np.abs(perfect), [0, 0, 0, 1], atol=1e-12)


def test_a_motion_of_single_numbers_is_the_motion_of_their_values():
    half_angle, frequency = np.float32(0.3), np.float32(0.7)
    plain = Coning(float(half_angle), float(frequency))
    np.testing.assert_array_equal(Coning(half_angle, frequency).attitude(1e3), plain.attitude(1e3))


def test_a_motion_does_not_follow_an_array_that_changes():
    axis = np.array([0.0, 0.0, 1.0])
    motion = FixedAxis(0.3, 1.0, axis)
    axis[0] = 5.0
    assert motion == FixedAxis(0.3, 1.0, (0.0, 0.0, 1.0))
    assert hash(motion) == hash(FixedAxis(0.3, 1.0, (0.0, 0.0, 1.0)))


def test_nobody_changes_the_weights_of_an_algorithm():
    weights = {(np.int8(0), np.int8(1)): np.float32(0.5)}
    mine = Algorithm("mine", 2, 0, weights, "tangent", 4, ())
    weights[0, 1] = 9.0
    assert dict(mine.coning) == {(0, 1): 0.5}
    assert {type(part) for pair in mine.coning for part in pair} == {int}
    for each in (mine, CONING_ALGORITHMS["memory-4"]):
        with pytest.raises(TypeError, match="does not support item assignment"):
            each.coning[0, 1] = 5.0
        for copied in (pickle.loads(pickle.dumps(each)), copy.deepcopy(each)):
            assert copied == each
            assert hash(copied) == hash(each)
    assert mine != dataclasses.replace(mine, coning={(0, 1): 0.6})


def test_nobody_changes_the_rows_of_a_recording_through_it():
    rows = np.zeros((3, 3))
    record = Recording(gyro=rows, accelerometer=rows, interval=0.1, kind="rates")
    for held in (record.gyro, record.accelerometer, record.part(0, 2).gyro):
        with pytest.raises(ValueError, match="read-only"):
            held[0] = 1.0
    assert np.shares_memory(record.gyro, rows)  # a long log is not copied
    rows[0] = 1.0  # what the caller has stays the caller's
