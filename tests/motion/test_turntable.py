"""The turntable: its records against quadrature and SciPy, its schemes position by position."""

import math

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.spatial.transform import Rotation

from driftlab.attitude.integration import integrate
from driftlab.core.earth import gravity_north
from driftlab.core.vectors import left_jacobian
from driftlab.earth import earth_rate, gravity
from driftlab.motion.scheme import (
    DIRECTIONS,
    EIGHTEEN_ROTATIONS,
    NINETEEN_POSITIONS,
    SCHEMES,
    Scheme,
    checked_scheme,
)
from driftlab.motion.turntable import segments, static_trajectory, turntable_trajectory
from driftlab.quaternion import from_rotation_vector, multiply
from support import EPS, quaternions, same_rotation, vectors

LATITUDE = 0.97
# Turns of all kinds: both senses, every axis, a part of a degree, more than a whole turn.
MIXED = Scheme("+90Y -180x +37.5Z -450Y", ("North", "Up", "East"), dwell=2.0, rate=np.pi / 4)
MIXED_TURNS = [("y", 90.0), ("x", -180.0), ("z", 37.5), ("y", -450.0)]
MIXED_START = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]])  # columns: x North, y Up, z East

every_scheme = pytest.mark.parametrize("scheme", SCHEMES.values(), ids=list(SCHEMES))


def standing_force(latitude, altitude):
    """Specific force (3,) of what stands still: gravity's opposite, East, North, Up."""
    return np.array([0.0, -gravity_north(latitude, altitude), gravity(latitude, altitude)])


def walk(interval):
    """Attitudes of `MIXED` as SciPy's Rotation, before and after each interval."""
    here, angle = Rotation.from_matrix(MIXED_START), 0.0
    attitudes = [here]
    for axis, degrees in [*MIXED_TURNS, (None, 0.0)]:
        attitudes += [here] * round(2 / interval)
        if axis:
            count = math.ceil(abs(degrees) / 45 / interval - 1e-6)
            for angle in degrees * np.arange(1, count + 1) / count:
                attitudes.append(here * Rotation.from_euler(axis, angle, degrees=True))
            here = attitudes[-1]
    return Rotation.concatenate(attitudes)


def mean_over_intervals(record, vector):
    """Means (n, 3), in body axes, of a local vector, by Gauss's ten points in each interval.

    The table turns at a constant body rate from the attitude before to the one after.
    """
    attitudes = Rotation.from_quat(record.attitude)
    way = (attitudes[:-1].inv() * attitudes[1:]).as_rotvec()
    points, weights = np.polynomial.legendre.leggauss(10)
    mean = np.zeros_like(way)
    for point, weight in zip(points, weights, strict=True):
        between = attitudes[:-1] * Rotation.from_rotvec(0.5 * (1 + point) * way)
        mean += 0.5 * weight * between.inv().apply(vector)
    return mean, way


def names_of(vectors_):
    """Names of directions that are one of `DIRECTIONS`."""
    found = {direction: name for name, direction in DIRECTIONS.items()}
    return [found[tuple(np.rint(v).astype(int))] for v in vectors_]


# Records


@pytest.mark.parametrize("interval", [0.05, 0.25, 0.5])
def test_attitude_walks_through_the_scheme(interval):
    record = turntable_trajectory(MIXED, LATITUDE, interval)
    expected = walk(interval).as_quat()
    assert record.attitude.shape == expected.shape
    assert same_rotation(record.attitude, expected, 64 * EPS)


@pytest.mark.parametrize("interval", [0.05, 0.5])
def test_increments_are_integrals_of_rate_and_force(interval):
    record = turntable_trajectory(MIXED, LATITUDE, interval, altitude=900.0)
    assert record.increments.interval == interval
    seen, way = mean_over_intervals(record, earth_rate(LATITUDE))
    # Ten points are exact up to rounding for half a radian. The way is a difference of attitudes
    # that are good to some eps, and turns by less than half a radian.
    np.testing.assert_allclose(
        record.increments.angle, way + interval * seen, rtol=0, atol=64 * EPS
    )
    pushed, _ = mean_over_intervals(record, standing_force(LATITUDE, 900.0))
    np.testing.assert_allclose(
        record.increments.velocity, interval * pushed, rtol=0, atol=64 * EPS * 9.8 * interval
    )


def test_increments_over_parts_of_an_interval_add_up():
    coarse, fine = (
        turntable_trajectory(MIXED, LATITUDE, 0.5),
        turntable_trajectory(MIXED, LATITUDE, 0.125, multiple_of=4),
    )
    for one, parts, size in zip(
        coarse.increments[1:], fine.increments[1:], (0.4, 4.9), strict=True
    ):
        total = parts.reshape(-1, 4, 3).sum(axis=1)
        np.testing.assert_allclose(total, one, rtol=0, atol=64 * EPS * size)
    assert same_rotation(coarse.attitude, fine.attitude[::4], 64 * EPS)


def test_angle_increments_lead_to_the_attitude_on_the_turning_earth():
    interval = 0.01
    record = turntable_trajectory(MIXED, LATITUDE, interval, multiple_of=2)
    found = integrate(record.increments.angle, "two-step-4", start=record.attitude[0])
    times = 2 * interval * np.arange(1, len(found) + 1)
    # Local axes stand on the Earth, which turns by 1.5e-3 rad meanwhile.
    turned = from_rotation_vector(times[:, np.newaxis] * earth_rate(LATITUDE))
    # The algorithm takes tan(angle/4) to its third power. What is left, 2/15 (angle/4)^5, makes
    # angle^5 / 3840 of the quaternion.
    step = 2 * interval * MIXED.rate
    bound = len(found) * step**5 / 3840 + len(found) * EPS
    assert same_rotation(found, multiply(turned, record.attitude[2::2]), bound)


def test_altitude_and_latitude_only_enter_gravity_and_earth_rate():
    low, high = (
        turntable_trajectory(MIXED, LATITUDE, 0.5),
        turntable_trajectory(MIXED, LATITUDE, 0.5, altitude=5e3),
    )
    share = gravity(LATITUDE, 5e3) / gravity(LATITUDE)
    np.testing.assert_array_equal(low.increments.angle, high.increments.angle)
    # The plumb line bends by the rest.
    bend = 0.5 * abs(float(gravity_north(LATITUDE, 5e3)))
    difference = high.increments.velocity - share * low.increments.velocity
    assert np.linalg.norm(difference, axis=-1).max() == pytest.approx(bend, rel=1e-9)


# How long pauses and rotations last


def test_rotation_is_slowed_down_and_pause_drawn_out_to_whole_intervals():
    scheme = Scheme("-90X", dwell=1.05, rate=np.radians(10))
    before, turn, after = segments(scheme, 0.4)
    assert before.duration == after.duration == pytest.approx(1.2)
    assert turn.duration == pytest.approx(9.2)  # 9 s are 22.5 intervals
    assert turn.rate == pytest.approx(-np.radians(90) / 9.2)
    np.testing.assert_array_equal(turn.axis, [1, 0, 0])
    assert before.rate == after.rate == 0
    assert len(turntable_trajectory(scheme, LATITUDE, 0.4).increments.angle) == 3 + 23 + 3


@pytest.mark.parametrize(("dwell", "interval"), [(1.1, 0.1), (0.3, 0.1), (120.0, 0.01), (4.2, 0.6)])
def test_whole_number_of_intervals_but_for_rounding_stays_what_it_is(dwell, interval):
    first, _, _ = segments(Scheme("+90X", dwell=dwell), interval)
    assert first.duration == pytest.approx(dwell, rel=4 * EPS)


def test_nothing_is_shorter_than_an_interval():
    durations = [s.duration for s in segments(Scheme("+1X", dwell=1e-9, rate=6.0), 0.25)]
    assert durations == [0.25, 0.25, 0.25]


@given(st.floats(0.1, 5), st.floats(0.2, 3), st.floats(0.01, 1), st.integers(1, 7))
def test_pauses_and_rotations_last_a_multiple_of_whole(dwell, rate, interval, whole):
    scheme = Scheme("+90Y -35.5Z", dwell=dwell, rate=rate)
    parts = segments(scheme, whole * interval)
    counts = [round(part.duration / interval) for part in parts]
    assert all(count % whole == 0 for count in counts)
    for part, least in zip(
        parts, [dwell, np.pi / 2 / rate, dwell, np.radians(35.5) / rate, dwell], strict=True
    ):
        # Drawn out by less than one multiple, and never cut by more than rounding.
        longer = part.duration - least
        assert -1e-5 * whole * interval < longer < whole * interval
    record = turntable_trajectory(scheme, LATITUDE, interval, multiple_of=whole)
    assert len(record.increments.angle) == sum(counts)
    assert len(record.increments.velocity) == sum(counts)
    assert len(record.attitude) == sum(counts) + 1


# The two schemes


@pytest.mark.parametrize(
    ("scheme", "ups", "axes"),
    [
        (
            NINETEEN_POSITIONS,
            "+x +z -x -z -x +z +x -y +z +y -z +y +z -y -x +y -x -y +x",
            "East East East -East -East -East North East East East -East -East -East "
            "North North -North -North -North",
        ),
        (
            EIGHTEEN_ROTATIONS,
            "+z -x +x -x +y -y +y -z +z -z -y +z +y +x -y -x -z +x +z",
            "North North North East East East North North North North North North East East East "
            "North North North",
        ),
    ],
    ids=list(SCHEMES),
)
def test_schemes_turn_about_level_axes_and_show_these_directions_up(scheme, ups, axes):
    """Worked out by hand from the words; a two-axis table could do both schemes."""
    parts = segments(scheme, 1.0)
    up = [Rotation.from_quat(part.attitude).inv().apply([0, 0, 1]) for part in parts[::2]]
    names = dict(zip(map(tuple, np.eye(3, dtype=int)), "xyz", strict=True))
    found = [
        ("+" if v.sum() > 0 else "-") + names[tuple(np.abs(np.rint(v)).astype(int))] for v in up
    ]
    assert found == ups.split()
    turns = parts[1::2]
    local = names_of(Rotation.from_quat(turn.attitude).apply(turn.axis) for turn in turns)
    signed = [("-" if t.rate < 0 else "") + name for t, name in zip(turns, local, strict=True)]
    opposite = {"-West": "East", "-South": "North", "West": "-East", "South": "-North"}
    assert [opposite.get(name, name) for name in signed] == axes.split()


@every_scheme
def test_schemes_have_nineteen_positions_and_show_each_axis_up_and_down(scheme):
    assert scheme.positions == 19
    assert len(scheme.turns) == 18
    parts = segments(scheme, 1.0)
    assert len(parts) == 37
    up = {tuple(np.rint(Rotation.from_quat(p.attitude).inv().apply([0, 0, 1]))) for p in parts[::2]}
    assert up == set(DIRECTIONS.values())


@every_scheme
def test_schemes_end_as_they_begin(scheme):
    parts = segments(scheme, 1.0)
    assert same_rotation(parts[-1].attitude, scheme.start_attitude, 32 * EPS)


@every_scheme
def test_pauses_last_two_minutes_and_rotations_are_of_ten_degrees_a_second(scheme):
    assert scheme.rate == pytest.approx(np.radians(10), rel=2 * EPS)
    before, turn, after = segments(scheme, 0.5)[:3]
    assert before.duration == after.duration == 120
    assert turn.duration == pytest.approx(9, rel=4 * EPS)
    assert turn.rate == pytest.approx(np.radians(10), rel=4 * EPS)


# Schemes


@pytest.mark.parametrize(
    "start",
    [
        ("East", "North", "Up"),
        ("North", "West", "Up"),
        ("Down", "South", "West"),
        ("Up", "East", "North"),
    ],
    ids=" ".join,
)
def test_body_axes_point_where_the_start_says(start):
    axes = Rotation.from_quat(Scheme("+90X", start).start_attitude).apply(np.eye(3))
    np.testing.assert_allclose(axes, [DIRECTIONS[name] for name in start], rtol=0, atol=4 * EPS)


def test_words_are_sign_angle_and_axis():
    turns = Scheme(" +90Y  -12.25x\n+720Z ").turns
    np.testing.assert_array_equal([axis for axis, _ in turns], np.eye(3)[[1, 0, 2]])
    np.testing.assert_allclose([a for _, a in turns], np.radians([90, -12.25, 720]), rtol=4 * EPS)


def test_a_word_has_ten_turns_at_most():
    _, angle = Scheme("-3600X").turns[0]
    assert angle == pytest.approx(-20 * np.pi)
    with pytest.raises(ValueError, match=r"^rotations: .* at most 3600 degrees .*'-3600\.5X'\.$"):
        Scheme("-3600.5X")


@pytest.mark.parametrize(
    "word",
    ["+90W", "90Y", "+Y", "+0Y", "-0.0Z", "+-90Y", "+90", "+90YZ", "+1e2Y", "+90Y,", "+nanX"],
)
def test_words_that_make_no_sense_are_refused(word):
    with pytest.raises(
        ValueError,
        match=r"^rotations: expected words like \+90Y or -180X: sign, degrees, axis X, Y or Z, "
        rf"got '{word.replace('+', '[+]')}'\.$",
    ):
        Scheme(f"+90Y {word} -90Y")


@pytest.mark.parametrize(
    "start", ["East North Down", "East East Up", "East West Up", "east north up", "East North"]
)
def test_starts_that_are_not_three_right_handed_directions_are_refused(start):
    with pytest.raises(
        ValueError,
        match=r"^start: expected three of East, West, North, South, Up, Down for x, y, z, "
        "right-handed, got ",
    ):
        Scheme("+90X", start.split())


# Standing still


@given(quaternions(), st.floats(-1.5, 1.5), st.floats(1e-3, 10), st.integers(1, 50))
def test_unit_that_stands_senses_gravity_and_the_turning_earth(q, latitude, interval, count):
    record = static_trajectory(3 * q, latitude, interval, count, altitude=250.0)
    to_body = Rotation.from_quat(q).inv()
    assert record.increments.interval == interval
    assert record.increments.angle.shape == record.increments.velocity.shape == (count, 3)
    np.testing.assert_allclose(
        record.increments.angle,
        np.tile(interval * to_body.apply(earth_rate(latitude)), (count, 1)),
        rtol=0,
        atol=32 * EPS * 7.3e-5 * interval,
    )
    pushed = interval * to_body.apply(standing_force(latitude, 250.0))
    np.testing.assert_allclose(
        record.increments.velocity,
        np.tile(pushed, (count, 1)),
        rtol=0,
        atol=32 * EPS * 9.9 * interval,
    )
    np.testing.assert_allclose(record.attitude, np.tile(q, (count + 1, 1)), rtol=0, atol=4 * EPS)
    np.testing.assert_array_equal(record.latitude, np.full(count + 1, latitude))
    np.testing.assert_array_equal(record.velocity, np.zeros((count + 1, 2)))


# The mean of a turning matrix


@given(vectors(6.0))
def test_left_jacobian_is_the_mean_of_the_matrices(vector):
    # Up to 10.4 rad: thirty points are exact to rounding.
    points, weights = np.polynomial.legendre.leggauss(30)
    matrices = Rotation.from_rotvec(0.5 * (1 + points)[:, np.newaxis] * vector).as_matrix()
    expected = np.einsum("i,ijk->jk", 0.5 * weights, matrices)
    np.testing.assert_allclose(left_jacobian(vector), expected, rtol=0, atol=64 * EPS)


@pytest.mark.parametrize("size", [1e-12, 1e-9, 1e-6])
def test_average_of_a_small_turn_is_half_of_it(size):
    vector = size * np.array([2.0, -1.0, 2.0])
    average = left_jacobian(vector)
    # The skew part begins with half the turn; what follows is smaller by the square over 12.
    np.testing.assert_allclose(
        (average - average.T) / 2, np.cross(vector, np.eye(3)).T / 2, rtol=1e-11, atol=0
    )
    # The symmetric part begins with a sixth of the square, up to 9 size^2.
    np.testing.assert_allclose(
        (average + average.T) / 2, np.eye(3), rtol=0, atol=1.5 * size**2 + 4 * EPS
    )


def test_a_scheme_may_be_called_by_its_name():
    for name, scheme in SCHEMES.items():
        assert checked_scheme(name) is scheme
    with pytest.raises(ValueError, match=r"^plan: expected a Scheme .* \(19 positions, .*got '9'"):
        checked_scheme("9", "plan")


def test_a_table_may_turn_once_a_second_and_no_faster():
    assert Scheme("+90X", rate=2 * np.pi).rate == 2 * np.pi
    with pytest.raises(
        ValueError, match=r"^rate: expected rad/s, at most 6\.283, got 6\.29: is it"
    ):
        Scheme("+90X", rate=6.29)
