"""Alignment in several positions: exactness, deviations in closed form, refusals."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from driftlab.earth import EARTH_RATE
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass.alignment import InconsistentAlignmentWarning, align
from driftlab.gyrocompass.alignment_deviations import (
    alignment_standard_deviation,
    two_position_standard_deviation,
)
from driftlab.gyrocompass.inertial_alignment import inertial_alignment_standard_deviation
from driftlab.gyrocompass.noise import GyroNoise
from driftlab.gyrocompass.two_position_alignment import align_multi_position
from driftlab.motion.vehicle import static_imu
from driftlab.quaternion import conjugate, from_rotation_vector, multiply, rotation_angle
from driftlab.vectors import wrap_angle
from support import random_quaternions

LATITUDE = np.radians(51.5)
LEVEL = EARTH_RATE * np.cos(LATITUDE)
GYRO_BIAS, ACCELEROMETER_BIAS = np.array([3e-6, -2e-6, 5e-6]), np.array([0.03, -0.02, 0.01])
HEADING = 0.7


def about_up(*degrees):
    """Turns about the upper axis of the body."""
    angles = np.radians(degrees)
    return from_rotation_vector(np.stack([0 * angles, angles, 0 * angles], axis=-1))


def readings(attitude, turn, latitude=LATITUDE):
    rate, force = static_imu(multiply(attitude, turn), latitude)
    return rate + GYRO_BIAS, force + ACCELEROMETER_BIAS


def level_errors(runs, turn, rng, *, rate=0.0, change=0.0, wrong=0.0, force_change=0.0):
    """Heading errors of a level unit; noise of a mean, change of a bias, turn not as believed."""
    attitude = from_euler_angles(HEADING, 0.0, 0.0)
    angles = np.stack([np.zeros(runs), turn + wrong * rng.standard_normal(runs)], axis=-1)
    true = from_rotation_vector(angles[..., np.newaxis] * np.array([0.0, 1.0, 0.0]))
    rates, forces = readings(attitude, true)
    rates = rates + rate * rng.standard_normal(rates.shape)
    rates[:, 1] += change * rng.standard_normal((runs, 3))
    forces[:, 1] += force_change * rng.standard_normal((runs, 3))
    found = align_multi_position(rates, forces, about_up(0, np.degrees(turn)))
    return wrap_angle(found.heading - HEADING)


# Exactness


@pytest.mark.parametrize("degrees", [180, -90, 20, 340])
def test_biases_across_the_axis_leave_no_trace(degrees):
    attitude, turn = from_euler_angles(HEADING, 0.05, -0.1), about_up(0, degrees)
    # The axis of the turn is the body's, which leans, so the biases along it would count.
    rate, force = static_imu(multiply(attitude, turn), LATITUDE)
    across = np.array([1.0, 0.0, 1.0])
    found = align_multi_position(
        rate + across * GYRO_BIAS, force + across * ACCELEROMETER_BIAS, turn
    )
    # Rounding of the Earth's rate and of gravity, over sin(turn/2)^2.
    assert rotation_angle(multiply(found.attitude, conjugate(attitude))) < 1e-12
    assert np.allclose(found.gyro_bias, across * GYRO_BIAS, rtol=0, atol=1e-16)
    assert np.allclose(found.accelerometer_bias, across * ACCELEROMETER_BIAS, rtol=0, atol=1e-11)
    assert np.isclose(found.latitude, LATITUDE)
    assert np.isclose(found.level_rate, LEVEL)


def test_a_bias_along_the_axis_stays_and_is_said_to_be_nothing():
    attitude, turn = from_euler_angles(HEADING, 0.0, 0.0), about_up(0, 180)
    found = align_multi_position(*readings(attitude, turn), turn)
    assert found.gyro_bias[1] == pytest.approx(0.0, abs=1e-18)
    assert np.isclose(found.heading, HEADING)
    up = np.tan(found.latitude) * found.level_rate
    assert np.isclose(up - EARTH_RATE * np.sin(LATITUDE), GYRO_BIAS[1])


def test_turns_about_two_axes_show_all_biases():
    rng = np.random.default_rng(4)
    attitude = from_euler_angles(rng.uniform(-3, 3, (5, 1)), 0.2, 0.4)
    turn = np.stack([*about_up(0, 180), from_rotation_vector([np.pi / 2, 0.0, 0.0])])
    found = align_multi_position(*readings(attitude, turn), turn)
    assert np.allclose(found.gyro_bias, GYRO_BIAS, rtol=0, atol=1e-15)
    assert np.allclose(found.accelerometer_bias, ACCELEROMETER_BIAS, rtol=0, atol=1e-11)
    assert rotation_angle(multiply(found.attitude, conjugate(attitude[:, 0]))).max() < 1e-12


def test_it_is_the_least_squares_solution():
    rng = np.random.default_rng(8)
    turn = random_quaternions(4, seed=3)
    matrices = Rotation.from_quat(turn).as_matrix()
    rates, forces = rng.standard_normal((2, 4, 3))
    found = align_multi_position(rates, forces, turn, heading_tolerance=np.inf)
    design = np.concatenate([np.concatenate([m.T, np.eye(3)], axis=1) for m in matrices])
    for rows, bias, left in (
        (rates, found.gyro_bias, found.rate_residual),
        (forces, found.accelerometer_bias, found.force_residual),
    ):
        best, squares, *_ = np.linalg.lstsq(design, rows.ravel(), rcond=None)
        assert np.allclose(bias, best[3:], rtol=0, atol=1e-12)
        assert np.isclose(left, np.sqrt(squares[0] / (12 - 6)))
    earth = np.linalg.lstsq(design, rates.ravel(), rcond=None)[0][:3]
    up = np.linalg.lstsq(design, forces.ravel(), rcond=None)[0][:3]
    assert np.isclose(found.heading, align(earth, up, rate_unit=None).heading)


# Closed forms


@pytest.mark.parametrize("degrees", [180.0, 60.0])
@pytest.mark.parametrize(
    ("simulated", "formula"),
    [
        ({"rate": 1e-8}, {"angle_random_walk": 1e-8 * np.sqrt(150.0)}),
        ({"change": 2e-8}, {"gyro_bias_change": 2e-8}),
        ({"wrong": 1e-3}, {"turn_error": 1e-3}),
        ({"force_change": 1e-3}, {"accelerometer_bias_change": 1e-3}),
    ],
    ids=["noise", "gyro", "turn", "accelerometer"],
)
def test_deviations_are_those_of_many_units(simulated, formula, degrees):
    runs, turn = 4000, np.radians(degrees)
    errors = level_errors(runs, turn, np.random.default_rng(2), **simulated)
    foretold = two_position_standard_deviation(
        LATITUDE, 300.0, turn_angle=turn, **{"angle_random_walk": 0.0} | formula
    )
    # A deviation of 4000 runs is known to 1 in sqrt(8000); four of these.
    assert abs(errors.std() / foretold - 1) < 4 / np.sqrt(2 * runs)


def test_half_a_turn_costs_nothing_in_noise_and_one_position_keeps_its_bias():
    one = alignment_standard_deviation(LATITUDE, 300.0, 1e-7)
    assert two_position_standard_deviation(LATITUDE, 300.0, 1e-7) == pytest.approx(one)
    assert two_position_standard_deviation(LATITUDE, 300.0, 1e-7, np.pi / 3) == pytest.approx(
        2 * one
    )
    # In inertial space the ends of the record count less: (700/429)^(1/2).
    carried = inertial_alignment_standard_deviation(LATITUDE, 300.0, 1e-7)
    assert carried / one == pytest.approx(np.sqrt(700 / 429))
    floor = alignment_standard_deviation(
        LATITUDE, 1e12, 1e-7, gyro_bias=1e-8, accelerometer_bias=1e-3
    )
    assert floor == pytest.approx(np.hypot(1e-8 / LEVEL, 1e-3 * np.tan(LATITUDE) / 9.81), rel=1e-3)


def test_with_a_slow_drift_half_a_turn_leaves_the_allan_deviation():
    noise, half, runs = GyroNoise(3e-7, 5e-8, correlation_time=400.0), 600, 1500
    drifts = noise.samples(2 * half, np.random.default_rng(3), runs, 3)
    means = drifts.reshape(runs, 3, 2, half).mean(axis=-1)
    attitude, turn = from_euler_angles(HEADING, 0.0, 0.0), about_up(0, 180)
    rates, forces = readings(attitude, turn)
    found = align_multi_position(rates + np.swapaxes(means, -1, -2), forces, turn)
    seconds = half * noise.interval
    foretold = noise.allan_deviation(np.array(seconds)) / (np.sqrt(2) * LEVEL)
    scatter = np.std(wrap_angle(found.heading - HEADING))
    assert abs(scatter / foretold - 1) < 4 / np.sqrt(2 * runs)


# Turns that were not made as told


def told_wrongly(made, told, **options):
    attitude = from_euler_angles(HEADING, 0.0, 0.0)
    rates, forces = static_imu(multiply(attitude, about_up(0, *made)), LATITUDE)
    small = 1e-3 * GYRO_BIAS  # a laser gyro's
    found = align_multi_position(rates + small, forces, about_up(0, *told), **options)
    return np.degrees(wrap_angle(found.heading - HEADING)), found


@pytest.mark.parametrize(
    ("made", "told", "place", "words"),
    [
        ([90], [180], LATITUDE, "a level rate that is not the Earth's"),
        ([180], [90], LATITUDE, "a level rate that is not the Earth's"),
        ([90], [-90], None, "biases of the gyros 1.41 times the Earth's level rate"),
        ([90, 170], [90, 180], None, "readings that do not fit each other"),
        ([120, 240], [-120, 240], None, "readings that do not fit each other"),
    ],
)
def test_a_turn_that_was_not_made_is_warned_of(made, told, place, words):
    with pytest.warns(InconsistentAlignmentWarning, match=words):
        off, _ = told_wrongly(made, told, latitude=place)
    assert abs(off) > 1.5
    told_wrongly(made, told, latitude=place, heading_tolerance=np.inf)
    told_wrongly(made, made, latitude=place)


def test_of_many_units_one_whose_readings_do_not_fit_is_warned_of():
    attitude = from_euler_angles(HEADING, 0.0, 0.0)
    turned = np.stack([about_up(0, 90, 180), about_up(0, 90, 170)])
    rates, forces = static_imu(multiply(attitude, turned), LATITUDE)
    with pytest.warns(InconsistentAlignmentWarning, match="readings that do not fit each other"):
        align_multi_position(rates, forces, turned[0])
    np.testing.assert_allclose(align_multi_position(rates, forces, turned).heading, HEADING)


def test_a_turn_of_170_degrees_told_as_180_stays_unseen_as_the_notes_say():
    off, found = told_wrongly([170], [180], latitude=LATITUDE)
    assert abs(off) == pytest.approx(5.0, abs=0.01)
    assert found.level_rate / LEVEL == pytest.approx(np.sin(np.radians(85)), abs=1e-4)
    assert found.heading_uncertainty < np.radians(0.5)


@pytest.mark.parametrize(("made", "told"), [(90, 180), (180, 90), (120, 180)])
def test_a_wrong_turn_scales_the_level_rate_and_halves_into_the_heading(made, told):
    off, found = told_wrongly([made], [told], heading_tolerance=np.inf)
    ratio = np.sin(np.radians(made / 2)) / np.sin(np.radians(told / 2))
    assert found.level_rate / LEVEL == pytest.approx(ratio, abs=1e-3)
    assert off == pytest.approx((made - told) / 2, abs=0.05)


def test_a_bias_about_up_does_not_alarm_and_two_axes_hold_the_whole_rate():
    attitude = from_euler_angles(HEADING, 0.0, 0.0)
    much = np.array([0.0, 1e-5, 0.0])  # 2 deg/h
    for turn, whole in (
        (about_up(0, 180), False),
        (np.stack([*about_up(0, 180), from_rotation_vector([np.pi / 2, 0.0, 0.0])]), True),
    ):
        rates, forces = static_imu(multiply(attitude, turn), LATITUDE)
        found = align_multi_position(rates + much, forces, turn, latitude=LATITUDE)
        assert np.isclose(found.gyro_bias[1], 1e-5) == whole
        assert found.heading_uncertainty < 1e-9
        told = align_multi_position(rates + much, forces, turn)
        assert np.isfinite(told.heading_uncertainty) == whole
    with pytest.warns(InconsistentAlignmentWarning, match="a level rate that is not the Earth's"):
        align_multi_position(1.2 * rates, forces, turn)
    directions = align_multi_position(1e3 * rates, forces, turn, rate_unit=None)
    assert np.isclose(directions.heading, HEADING)


def test_noise_of_a_residual_is_that_of_the_readings():
    rng, turn = np.random.default_rng(6), about_up(0, 120, 240)
    rates, forces = readings(from_euler_angles(HEADING, 0.0, 0.0), turn)
    noisy = rates + 1e-8 * rng.standard_normal((4000, 3, 3))
    found = align_multi_position(noisy, forces, turn)
    # Four degrees of freedom each: 9 readings, 5 of the 6 unknowns.
    assert np.mean(found.rate_residual**2) == pytest.approx(1e-16, rel=4 * np.sqrt(2 / 16000))


# Contract


def test_each_unit_may_have_turns_of_its_own():
    attitude = from_euler_angles(np.array([0.3, -2.0]), 0.1, 0.0)
    tilted = from_rotation_vector([1.2, 0.5, 0.3])
    turns = np.stack([about_up(30, 200, 280), multiply(tilted, about_up(0, 100, 250))])
    rate, force = readings(attitude[:, np.newaxis], turns)
    found = align_multi_position(rate, force, turns)
    for i in range(2):
        alone = align_multi_position(rate[i], force[i], turns[i])
        assert abs(alone.heading - found.heading[i]) < 1e-12
        np.testing.assert_allclose(alone.gyro_bias, found.gyro_bias[i], rtol=0, atol=1e-15)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"turn": about_up(0)}, "turn: expected at least two positions, got 1"),
        ({"turn": about_up(0)[0]}, "turn: expected at least two positions, got 1"),
        ({"turn": about_up(0, 4)}, "turn: expected a turn by more than 5 degrees .* got 4"),
        ({"specific_force": np.ones((2, 2))}, r"specific_force: expected shape"),
        ({"turn": np.zeros((2, 4))}, "turn: expected nonzero quaternions"),
    ],
)
def test_refusals(change, words):
    turn = about_up(0, 180)
    rate, force = readings(from_euler_angles(HEADING, 0.0, 0.0), turn)
    with pytest.raises(ValueError, match=words):
        align_multi_position(
            **{"angular_rate": rate, "specific_force": force, "turn": turn} | change
        )


@pytest.mark.filterwarnings("ignore:.*If deg/√h were meant")
def test_where_nothing_is_known_the_deviation_is_that_of_any_heading():
    """N in degrees per root hour instead of rad per root second made 272 degrees once."""
    nothing = np.pi / np.sqrt(3)
    assert alignment_standard_deviation(LATITUDE, 300.0, 0.003) == nothing
    assert two_position_standard_deviation(LATITUDE, 300.0, 0.003) == nothing
    assert inertial_alignment_standard_deviation(LATITUDE, 300.0, 0.003) == nothing


def test_deviations_refuse_what_has_no_meaning():
    with pytest.raises(ValueError, match=r"turn_angle: expected angles .* got 360 degrees"):
        two_position_standard_deviation(LATITUDE, 60.0, 1e-7, 2 * np.pi)
    with pytest.raises(ValueError, match=r"turn_angle: expected rad, .* got 180\."):
        two_position_standard_deviation(LATITUDE, 60.0, 1e-7, [np.pi, 180.0])
    with pytest.raises(ValueError, match="gyro_bias: expected a number of at least 0, got -1"):
        alignment_standard_deviation(LATITUDE, 60.0, 1e-7, gyro_bias=-1.0)
    with pytest.raises(ValueError, match="duration: expected numbers above 0, got 0"):
        alignment_standard_deviation(LATITUDE, [60.0, 0.0], 1e-7)
    with pytest.raises(ValueError, match="latitude: expected at most"):
        two_position_standard_deviation(np.pi / 2, 60.0, 1e-7)
