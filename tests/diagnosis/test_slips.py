"""Slips, piece by piece: other units, starts, axes and latitudes, and the filter that judges."""

from types import SimpleNamespace

import numpy as np
import pytest

from driftlab import diagnosis
from driftlab.calibration import FULL
from driftlab.calibration._filter_inputs import FilterInputs, evidence
from driftlab.calibration.calibration_history import BEYOND
from driftlab.diagnosis import (
    _ORDERS,
    _headed,
    _interval_slip,
    _Judge,
    _levelled,
    _other_starts,
    _rescaled,
    _turned,
)
from driftlab.earth import gravity
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.increments import Increments
from driftlab.motion.turntable import static_trajectory
from driftlab.quaternion import (
    conjugate,
    from_rotation_vector,
    multiply,
    rotate,
    to_matrix,
    to_rotation_vector,
)

LATITUDE = 0.7
UNTURNED = np.array([0.0, 0.0, 0.0, 1.0])
GRAVITY = float(gravity(LATITUDE))


def inputs(increments=None, latitude=LATITUDE, start=UNTURNED, prior=None, ends=None):
    """What a table that stands tells."""
    ends = np.zeros(1) if ends is None else ends
    prior = PriorStandardDeviations() if prior is None else prior
    still = np.zeros((len(ends), 3))
    return FilterInputs(
        increments, start, latitude, FULL, prior, ImuNoise(), reference=still, ends=ends
    )


# The judge


class LinearJudge(_Judge):
    """One whose filter has innovations that are linear in the latitude."""

    true, slope, rest = 0.5, np.array([[3.0, 0.0, 4.0]]), np.array([[0.8, 5.0, -0.6]])
    steps = (1e-3, 0.1)

    def _run(self, other, deviation, longest, loose=False):
        found = self.slope * (other.latitude - self.true) + self.rest
        return None, SimpleNamespace(innovations=found)


@pytest.mark.parametrize("latitude", [0.45, 0.5, 0.55])
def test_latitude_is_that_of_the_least_innovations(latitude):
    found, deviation = LinearJudge(inputs()).latitude(inputs(latitude=latitude))
    assert found == pytest.approx(0.5, abs=1e-9)
    assert deviation == pytest.approx(1 / 5)


def test_the_judge_adds_up_to_small_turns_and_measures_every_ten_seconds(monkeypatch):
    """A turn of 0.001 rad every 10 ms: a tenth of a second comes before a turn of 0.02 rad."""
    handed = []

    def calibrate(rows, reference, **_):
        handed.append((rows.interval, len(reference)))
        raise ValueError

    monkeypatch.setattr(diagnosis, "calibrate", calibrate)
    rows = np.full((8000, 3), [0.0, 0.0, 1e-3])
    judged = _Judge(inputs(Increments(0.01, rows, rows), ends=np.arange(200, 8001, 200)))
    assert judged.steps == (ImuNoise().reference_velocity, 0.1)
    assert handed == [(pytest.approx(0.1), 8)]


# Likely slips


def test_other_meanings_of_a_start_that_come_to_the_same_are_told_together():
    attitude = from_rotation_vector([0.3, -0.4, 1.0])
    found = dict(_other_starts(attitude))
    x, y, z, w = attitude
    np.testing.assert_allclose(found["start: scalar first"], [y, z, w, x])
    np.testing.assert_allclose(
        found["start: from East, North, Up to the body"], conjugate(attitude)
    )
    np.testing.assert_allclose(np.linalg.norm(list(found.values()), axis=-1), 1.0, rtol=1e-14)
    # North, East, Down and East, North, Up differ by a half turn, North, Up, East by a third.
    for name, columns in {"North, East, Down": [1, 0, 2], "North, Up, East": [2, 0, 1]}.items():
        other = to_matrix(found[f"start: body to {name}"])
        meant = to_matrix(attitude)[columns]
        if name.endswith("Down"):
            meant[2] *= -1
        np.testing.assert_allclose(other, meant, atol=1e-12)
    # A half turn is its own inverse, and so is what it becomes.
    half_turn = dict(_other_starts(np.array([1.0, 0.0, 0.0, 0.0])))
    assert list(half_turn) == [
        "start: scalar first, or scalar first, and from East, North, Up to the body",
        "start: body to North, East, Down",
        "start: body to North, Up, East",
    ]


@pytest.mark.parametrize("degrees", [-33.0, 11.5, 28.6, 179.0])
@pytest.mark.parametrize("tilt", [[0.0, 0.0, 0.0], [1.0, -0.5, 0.2]])
def test_a_start_is_levelled_and_headed_by_what_is_felt(tilt, degrees):
    true = from_rotation_vector(tilt)
    wrong = multiply(
        from_rotation_vector([0.2, -0.1, 0.0]), from_rotation_vector([0, 0, np.radians(degrees)])
    )
    seen = evidence(static_trajectory(true, LATITUDE, 1.0, 2000).increments)
    level = _levelled(multiply(wrong, true), seen)
    up_again = rotate(level, seen.force[0])
    np.testing.assert_allclose(up_again / np.linalg.norm(up_again), [0, 0, 1], atol=1e-12)
    start = _headed(inputs(start=level), seen)
    turn = to_rotation_vector(multiply(start, conjugate(true)))
    assert np.abs(turn[:2]).max() < 1e-3
    assert abs(turn[2]) <= np.radians(1.01)


@pytest.mark.parametrize(("scale", "bound"), [(0.0, 1e-4), (1e-3, BEYOND * 1e-3)])
@pytest.mark.parametrize("sense", [-1, 1])
def test_only_an_interval_that_gravity_contradicts_is_another_one(scale, bound, sense):
    angle, up = np.zeros((4, 3)), np.tile([0.0, 0.0, 0.1 * GRAVITY], (4, 1))

    def intervals(ratio):
        prior = PriorStandardDeviations(scale_factor=scale)
        tried = _rescaled(inputs(Increments(0.1, angle, ratio * up), prior=prior))
        return [other.interval for name, other in tried if name.startswith("interval")]

    assert intervals(1.0) == intervals(1 + 0.99 * sense * bound) == []
    assert intervals(0.0) == []  # of no force at all nothing is known
    assert intervals(1 + 1.01 * sense * bound) == pytest.approx([0.1 + 0.101 * sense * bound])


def test_orders_are_all_signed_permutations_but_none_at_all():
    names, matrices = zip(*_ORDERS, strict=True)
    assert len(set(names)) == len(matrices) == 47
    assert len({matrix.tobytes() for matrix in matrices}) == 47
    for name, matrix in _ORDERS:
        assert ("left-handed" in name) == (np.linalg.det(matrix) < 0)
        axes = dict(zip("xyz", np.eye(3), strict=True))
        words = name.split(" would be right")[0].split(", ")
        rows = [axes[word[-1]] * (-1 if word[0] == "-" else 1) for word in words]
        np.testing.assert_array_equal(matrix, rows)
        flipped = np.array_equal(matrix, np.diag([1, -1, -1]))
        assert ("forward, right, down" in name) == flipped


@pytest.mark.parametrize(
    ("interval", "ratio", "words"),
    [
        (10.0, 1.05e-3, "interval: milliseconds taken for seconds"),
        (1e4, 0.95e-6, "interval: microseconds taken for seconds"),
        (0.1, 2.0, "0.2 s instead of 0.1 s, by gravity, or accelerometers with that error of sca"),
        (0.1, 0.5, "0.05 s instead of 0.1 s, by gravity, or accelerometers with that error of s"),
        (0.1, 1 - 3.1e-7 * 2000, "by gravity, or a place 2000 m high"),
        (0.1, 1 - 3.1e-7 * 9100, "accelerometers with that error of scale"),
        (0.1, 1 + 1e-4, "accelerometers with that error of scale"),
    ],
)
def test_an_interval_that_gravity_contradicts_is_explained(interval, ratio, words):
    assert words in _interval_slip(interval, ratio)


@pytest.mark.parametrize(
    ("turn", "words"),
    [
        ([0.0, 0.0, -5.0], "a heading wrong by 5 degrees"),
        ([0.3, 0.3, 5.0], "a heading wrong by 5 degrees"),
        ([3.0, 0.0, 4.0], "an attitude wrong by 5 degrees"),
    ],
)
def test_a_wrong_start_is_one_of_heading_where_it_hardly_tilts(turn, words):
    assert _turned(np.array(turn)) == f"start: {words}"
