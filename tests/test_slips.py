"""Natural slips at every public door: each gets one sentence that names the argument.

The valid calls are those of `doors`, which are made again with one argument put wrong.
"""

import datetime
import inspect
import re
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import driftlab as dl
from doors import CORES, Door, doors
from driftlab.calibration import ERROR_MODELS, TurntableTrial, linearize_along
from driftlab.checks import UnusualWarning
from driftlab.drift import PAIR_AXES
from driftlab.gyrocompass import Gains
from driftlab.imu import NO_ERRORS, TYPICAL_ERRORS, ImuNoise, PriorStandardDeviations
from driftlab.increments import Increments, measure
from driftlab.motion import (
    NINETEEN_POSITIONS,
    Coning,
    Scheme,
    TurntableRotation,
    turntable_trajectory,
)
from driftlab.recordings import Recording
from support import helper_modules

# Words that are only shown, and what is looked at where it is used.
LET_THROUGH = {
    "Layout.time",  # of what columns there are only a table can say
    *(
        "integrate.history",
        "step_quaternions.history",
        "step_rotation_vectors.history",
    ),  # not always used
    "convert_attitude_error.true_attitude",
    *("Algorithm.name", "Algorithm.order", "FunctionalIteration.name", "Recording.longest_gap"),
}
MAY_BE_EMPTY = ("static_intervals", "axes")


class Anything:
    """An object of no kind that is known here."""


OBJECTS = {
    "an object": Anything(),
    "a dict": {"a": 1.0},
    "a date": datetime.datetime(2026, 1, 1),
    "a class": Scheme,
    "a complex number": 1 + 2j,
    "noise": ImuNoise(),
    "errors": NO_ERRORS,
}
NOTHING = {"nothing": None}
NUMBERS = {"text": "1.5", "NaN": np.nan, "a row": [1.0, 2.0], "a truth value": True}
COUNTS = {"text": "3", "NaN": np.nan, "a half": 2.5, "a row": [1, 2]}
FLAGS = {"text": "yes", "one": 1, "an array": np.eye(3)}
NAMES = {"a number": 3, "an unknown name": "no such name", "a path": Path("a/b")}
ARRAYS = {
    "text": "no such name",
    "texts": ["1", "2", "3"],
    "ragged": [[1.0, 2.0], [3.0]],
    "empty": np.zeros((0, 3)),
    "NaN": np.full((3, 3), np.nan),
    "truth values": np.eye(3) > 0,
    "a function": np.sin,
}
THINGS = {"an unknown name": "no such name", "an array": np.eye(3), "a number": 1.0, "a list": [1]}
FREE_TEXT = ("name", "source", "licence", "path", "accelerometer_path", "gyro_path", "text")


def slips(name: str, kind: str) -> dict[str, Any]:
    """Wrong values for an argument that is annotated so."""
    parts = {part.strip() for part in kind.split("|")}
    wrong = dict(OBJECTS) | ({} if "None" in parts or name == "axes" else NOTHING)
    if "ImuNoise" in parts:
        del wrong["noise"]
    if "ImuErrors" in parts:
        del wrong["errors"]
    if "bool" in parts:
        return wrong | FLAGS
    if "int" in parts:
        return wrong | COUNTS
    if "float" in parts:
        return wrong | NUMBERS
    if "ArrayLike" in parts:
        arrays = {
            key: value
            for key, value in ARRAYS.items()
            if name not in MAY_BE_EMPTY or key != "empty"
        }
        return wrong | arrays
    if "Path" in parts:
        return wrong | {"a number": 3, "a list": ["a.csv"]}
    if "str" in parts and len(parts - {"None"}) == 1:
        more = dict(NAMES)
        if name in FREE_TEXT:
            del more["an unknown name"], more["a path"]
        return wrong | more
    if "np.random.Generator" in parts:
        return wrong | THINGS
    if any(word in kind for word in ("Callable", "Task", "Columns", "Sequence", "DTypeLike")):
        return {key: wrong[key] for key in ("an object", "a date", "a complex number")}
    return wrong | THINGS


def complaint(door: Door, name: str, wrong: Any) -> str:
    """What is wrong with the answer to a slip; nothing if it is one good sentence."""
    names = "|".join(sorted(door.names()))
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            door.call(**(door.arguments | {name: wrong}))
    except (ValueError, TypeError) as refusal:
        text = str(refusal)
        if not re.fullmatch(rf"({names})\b[\w., ]*: expected [^\n]*[.?)]", text):
            return f"{type(refusal).__name__}: {text!r:.150}"
        return ""
    except Exception as other:
        return f"{type(other).__name__}: {str(other)!r:.120}"
    return "accepted"


@pytest.mark.parametrize("module", helper_modules(), ids=lambda module: module.__name__[9:])
def test_a_slip_gets_one_sentence_that_names_the_argument(module):
    complaints = []
    for door in doors(module):
        if door.name in CORES:
            continue
        for name, parameter in inspect.signature(door.call).parameters.items():
            full = f"{door.name}.{name}"
            kind = str(parameter.annotation)
            if (
                full in LET_THROUGH
                or "FloatArray" in kind
                or parameter.kind in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD)
            ):
                continue
            for what, wrong in slips(name, kind).items():
                if text := complaint(door, name, wrong):
                    complaints.append(f"{full} ({kind}) given {what}: {text}")
    assert not complaints, "\n".join(complaints)


def test_every_function_at_the_doors_has_a_call():
    """Without one it would not be tested above."""
    found, offered = set(), set()
    for module in helper_modules():
        found |= {door.name for door in doors(module)}
        for name, thing in vars(module).items():
            if inspect.isfunction(thing) and thing.__module__ == module.__name__:
                offered.add(name)
    uncalled = {name for name in offered - found if not name.startswith(("_", "checked_"))}
    assert uncalled <= {"published"}  # which asks the network
    assert {"Scheme", "ImuNoise", "TurntableRotation", "DesignTask", "Increments.part"} <= found


LATITUDE = np.radians(59.9)
SCHEME = Scheme("+90X -90X", dwell=10.0)
TRUE = turntable_trajectory(SCHEME, LATITUDE, 0.5)
LOG = Recording(TRUE.increments.angle, TRUE.increments.velocity, 0.5, "increments")
BENT = np.array([[0, 2e-3, 0], [0, 0, 0], [0, 0, 0]])
CALIBRATE = {
    "latitude": LATITUDE,
    "start": SCHEME.start_attitude,
    "model": ERROR_MODELS["averaged"],
    "prior": PriorStandardDeviations(),
    "noise": ImuNoise(reference_velocity=1e-5),
    "update_interval": 10.0,
}


def calibrate(**changes):
    return dl.calibrate(TRUE.increments, **(CALIBRATE | changes))


@pytest.mark.parametrize(
    ("slip", "sentence"),
    [
        (lambda: calibrate(model="average"), "model: expected an ErrorModel or the name of one"),
        (lambda: calibrate(latitude=59.9), r"latitude: .* in degrees\? np\.radians\(59\.9\)"),
        (lambda: TurntableTrial("+90X"), r"scheme: expected a Scheme such as .* got '\+90X'"),
        (lambda: TurntableTrial(states=["levers"]), "states: expected some of lever arms,"),
        (
            lambda: dl.calibration.unobservable_subspace(SCHEME),
            r"linearized: expected what linearize_along\(scheme, latitude\) returns, got a Scheme",
        ),
        (
            lambda: dl.calibration.covariance_analysis(
                SCHEME, ImuNoise(), PriorStandardDeviations()
            ),
            r"linearized: expected what linearize_along\(scheme, latitude\) returns, got a Scheme",
        ),
        (lambda: measure(TRUE.increments.angle, NO_ERRORS), "increments: .* got an array of shape"),
        (
            lambda: measure(TRUE.increments, TYPICAL_ERRORS._replace(gyro_bias=[10, 20, 30])),
            r"gyro_bias: expected rad/s, at most 10 in size, got 30: is it in deg/h\?",
        ),
        (lambda: dl.drift_per_revolution(BENT, [1, 1, 0]), "error_matrix: expected shape"),
        (
            lambda: dl.drift_per_revolution([1, 1, 0], np.eye(3) + BENT),
            r"error_matrix: .* is it the whole matrix I \+ M\? Subtract the identity",
        ),
        (lambda: Scheme("+90X", rate=10), r"rate: expected rad/s, .* degrees\? np\.radians\(10\)"),
        (
            lambda: TurntableRotation(rate=360),
            r"rate: expected rad/s, .* degrees\? np\.radians\(360\)",
        ),
        (lambda: Coning(10, 5.0), "half_angle: .* in degrees"),
        (
            lambda: dl.gyrocompass.level_loop(Gains(1e-3, 1e-6), gravity=1.0),
            r"gravity: expected m/s\^2, 1.2 to 50, got 1: is it in g\?",
        ),
        (
            lambda: dl.gyrocompass.level_loop(Gains(1e-3, 1e-6), gravity=5e-3),
            r"gravity: expected m/s\^2, 1.2 to 50, got 0\.005\.$",
        ),
        (lambda: dl.integrate(LOG), "increments: .* got a Recording: .* angles"),
        (lambda: dl.integrate(TRUE.increments), "increments: .* got an Increments: .* angle,"),
        (lambda: dl.align(LOG, LOG), "angular_rate: .* got a Recording: .* gyro"),
        (
            lambda: dl.compensate(LOG, NO_ERRORS),
            r"increments: .* got a Recording: hand in its increments\(\)",
        ),
        (
            lambda: dl.compensate(TRUE.increments, dl.drift.fit_turns(np.ones(3), PAIR_AXES)),
            r"imu_errors: .* got a TurnFit\.",
        ),
        (
            lambda: dl.allan_deviation(np.ones((200, 3)), 0.01),
            r"samples: .* got \(200, 3\): .* samples\.T",
        ),
        (lambda: Increments(1.0, np.eye(3), np.eye(3)).part(0.5, 2), "begin: expected a whole"),
        (
            lambda: dl.attitude.integrate_riccati(lambda time: np.ones(3), [0, 1], tolerance=1e-20),
            r"tolerance: expected at least 2\.2e-14, got 1e-20",
        ),
        (
            lambda: dl.calibration.kalman.nees([1.0, 1.0], np.ones((2, 2))),
            "covariance: expected one with an inverse where variances are not zero",
        ),
        (
            lambda: dl.calibration.NominalReadings(accelerometer_scale_factor=[1, 0, 1]),
            "accelerometer_scale_factor: expected numbers above 0, got 0",
        ),
        (
            lambda: dl.drift.hand_turns(np.full((90, 3), 90.0), 0.1, [[0, 20], [40, 60]]),
            "increments: expected rad, at most 6.283 in size, got 90: is it in degrees",
        ),
        (
            lambda: dl.drift.hand_turns(
                np.zeros((90, 3)), 0.1, np.ma.array([[0, 20], [40, 60]], mask=[[0, 0], [0, 1]])
            ),
            r"static_intervals: expected whole numbers of shape \(m, 2\), got",
        ),
        (
            lambda: dl.gyrocompass.marine_type_test(dl.gyrocompass.Gyrocompass(), 0.9, speed=140.0),
            r"speed: expected m/s, at most 100, got 140\.0: is it in knots",
        ),
        (lambda: LOG.between(1e44, 1e45), "begin, end: expected times of the record"),
        (
            lambda: Recording(np.eye(3), None, 0.1, "rates", longest_gap=0.5),
            "longest_gap: expected a number of usual intervals, at least 1, got 0.5",
        ),
        (
            lambda: turntable_trajectory(SCHEME, LATITUDE, 1e-20),
            "interval: expected at most 2147483647 samples of 10 s, got 1e-20 s",
        ),
        (
            lambda: dl.drift.earth_rate_offset(0.9, [1e-300, 1.0]),
            "table_rate: expected rates of at least 1e-50 in size, got 1e-300",
        ),
        (
            lambda: dl.gyrocompass.GyroNoise().allan_deviation(1e-60),
            "averaging_times: expected numbers of at least 1e-50, got 1e-60",
        ),
        (
            lambda: dl.align([1, 2, 3], [0, 1e60, 0]),
            r"specific_force: expected numbers of at most 1e\+50 in size, got 1e\+60",
        ),
    ],
)
def test_named_slip_is_told_what_would_be_right(slip, sentence):
    with pytest.raises(ValueError, match=f"^{sentence}"):
        slip()


@pytest.mark.parametrize(
    ("unusual", "words"),
    [
        (lambda: TurntableRotation(rate=10), r"^rate: 10 rad/s is 573 degrees a second"),
        (lambda: ImuNoise(angle_random_walk=0.003), r"^angle_random_walk: .*np\.radians\(0\.003\)"),
        (lambda: PriorStandardDeviations(installation=40), "^installation: .* arc seconds"),
        (
            lambda: dl.gyrocompass.alignment_standard_deviation(0.9, 60.0, 0.003),
            "^angle_random_walk: .* deg/√h",
        ),
        (
            lambda: dl.fit_turns(np.ones(3), PAIR_AXES, table_rates=[10, -10, 10]),
            r"^table_rates: 10 rad/s is 573 degrees a second",
        ),
        (lambda: dl.triad.split_error_matrix(np.eye(3) + BENT), r"^matrix: .* I \+ M\?"),
        (
            lambda: dl.integrate(np.full((4, 3), 20.0), "rotation-vector-2"),
            "^increments: 20 rad between two samples .* np.radians",
        ),
        (
            lambda: dl.drift_per_revolution([1, 1, 0], 1e3 * BENT),
            "^error_matrix: an entry is 2, .* mrad",
        ),
        (
            lambda: measure(
                TRUE.increments, NO_ERRORS._replace(gyro_error_matrix=np.eye(3) + BENT)
            ),
            r"^gyro_error_matrix: .* is it the whole matrix I \+ M\? If so, subtract the identity",
        ),
        (
            lambda: dl.triad.measured_rate([1, 0, 0], np.diag([1, 1, 0.75])),
            r"^error_matrix: .* is it the whole matrix I \+ M\? If so",
        ),
        (
            lambda: measure(TRUE.increments, NO_ERRORS._replace(gyro_bias=[0, -1.3, 0])),
            r"^gyro_bias: -1\.3 rad/s is much: is it in deg/h\?",
        ),
        (
            lambda: measure(TRUE.increments, NO_ERRORS._replace(accelerometer_bias=[0, 20, 0])),
            r"^accelerometer_bias: 20 m/s\^2 is much: is it in mg\?",
        ),
        (
            lambda: dl.gyrocompass.level_loop(Gains(1e-3, 1e-6), gravity=32.2),
            r"^gravity: 32\.2 m/s\^2 is that of the Earth in ft/s\^2",
        ),
        (lambda: TurntableRotation(rate=np.radians(6000)), r"^rate: .* is 6000 degrees a second"),
        (lambda: dl.drift.drift_coefficient([1, 1, 0], np.eye(3)), r"^error_matrix: .* I \+ M\?"),
        (lambda: dl.frames.from_euler_angles(90, 0, 0), r"^heading: 90 rad is 14\.3 turns"),
        (lambda: dl.turn_estimate([1.0, 0, 0, 1e-3], [1, 0, 0]), r"^error_quaternion: .* last"),
        (
            lambda: dl.alignment_errors(0, 0, 0.7, [0.01, 0, 0], np.zeros(3)),
            r"^gyro_bias_nue: 0\.01 rad/s is much: .* np\.radians\(x\) / 3600",
        ),
        (
            lambda: dl.operating_heading_error(
                0.7, *[[0, 0]] * 3, [0.01, 0], yaw_error=0, heading=0, pitch=0
            ),
            r"^gyro_bias_north_east: 0\.01 rad/s is much",
        ),
    ],
)
def test_what_is_only_unusual_is_warned_of(unusual, words):
    with pytest.warns(UnusualWarning, match=words):
        unusual()


def test_what_some_sensor_or_place_has_is_let_through():
    measure(TRUE.increments, NO_ERRORS._replace(gyro_bias=np.radians([0, 55, 0])))  # filter: error
    measure(TRUE.increments, NO_ERRORS._replace(accelerometer_bias=[0, 2.5, 0]))
    dl.gyrocompass.level_loop(Gains(1e-3, 1e-6), gravity=1.62)  # on the Moon


def test_a_name_stands_for_an_object_wherever_there_is_a_table_of_them():
    by_name = linearize_along("19 positions", LATITUDE, "averaged")
    own = linearize_along(NINETEEN_POSITIONS, LATITUDE, ERROR_MODELS["averaged"])
    np.testing.assert_array_equal(by_name.transitions, own.transitions)
    assert TurntableTrial("19 positions") == TurntableTrial(NINETEEN_POSITIONS)
    task = dl.calibration.DesignTask(model="averaged")
    assert task.model is ERROR_MODELS["averaged"]
    assert TurntableTrial(states="lever arms").states == ("lever arms",)
