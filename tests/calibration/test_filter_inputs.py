"""What a record says of its start and place before any filter, piece by piece, in closed form."""

from dataclasses import fields
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.constants import degree, hour
from scipy.stats import chi2

from driftlab.calibration._filter_inputs import Evidence, _random_walk, evidence, thinned
from driftlab.earth import EARTH_RATE, earth_rate, gravity
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.increments import Increments
from driftlab.quaternion import (
    conjugate,
    from_rotation_vector,
    rotate,
)

LATITUDE = 0.7
UNTURNED = np.array([0.0, 0.0, 0.0, 1.0])
GRAVITY = float(gravity(LATITUDE))
WINDOW, COUNT = 2.0, 5
ELAPSED = WINDOW * np.arange(COUNT + 1)
MIDDLE = ELAPSED[:-1] + WINDOW / 2
WAY = np.linspace(0.5, 3.0, COUNT)


def up():
    """Mean direction Up in each window, East, North, Up of the time zero, by quadrature."""
    nodes, weights = np.polynomial.legendre.leggauss(5)
    times = MIDDLE[:, np.newaxis] + WINDOW / 2 * nodes
    turned = from_rotation_vector(times[..., np.newaxis] * earth_rate(LATITUDE))
    return 0.5 * np.einsum("j,ijk->ik", weights, rotate(turned, np.array([0.0, 0.0, 1.0])))


def still(force, rate, rest=True):
    """A body that stands as its start says, but for a part of the force and of the rate."""
    return Evidence(
        WINDOW,
        ELAPSED,
        GRAVITY * (up() + force),
        earth_rate(LATITUDE) + np.broadcast_to(rate, (COUNT, 3)),
        np.broadcast_to(rest, COUNT),
        WAY,
    )


def sizes(kind, **given):
    """Deviations of any size, larger than an instrument has."""
    return SimpleNamespace(**({field.name: 0.0 for field in fields(kind)} | given))


def noise(**given):
    return sizes(ImuNoise, **given)


def expected_of(start=UNTURNED, sway=0.0, noise=None, **prior):
    return SimpleNamespace(
        start=start,
        latitude=LATITUDE,
        prior=sizes(PriorStandardDeviations, **prior),
        noise=noise or sizes(ImuNoise),
        reference=np.array([[0.0, -sway, 0.0]]),
    )


LEAST_ANGLE, LEAST_RATE = 3e-4, 0.1 * degree / hour


def test_a_right_record_contradicts_nothing():
    assert still(np.zeros(3), np.zeros(3)).misfit(expected_of()) == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize(
    ("expected", "variance"),
    [
        (expected_of(attitude=0.02), 0.02**2),
        (expected_of(gyro_bias=1e-3), (1e-3 * MIDDLE) ** 2),
        (expected_of(noise=noise(angle_random_walk=0.01)), 0.01**2 * MIDDLE),
        (expected_of(scale_factor=0.01), 0.01**2 * (1 + WAY * (1 + WAY) / 2)),
        (expected_of(installation=0.01), 2 * 0.01**2 * (1 + WAY * (1 + WAY) / 2)),
        (expected_of(accelerometer_bias=0.3), (0.3 / GRAVITY) ** 2),
        (expected_of(noise=noise(velocity_random_walk=0.2)), (0.2 / GRAVITY) ** 2 / WINDOW),
        (expected_of(sway=0.2), (2 * 0.2 / (WINDOW * GRAVITY)) ** 2),
    ],
)
def test_gravity_counts_by_what_may_bend_it(expected, variance):
    off = np.array([0.03, -0.02, 0.01]) * np.arange(1, COUNT + 1)[:, np.newaxis]
    squares = np.sum(off**2, axis=-1) / (variance + LEAST_ANGLE**2)
    found = still(off, np.zeros(3)).misfit(expected)
    assert found == pytest.approx(np.sqrt(squares.mean()), rel=1e-9)


@pytest.mark.parametrize(
    ("expected", "variance"),
    [
        (expected_of(), 0.0),
        (expected_of(gyro_bias=1e-3), 1e-3**2),
        (expected_of(noise=noise(angle_random_walk=1e-3)), 1e-3**2 / WINDOW),
        (expected_of(attitude=0.5), (0.5 * EARTH_RATE) ** 2),
        (expected_of(scale_factor=0.5), (0.5 * EARTH_RATE) ** 2),
        (expected_of(installation=0.5), 2 * (0.5 * EARTH_RATE) ** 2),
    ],
)
@pytest.mark.parametrize("static_intervals", [1, 3, 4, 5])
def test_the_earths_rate_counts_at_three_quarters_of_the_rests(
    expected, variance, static_intervals
):
    sizes = np.array([5.0, 1.0, 4.0, 2.0, 3.0])
    wrong = 2e-3 * sizes[:, np.newaxis] * [0.6, 0.0, -0.8]
    rest = np.arange(COUNT) < static_intervals
    counted = np.sort(sizes[rest])[: int(np.ceil(0.75 * static_intervals))]
    mean = np.mean((2e-3 * counted) ** 2)
    found = still(np.zeros(3), wrong, rest).misfit(expected)
    assert found == pytest.approx(np.sqrt(mean / (variance + LEAST_RATE**2)), rel=1e-9)


def test_a_start_turns_what_the_body_feels():
    start = from_rotation_vector([0.3, -0.4, 0.5])
    plain = still(np.full(3, 1e-3), np.full(3, 1e-6))
    seen = plain._replace(
        force=rotate(conjugate(start), plain.force), rate=rotate(conjugate(start), plain.rate)
    )
    turned, untold = (expected_of(each, attitude=1e-3) for each in (start, UNTURNED))
    assert seen.misfit(turned) == pytest.approx(float(plain.misfit(untold)), rel=1e-9)


def test_means_are_those_of_the_axes_of_the_start():
    """A body that rests, turns by a right angle about its third axis, and rests again."""
    interval, rest, turn = 0.1, 2000, 400
    rate = np.zeros((2 * rest + turn, 3))
    rate[rest : rest + turn, 2] = np.pi / 2 / (turn * interval)
    rate[:rest] += [0.0, 5e-6, 3e-6]
    rate[rest + turn :] += [5e-6, 0.0, 3e-6]
    angle = np.concatenate([np.zeros((1, 3)), np.cumsum(interval * rate, axis=0)])[:, 2]
    middle = (angle[1:] + angle[:-1]) / 2
    force = 9.0 * np.stack([np.cos(middle), -np.sin(middle), np.zeros_like(middle)], axis=-1)
    seen = evidence(Increments(interval, interval * rate, interval * force))
    assert seen.elapsed[0] == 0
    np.testing.assert_allclose(np.diff(seen.elapsed), seen.window, rtol=1e-12)
    assert seen.elapsed[-1] == pytest.approx(interval * len(rate), abs=seen.window)
    assert 90 <= len(seen.force) <= 220
    np.testing.assert_allclose(seen.force, np.broadcast_to([9.0, 0, 0], seen.force.shape), atol=0.3)
    begin, end = interval * rest, interval * (rest + turn)
    before, after = seen.elapsed[1:] <= begin, seen.elapsed[:-1] >= end
    np.testing.assert_allclose(seen.force[before], [[9.0, 0, 0]] * before.sum(), atol=0.02)
    np.testing.assert_allclose(seen.rate[before], [[0, 5e-6, 3e-6]] * before.sum(), atol=1e-8)
    np.testing.assert_allclose(seen.rate[after], [[0, 5e-6, 3e-6]] * after.sum(), atol=1e-7)
    assert seen.rest[before].all()
    assert seen.rest[after].all()
    assert not seen.rest[~before & ~after].any()
    np.testing.assert_allclose(
        seen.way[before], seen.elapsed[1:][before] * np.hypot(5e-6, 3e-6), rtol=1e-9
    )
    way = np.linalg.norm(interval * rate, axis=-1).sum()
    assert seen.way[-1] == pytest.approx(way, rel=1e-4)


def test_nothing_is_said_of_turns_by_more_than_a_right_angle_in_an_interval_and_of_few_rows():
    rows = np.zeros((50, 3))
    rows[7, 1] = 1.001 * np.pi / 2
    assert evidence(Increments(0.1, rows, rows)) is None
    assert evidence(Increments(0.1, rows / 1.002, rows)) is not None
    assert evidence(Increments(0.1, np.zeros((3, 3)), np.zeros((3, 3)))) is None
    few = evidence(Increments(0.1, np.zeros((2, 4, 3)), np.zeros((2, 4, 3))))
    np.testing.assert_array_equal(few.rest, np.zeros((2, 2)))  # of so few, none is called a rest


@pytest.mark.parametrize(
    ("angle", "longest", "count", "many"),
    [
        (0.0, np.inf, 4000, 10),  # at least 400 sums
        (0.0, 0.3, 4000, 3),
        (0.025, np.inf, 4000, 4),
        (0.2, np.inf, 4000, 1),
        (0.0, np.inf, 799, 1),
    ],
)
def test_increments_are_added_up_as_far_as_may_be(angle, longest, count, many):
    rows = np.zeros((count, 3))
    rows[::2, 1], rows[1::2, 1] = angle, -angle
    pushes = np.arange(3.0 * count).reshape(-1, 3)
    found = thinned(Increments(0.1, rows, pushes), longest=longest)
    kept = count // (2 * many) * 2 * many
    assert found.interval == pytest.approx(0.1 * many)
    np.testing.assert_allclose(found.velocity, pushes[:kept].reshape(-1, many, 3).sum(axis=1))
    assert found.angle.shape == found.velocity.shape


# Noise as it is seen in rests


def resting(rows, each, blocks, size):
    """Increments whose blocks in each window differ by plus and minus a size about a mean."""
    pattern = np.where(np.arange(blocks) % 2, -1.0, 1.0).repeat(each // blocks) * blocks / each
    window = np.zeros((each, 3))
    window[: len(pattern), 1] = size * pattern
    return np.tile(window, (rows, 1)) + np.array([3e-4, 0.0, 0.0])


@pytest.mark.parametrize("each", [8, 9, 3])
def test_white_noise_is_that_of_blocks_in_windows_that_rest(each):
    blocks = 4 if each >= 4 else each
    part, freedom = each // blocks, 3 * (blocks - 1)
    rows = resting(40, each, blocks, 1e-5)
    rest = np.arange(40) < 20
    rows[20 * each :] += np.random.default_rng(1).normal(size=(20 * each, 3))  # turns: not asked
    shown = SimpleNamespace(rest=rest, window=0.1 * each)
    sums = rows[:each][: blocks * part].reshape(blocks, part, 3).sum(axis=1)
    square = float(np.sum((sums - sums.mean(axis=0)) ** 2))
    expected = np.sqrt(square / chi2.ppf(0.5, freedom) / (part * 0.1))
    assert _random_walk(rows, shown, 0.1) == pytest.approx(expected, rel=1e-9)
    for count in (1, 2, 3, 4, 5, 6, 10):
        shown.rest = np.arange(40) < count
        assert (_random_walk(rows, shown, 0.1) is None) == (count * freedom < 30)
