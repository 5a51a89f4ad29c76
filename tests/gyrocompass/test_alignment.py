"""Alignment against SciPy, the first-order formulas against the alignment itself, refusals."""

import warnings

import numpy as np
import pytest
from hypothesis import given
from scipy.spatial.transform import Rotation

from driftlab.earth import EARTH_RADIUS, EARTH_RATE, earth_rate
from driftlab.frames import (
    FROM_EAST_NORTH_UP,
    from_euler_angles,
    navigation_frame_rate,
    to_euler_angles,
)
from driftlab.gyrocompass.alignment import align, alignment_attitude_error, alignment_errors
from driftlab.gyrocompass.heading_error import (
    operating_heading_error,
    speed_error,
)
from driftlab.motion.vehicle import static_imu
from driftlab.quaternion import conjugate, multiply, rotate, to_rotation_vector
from support import order_of, quaternions, random_quaternions, same_rotation

LATITUDE = np.radians(51.5)
ANGLES = np.random.default_rng(1).uniform([-3.1, -1.5, -3.1], [3.1, 1.5, 3.1], (200, 3))
HEADING, PITCH, ROLL = ANGLES.T
GYRO_BIAS, ACCELEROMETER_BIAS = np.array([2e-8, -3e-8, 1e-8]), np.array([3e-5, -1e-5, 2e-5])


def aligned_with(scale, attitude, latitude):
    """Alignment with `scale` times the two biases, given in local axes."""
    rate, force = static_imu(attitude, latitude)
    to_body = conjugate(attitude)
    return align(
        rate + scale * rotate(to_body, GYRO_BIAS),
        force + scale * rotate(to_body, ACCELEROMETER_BIAS),
    )


def wrapped(angle):
    return (angle + np.pi) % (2 * np.pi) - np.pi


# Axes and angles


def test_east_north_up_becomes_north_up_east():
    assert np.array_equal(rotate(FROM_EAST_NORTH_UP, np.eye(3)), np.eye(3)[[2, 0, 1]])
    turned = rotate(FROM_EAST_NORTH_UP, earth_rate(LATITUDE))
    assert np.allclose(turned, navigation_frame_rate(LATITUDE), rtol=1e-15)


def test_attitude_is_heading_then_pitch_then_roll():
    reference = Rotation.from_euler("YZX", ANGLES).as_quat()
    assert same_rotation(from_euler_angles(HEADING, PITCH, ROLL), reference, 1e-15)


def test_positive_heading_turns_the_bow_to_west_and_positive_pitch_lifts_it():
    forward = np.array([1.0, 0.0, 0.0])
    north, up, east = rotate(from_euler_angles(0.1, 0.2, 0.0), forward)
    assert north > 0
    assert up > 0
    assert east < 0


@given(quaternions())
def test_any_attitude_is_that_of_its_angles(attitude):
    again = from_euler_angles(*to_euler_angles(attitude))
    assert same_rotation(again, attitude, 1e-14)


@pytest.mark.parametrize("pitch", [np.pi / 2, -np.pi / 2])
def test_a_vertical_body_keeps_its_attitude(pitch):
    attitude = from_euler_angles(0.4, pitch, 0.3)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        angles = to_euler_angles(attitude)
        rate, force = static_imu(attitude, LATITUDE)
        found = align(rate, force)
    assert same_rotation(from_euler_angles(*angles), attitude, 1e-14)
    assert same_rotation(found.attitude, attitude, 1e-14)
    # Heading and roll turn about one line: only their sum or difference is told.
    together = found.heading + np.sign(pitch) * found.roll
    assert wrapped(together - (0.4 + np.sign(pitch) * 0.3)) == pytest.approx(0, abs=1e-9)


# Alignment


def test_alignment_finds_what_the_body_is():
    found = align(*static_imu(from_euler_angles(HEADING, PITCH, ROLL), -0.8))
    assert np.allclose(np.array(found[:3]).T, ANGLES, atol=1e-13)
    assert np.allclose(found.latitude, -0.8, atol=1e-14)


def test_alignment_equals_a_triad_of_directions():
    attitude = random_quaternions(50, seed=3)
    rate, force = static_imu(attitude, LATITUDE)
    east = np.cross(rate, force)
    local = np.cross(navigation_frame_rate(LATITUDE), [0.0, 1.0, 0.0])
    for i in range(50):
        triad, _ = Rotation.align_vectors(
            [[0.0, 1.0, 0.0], local / np.linalg.norm(local)],
            [force[i] / np.linalg.norm(force[i]), east[i] / np.linalg.norm(east[i])],
        )
        assert same_rotation(align(rate[i], force[i]).attitude, triad.as_quat(), 1e-9)


def test_only_directions_count():
    rate, force = static_imu([0.1, 0.2, 0.3, 0.9], LATITUDE)
    once, again = align(rate, force), align(1e-200 * rate, 1e45 * force, rate_unit=None)
    assert np.allclose(once[:4], again[:4], rtol=0, atol=1e-14)
    # The level rate has the unit of the rate.
    assert once.level_rate == pytest.approx(EARTH_RATE * np.cos(LATITUDE), rel=1e-13)
    assert again.level_rate == pytest.approx(1e-200 * once.level_rate, rel=1e-13)


@pytest.mark.parametrize("latitude", [-1.5, -0.3, 0.0, 0.9, 1.5])
def test_errors_are_of_first_order_and_what_the_formulas_say(latitude):
    attitude = from_euler_angles(HEADING, PITCH, ROLL)
    expected = alignment_errors(HEADING, PITCH, latitude, GYRO_BIAS, ACCELEROMETER_BIAS)
    true = align(*static_imu(attitude, latitude))
    steep = 1 / (np.cos(PITCH).min() * np.cos(latitude))

    def gap(scale, field):
        found = getattr(aligned_with(scale, attitude, latitude), field)
        error = wrapped(found - getattr(true, field))
        return np.abs(error - scale * getattr(expected, field)).max()

    for field in ("heading", "pitch", "roll", "latitude"):
        # Halving the errors twice quarters what first order leaves, and it stays small.
        coarse, fine = gap(0.1, field), gap(0.05, field)
        assert coarse < 1e-7 * steep**2
        assert fine == pytest.approx(coarse / 4, rel=0.15, abs=1e-14 * steep)


@pytest.mark.parametrize("latitude", [-1.2, 0.0, LATITUDE])
def test_the_attitude_error_holds_in_every_attitude(latitude):
    attitude = np.concatenate(
        [random_quaternions(40, seed=5), from_euler_angles([0.3, 2.0], np.pi / 2, 0.2)]
    )
    expected = alignment_attitude_error(latitude, GYRO_BIAS, ACCELEROMETER_BIAS)

    def gap(scale):
        found = aligned_with(scale, attitude, latitude).attitude
        error = to_rotation_vector(multiply(found, conjugate(attitude)))
        return np.abs(error - scale * expected).max()

    assert order_of(gap) == pytest.approx(2, abs=0.02)


def test_the_heading_error_is_that_of_the_attitude():
    error = alignment_attitude_error(LATITUDE, GYRO_BIAS, ACCELEROMETER_BIAS)
    across = error[0] * np.cos(HEADING) - error[2] * np.sin(HEADING)
    of_attitude = error[1] - across * np.tan(PITCH)
    formula = alignment_errors(HEADING, PITCH, LATITUDE, GYRO_BIAS, ACCELEROMETER_BIAS)
    assert np.allclose(of_attitude, formula.heading, rtol=1e-12)
    assert np.allclose(formula.heading_terms.sum(axis=-1), formula.heading, rtol=1e-15)


def test_errors_that_do_no_harm():
    # An error of the vertical accelerometer, and of the gyros North and Up, leave the heading.
    still = alignment_errors(0.5, 0.3, LATITUDE, [1e-7, 1e-7, 0.0], [0.0, 1e-3, 0.0])
    assert still.heading == still.pitch == still.roll == 0
    assert still.latitude != 0


# The compass at work


@pytest.mark.parametrize("latitude", [-1.2, 0.0, LATITUDE])
def test_without_motion_the_operating_formula_is_the_alignment_formula(latitude):
    north, east = ACCELEROMETER_BIAS[0] / 9.8, ACCELEROMETER_BIAS[2] / 9.8
    working = operating_heading_error(
        latitude,
        [0.0, 0.0],
        # Accelerometers that err hold the horizon where they read zero.
        [east, -north],
        [0.0, 0.0],
        GYRO_BIAS[[0, 2]],
        0.01,
        HEADING,
        PITCH,
    )
    aligned = alignment_errors(HEADING, PITCH, latitude, GYRO_BIAS, ACCELEROMETER_BIAS, gravity=9.8)
    assert np.allclose(working.heading, aligned.heading, rtol=1e-12)
    assert np.allclose(working.compass_angle, working.heading - 0.01, rtol=1e-12)


def test_operating_formula_as_the_paper_has_it():
    v1, v3, alpha, chi, alpha_rate, chi_rate = 12.0, -7.0, 1e-4, -2e-4, 3e-8, 1e-8
    dw1, dw3, dpsi, heading, pitch, R, U = 2e-8, 5e-8, 3e-4, 0.7, 0.2, EARTH_RADIUS, EARTH_RATE
    c, s, t = np.cos(LATITUDE), np.sin(LATITUDE), np.tan(LATITUDE)
    below = v1**2 + v3**2 + R * U * c * (2 * v3 + R * U * c)
    expected = (
        R * (v3 + R * U * c) * (chi_rate - alpha * U * s - alpha * v3 * t / R + dw3) / below
        + R * v1 * (alpha_rate + chi * U * s + chi * v3 * t / R + dw1) / below
        - dpsi
        + (alpha * np.cos(heading) - chi * np.sin(heading)) * np.tan(pitch)
    )
    found = operating_heading_error(
        LATITUDE,
        [v1, v3],
        [alpha, chi],
        [alpha_rate, chi_rate],
        [dw1, dw3],
        dpsi,
        heading,
        pitch,
    )
    assert found.compass_angle == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("seed", range(6))
def test_operating_formula_is_the_derivative_of_the_compass_angle(seed):
    rng = np.random.default_rng(seed)
    velocity, latitude = rng.uniform(-30, 30, 2), rng.uniform(-1.3, 1.3)
    rate = navigation_frame_rate(latitude, velocity)

    def compass(tilt, tilt_rate, gyro_bias):
        # A horizon turned by (alpha, 0, chi), and turning, seen from its own axes.
        delta = np.array([tilt[0], 0.0, tilt[1]])
        own = rate + np.cross(rate, delta) + [tilt_rate[0], 0, tilt_rate[1]]
        return np.arctan2(own[2] + gyro_bias[1], own[0] + gyro_bias[0])

    zero = np.zeros(2)
    tilt, tilt_rate, gyro_bias = 1e-6 * rng.normal(size=2), *(1e-10 * rng.normal(size=(2, 2)))
    change = (compass(tilt, tilt_rate, gyro_bias) - compass(-tilt, -tilt_rate, -gyro_bias)) / 2
    formula = operating_heading_error(latitude, velocity, tilt, tilt_rate, gyro_bias, 0.0, 0.0, 0.0)
    assert compass(zero, zero, zero) == pytest.approx(speed_error(latitude, velocity))
    assert formula.compass_angle == pytest.approx(change, rel=1e-6)


def test_speed_deviation_of_a_ship():
    # North at 10 m/s: the compass shows a heading that is too small, by v/(R U cos phi).
    deviation = speed_error(LATITUDE, [10.0, 0.0])
    expected = -np.arctan(10 / (EARTH_RADIUS * EARTH_RATE * np.cos(LATITUDE)))
    assert deviation == pytest.approx(expected, rel=1e-12)
    assert speed_error(LATITUDE, [0.0, 10.0]) == 0
    assert abs(speed_error(1.2, [10.0, 0.0])) > abs(deviation)


# Refusals


@pytest.mark.parametrize(
    ("rate", "force", "words"),
    [
        ([0.0, 0.0, 0.0], [0.0, 9.8, 0.0], "^angular_rate: expected nonzero vectors"),
        ([7e-5, 0.0, 0.0], [0.0, 0.0, 0.0], "^specific_force: expected nonzero vectors"),
        ([0.0, 7e-5, 0.0], [0.0, 9.8, 0.0], "^angular_rate, specific_force: .* at a pole"),
        ([0.0, -7e-5, 0.0], [0.0, 9.8, 0.0], "^angular_rate, specific_force: .* at a pole"),
        (np.ones((3, 3)), np.ones((2, 3)), "^angular_rate, specific_force: .* broadcast"),
    ],
)
def test_alignment_refuses(rate, force, words):
    with pytest.raises(ValueError, match=words):
        align(rate, force)


@pytest.mark.parametrize("latitude", [np.pi / 2, -np.pi / 2, 1.5705])
def test_the_pole_is_refused_by_every_formula(latitude):
    with pytest.raises(ValueError, match=r"^latitude: expected at most 89.9 degrees"):
        alignment_errors(0.0, 0.0, latitude, GYRO_BIAS, ACCELEROMETER_BIAS)
    with pytest.raises(ValueError, match=r"^latitude: expected at most 89.9 degrees"):
        alignment_attitude_error(latitude, GYRO_BIAS, ACCELEROMETER_BIAS)
    with pytest.raises(ValueError, match=r"^latitude: expected at most 89.9 degrees"):
        speed_error(latitude, [1.0, 0.0])
    with pytest.raises(ValueError, match=r"^latitude: expected at most 89.9 degrees"):
        static_imu([0, 0, 0, 1], latitude)


def test_a_vertical_body_has_no_heading_error():
    with pytest.raises(ValueError, match=r"^pitch: expected at most 89.9 degrees.* got 90"):
        alignment_errors(0.0, np.pi / 2, LATITUDE, GYRO_BIAS, ACCELEROMETER_BIAS)


def test_a_body_that_outruns_the_earth_has_no_compass():
    west = -EARTH_RADIUS * EARTH_RATE * np.cos(LATITUDE)
    with pytest.raises(ValueError, match=r"^latitude, velocity: expected local axes that turn"):
        speed_error(LATITUDE, [0.0, west])


# One bad element among good ones, and both sides of each limit


@pytest.mark.parametrize("sign", [1, -1])
def test_the_limits_are_where_they_are_said_to_be(sign):
    just_inside, just_outside = np.radians([89.899, 89.901])
    rest = np.zeros((3, 2))
    align(*static_imu([0, 0, 0, 1], sign * just_inside))
    near_pole = 7e-5 * np.array([np.cos(just_outside), sign * np.sin(just_outside), 0])
    with pytest.raises(ValueError, match=r"got an angle of 0\.099 degrees"):
        align(near_pole, [0, 9.8, 0])
    for formula in (
        lambda pitch: alignment_errors(0.0, pitch, LATITUDE, GYRO_BIAS, ACCELEROMETER_BIAS),
        lambda pitch: operating_heading_error(LATITUDE, [1.0, 2.0], *rest, 0.0, 0.0, pitch),
    ):
        formula(sign * just_inside)
        with pytest.raises(ValueError, match=r"^pitch: expected at most 89.9 degrees"):
            formula(sign * just_outside)


def test_the_latitude_keeps_its_digits_near_the_pole():
    place = np.radians(89.89)
    found = align(*static_imu(from_euler_angles(0.3, 0.4, 0.5), place))
    assert found.latitude == pytest.approx(place, abs=1e-15)


# The Earth's radius


@pytest.mark.parametrize("latitude", [0.0, 0.9, -1.3])
def test_effect_of_the_north_drift_grows_with_the_speed_on_a_fixed_course(latitude):
    """Up to the speed of the ground, and on every course but due East and due West."""
    ground = EARTH_RADIUS * EARTH_RATE * np.cos(latitude)
    speeds = np.linspace(0.0, 1.5 * ground, 301)
    for course in np.radians(np.arange(0.0, 360.0, 7.0)):
        bow = np.array([np.cos(course), np.sin(course)])
        errors = operating_heading_error(
            latitude, speeds[:, np.newaxis] * bow, [0, 0], [0, 0], [1e-9, 0], 0, 0, 0
        )
        effect = np.abs(errors.north_rate)
        assert effect.argmax() == 200
        assert (np.diff(effect[:201]) > 0).all()


def test_angles_come_back():
    found = to_euler_angles(from_euler_angles(HEADING, PITCH, ROLL))
    assert np.allclose(np.array(found).T, ANGLES, atol=1e-13)


def test_east_drift_does_more_than_north_drift_up_to_the_speed_of_the_ground():
    level = EARTH_RADIUS * EARTH_RATE * np.cos(0.9)
    for speed in (0.0, 10.0, 0.99 * level):
        gyro_biases = [[1e-7, 0], [0, 1e-7]]
        errors = operating_heading_error(0.9, [speed, 0.0], [0, 0], [0, 0], gyro_biases, 0, 0, 0)
        north, east = np.abs(errors.heading)
        assert east > north


def north_term(north, east):
    """Heading error from a drift about North of 1e-7 rad/s at latitude 0.9."""
    errors = operating_heading_error(0.9, [north, east], [0, 0], [0, 0], [1e-7, 0], 0, 0, 0)
    return errors.heading


def test_effect_of_the_north_drift_comes_from_the_velocity_north():
    level = EARTH_RADIUS * EARTH_RATE * np.cos(0.9)
    assert north_term(0.0, 300.0) == 0  # due East it is not there at all
    speeds = np.linspace(0, level, 20)
    assert (np.diff([north_term(speed, 0.0) for speed in speeds]) > 0).all()
    assert north_term(1.1 * level, 0.0) < north_term(level, 0.0) > north_term(0.9 * level, 0.0)
    easts = np.linspace(-0.5 * level, 0.5 * level, 20)
    assert (np.diff([north_term(10.0, east) for east in easts]) < 0).all()


def test_the_tan_pitch_terms_are_minus_the_roll_error_times_sin_pitch():
    formula = alignment_errors(HEADING, PITCH, LATITUDE, GYRO_BIAS, ACCELEROMETER_BIAS)
    pair = formula.heading_terms[:, 1] + formula.heading_terms[:, 2]
    assert np.allclose(pair, -formula.roll * np.sin(PITCH), rtol=1e-12)
