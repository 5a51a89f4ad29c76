"""What a record says of its start and place before any filter, piece by piece, in closed form."""

from dataclasses import fields
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.constants import arcsecond, degree, g, hour, micro
from scipy.stats import chi2, norm

from driftlab.calibration import FULL, Calibration, InnovationTest
from driftlab.calibration._contradictions import (
    BEYOND,
    Evidence,
    Expected,
    _random_walk,
    _unit,
    beyond_prior,
    contradiction,
    evidence,
    second_order,
    thinned,
)
from driftlab.calibration._doubt import LARGE_BIAS, TAKE_THE_MEAN, _advice
from driftlab.calibration._judge import Judge, Told
from driftlab.calibration._other_starts import headed, levelled, other_starts
from driftlab.calibration._slips import _ORDERS, _interval_slip, _rescaled, _turned
from driftlab.calibration.calibration_history import (
    CONFIDENCE,
    innovation_test,
)
from driftlab.calibration.filter import _normalised_innovations
from driftlab.earth import EARTH_RATE, earth_rate, gravity
from driftlab.imu import ImuNoise, PriorDeviations
from driftlab.increments import Increments
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


def expected_of(sway=0.0, noise=None, **prior):
    return Expected(sizes(PriorDeviations, **prior), noise or sizes(ImuNoise), sway)


LEAST_ANGLE, LEAST_RATE = 3e-4, 0.1 * degree / hour


def test_a_right_record_contradicts_nothing():
    assert still(np.zeros(3), np.zeros(3)).misfit(
        UNTURNED, LATITUDE, expected_of()
    ) == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize(
    ("expected", "variance"),
    [
        (expected_of(attitude=0.02), 0.02**2),
        (expected_of(gyro_bias=1e-3), (1e-3 * MIDDLE) ** 2),
        (expected_of(noise=noise(angle_random_walk=0.01)), 0.01**2 * MIDDLE),
        (expected_of(scale=0.01), 0.01**2 * (1 + WAY * (1 + WAY) / 2)),
        (expected_of(installation=0.01), 2 * 0.01**2 * (1 + WAY * (1 + WAY) / 2)),
        (expected_of(accelerometer_bias=0.3), (0.3 / GRAVITY) ** 2),
        (expected_of(noise=noise(velocity_random_walk=0.2)), (0.2 / GRAVITY) ** 2 / WINDOW),
        (expected_of(sway=0.2), (2 * 0.2 / (WINDOW * GRAVITY)) ** 2),
    ],
)
def test_gravity_counts_by_what_may_bend_it(expected, variance):
    off = np.array([0.03, -0.02, 0.01]) * np.arange(1, COUNT + 1)[:, np.newaxis]
    squares = np.sum(off**2, axis=-1) / (variance + LEAST_ANGLE**2)
    found = still(off, np.zeros(3)).misfit(UNTURNED, LATITUDE, expected)
    assert found == pytest.approx(np.sqrt(squares.mean()), rel=1e-9)


@pytest.mark.parametrize(
    ("expected", "variance"),
    [
        (expected_of(), 0.0),
        (expected_of(gyro_bias=1e-3), 1e-3**2),
        (expected_of(noise=noise(angle_random_walk=1e-3)), 1e-3**2 / WINDOW),
        (expected_of(attitude=0.5), (0.5 * EARTH_RATE) ** 2),
        (expected_of(scale=0.5), (0.5 * EARTH_RATE) ** 2),
        (expected_of(installation=0.5), 2 * (0.5 * EARTH_RATE) ** 2),
    ],
)
@pytest.mark.parametrize("rests", [1, 3, 4, 5])
def test_the_earths_rate_counts_at_three_quarters_of_the_rests(expected, variance, rests):
    sizes = np.array([5.0, 1.0, 4.0, 2.0, 3.0])
    wrong = 2e-3 * sizes[:, np.newaxis] * [0.6, 0.0, -0.8]
    rest = np.arange(COUNT) < rests
    counted = np.sort(sizes[rest])[: int(np.ceil(0.75 * rests))]
    mean = np.mean((2e-3 * counted) ** 2)
    found = still(np.zeros(3), wrong, rest).misfit(UNTURNED, LATITUDE, expected)
    assert found == pytest.approx(np.sqrt(mean / (variance + LEAST_RATE**2)), rel=1e-9)


def test_without_rests_the_rate_says_nothing():
    seen = still(np.zeros(3), np.ones(3), rest=False)
    assert seen.misfit(UNTURNED, LATITUDE, expected_of()) < 1e-9


def test_a_start_turns_what_the_body_feels():
    start = from_rotation_vector([0.3, -0.4, 0.5])
    plain = still(np.full(3, 1e-3), np.full(3, 1e-6))
    seen = plain._replace(
        force=rotate(conjugate(start), plain.force), rate=rotate(conjugate(start), plain.rate)
    )
    prior = expected_of(attitude=1e-3)
    assert seen.misfit(start, LATITUDE, prior) == pytest.approx(
        float(plain.misfit(UNTURNED, LATITUDE, prior)), rel=1e-9
    )


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


def test_a_body_that_turns_slowly_feels_the_same_in_each_window_and_rests_in_it():
    rate = np.repeat([1e-5, 1.5e-3], 2000)[:, np.newaxis] * [0.0, 0.0, 1.0]
    force = np.broadcast_to([0.0, 0.0, 9.0], rate.shape)
    seen = evidence(Increments(0.1, 0.1 * rate, 0.1 * force))
    np.testing.assert_allclose(seen.force, [[0.0, 0.0, 9.0]] * len(seen.force), rtol=0, atol=1e-9)
    begin, end = seen.elapsed[:-1], seen.elapsed[1:]
    np.testing.assert_array_equal(seen.rest, (end <= 200.01) | (begin >= 199.99))


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


# Innovations


def innovations(squares, mean):
    return InnovationTest(np.array(squares), 0.8, 1.2, np.array(mean), 2.0, np.zeros(2), 0.1)


@pytest.mark.parametrize(
    ("squares", "mean", "found"),
    [
        ([1.0, 1.1], [1.0, 1.9], None),
        ([1.0, 1.49], [0.0, 0.0], None),  # a quarter above the bound
        ([1.0, 1.51], [0.0, 0.0], (1, "squared innovations (NIS / 3) from 0.8 to 1.2, got 1.51")),
        ([3.0, 1.0], [0.0, 3.9], (0, "squared innovations (NIS / 3) from 0.8 to 1.2, got 3")),
        ([3.0, 1.0], [0.0, 4.1], (1, "squared mean of the innovations from 0 to 2, got 4.1")),
        ([1.0, 0.9], [2.1, 0.0], (0, "squared mean of the innovations from 0 to 2, got 2.1")),
    ],
)
def test_the_worst_of_both_tests_is_told(squares, mean, found):
    told = contradiction(innovations(squares, mean))
    assert told == (found and (found[0], f"expected {found[1]}"))


def test_normalised_innovations_have_the_nis_for_square():
    rng = np.random.default_rng(2)
    half, innovation = rng.normal(size=(4, 3, 3)), rng.normal(size=(4, 3))
    predicted = half @ np.swapaxes(half, -1, -2)
    found = _normalised_innovations(innovation, predicted, 0.3)
    nis = [
        v @ np.linalg.inv(p + 0.3 * np.eye(3)) @ v
        for v, p in zip(innovation, predicted, strict=True)
    ]
    np.testing.assert_allclose(np.sum(found**2, axis=-1), nis, rtol=1e-12)


def passes(state, deviations=None):
    """What is read of a calibration."""
    return SimpleNamespace(model=FULL, state=np.asarray(state), deviations=deviations)


def test_errors_beyond_the_prior_are_told_in_their_units_the_largest_of_each_kind():
    prior, start = PriorDeviations(), np.array([[0.0, 0.0, 0.0, 1.0]] * 2)
    known = np.sqrt(np.diag(FULL.covariance(prior, start[0])))
    kinds = {
        "gyro bias": (degree / hour, " deg/h"),
        "accelerometer bias": (micro * g, " µg"),
        "gyro scale": (1e-6, " ppm"),
        "gyro installation": (arcsecond, " arc seconds"),
    }
    for kind, (unit, word) in kinds.items():
        first, second = [k for k, name in enumerate(FULL.names) if name.startswith(kind)][:2]
        state = np.zeros((2, 3, FULL.size))
        state[..., :6] = 1.0  # attitude and velocity are no errors of the unit
        state[0, -1, first] = 6.5 * known[first]
        state[1, -1, first], state[1, -1, second] = -6.1 * known[first], 7.0 * known[second]
        run, said = beyond_prior(passes(state), prior, start)
        assert run == 1
        assert said == [
            f"{FULL.names[second]}: found {7 * known[second] / unit:.3g}{word} where the prior "
            f"says {known[second] / unit:.3g}"
        ]
        state[1] = state[0] = 0.0
        state[0, -1, first] = 5.9 * known[first]
        assert beyond_prior(passes(state), prior, start)[1] == []


def test_second_order_is_the_square_of_the_largest_error_over_the_least_deviation():
    scale = [k for k, name in enumerate(FULL.names) if " scale " in name]
    state, deviations = np.zeros((2, 2, FULL.size)), np.full((2, 2, FULL.size), 1e-2)
    deviations[..., scale[0]] = 0.0  # known before
    deviations[:, -1, scale[1]] = [1e-6, 4e-6]
    state[:, -1, scale[2]] = [1e-3, -3e-3]
    state[:, 0] = 1.0  # of the beginning nothing counts
    assert second_order(passes(state, deviations)) == pytest.approx(9e-6 / 4e-6)


# The judge's latitude and advice


class LinearJudge(Judge):
    """One whose filter has innovations that are linear in the latitude."""

    true, slope, rest = 0.5, np.array([[3.0, 0.0, 4.0]]), np.array([[0.8, 5.0, -0.6]])
    steps = (1e-3, 0.1)

    def _run(self, other, model, deviation, longest):
        found = self.slope * (other.latitude - self.true) + self.rest
        return None, SimpleNamespace(innovations=found)


def judge(kind):
    return kind(Told(None, UNTURNED, 0.0), None, np.zeros(1), None, None, FULL, None)


@pytest.mark.parametrize("latitude", [0.45, 0.5, 0.55])
def test_latitude_is_that_of_the_least_innovations(latitude):
    found, deviation = judge(LinearJudge).latitude(Told(None, UNTURNED, latitude))
    assert found == pytest.approx(0.5, abs=1e-9)
    assert deviation == pytest.approx(1 / 5)


@pytest.mark.parametrize("latitude", [-1.5707, 1.5707])
def test_latitude_is_sought_away_from_the_pole_and_a_tenth_of_a_radian_at_a_time(latitude):
    tried = []

    class Near(LinearJudge):
        def _run(self, other, *rest):
            tried.append(other.latitude)
            return super()._run(other, *rest)

    found, _ = judge(Near).latitude(Told(None, UNTURNED, latitude))
    assert found == pytest.approx(latitude + (0.1 if latitude < 0 else -0.1))
    assert max(np.abs(tried)) == abs(latitude)


def test_the_judge_adds_up_to_small_turns_and_measures_every_ten_seconds():
    """A turn of 0.001 rad every 10 ms: a tenth of a second comes before a turn of 0.02 rad."""
    handed = []

    def calibrate(rows, reference, **_):
        handed.append((rows.interval, len(reference)))
        raise ValueError

    rows, ends = np.full((8000, 3), [0.0, 0.0, 1e-3]), np.arange(200, 8001, 200)
    told = Told(Increments(0.01, rows, rows), UNTURNED, 0.5)
    velocity = np.zeros((len(ends), 3))
    judged = Judge(told, velocity, ends, PriorDeviations(), ImuNoise(), FULL, calibrate)
    assert judged.steps == (ImuNoise().reference_velocity, 0.1)
    assert handed == [(pytest.approx(0.1), 8)]


def test_a_latitude_that_shows_in_nothing_is_not_known():
    class Blind(LinearJudge):
        slope = np.zeros((1, 3))

    assert judge(Blind).latitude(Told(None, UNTURNED, 0.3)) == (0.3, np.inf)


@pytest.mark.parametrize(
    ("slips", "certain", "words"),
    [
        (["a?", "b"], None, ": a; or b?"),
        ([], ["c?"], ": c?"),
        (["a"], ["c?", "d?"], ": c; and d; and a?"),
        ([], None, "; no slip is known that explains it. Are the errors larger than"),
    ],
)
def test_advice_has_what_is_certain_first(slips, certain, words):
    assert _advice(PriorDeviations(), slips, certain).startswith(words)


@pytest.mark.parametrize("share", [0.99, 1.0, 1.01])
def test_advice_for_large_biases_is_the_mean_of_two_senses(share):
    prior = SimpleNamespace(gyro_bias=share * LARGE_BIAS)
    assert (TAKE_THE_MEAN in _advice(prior, [])) == (share > 1)


# Likely slips


def test_other_meanings_of_a_start_that_come_to_the_same_are_told_together():
    attitude = from_rotation_vector([0.3, -0.4, 1.0])
    found = dict(other_starts(attitude))
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
    half_turn = dict(other_starts(np.array([1.0, 0.0, 0.0, 0.0])))
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
    seen = still(np.zeros(3), np.zeros(3))
    seen = seen._replace(
        force=rotate(conjugate(true), seen.force), rate=rotate(conjugate(true), seen.rate)
    )
    level = levelled(multiply(wrong, true), seen)
    up_again = rotate(level, seen.force[0])
    np.testing.assert_allclose(up_again / np.linalg.norm(up_again), [0, 0, 1], atol=1e-12)
    start = headed(level, seen, LATITUDE, expected_of())
    turn = to_rotation_vector(multiply(start, conjugate(true)))
    assert np.abs(turn[:2]).max() < 1e-3
    assert abs(turn[2]) <= np.radians(1.01)


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


@pytest.mark.parametrize(("scale", "bound"), [(0.0, 1e-4), (1e-3, BEYOND * 1e-3)])
@pytest.mark.parametrize("sense", [-1, 1])
def test_only_an_interval_that_gravity_contradicts_is_another_one(scale, bound, sense):
    angle, up = np.zeros((4, 3)), np.tile([0.0, 0.0, 0.1 * GRAVITY], (4, 1))

    def intervals(ratio):
        told = Told(Increments(0.1, angle, ratio * up), UNTURNED, LATITUDE)
        tried = _rescaled(told, expected_of(scale=scale))
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


@pytest.mark.parametrize(
    ("ratio", "words"),
    [
        (1.25 * np.pi / 180, ": degrees for radians, or degrees/sqrt(h) for degrees/sqrt(s)?"),
        (np.pi / 180 / 1.25, ": degrees for radians, or degrees/sqrt(h) for degrees/sqrt(s)?"),
        (1.25 * np.pi / 180 / 60, ": degrees/sqrt(h) for rad/sqrt(s)?"),
        (np.pi / 180 / 60 / 1.25, ": degrees/sqrt(h) for rad/sqrt(s)?"),
        (1.35 * np.pi / 180, ""),
        (np.pi / 180 / 1.35, ""),
        (1.0, ""),
    ],
)
def test_noise_that_is_wrong_by_a_unit_of_angle_is_told(ratio, words):
    assert _unit(ratio) == words


# Bounds of the innovations' tests


def kept(rows):
    """A calibration of which only the innovations are asked."""
    nothing = np.zeros(1)
    return Calibration(FULL, *[nothing] * 6, rows)


@pytest.mark.parametrize("count", [2, 40])
def test_bounds_are_quantiles_of_chi_square_and_of_the_normal(count):
    rows = np.random.default_rng(3).normal(size=(count, 3))
    test, chance = innovation_test(kept(rows)), CONFIDENCE
    assert test.squares == pytest.approx(np.mean(rows**2))
    low, high = chi2.interval(chance, 3 * count)
    assert (test.lower, test.upper) == pytest.approx((low / (3 * count), high / (3 * count)))
    assert test.mean == pytest.approx(np.sum(rows.mean(axis=0) ** 2) * count / 3)
    assert test.mean_upper == pytest.approx(chi2.ppf(chance, 3) / 3)
    assert test.correlation == pytest.approx(np.sum(rows[1:] * rows[:-1]) / np.sum(rows**2))
    assert test.correlation_bound == pytest.approx(norm.interval(chance)[1] / np.sqrt(3 * count))
    assert innovation_test(kept(np.zeros((2, 3)))).correlation == 0


def test_without_innovations_nothing_is_tested():
    with pytest.raises(ValueError, match=r"^calibration: expected the innovations of some updates"):
        innovation_test(kept(np.zeros((0, 3))))
    assert Calibration._field_defaults["innovations"].shape == (0, 3)
