"""Wu (6), (49), (50): errors grow as the nonlinear mechanisation has it."""

import numpy as np
import pytest
from scipy.linalg import expm

from driftlab.calibration.body_axes import attitude_error
from driftlab.calibration.error_dynamics import (
    _transition,
    free_transition,
    process_noise,
    transition_of_increments,
)
from driftlab.calibration.error_model import ERROR_MODELS, FULL
from driftlab.earth import EARTH_RATE, earth_rate, gravity
from driftlab.imu import ImuErrors, ImuNoise
from driftlab.increments import measure
from driftlab.motion.scheme import Scheme
from driftlab.motion.turntable import turntable_trajectory
from driftlab.quaternion import from_rotation_vector, multiply, to_matrix
from driftlab.strapdown import final_state, navigate, stationary_state
from driftlab.vectors import cross_matrix
from numerical_growth import allowed, numerical_growth
from support import EPS, order_of, random_quaternions

MODELS = {"all": FULL, **ERROR_MODELS}
every_model = pytest.mark.parametrize("model", MODELS.values(), ids=list(MODELS))
every_latitude = pytest.mark.parametrize("latitude", np.radians([37.5, -60.0, 0.0]))
NOISE = ImuNoise(1.5e-3, 1.2e-2)
EARTH_RADIUS = 6.378e6


# Growth: against the nonlinear mechanisation


TURNS = Scheme("+40X -30Z +50Y", ("North", "West", "Up"), dwell=0.02, rate=np.radians(30))
TURNED = np.radians(120)


def growth_along(record, latitude, model):
    """`_transition` over a whole record, as the filter calls it: pairs, taken in their middles."""
    pairs = len(record.increments.angle) // 2
    interval = 2 * record.increments.interval
    middles = interval * (np.arange(pairs) + 0.5)
    turned = from_rotation_vector(middles[:, np.newaxis] * earth_rate(latitude))
    return _transition(
        model,
        free_transition(latitude, pairs * interval),
        to_matrix(multiply(turned, record.attitude[1::2])),
        np.full(pairs, interval),
        record.increments.angle[0::2] + record.increments.angle[1::2],
        record.increments.velocity[0::2] + record.increments.velocity[1::2],
        np.tri(pairs) - 0.5 * np.eye(pairs),
    )


@every_model
@every_latitude
def test_growth_is_that_of_the_nonlinear_mechanisation(model, latitude):
    record = turntable_trajectory(TURNS, latitude, 0.01, multiple_of=2)
    duration = 0.01 * len(record.increments.angle)
    found = growth_along(record, latitude, model)
    # Rotations by 0.01 rad a pair, taken in the middle: 0.01^2/24 of each share.
    bounds = allowed(model, duration, TURNED) * (1 + 1e-4) + 4e-6 * np.abs(found[:6])
    difference = np.abs(found[:6] - numerical_growth(record, latitude, model))
    assert (difference < bounds).all()
    np.testing.assert_array_equal(found[6:], np.eye(model.size)[6:])


@every_model
def test_growth_of_increments_counts_the_local_axes_as_fixed(model):
    """So it is wrong by W T in attitudes as well; and the middle of two attitudes is a chord."""
    latitude = np.radians(37.5)
    record = turntable_trajectory(TURNS, latitude, 0.01, multiple_of=2)
    duration = 0.01 * len(record.increments.angle)
    found = transition_of_increments(
        model, free_transition(latitude, duration), record.attitude[0::2], record.increments
    )
    bounds = allowed(model, duration, TURNED)
    gyro = np.s_[:3, 6 : 9 + len(model.gyro_basis)]
    bounds[gyro] += EARTH_RATE * duration * bounds[gyro] / (9.8 * duration**2 / EARTH_RADIUS)
    # Pairs turn by 0.01 rad: 0.01^2/8 of each share for the chord.
    bounds += 2e-5 * np.abs(found[:6])
    difference = np.abs(found[:6] - numerical_growth(record, latitude, model))
    assert (difference < bounds).all()
    np.testing.assert_array_equal(found[6:], np.eye(model.size)[6:])


def test_leading_axes_of_any_argument_count():
    rng, lead = np.random.default_rng(14), (3, 1)
    times, weights = rng.uniform(1, 2, 4), rng.uniform(0, 1, (4, 4))
    plain = {
        "free": free_transition(0.5, 2.0),
        "attitude": to_matrix(random_quaternions(4)),
        "times": times,
        "angle": rng.normal(size=(4, 3)),
        "velocity": rng.normal(size=(4, 3)),
    }
    alone = _transition(FULL, *plain.values(), weights)
    for name, value in plain.items():
        arguments = plain | {name: np.tile(value, (*lead, *[1] * value.ndim))}
        found = _transition(FULL, *arguments.values(), weights)
        assert found.shape == (*lead, 30, 30)
        np.testing.assert_allclose(found, np.broadcast_to(alone, found.shape), rtol=1e-12)
    force, durations = rng.normal(size=(3, 3)), np.array([1.0, 2.0])
    found = process_noise(NOISE, force, durations)
    for one, duration in zip(found, durations, strict=True):
        expected = process_noise(NOISE, force, duration)
        np.testing.assert_allclose(one, expected, rtol=0, atol=4 * EPS)


def test_growth_leaves_out_no_more_than_is_said():
    """What is left shrinks with the square of the interval in attitudes, velocities per g T."""
    latitude = np.radians(37.5)

    def left(size):
        scheme = Scheme("+60X", dwell=64 * size, rate=np.radians(60) / (256 * size))
        record = turntable_trajectory(scheme, latitude, 0.5 * size, multiple_of=2)
        growth, duration = growth_along(record, latitude, FULL), 0.5 * size
        duration *= len(record.increments.angle)
        difference = np.abs(growth[:6] - numerical_growth(record, latitude, FULL))
        return difference[:3, :3].max(), difference[3:, :3].max() / (9.8 * duration)

    assert order_of(lambda size: left(size)[0]) == pytest.approx(2, abs=0.1)
    assert order_of(lambda size: left(size)[1]) == pytest.approx(1, abs=0.1)


def random_interval(rng, lead, count):
    """Arguments of `_transition` after the free growth, of nothing in particular."""
    return [
        to_matrix(random_quaternions(*lead, count, seed=int(rng.integers(1000)))),
        rng.normal(size=(*lead, count)),
        rng.normal(size=(*lead, count, 3)),
        rng.normal(size=(*lead, count, 3)),
    ]


@every_model
def test_growth_over_two_halves_multiplies_to_that_over_the_whole(model):
    """Exactly so, where the local axes stand still."""
    rng = np.random.default_rng(9)
    halves = [random_interval(rng, (2,), count) for count in (3, 4)]
    passed = [rng.normal(size=(count, count)) for count in (3, 4)]
    first, second = (
        _transition(model, np.eye(6), *half, part)
        for half, part in zip(halves, passed, strict=True)
    )
    whole = [
        np.concatenate(pair, axis=1) for pair in zip(*halves, strict=True)
    ]  # behind one leading axis
    # All of the first half has passed in the second, and nothing of the second in the first.
    together = np.block([[passed[0], np.zeros((3, 4))], [np.ones((4, 3)), passed[1]]])
    expected = _transition(model, np.eye(6), *whole, together)
    np.testing.assert_allclose(second @ first, expected, rtol=0, atol=1e-13)


@every_latitude
def test_free_growth_is_an_exponential_to_third_order(latitude):
    # Of a polynomial of third degree this is the derivative at zero, for any step.
    step = 300.0
    one, two = (
        free_transition(latitude, k * step) - free_transition(latitude, -k * step) for k in (1, 2)
    )
    rates = (8 * one - two) / (12 * step)
    scale = np.diag([1, 1, 1, 1e-3, 1e-3, 1e-3])  # 1 rad and 1 km/s

    def error(size):
        duration = 64 / EARTH_RATE * size
        difference = free_transition(latitude, duration) - expm(duration * rates)
        return np.abs(scale @ difference @ np.linalg.inv(scale)).max()

    # x = W T up to 1 there, where x^4/24 is not small against x^5/120.
    assert order_of(error) == pytest.approx(4, abs=0.1)
    # Attitudes turn with the local axes and do not push where there is no force.
    np.testing.assert_array_equal(free_transition(latitude, step)[3:, :3], 0)
    many = free_transition(latitude, [[1.0, 2.0], [3.0, step]])
    # Products of many matrices at once may be added up in another order.
    np.testing.assert_allclose(many[1, 1], free_transition(latitude, step), rtol=16 * EPS)


# Noise


def test_process_noise_is_what_many_small_steps_add_up_to():
    """Each small piece of random walk is carried on to the end by the transition matrix."""
    noise, duration, count = NOISE, 2.5, 400
    force = np.array([1.0, -2.0, 9.0])
    expected, step = np.zeros((30, 30)), duration / count
    piece = np.zeros((30, 30))
    piece[:3, :3] = noise.angle_random_walk**2 * step * np.eye(3)
    piece[3:6, 3:6] = noise.velocity_random_walk**2 * step * np.eye(3)
    for left in step * (count - 0.5 - np.arange(count)):
        carry = np.eye(30)
        carry[3:6, :3] = cross_matrix(left * force)
        expected += carry @ piece @ carry.T
    np.testing.assert_array_equal(expected[6:], 0)
    expected = expected[:6, :6]
    found = process_noise(noise, cross_matrix(duration * force), np.asarray(duration))
    # The middles of 400 pieces under a parabola miss 1/(4 * 400^2) of it.
    bound = 2e-6 * np.abs(expected).max()
    np.testing.assert_allclose(found, expected, rtol=0, atol=bound)
    np.testing.assert_array_equal(found, found.T)


def test_process_noise_has_the_spread_of_navigated_noise():
    """Noise put into increments and navigated, against the covariance; one step of 4 s."""
    noise, latitude, runs = ImuNoise(1e-5, 1e-2), np.radians(37.5), 400
    record = turntable_trajectory(Scheme("", dwell=4.0), latitude, 0.1)
    rng = np.random.default_rng(11)
    imu_errors = ImuErrors(*(np.zeros((runs, *shape)) for shape in ((3,), (3, 3), (3,), (3, 3))))
    said = measure(record.increments, imu_errors, noise, rng)
    found = final_state(
        navigate(stationary_state(latitude, np.tile(record.attitude[0], (runs, 1))), said)
    )
    drawn = np.hstack([attitude_error(found.attitude, record.attitude[-1]), found.velocity])
    force = cross_matrix([0, 0, 4 * float(gravity(latitude))])
    covariance = process_noise(noise, force, np.asarray(4.0))
    white = np.linalg.solve(np.linalg.cholesky(covariance), drawn.T)
    values = np.linalg.svd(white / np.sqrt(runs), compute_uv=False)
    # As for the prior, and 1 % for 40 steps in place of white noise.
    assert np.abs(values - 1).max() < np.sqrt(6 / runs) + np.sqrt(28 / runs) + 0.01


def test_process_noise_has_leading_axes():
    rng = np.random.default_rng(12)
    forces, durations = rng.normal(size=(2, 4, 3, 3)), rng.uniform(1, 2, size=(2, 4))
    together = process_noise(NOISE, forces, durations)
    assert together.shape == (2, 4, 6, 6)
    for index in np.ndindex(2, 4):
        alone = process_noise(NOISE, forces[index], durations[index])
        np.testing.assert_allclose(together[index], alone, rtol=0, atol=4 * EPS)
        assert np.linalg.eigvalsh(alone)[0] > -1e-15
