"""Test motions: attitude, rate and increments belong together, and each motion is what it says."""

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.integrate import quad_vec, solve_ivp
from scipy.spatial.transform import Rotation

from driftlab.drift.error_kinematics import rate_matrix
from driftlab.motion.profiles import Coning, FixedAxis, Sway
from support import EPS

MOTIONS = {
    "small cone": Coning(np.radians(1), 0.7),
    "wide cone": Coning(np.radians(60), -0.7),
    "sway": Sway(0.5, 0.6),
    "fixed axis": FixedAxis(0.8, 0.6, (1, -2, 0.5)),
}
every_motion = pytest.mark.parametrize("motion", MOTIONS.values(), ids=list(MOTIONS))
TIMES = np.linspace(-2, 3, 101)


# Attitude, rate and increments


@every_motion
def test_attitude_is_the_integral_of_the_rate(motion):
    answer = solve_ivp(
        lambda time, q: 0.5 * rate_matrix(motion.rate(time)) @ q,
        (0, 3),
        motion.attitude(0),
        method="DOP853",
        t_eval=TIMES[TIMES > 0],
        rtol=1e-12,
        atol=1e-12,
    )
    # Some hundred steps of 1e-12. The attitude's sign is continuous, too.
    np.testing.assert_allclose(motion.attitude(answer.t), answer.y.T, rtol=0, atol=1e-10)


@every_motion
def test_increments_are_integrals_of_the_rate(motion):
    interval, count = 0.31, 7
    expected = [
        quad_vec(motion.rate, i * interval, (i + 1) * interval, epsabs=1e-14, epsrel=1e-14)[0]
        for i in range(count)
    ]
    # Increments up to 1.5 rad, from phases up to 10 rad that are good to an eps each.
    np.testing.assert_allclose(motion.increments(interval, count), expected, rtol=0, atol=32 * EPS)


@every_motion
@given(parts=st.integers(2, 9), count=st.integers(1, 6), interval=st.floats(1e-3, 0.4))
def test_increments_over_parts_of_an_interval_add_up(motion, parts, count, interval):
    whole = motion.increments(interval, count)
    fine = motion.increments(interval / parts, parts * count).reshape(count, parts, 3)
    # Each of up to nine parts of at most 2 rad, at phases up to 11 rad, good to an eps.
    np.testing.assert_allclose(fine.sum(axis=1), whole, rtol=0, atol=64 * EPS)


@every_motion
def test_small_increments_keep_their_digits(motion):
    interval = 2.0**-40
    # The rate changes by less than 20 rad/s in a second.
    middle = interval * (np.arange(5) + 0.5)
    np.testing.assert_allclose(
        motion.increments(interval, 5) / interval, motion.rate(middle), rtol=0, atol=32 * EPS
    )


# What each motion is


def test_coning_axis_runs_round_a_cone():
    half_angle, frequency = 0.4, 0.25
    motion = Coning(half_angle, frequency)
    third = Rotation.from_quat(motion.attitude(TIMES)).apply([0, 0, 1])
    # The third axis tilts by the half angle, about a direction that turns.
    phase = 2 * np.pi * frequency * TIMES
    expected = np.stack(
        [
            np.sin(half_angle) * np.sin(phase),
            -np.sin(half_angle) * np.cos(phase),
            np.full_like(phase, np.cos(half_angle)),
        ],
        axis=-1,
    )
    np.testing.assert_allclose(third, expected, rtol=0, atol=16 * EPS)


def test_coning_does_not_turn_about_itself_on_the_whole():
    motion = Coning(0.4, 0.25)
    np.testing.assert_allclose(motion.attitude(4), motion.attitude(0), rtol=0, atol=8 * EPS)
    rotation_vectors = Rotation.from_quat(motion.attitude(TIMES)).as_rotvec()
    np.testing.assert_allclose(rotation_vectors[:, 2], 0, atol=4 * EPS)


@given(st.floats(0, 1.5), st.floats(0.01, 5) | st.floats(-5, -0.01))
def test_coning_rate_is_a_chord_of_the_unit_sphere_times_the_frequency(half_angle, frequency):
    """The length is 2 W sin(a/2) in all, W sin(a) across the axis."""
    rate = Coning(half_angle, frequency).rate(TIMES)
    turning = 2 * np.pi * abs(frequency)
    bound = 8 * turning * EPS
    across = np.linalg.norm(rate[:, :2], axis=-1)
    np.testing.assert_allclose(across, turning * np.sin(half_angle), rtol=0, atol=bound)
    np.testing.assert_allclose(
        np.linalg.norm(rate, axis=-1), 2 * turning * np.sin(half_angle / 2), rtol=0, atol=bound
    )


def test_sway_is_three_sines():
    amplitude, frequency = 0.3, 0.2
    attitude = Sway(amplitude, frequency).attitude(TIMES)
    heading, pitch, roll = Rotation.from_quat(attitude).as_euler("ZYX").T
    turning = 2 * np.pi * frequency * TIMES
    bound = 32 * EPS
    np.testing.assert_allclose(roll, amplitude * np.sin(turning), rtol=0, atol=bound)
    np.testing.assert_allclose(
        pitch, 0.6 * amplitude * np.sin(0.7548776662 * turning + 1), rtol=0, atol=bound
    )
    np.testing.assert_allclose(
        heading, 0.4 * amplitude * np.sin(0.5698402910 * turning + 2), rtol=0, atol=bound
    )


@pytest.mark.parametrize("amplitude", [0.1, 0.5, 1.5, 3.1])
def test_sixteen_points_are_enough_over_a_quarter_of_the_period(amplitude):
    motion = Sway(amplitude, 1.0)
    whole = motion.increments(0.25, 40)
    parts = motion.increments(0.25 / 16, 640).reshape(40, 16, 3).sum(axis=1)
    # Phases up to 63 rad, good to an eps, turn into as many eps of a rate's share.
    np.testing.assert_allclose(whole, parts, rtol=0, atol=64 * amplitude * EPS)


def test_fixed_axis_swings_while_it_turns():
    amplitude, frequency = 0.8, 0.6
    motion = FixedAxis(amplitude, frequency, (2, -1, 2))
    angle = amplitude * (TIMES + np.sin(2 * np.pi * frequency * TIMES))
    axis = np.array([2, -1, 2]) / 3
    np.testing.assert_allclose(
        motion.attitude(TIMES),
        np.concatenate([np.outer(np.sin(angle / 2), axis), np.cos(angle / 2)[:, None]], axis=1),
        rtol=0,
        atol=8 * EPS,
    )
    # Parallel to the axis, as a row of numbers times a constant vector.
    increments = motion.increments(0.1, 20)
    np.testing.assert_allclose(np.cross(increments, axis), 0, atol=4 * EPS)


# Shapes and refusals


@every_motion
@pytest.mark.parametrize("shape", [(), (4,), (2, 3)], ids=str)
def test_shapes_follow_the_times(motion, shape):
    times = np.linspace(0, 1, int(np.prod(shape))).reshape(shape)
    times.setflags(write=False)
    assert motion.attitude(times).shape == (*shape, 4)
    assert motion.rate(times).shape == (*shape, 3)
    for index in np.ndindex(shape):
        # The same operations, perhaps in other instructions of the processor.
        for function in (motion.attitude, motion.rate):
            np.testing.assert_allclose(
                function(times)[index], function(times[index]), rtol=0, atol=8 * EPS
            )


@pytest.mark.parametrize(("motion_class", "name"), [(Coning, "half_angle"), (Sway, "amplitude")])
@pytest.mark.parametrize("bad", [3.2, -3.2])
def test_angles_beyond_half_a_turn_are_refused(motion_class, name, bad):
    with pytest.raises(
        ValueError, match=rf"^{name}: expected at most pi rad, got {bad}: is it in degrees\?$"
    ):
        motion_class(bad, 1.0)


@every_motion
@pytest.mark.parametrize("interval", [0, 0.0, -1e-3])
def test_intervals_that_are_not_positive_are_refused(motion, interval):
    with pytest.raises(
        ValueError, match=rf"^interval: expected a positive number, got {interval!r}\.$"
    ):
        motion.increments(interval, 3)


@pytest.mark.parametrize("frequency", [2.0, -2.0])
def test_sway_refuses_intervals_beyond_a_quarter_of_the_period(frequency):
    motion = Sway(0.3, frequency)
    assert motion.increments(0.125, 2).shape == (2, 3)
    with pytest.raises(
        ValueError,
        match=rf"^interval: expected at most a quarter of the period, got 0\.126 s "
        rf"at {frequency} Hz\.$",
    ):
        motion.increments(0.126, 2)
