"""Slips on purpose are named.

Each is made on one of three schemes, with a reference velocity that has noise or at a table that
stands; all 156 combinations were tried once. Three of four are for ``lab.py test --long``; the
pieces of which all are made have tests of their own, in `test_slips`.
"""

import re
import warnings

import numpy as np
import pytest
from scipy.constants import g

from driftlab.calibration import InconsistentCalibrationWarning, calibrate
from driftlab.calibration.filter import FilterFailure
from driftlab.diagnosis import diagnose
from driftlab.increments import Increments
from driftlab.quaternion import conjugate, from_rotation_vector, multiply
from table_records import LATITUDE, RECORDS, STEP, inputs


def scaled(angle=1.0, velocity=1.0, interval=1.0):
    return lambda run: (
        run
        | {
            "increments": Increments(
                run["increments"].interval * interval,
                run["increments"].angle * angle,
                run["increments"].velocity * velocity,
            )
        }
    )


def turned(angle, velocity):
    """Axes of the log in some order and with some signs: matrices or diagonals."""
    a, v = (np.diag(m) if np.ndim(m) == 1 else np.asarray(m, float) for m in (angle, velocity))
    return lambda run: (
        run
        | {
            "increments": Increments(
                STEP, run["increments"].angle @ a.T, run["increments"].velocity @ v.T
            )
        }
    )


def started(change):
    return lambda run: run | {"start": change(run["start"])}


def turned_about(axis, degrees):
    turn = from_rotation_vector(np.radians(degrees) * np.eye(3)[axis])
    return started(lambda start: multiply(turn, start))


NED = np.array([1.0, 1.0, 0.0, 0.0]) / np.sqrt(2)
FRD, SAME = [1, -1, -1], [1, 1, 1]
SWAPPED = np.eye(3)[[1, 0, 2]]
SLIPS = {
    "rates and forces": (
        scaled(1 / STEP, 1 / STEP),
        "rates taken for increments and .*specific force taken for increments",
    ),
    "rates alone": (scaled(1 / STEP), "gyros: rates taken for increments"),
    "degrees": (scaled(180 / np.pi), "gyros: degrees taken for radians"),
    "rates in degrees, forces": (
        scaled(180 / np.pi / STEP, 1 / STEP),
        "rates in degrees .* and accelerometers: specific force taken",
    ),
    "m/s^2 for m/s": (scaled(1, 1 / STEP), "accelerometers: specific force taken"),
    "g": (scaled(1, 1 / STEP / g), "specific force in g taken"),
    "mg": (scaled(1, 1000 / STEP / g), "specific force in mg taken"),
    "g s for m/s": (scaled(1, 1 / g), r"g\*s taken for m/s"),
    "exchanged": (
        lambda run: (
            run
            | {
                "increments": run["increments"]._replace(
                    angle=run["increments"].velocity, velocity=run["increments"].angle
                )
            }
        ),
        "gyros and accelerometers exchanged",
    ),
    "FRD": (turned(FRD, FRD), "x, -y, -z would be right"),
    "left-handed": (turned(SWAPPED, SWAPPED), "y, x, z would be right .left-handed"),
    "gyros with the other sign": (turned([-1, -1, -1], SAME), "gyros alone: -x, -y, -z"),
    "one gyro with the other sign": (turned([1, 1, -1], SAME), "gyros alone: x, y, -z"),
    "gravity for specific force": (turned(SAME, [-1, -1, -1]), "accelerometers alone: -x, -y"),
    "scalar first": (started(lambda q: np.roll(q, 1)), "scalar first"),
    "inverted": (started(conjugate), "from East, North, Up to the body"),
    "North, East, Down": (started(lambda q: multiply(conjugate(NED), q)), "North, East, Down"),
    "North, Up, East": (
        started(lambda q: multiply(conjugate(np.full(4, 0.5)), q)),
        "North, Up, East",
    ),
    "heading by 5 degrees": (turned_about(2, 5.0), "heading wrong by (4.9|5)"),
    "heading by 90 degrees": (
        turned_about(2, -90.0),
        "heading wrong by (89.9|90)|z, -x|-z, y|z, x",
    ),
    "tilt by 5 degrees": (turned_about(0, 5.0), "an attitude wrong by (4.9|5)"),
    "latitude's sign": (lambda run: run | {"latitude": -LATITUDE}, "latitude: the other sign"),
    "latitude too small": (
        lambda run: run | {"latitude": np.radians(LATITUDE)},
        "turned into radians twice",
    ),
    "another place": (lambda run: run | {"latitude": 0.9}, "latitude: 3[678].* degrees fits"),
    "interval by 1 %": (scaled(interval=1.01), r"interval: 0\.75 s instead of 0\.7575 s"),
    "interval twice": (scaled(interval=2.0), r"interval: 0\.75 s instead of 1\.5 s"),
}
NAMES = list(RECORDS)


def calibrated(run):
    """What the filter found, or how it failed."""
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore", InconsistentCalibrationWarning)
        try:
            return calibrate(**run)
        except FilterFailure as failure:
            return failure


@pytest.mark.parametrize(
    ("slip", "place"),
    [
        pytest.param(slip, k, marks=pytest.mark.long if k % 4 else pytest.mark.slow)
        for k, slip in enumerate(SLIPS)
    ],
)
def test_slip_is_named(slip, place):
    change, words = SLIPS[slip]
    run = inputs(NAMES[place % 3], noisy=place % 2 == 0)
    sentence = str(diagnose(calibrated(change(run))))
    assert re.search(words, sentence), sentence
    assert re.match(r"expected .* (to|within) \S+.*, got \S+[:;.] ", sentence)


@pytest.mark.parametrize("slip", ["rates alone", "degrees"])  # a result, and a failure
def test_arrays_that_change_afterwards_change_no_diagnosis(slip):
    run = SLIPS[slip][0](inputs())
    found = calibrated(run)
    before = diagnose(found)
    run["increments"].angle[:] = 0.0
    assert diagnose(found) == before


def test_no_second_pass_is_advised_for_errors_that_a_slip_makes():
    with pytest.warns(InconsistentCalibrationWarning, match="accelerometer scale x: found") as said:
        calibrate(**scaled(interval=1.01)(inputs()))
    assert "over the record again" not in str(said[0].message)
