"""Whole turns of a rate table on the Earth: closed forms, an independent integration, refusals."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given, strategies as st
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from driftlab.attitude.integration import integrate
from driftlab.earth import EARTH_RATE, earth_rate, gravity
from driftlab.motion.turntable_rotation import TurntableRotation
from support import EPS, directions

LATITUDE = np.radians(51.5)
TEN = np.radians(10.0)
SLANTED = TurntableRotation(
    -TEN, latitude=LATITUDE, table_axis=(0.1, -0.2, 0.9), angle_error=1e-3, ramp=3.0, dwell=2.5
)


def test_increments_about_the_vertical_in_closed_form():
    """Along the axis both rates; across it what the integral of a cosine and a sine gives."""
    turn = TurntableRotation(TEN, turns=2, latitude=LATITUDE)
    found = turn.increments([0, 0, 3], 100)
    assert found.interval == pytest.approx(0.72, rel=4 * EPS)
    angles = TEN * found.interval * np.arange(101)
    level = EARTH_RATE * np.cos(LATITUDE) / TEN
    upward = (TEN + EARTH_RATE * np.sin(LATITUDE)) * found.interval
    expected = [-level * np.diff(np.cos(angles)), level * np.diff(np.sin(angles))]
    np.testing.assert_allclose(found.angle[:, :2].T, expected, rtol=0, atol=4 * EPS)
    np.testing.assert_allclose(found.angle[:, 2], upward, rtol=0, atol=64 * EPS)
    np.testing.assert_allclose(
        found.velocity, np.tile([0, 0, gravity(LATITUDE) * 0.72], (100, 1)), rtol=1e-13, atol=1e-14
    )


@pytest.mark.parametrize("axis", [(1, 1, 0), (1, -2, 0.5)])
def test_increments_are_integrals_of_an_independent_motion(axis):
    """The attitude by solve_ivp from the rate, the rates of Earth and plumb line through it."""
    n = np.array(axis) / np.linalg.norm(axis)
    a = np.array(SLANTED.table_axis) / np.linalg.norm(SLANTED.table_axis)
    first, _ = Rotation.align_vectors([a, np.cross(a, n)], [n, np.cross(a, n)])
    until = (2 * np.pi + 1e-3) / TEN
    up = np.array([0, 0, gravity(LATITUDE)])

    def rate(t):
        return -TEN * np.interp(t, [0, 3, until, until + 3], [0, 1, 1, 0])

    def sensed(t, state):
        body = Rotation.from_quat(state[:4]).inv()
        x, y, z, w = state[:4]
        rows = np.array([[w, -z, y], [z, w, -x], [-y, x, w], [-x, -y, -z]])
        against_inertial = rate(t) * n + body.apply(earth_rate(LATITUDE))
        return np.concatenate([0.5 * rows @ (rate(t) * n), against_inertial, body.apply(up)])

    found = SLANTED.increments(axis, 12)
    times = np.linspace(0, until + 5.5, 13)
    assert SLANTED.duration == pytest.approx(times[-1], rel=4 * EPS)
    # From place to place, so that no step goes over a corner of the rate, where its error, up to
    # 1e-9, would hang on where the steps happen to lie.
    places = np.unique([*times, 3, until, until + 3])
    path = [np.concatenate([first.as_quat(), np.zeros(6)])]
    for span in pairwise(places):
        path.append(solve_ivp(sensed, span, path[-1], "DOP853", rtol=1e-12, atol=1e-14).y[:, -1])
    ends = np.array(path)[np.isin(places, times)]
    # The solver's 1e-12 of the largest integrals, a turn and g for 42 s.
    largest = np.abs(ends).max(axis=0)
    np.testing.assert_allclose(
        np.diff(ends[:, 4:7], axis=0), found.angle, rtol=0, atol=1e-12 * largest[4:7].max()
    )
    np.testing.assert_allclose(
        np.diff(ends[:, 7:], axis=0), found.velocity, rtol=0, atol=1e-12 * largest[7:].max()
    )


@pytest.mark.parametrize("axis", [(1, 1, 0), (0, 0, -1), (1, -2, 0.5)])
def test_a_perfect_triad_shows_the_rotation_of_the_earth(axis):
    """In inertial space the table has brought the body back to where the Earth has gone."""
    turn = TurntableRotation(TEN, latitude=LATITUDE)
    shown = integrate(turn.increments(axis, 3600).angle, "rotation-vector-2")[-1]
    n = np.array(axis) / np.linalg.norm(axis)
    size = EARTH_RATE * turn.duration
    vector = Rotation.from_quat(shown * np.sign(shown[3])).as_rotvec()
    # The algorithm's own error: measured 1e-12, three hundred thousand times less than the Earth.
    assert np.linalg.norm(vector) == pytest.approx(size, rel=1e-7)
    assert vector @ n == pytest.approx(size * np.sin(LATITUDE), rel=1e-7)


@example(n=np.array([0.0, 0.0, 1.0]), ramp=5e-324, dwell=0.0, sense=1)  # no angle, but a time
@given(
    n=directions(), ramp=st.floats(0, 30), dwell=st.floats(0, 30), sense=st.sampled_from([1, -1])
)
def test_along_the_axis_only_angle_and_time_count(n, ramp, dwell, sense):
    turn = TurntableRotation(sense * TEN, 1, LATITUDE, angle_error=0.01, ramp=ramp, dwell=dwell)
    n = n / np.linalg.norm(n)
    felt = (turn.increments(n, 37).angle @ n).sum()
    expected = sense * (2 * np.pi + 0.01) + earth_rate(LATITUDE)[2] * turn.duration
    assert felt == pytest.approx(expected, abs=200 * EPS)
    assert turn.duration == pytest.approx((2 * np.pi + 0.01) / TEN + ramp + dwell, rel=4 * EPS)
    assert turn.mean_rate == pytest.approx(sense * 2 * np.pi / turn.duration, rel=4 * EPS)


@pytest.mark.parametrize(
    ("settings", "samples"),
    [
        ({"rate": 0.2, "dwell": 300.0}, 8),
        ({"rate": -1.0, "turns": 10, "dwell": 3600.0}, 80),
        ({"rate": 0.2, "turns": 10, "ramp": 30.0, "dwell": 100.0, "angle_error": 3.0}, 80),
    ],
)
def test_a_long_sample_is_the_sum_of_short_ones(settings, samples):
    """A sample may hold several turns, for the rests count as well."""
    turn = TurntableRotation(latitude=0.7, table_axis=(0.0, 1.0, 0.2), **settings)
    coarse = turn.increments([1, 2, 3], samples)
    fine = turn.increments([1, 2, 3], 64 * samples)
    for long, short in ((coarse.angle, fine.angle), (coarse.velocity, fine.velocity)):
        summed = short.reshape(samples, 64, 3).sum(axis=1)
        bound = 64 * EPS * np.abs(short).sum() / samples
        np.testing.assert_allclose(long, summed, rtol=0, atol=max(bound, 1e-12))


def test_the_longest_piece_of_a_turn_is_exact_to_rounding():
    """A sample in which the table turns by 4/pi: from the vertical, what the integrals give."""
    angle = 4 / np.pi
    turn = TurntableRotation(TEN, latitude=LATITUDE, dwell=(8 * angle - 2 * np.pi) / TEN)
    found = turn.increments([0, 0, 1], 8).angle[0]
    assert turn.duration / 8 * TEN == pytest.approx(angle)
    level = earth_rate(LATITUDE)[1] / TEN
    expected = level * np.array([1 - np.cos(angle), np.sin(angle)])
    np.testing.assert_allclose(found[:2], expected, rtol=0, atol=4 * EPS * level)


def test_without_the_earth_there_is_the_turn_alone():
    found = TurntableRotation(-TEN, turns=3).increments([[0, 3, 4], [1, 0, 0]], 60)
    expected = -6 * np.pi / 60 * np.array([[0, 0.6, 0.8], [1, 0, 0]])
    np.testing.assert_allclose(
        found.angle, np.repeat(expected[:, None], 60, axis=1), rtol=0, atol=64 * EPS
    )
    assert not found.velocity.any()


def test_the_other_sense_is_the_same_motion_backwards():
    n = np.array([1, 2, 2]) / 3

    def of_the_earth(sense):
        turn = TurntableRotation(sense * TEN, latitude=LATITUDE, ramp=4.0)
        table = np.diff(turn.angle(np.linspace(0, turn.duration, 51)))
        return turn.increments(n, 50).angle - table[:, np.newaxis] * n

    np.testing.assert_allclose(of_the_earth(-1), of_the_earth(1)[::-1], rtol=0, atol=16 * EPS)


def test_a_body_upside_down_is_near_to_one_nearly_so():
    """Half a turn leads there about any level axis: the Earth's level part may come from aside."""
    turn = TurntableRotation(TEN, latitude=LATITUDE)
    down = turn.increments([0, 0, -1], 36).angle
    across = np.linalg.norm(down[:, :2], axis=1)
    expected = EARTH_RATE * np.cos(LATITUDE) * np.sin(np.radians(5)) / np.radians(5)
    np.testing.assert_allclose(across, expected, rtol=1e-12)
    assert (-down[:, 2]).sum() == pytest.approx(2 * np.pi + 36 * earth_rate(LATITUDE)[2], rel=1e-13)


@pytest.mark.parametrize(
    ("settings", "sentence"),
    [
        ({"rate": 0}, "^rate: expected a rate that is not zero, got 0"),
        ({"turns": 0.5}, "^turns: expected a whole number of at least 1, got 0.5"),
        ({"latitude": 51.5}, "^latitude: expected at most 89.9 degrees"),
        ({"table_axis": (0, 0, 0)}, "^table_axis: expected nonzero vectors"),
        ({"table_axis": np.eye(3)}, r"^table_axis: expected shape \(3,\), got shape \(3, 3\)"),
        ({"angle_error": 4.0}, "^angle_error: expected less than half a turn, got 4.0 rad"),
        ({"ramp": -1.0}, "^ramp: expected a number of at least 0, got -1.0"),
        ({"dwell": -1.0}, "^dwell: expected a number of at least 0, got -1.0"),
        ({"ramp": 40.0}, "^ramp: expected at most 36 s, in which .* got 40.0"),
    ],
)
def test_impossible_turns_are_refused(settings, sentence):
    with pytest.raises(ValueError, match=sentence):
        TurntableRotation(**({"rate": TEN} | settings))


@pytest.mark.parametrize(
    ("axis", "samples", "sentence"),
    [
        ([0, 0, 0], 100, "^axis: expected nonzero vectors"),
        ([0, 0, 1], 15, "^samples: expected a whole number of at least 16, got 15"),
    ],
)
def test_impossible_increments_are_refused(axis, samples, sentence):
    with pytest.raises(ValueError, match=sentence):
        TurntableRotation(TEN, turns=2).increments(axis, samples)
