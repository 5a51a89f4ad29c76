"""Alignment in inertial space against simulated bodies, its rival, its formulas; refusals."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from driftlab.core.carried_gravity import cone_velocity, earth_turn, wahba_rotation
from driftlab.core.velocity_noise import MOST_WINDOWS, _mixtures, _windows, mean_deviation
from driftlab.earth import EARTH_RATE
from driftlab.frames import from_euler_angles, navigation_frame_rate, to_euler_angles
from driftlab.gyrocompass.alignment import align, alignment_attitude_error
from driftlab.gyrocompass.inertial_alignment import (
    _DENSITIES,
    align_in_inertial_frame,
    inertial_alignment_standard_deviation,
)
from driftlab.increments import Increments
from driftlab.motion.vehicle import smooth_step, static_imu, vehicle_trajectory
from driftlab.quaternion import (
    conjugate,
    from_rotation_vector,
    multiply,
    rotate,
    rotation_angle,
    to_rotation_vector,
)
from support import random_quaternions

LATITUDE = np.radians(51.5)
WALK = np.radians(0.01) / 60
BELL = 140 * np.polynomial.Polynomial([0, 1, -1]) ** 3


def still(attitude, latitude, *, interval, count):
    """Increments of a body at rest."""
    rate, force = static_imu(attitude, latitude)
    rows = (
        np.repeat(interval * part[..., np.newaxis, :], count, axis=-2) for part in (rate, force)
    )
    return Increments(interval, *rows)


def ship(latitude, duration, interval, rng, arm=(3.0, 10.0, 2.0)):
    """A ship that rolls by 5 degrees in 8 s, and pitches and yaws; the unit sits off its centre."""
    times = interval * np.arange(round(duration / interval) + 1)
    heading, pitch, roll = (
        np.radians(size) * np.sin(2 * np.pi / period * times + rng.uniform(0, 2 * np.pi))
        for size, period in ((2.0, 10.4), (1.5, 6.4), (5.0, 8.0))
    )
    heading = heading + rng.uniform(-np.pi, np.pi)
    place = rotate(from_euler_angles(heading, pitch, roll), np.array(arm))
    velocity = np.gradient(place, interval, axis=0)
    return vehicle_trajectory(
        latitude, velocity[:, [0, 2]], heading, pitch, roll, interval=interval
    )


def error(found, true):
    """Rotation vector in North, Up, East from the true to the found attitude."""
    return to_rotation_vector(multiply(found, conjugate(true)))


# Attitude


def test_an_attitude_at_rest_is_found_in_both_hemispheres():
    attitude = random_quaternions(4, seed=1)
    places = np.radians([-80.0, -33.0, 0.0, 51.5])
    found = align_in_inertial_frame(still(attitude, places, interval=0.1, count=3000), places)
    # Rounding of the velocities, up to 3 km/s, against the parabolas of 70 m/s and more.
    for body in (found.attitude, found.start_attitude):
        assert rotation_angle(multiply(body, conjugate(attitude))).max() < 1e-11
    assert np.allclose(found.level_rate, EARTH_RATE * np.cos(places), rtol=1e-7)
    assert found.residual.max() < 1e-9
    assert found.deviation.max() < 1e-8


@pytest.mark.parametrize("swing", [0.0, 0.3])
def test_angles_are_those_at_the_end_while_a_body_turns(swing):
    interval = 0.02
    times = np.arange(0, 200 + interval / 2, interval)
    ride = vehicle_trajectory(
        -LATITUDE,
        np.zeros((len(times), 2)),
        2.0 + 0.02 * times,
        swing * np.sin(0.1 * times),
        interval=interval,
    )
    found = align_in_inertial_frame(ride.increments, -LATITUDE)
    # The simulated rate is steady in an interval and jumps between two. Steps of pairs take it for
    # smooth: their coning weight is 2/3 where 1/2 were right, a drift of w x w' dt^2/12.
    drift = 0.02 * (swing * 0.01) * interval**2 / 12
    bound = 1e-9 + drift / (EARTH_RATE * np.cos(LATITUDE))
    assert rotation_angle(multiply(found.attitude, conjugate(ride.attitude[-1]))) < bound
    assert rotation_angle(multiply(found.start_attitude, conjugate(ride.attitude[0]))) < bound
    expected = to_euler_angles(ride.attitude[-1])
    assert np.allclose([found.heading, found.pitch, found.roll], expected, atol=bound)


def test_a_lean_turns_the_heading_of_means_and_not_this_one():
    """An arc minute about East in five minutes, with a smooth beginning and end."""
    lean, duration = np.radians(1 / 60), 300.0
    times = np.linspace(0.0, duration, 3001)
    ride = vehicle_trajectory(
        LATITUDE, np.zeros((3001, 2)), 0.0, lean * smooth_step(times, 50.0, 200.0), interval=0.1
    )
    means = [rows.mean(axis=0) for rows in (ride.increments.mean_rate, ride.increments.velocity)]
    means = align(*means, heading_tolerance=np.inf).heading
    expected = lean / (duration * EARTH_RATE * np.cos(LATITUDE))
    assert np.isclose(means, expected, rtol=0.02)
    assert np.degrees(expected) == pytest.approx(1.2, abs=0.05)
    found = align_in_inertial_frame(ride.increments, LATITUDE)
    assert abs(found.heading) < 1e-4 * expected


@pytest.mark.parametrize("latitude", np.radians([-55.0, 10.0, 60.0]))
def test_a_ship_in_a_swell_is_aligned_where_means_fail_by_degrees(latitude):
    rng = np.random.default_rng(8)
    for _ in range(3):
        ride = ship(latitude, 300.0, 0.02, rng)
        found = align_in_inertial_frame(ride.increments, latitude)
        # Three swings together move the unit by at most 1.3 m, each in at most 10.4 s. Integrated
        # by parts, the bell's third derivative at the two ends is left, 840 each.
        swung = 1.3 * 10.4 / (2 * np.pi)
        bound = 2 * 840 * swung / (9.8 * EARTH_RATE * np.cos(latitude) * 300.0**4)
        assert abs(error(found.attitude, ride.attitude[-1])[1]) < bound < np.radians(0.1)
        _, angle, velocity = ride.increments
        means = align(angle.mean(axis=0), velocity.mean(axis=0), rate_unit=None)
        assert rotation_angle(multiply(means.attitude, conjugate(ride.attitude[-1]))) > 0.1


def test_a_stretch_that_begins_in_the_middle_of_a_swing_is_as_good():
    """The velocity at the start is free in the fit."""
    times = np.arange(0, 300.001, 0.05)
    drifting = np.stack([np.full(len(times), 0.5), np.full(len(times), -0.3)], axis=-1)
    ride = vehicle_trajectory(LATITUDE, drifting, 1.0, interval=0.05)
    begin = Increments(*ride.increments)
    found = align_in_inertial_frame(begin, LATITUDE)
    # What counts of a constant velocity is the turn of the level along the way, v/R, against U.
    along = 0.5 / (6.37e6 * EARTH_RATE * np.cos(LATITUDE))
    assert np.isclose(error(found.attitude, ride.attitude[-1])[1], -along, rtol=0.05)


# Errors of the sensors


def test_constant_biases_make_the_errors_of_means():
    """First order, at the end of the record; the drift's part of half the time is the bound."""
    attitude = from_euler_angles(0.7, 0.2, -0.3)
    rows = still(attitude, LATITUDE, interval=0.1, count=6000)
    gyro, force = np.radians([0.02, -0.03, 0.05]) / 3600, np.array([3e-4, -2e-4, 5e-4])
    to_body = conjugate(attitude)
    bent = Increments(
        0.1,
        rows.angle + 0.1 * rotate(to_body, gyro),
        rows.velocity + 0.1 * rotate(to_body, force),
    )
    found = align_in_inertial_frame(bent, LATITUDE)
    expected = alignment_attitude_error(LATITUDE, gyro, force)
    gap = error(found.attitude, attitude) - expected
    drift = np.abs(gyro).max() * 600.0
    turned = EARTH_RATE * 600.0 * np.abs(expected).max()
    assert np.abs(gap).max() < drift + turned
    assert abs(gap[1]) < 0.05 * abs(expected[1])
    # The North gyro's bias shows in the rate of gravity.
    level = EARTH_RATE * np.cos(LATITUDE)
    assert np.isclose(found.level_rate - level, gyro[0], rtol=0.1)


def test_a_wrong_latitude_hardly_matters():
    rows = still(from_euler_angles(0.4, 0.0, 0.0), LATITUDE, interval=0.1, count=3000)
    found = align_in_inertial_frame(rows, LATITUDE + np.radians(0.1))
    assert abs(found.heading - 0.4) < EARTH_RATE * 300 * np.radians(0.1)


def test_the_drift_is_seen_through_the_bell():
    """A step of the East gyro's drift at a moment: the bell's integral from there on."""
    level = EARTH_RATE * np.cos(LATITUDE)
    size, duration = 1e-3 * level, 400.0
    for moment in (0.2, 0.5, 0.7):
        rows = still(np.array([0.0, 0.0, 0.0, 1.0]), LATITUDE, interval=0.1, count=4000)
        rows.angle[round(moment * 4000) :, 2] += 0.1 * size
        found = align_in_inertial_frame(rows, LATITUDE)
        expected = (BELL.integ()(1) - BELL.integ()(moment)) * size / level
        # The rest is of the order of the Earth's turn in the record, 0.03.
        assert abs(found.start_attitude[1] * 2 - expected) < EARTH_RATE * duration * size / level


def test_the_bell_is_one_and_its_integrals_are_those_of_the_formula():
    assert np.isclose(BELL.integ()(1), 1.0)
    squares = [(BELL.deriv(order) ** 2).integ()(1) for order in (3, 2, 1)] + [(BELL**2).integ()(1)]
    assert np.allclose(_DENSITIES, squares)


def noisy(runs, rng, duration=200.0, interval=0.25, velocity=0.0):
    """Many records of a still body with noise of the gyros, and of the velocity."""
    count = round(duration / interval)
    rows = still(np.array([0.0, 0.0, 0.0, 1.0]), LATITUDE, interval=interval, count=count)
    angle = rows.angle + WALK * np.sqrt(interval) * rng.standard_normal((runs, count, 3))
    shaken = velocity * rng.standard_normal((runs, count + 1, 3))
    return Increments(interval, angle, rows.velocity + np.diff(shaken, axis=-2))


@pytest.mark.parametrize("velocity", [0.0, 0.05])
def test_deviations_foretold_and_stated_are_those_of_many_runs(velocity):
    rng = np.random.default_rng(6)
    runs = 300
    found = align_in_inertial_frame(noisy(runs, rng, velocity=velocity), LATITUDE)
    foretold = inertial_alignment_standard_deviation(
        LATITUDE, 200.0, WALK, velocity * np.sqrt(0.25)
    )
    scatter = np.sqrt(np.mean(found.heading**2))
    # A deviation of 300 runs is known to 4 per cent; three of these.
    assert abs(scatter / foretold - 1) < 0.13
    assert np.sqrt(np.mean(found.deviation**2)) > 0.9 * scatter
    assert np.median(found.deviation) < 2.5 * scatter
    # Two stated deviations hold 0.954 of normal errors; 300 runs tell that to 0.012.
    assert np.mean(np.abs(found.heading) < 2 * found.deviation) > 0.954 - 3 * 0.012


@pytest.mark.parametrize("kind", ["displacement", "velocity", "walk of velocity", "walk of axes"])
@pytest.mark.parametrize("steps", [80, 1000])
def test_the_deviation_holds_for_each_noise_of_the_velocity(kind, steps):
    """On the fit of a parabola alone; the unit of time is the record."""
    rng = np.random.default_rng(9)
    runs, density = 300, dict(zip(
        ("displacement", "velocity", "walk of velocity", "walk of axes"), _DENSITIES, strict=True
    ))[kind]  # fmt: skip
    white = np.sqrt(steps) * rng.standard_normal((runs, steps + 1, 2))
    velocity = {
        "displacement": lambda: steps * np.diff(white, axis=1),
        "velocity": lambda: white[:, 1:],
        "walk of velocity": lambda: np.cumsum(white[:, 1:], axis=1) / steps,
        "walk of axes": lambda: np.cumsum(np.cumsum(white[:, 1:], axis=1), axis=1) / steps**2,
    }[kind]()
    part = np.arange(1, steps + 1) / steps
    weights = part * (1 - part)
    powers = np.stack([np.ones(steps), part, part**2 / 2], axis=-1)
    found = np.linalg.solve(powers.T * weights @ powers, powers.T * weights) @ velocity
    errors, stated = found[:, 2, 0], mean_deviation(velocity - powers @ found, _DENSITIES)
    # A deviation of 300 runs is known to 4 per cent; three of these, and what 80 steps leave out.
    assert np.isclose(errors.std(), np.sqrt(density), rtol=0.12 + 4 / steps)
    assert np.mean(np.abs(errors) < 2 * stated) > 0.88
    assert np.median(stated) < 4 * errors.std()


def test_swaying_alone_is_not_understated():
    """A walk of the gyros that may hide under the swaying is counted in, so it is overstated."""
    rng = np.random.default_rng(7)
    rides = [ship(LATITUDE, 120.0, 0.05, rng) for _ in range(12)]
    rows = Increments(0.05, *(np.stack([getattr(r.increments, name) for r in rides])
                              for name in ("angle", "velocity")))  # fmt: skip
    found = align_in_inertial_frame(rows, LATITUDE)
    errors = error(found.attitude, np.stack([r.attitude[-1] for r in rides]))[:, 1]
    assert np.sqrt(np.mean(errors**2)) < np.sqrt(np.mean(found.deviation**2))


# Parts


def test_wahbas_rotation_is_scipys():
    rng = np.random.default_rng(2)
    given, wanted = rng.standard_normal((2, 7, 20, 3))
    weights = rng.uniform(size=20)
    found = wahba_rotation(given, wanted, weights)
    assert (found[:, 3] > 0).all()  # of the two quaternions of a rotation always the same
    for one, first, second in zip(found, given, wanted, strict=True):
        peer, _ = Rotation.align_vectors(second, first, weights)
        assert (Rotation.from_quat(one) * peer.inv()).magnitude() < 1e-7


def test_the_cone_is_the_integral_of_a_direction_that_turns_with_the_earth():
    times = np.linspace(0, 3000, 3001)
    axis = navigation_frame_rate(LATITUDE)
    up = rotate(from_rotation_vector(times[:, np.newaxis] * axis), np.array([0.0, 1.0, 0.0]))
    slope = np.gradient(cone_velocity(np.array(LATITUDE), times), 1.0, axis=0, edge_order=2)
    assert np.allclose(slope, up, atol=1e-8)
    again = rotate(earth_turn(np.array(LATITUDE), 3000.0), up[-1])
    assert np.allclose(again, [0, 1, 0], atol=1e-14)


def test_windows_are_blind_to_a_parabola_and_know_white_velocity():
    blind, inverses, log_determinants, mixtures = _mixtures(16)
    times = np.linspace(0, 1, 2000, endpoint=False)
    parabola = np.stack([times**2, 1 - times], axis=-1)
    assert np.abs(blind.T @ _windows(parabola, 16)).max() < 1e-12
    # Each is a mean about its middle.
    means = _windows(np.arange(170)[:, np.newaxis] + 0.5, 16)
    np.testing.assert_allclose(means[:, 0], 10.0 * np.arange(1, 17), rtol=1e-13)
    assert np.allclose(-np.linalg.slogdet(inverses)[1], log_determinants)
    assert (mixtures > 0).all()
    assert np.isfinite(mean_deviation(np.zeros((2000, 2)), _DENSITIES))


def test_windows_know_the_covariance_of_each_noise():
    """White samples, differenced or summed up, as the means under the windows show them."""
    steps = 1800
    blind, inverses, _, mixtures = _mixtures(8)
    windows = blind.T @ _windows(np.eye(steps), 8)
    sums = np.tril(np.ones((steps, steps))) / steps
    ways = steps * np.diff(np.eye(steps + 1), axis=0), np.eye(steps), sums, sums @ sums
    kinds = np.stack([steps * (windows @ way) @ (windows @ way).T for way in ways])
    expected = np.tensordot(mixtures, kinds, 1)
    missed = np.linalg.norm(np.linalg.inv(inverses) - expected, axis=(1, 2))
    # Windows of so few points as are used know the roughest of them to some percent.
    assert (missed < 0.03 * np.linalg.norm(expected, axis=(1, 2))).all()


@pytest.mark.parametrize("kind", range(4))
def test_a_record_backwards_is_as_uncertain(kind):
    """Each of the noises is as likely in either order of time."""
    level = np.random.default_rng(10).standard_normal((5, 10 * (MOST_WINDOWS + 1), 2))
    found, backwards = (mean_deviation(rows, np.eye(4)[kind]) for rows in (level, level[:, ::-1]))
    np.testing.assert_allclose(backwards, found, rtol=1e-9)


# Contract


def test_of_an_odd_number_the_first_is_left_out():
    rows = still(from_euler_angles(1.0, 0.1, 0.2), LATITUDE, interval=0.2, count=501)
    odd = align_in_inertial_frame(rows, LATITUDE)
    even = align_in_inertial_frame(rows.part(1, 501), LATITUDE)
    assert np.array_equal(odd.attitude, even.attitude)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda r: r.part(0, 71), "increments: expected at least 72, got 71"),
        (lambda r: r._replace(velocity=5 * r.velocity), r"velocity: .* 5 times what gravity makes"),
        (lambda r: r._replace(velocity=r.velocity / 9.8), r"velocity: .* or in g\?"),
        (lambda r: r._replace(velocity=0 * r.velocity), r"velocity: expected integrals"),
        (lambda r: r._replace(angle=57.3 * r.angle), r"angle: .* 35.7 times as fast as the Earth"),
        (lambda r: r._replace(angle=0 * r.angle), r"angle: .* moves \S+ times as fast as"),
        (lambda r: r._replace(angle=0.1 * r.angle), r"angle: .* 0\.0623 times as fast as"),
        (lambda r: r._replace(angle=r.angle[:, :2]), r"angle: expected shape"),
        (lambda r: r._replace(interval=0.0), r"interval: expected a positive"),
    ],
)
def test_refusals(change, words):
    rows = still(np.array([0.0, 0.0, 0.0, 1.0]), LATITUDE, interval=0.2, count=300)
    with pytest.raises(ValueError, match=words):
        align_in_inertial_frame(change(rows), LATITUDE)


def test_gyros_that_sleep_are_refused_and_noise_that_hides_the_earth_is_not():
    rng = np.random.default_rng(11)
    rows = noisy(40, rng)
    asleep = rows.angle.copy()
    asleep[17] = 0.0
    with pytest.raises(ValueError, match="gravity moves"):
        align_in_inertial_frame(rows._replace(angle=asleep), LATITUDE)
    # A drift against the Earth's rate about North leaves a twentieth of it, which is refused as
    # well, unless there is noise that could have done it: here one radian of the heading.
    level = EARTH_RATE * np.cos(LATITUDE)
    drifting = rows._replace(angle=rows.angle - 0.25 * 0.95 * level * np.array([1.0, 0.0, 0.0]))
    with pytest.raises(ValueError, match="gravity moves"):
        align_in_inertial_frame(drifting, LATITUDE)
    shaken = 1e-3 / inertial_alignment_standard_deviation(
        LATITUDE, 200.0, 0.0, 1e-3 * np.sqrt(0.25)
    )
    velocity = rows.velocity + shaken * np.diff(rng.standard_normal((40, 801, 3)), axis=-2)
    found = align_in_inertial_frame(drifting._replace(velocity=velocity), LATITUDE)
    assert found.deviation.min() > 0.2


def test_mistakes_that_pass_are_those_of_the_notes():
    rows = still(from_euler_angles(0.4, 0.0, 0.0), LATITUDE, interval=0.1, count=3000)
    turned = align_in_inertial_frame(rows._replace(angle=-rows.angle), LATITUDE)
    south = align_in_inertial_frame(rows, -LATITUDE)
    turn = EARTH_RATE * 300.0
    # First order in the Earth's turn; a wrong sign of the vertical rate alone leaves twice of it.
    assert np.cos(turned.heading - 0.4 - np.pi) > np.cos(2 * turn)
    assert abs(abs(south.heading - 0.4) - turn * np.sin(LATITUDE)) < turn**2
