"""Calibration by poses: simulated units are found again with the deviations stated, one closed turn
is Larin's estimate, and too few poses are refused."""

from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from driftlab.attitude import CONING_ALGORITHMS, integrate
from driftlab.body_frames import body_frame_rotation, change_body_frame
from driftlab.calibration import FULL, InconsistentCalibrationWarning
from driftlab.calibration.body_axes import POSE_AXES, imu_errors_in_frame
from driftlab.calibration.multi_position import Consistency, _variances, calibrate_multi_position
from driftlab.core.multi_position import (
    UNKNOWNS,
    PoseModel,
    Poses,
    Variances,
    fit_poses,
    row_variance,
)
from driftlab.core.quaternion import conjugate
from driftlab.drift import turn_estimate
from driftlab.earth import EARTH_RATE
from driftlab.imu import NO_ERRORS, ImuErrors, ImuNoise, PriorStandardDeviations
from driftlab.increments import Increments, measure
from driftlab.quaternion import rotate
from driftlab.recordings.recording import Recording
from support import assert_normal, chi_bounds, largest

GRAVITY = 9.81
NOISE = ImuNoise(angle_random_walk=1e-4, velocity_random_walk=1e-3)
QUIET = ImuNoise(angle_random_walk=1e-9, velocity_random_walk=1e-8)
WIDE = PriorStandardDeviations(
    gyro_bias=1e-3, accelerometer_bias=0.1, scale_factor=0.05, installation=0.05
)
RATE, STILL, MOVE = 50.0, 75, 50  # Hz, rows


def unit(seed, size=1.0):
    rng = np.random.default_rng(seed)
    return ImuErrors(
        size * 2e-3 * rng.standard_normal(3),
        size * 0.01 * rng.standard_normal((3, 3)),
        size * 0.1 * rng.standard_normal(3),
        size * 0.01 * rng.standard_normal((3, 3)),
    )


def moved(turns):
    """True increments of a unit that rests, turns by each vector (rad), and rests again."""
    profile = 1 - np.cos(2 * np.pi * (np.arange(MOVE) + 0.5) / MOVE)
    still = np.zeros((STILL, 3))
    rows = [still]
    for turn in turns:
        rows += [profile[:, np.newaxis] * turn / MOVE, still]
    angle = np.concatenate(rows)
    attitude = integrate(angle, "memory-4")
    velocity = rotate(conjugate(attitude), [0.0, 0.0, GRAVITY]) / RATE
    places = [i * (STILL + MOVE) for i in range(len(turns) + 1)]
    return Increments(1 / RATE, angle, velocity), [(b + 2, b + STILL - 2) for b in places]


def log(increments):
    return Recording(increments.angle, increments.velocity, increments.interval, "increments")


@cache
def by_hand(moves=14):
    return moved(np.random.default_rng(2).uniform(-2.5, 2.5, (moves, 3)))


def in_axes(errors, body_axes):
    """True errors in the axes of a choice."""
    if body_axes != "lower triangle accelerometers":
        return imu_errors_in_frame(errors, body_axes)[0]
    turn = body_frame_rotation(errors.accelerometer_error_matrix, frame="lower triangle")
    return errors._replace(
        gyro_error_matrix=change_body_frame(errors.gyro_error_matrix, turn),
        accelerometer_error_matrix=change_body_frame(errors.accelerometer_error_matrix, turn),
    )


@pytest.mark.parametrize("body_axes", POSE_AXES)
def test_a_unit_without_noise_is_found_exactly_in_any_axes(body_axes):
    true, rows = by_hand()
    errors = unit(1)
    record = log(measure(true, errors))
    found = calibrate_multi_position(
        record, rows, gravity=GRAVITY, noise=QUIET, body_axes=body_axes
    )
    for one, other in zip(found.imu_errors, in_axes(errors, body_axes), strict=True):
        # The velocity of a rest, a mean over 71 rows, is exact; the way is off by what the
        # integration loses, some 1e-7 rad at 0.1 rad a step.
        np.testing.assert_allclose(one, other, rtol=0, atol=2e-6)
    fixed = found.covariance.diagonal() < 1e-30
    assert fixed.sum() == (0 if "averaged" in body_axes else 3)
    assert np.linalg.matrix_rank(found.covariance, tol=1e-9 * found.covariance.max()) <= 21


def test_rates_say_what_increments_say():
    true, rows = by_hand()
    errors = unit(1)
    measured = measure(true, errors)
    # Means over an interval stand for the rate in its middle.
    record = Recording(RATE * measured.angle, RATE * measured.velocity, 1 / RATE, "rates")
    stamped = Recording(
        record.gyro,
        record.accelerometer,
        1 / RATE,
        "rates",
        times=5.0 + np.arange(len(record)) / RATE,
    )
    found, again = (
        calibrate_multi_position(r, rows, gravity=GRAVITY, noise=QUIET) for r in (record, stamped)
    )
    truth = in_axes(errors, "accelerometers")
    # The coning that samples lose goes with the square of the step: measured, 3e-4 here.
    assert largest(found.imu_errors.gyro_error_matrix - truth.gyro_error_matrix) < 1e-3
    for one, other in zip(found.imu_errors, again.imu_errors, strict=True):
        np.testing.assert_allclose(one, other, rtol=0, atol=1e-9)


def poses_of(record, rows, closed=()):
    share, feels = 1 / record.interval, record.accelerometer
    moves = np.concatenate([np.r_[a[1] : b[0]] for a, b in pairwise(rows)])
    return Poses(
        force=np.array([share * record.accelerometer[b:e].mean(axis=0) for b, e in rows]),
        rate=np.array([share * record.gyro[b:e].mean(axis=0) for b, e in rows]),
        angle=record.gyro[moves],
        velocity=feels[moves],
        interval=record.interval,
        edges=np.cumsum([0, *(b[0] - a[1] for a, b in pairwise(rows))]),
        gravity=GRAVITY,
        closed=np.array(closed, int).reshape(-1, 2),
        open=np.setdiff1d(np.arange(len(rows) - 1), [i for i, j in closed if j == i + 1]),
        algorithm=CONING_ALGORITHMS["memory-4"].steps,
    )


def test_derivatives_are_those_of_the_residuals():
    """But for the derivatives of the coning correction, a twelfth of the cross product of steps,
    summed up over less than a turn."""
    true, rows = by_hand(moves=5)
    back = moved([[0, 0, 2 * np.pi], [0.4, 0, 0], [0.5, 0.8, 0], [0, -0.6, 1.2]])
    for (increments, places), closed in (((true, rows), ()), (back, [(0, 1)])):
        model = PoseModel(poses_of(log(increments), places, closed))
        at, step = np.zeros(UNKNOWNS), 1e-5
        coning = np.linalg.norm(np.diff(increments.angle, axis=0), axis=-1).max() / 12 * 2 * np.pi
        exact = model.jacobian(at).copy()
        for k in range(UNKNOWNS):
            ahead, behind = at.copy(), at.copy()
            ahead[k] += step
            behind[k] -= step
            slope = (model.residuals(ahead) - model.residuals(behind)) / (2 * step)
            np.testing.assert_allclose(exact[:, k], slope, rtol=1e-6, atol=coning)


def test_the_earths_rate_is_one_vector_as_the_moves_have_turned_the_unit():
    """What it does to the rates at two rests differs by the turn between them."""
    turns = np.array([[0.0, 0.0, 0.4], [0.0, 0.7, 0.0], [1.1, 0.0, 0.0]])
    increments, rows = moved(turns)
    model, none = PoseModel(poses_of(log(increments), rows)), np.zeros((len(rows), 3))
    found = model.covariance(np.zeros(UNKNOWNS), Variances(none, none, np.zeros(len(turns)), 2.0))
    ahead = [np.eye(3)]
    for turn in turns:
        ahead.append(ahead[-1] @ Rotation.from_rotvec(turn).as_matrix())
    into_body = np.concatenate(np.swapaxes(ahead, 1, 2))
    expected = 2.0 * into_body @ into_body.T
    # As far as the integration of the moves is exact.
    np.testing.assert_allclose(found[model.rates, model.rates], expected, rtol=0, atol=1e-8)


RUNS = 30


def with_earth(true, rng):
    """The same on an Earth that turns about an axis of any direction."""
    rate = rng.standard_normal(3)
    rate *= EARTH_RATE / np.linalg.norm(rate)
    attitude = integrate(true.angle, "memory-4")
    return true._replace(angle=true.angle + rotate(conjugate(attitude), rate) / RATE)


@cache
def trials(noise):
    """Errors in their deviations (RUNS, 21), chi-square and freedom of kinds, and bare bias errors.

    The Earth turns. Its rate is as large as the noise of a rest's mean, or thirty times larger.
    """
    true, rows = by_hand()
    errors = unit(4)
    truth = in_axes(errors, "accelerometers")
    rng = np.random.default_rng(8)
    scaled, squares, freedoms, bare = [], np.zeros(3), np.zeros(3), []
    for _ in range(RUNS):
        record = log(measure(with_earth(true, rng), errors, noise, rng))
        found = calibrate_multi_position(record, rows, gravity=GRAVITY, noise=noise)
        wrong = (FULL.state(found.imu_errors) - FULL.state(truth))[6:]
        free = found.covariance.diagonal() > 0
        root = np.linalg.cholesky(found.covariance[np.ix_(free, free)])
        scaled.append(np.linalg.solve(root, wrong[free]))
        tests = list(found.consistency.values())
        squares += [test.chi_square for test in tests]
        freedoms += [test.degrees_of_freedom for test in tests]
        bare.append(found.imu_errors.gyro_bias - truth.gyro_bias)
    return np.array(scaled), squares, freedoms, np.array(bare)


GOOD_GYROS = ImuNoise(angle_random_walk=3e-6, velocity_random_walk=1e-4)
noises = pytest.mark.parametrize("noise", [NOISE, GOOD_GYROS], ids=["cheap", "good"])


@noises
def test_errors_are_as_large_as_the_covariance_says(noise):
    scaled, *_ = trials(noise)
    assert scaled.shape == (RUNS, 21)
    assert_normal(scaled, 1.0)


def test_good_gyros_have_a_bias_without_the_earth():
    """The mean of 15 rests in any pose has a part of the Earth's rate in it, U/sqrt(45)."""
    *_, bare = trials(GOOD_GYROS)
    assert np.sqrt(np.mean(bare**2)) < EARTH_RATE / np.sqrt(45) / 5


@noises
def test_residuals_are_as_large_as_noise_makes_them(noise):
    _, squares, freedoms, _ = trials(noise)
    for total, freedom in zip(squares, freedoms, strict=True):
        low, high = chi_bounds(round(freedom))
        assert low < total / freedom < high


def test_variance_of_rows_is_that_of_their_means():
    samples = np.random.default_rng(3).standard_normal((100, 3)) * [1.0, 2.0, 3.0]
    rows, width = [(0, 42), (50, 90), (92, 97)], 4
    found, colour = row_variance(samples, rows, width)
    squares = [samples[b:e].var(axis=0) * (e - b) for b, e in rows]
    white = np.sum(squares, axis=0) / (41 + 39 + 4)
    # Ten means in each of the first two rests; of the last there is one only.
    means = [samples[b : b + 40].reshape(10, 4, 3).mean(axis=1) for b, _ in rows[:2]]
    slow = 4 * sum(each.var(axis=0, ddof=1) for each in means) / 2
    np.testing.assert_allclose(found, slow, rtol=1e-12)
    assert colour == pytest.approx(slow.sum() / white.sum())
    found, colour = row_variance(samples, rows, 50)
    np.testing.assert_allclose(found, white, rtol=1e-12)
    assert np.isnan(colour)


def test_variances_are_those_of_means_and_of_turns():
    true, rows = by_hand(moves=3)
    noisy = measure(true, NO_ERRORS, NOISE, np.random.default_rng(4))
    poses = poses_of(log(true), rows)
    lengths = np.array([[e - b] for b, e in rows])
    samples = RATE * noisy.angle, RATE * noisy.velocity
    told, colour = _variances(*samples, rows, poses, NOISE)
    np.testing.assert_allclose(told.force, 1e-3**2 * RATE / lengths * np.ones(3))
    np.testing.assert_allclose(told.rate, 1e-4**2 * RATE / lengths * np.ones(3))
    np.testing.assert_allclose(told.move, 1e-4**2 / RATE * np.diff(poses.edges))
    assert told.earth == pytest.approx(EARTH_RATE**2 / 3)
    assert np.isnan(colour).all()
    found, _ = _variances(*samples, rows, poses, None)
    # Two means in each of four rests, of three axes: a chi-square with 12 degrees or more.
    assert 0.3 < np.mean(found.force / told.force) < 2.5
    assert 0.3 < np.mean(found.rate / told.rate) < 2.5


def test_noise_of_the_rests_is_noise_enough():
    """What the rests themselves say of the noise agrees with what was put in: 15 rests of 2 blocks
    of half a second and three axes make 45 degrees of freedom or more, two triads."""
    true, rows = by_hand()
    record = log(measure(true, unit(4), NOISE, np.random.default_rng(1)))
    own = calibrate_multi_position(record, rows, gravity=GRAVITY)
    told = calibrate_multi_position(record, rows, gravity=GRAVITY, noise=NOISE)
    ratio = own.standard_deviations.gyro_error_matrix / told.standard_deviations.gyro_error_matrix
    low, high = np.sqrt(chi_bounds(30))
    assert (ratio > low).all()
    assert (ratio < high).all()
    assert 0.3 < own.colour[0] < 2.5


def test_what_noise_does_not_explain_is_added_and_said():
    true, rows = by_hand()
    rng = np.random.default_rng(5)
    measured = measure(true, unit(4), NOISE, rng)
    velocity = measured.velocity.copy()
    for begin, end in rows:  # each pose has an error of its own, of 0.02 m/s^2
        velocity[begin - 2 : end + 2] += 0.02 / RATE * rng.standard_normal(3)
    found = calibrate_multi_position(
        log(measured._replace(velocity=velocity)), rows, gravity=GRAVITY, noise=NOISE
    )
    test = found.consistency["static_intervals"]
    assert not test.holds
    # Its square is estimated from the 5 or so degrees of freedom that 15 rests leave.
    assert 0.02 / 4 < test.excess < 0.02 * 4
    assert "not noise alone" in found.why


def test_with_what_is_missing_the_noise_explains_the_residuals():
    """Told the excess of each kind beside its noise, the fit finds the same, and nothing missing:
    chi-square is the number of degrees of freedom. The excess is good to a thousandth."""
    true, rows = by_hand()
    rng = np.random.default_rng(5)
    measured = measure(true, unit(4), NOISE, rng)
    angle, velocity = measured.angle.copy(), measured.velocity.copy()
    for begin, end in rows:
        velocity[begin - 2 : end + 2] += 0.02 / RATE * rng.standard_normal(3)
        angle[begin - 2 : end + 2] += 1e-3 / RATE * rng.standard_normal(3)
    for (_, end), (begin, _) in pairwise(rows):
        angle[end + 2 : begin - 2] += 0.02 / MOVE * rng.standard_normal(3)
    record = log(measured._replace(angle=angle, velocity=velocity))
    poses = poses_of(record, rows)._replace(velocity=None)
    told, _ = _variances(RATE * angle, RATE * velocity, rows, poses, NOISE)
    found = fit_poses(poses, told, None, None)
    excess = found.tests[:, 4]
    assert excess.min() > 0
    more = told._replace(
        force=told.force + excess[0] ** 2,
        move=told.move + excess[1] ** 2,
        rate=told.rate + excess[2] ** 2,
    )
    again = fit_poses(poses, more, None, None)
    np.testing.assert_allclose(again.tests[:, 0], again.tests[:, 1], rtol=3e-3)
    assert not again.tests[:, 4].any()
    free = found.covariance.diagonal() > 0
    sizes = np.sqrt(found.covariance.diagonal()[free])
    np.testing.assert_allclose(
        found.unknowns[free] / sizes, again.unknowns[free] / sizes, rtol=0, atol=1e-3
    )
    np.testing.assert_allclose(
        found.covariance[np.ix_(free, free)] / np.outer(sizes, sizes),
        again.covariance[np.ix_(free, free)] / np.outer(sizes, sizes),
        rtol=0,
        atol=1e-3,
    )


def test_what_is_left_is_told_in_sentences():
    true, rows = by_hand()
    record = log(measure(true, unit(3), NOISE, np.random.default_rng(7)))
    found = calibrate_multi_position(record, rows, gravity=GRAVITY, noise=NOISE)
    assert found.longest_move == pytest.approx((MOVE + 4) / RATE)
    assert found.earth_turn == pytest.approx(EARTH_RATE * found.longest_move)
    assert 1 < found.iterations < 100
    assert isinstance(found.iterations, int)
    first, second, third, earth = found.why.split("\n")
    for line, word, values, name in (
        (first, "Gravity at rest", found.force_residuals, "m/s^2"),
        (second, "Gravity or attitude after a move", np.degrees(found.turn_residuals), "degrees"),
        (third, "Gyros at rest", found.rate_residuals, "rad/s"),
    ):
        rms = np.linalg.norm(values) / np.sqrt(values.size)
        assert line.startswith(f"{word}: residuals {rms:.3g} {name} (rms). Chi-square ")
    assert f"by at most {np.degrees(found.earth_turn):.2g} degrees" in earth


@pytest.mark.parametrize(
    ("chi_square", "excess", "words"),
    [
        (3.0, 0.0, "degrees of freedom: less than noise."),
        (7.0, 0.0, "Chi-square 7, 4 to 9 expected of noise with 6 degrees of freedom: noise."),
        (7.0, 0.02, "degrees of freedom: not noise alone, 0.02 were added to its deviation."),
        (30.0, 0.0, "degrees of freedom: more than noise."),
    ],
)
def test_a_test_of_noise_says_what_it_found(chi_square, excess, words):
    test = Consistency(chi_square, 6, 4.0, 9.0, excess)
    assert test.why.endswith(words)
    assert test.holds == (chi_square == 7.0)


def test_gyros_that_feel_force():
    true, rows = by_hand()
    felt = np.random.default_rng(6).normal(0, 1e-4, (3, 3))  # rad/s for 1 m/s^2
    measured = measure(true, unit(4), NOISE, np.random.default_rng(7))
    record = log(measured._replace(angle=measured.angle + true.velocity @ felt.T))
    blind = calibrate_multi_position(record, rows, gravity=GRAVITY, noise=NOISE)
    assert not blind.consistency["rates"].holds
    found = calibrate_multi_position(record, rows, gravity=GRAVITY, noise=NOISE, sensitivity=True)
    assert found.consistency["rates"].holds
    turn = body_frame_rotation(
        None or unit(4).gyro_error_matrix, unit(4).accelerometer_error_matrix, "accelerometers"
    )
    wrong = (found.sensitivity - felt @ turn.T) / found.sensitivity_standard_deviations
    assert largest(wrong) < 4.9  # one in a million, each
    assert not blind.sensitivity.any()


@pytest.mark.parametrize("axis", [[0, 0, 1], [0, 1, 0], [1, 1, 0]])
def test_one_closed_turn_is_larins_estimate_to_first_order(axis):
    """All that a closed turn shows of K is n^T K n, and the estimate is (3.3). The prior takes its
    share of it, the square of 1e-4 rad over 0.05 times 2 pi."""
    n = np.array(axis) / np.linalg.norm(axis)
    true, rows = moved([2 * np.pi * n])
    bent = np.random.default_rng(3).standard_normal((3, 3))

    def difference(size):
        record = log(measure(true, NO_ERRORS._replace(gyro_error_matrix=size * bent)))
        found = calibrate_multi_position(
            record, rows, gravity=GRAVITY, noise=NOISE, prior=WIDE, closed=[(0, 1)]
        )
        way = record.gyro[rows[0][1] : rows[1][0]]
        estimate = turn_estimate(integrate(way, "memory-4")[-1], n)
        return abs(n @ found.imu_errors.gyro_error_matrix @ n - estimate)

    for size in (1e-2, 1e-3, 1e-4):
        assert difference(size) < 20 * size**2


def test_closed_paths_over_several_moves_add_what_gravity_does_not_show():
    """Turns about the vertical tell gravity nothing; that the attitude came back does."""
    turns = np.random.default_rng(2).uniform(-2.5, 2.5, (10, 3))
    back = [[0, 0, 1.5], [0, 1.2, 0], [0, -1.2, 0], [0, 0, -1.5]]
    true, rows = moved([*back, *turns])
    errors = unit(4)
    record = log(measure(true, errors, NOISE, np.random.default_rng(9)))
    truth = in_axes(errors, "accelerometers").gyro_error_matrix
    without, with_path = (
        calibrate_multi_position(record, rows, gravity=GRAVITY, noise=NOISE, closed=closed)
        for closed in ((), [(0, 4)])
    )
    # Two estimates, 1e-4 apart, and each has the deviations of its own place.
    assert (
        with_path.standard_deviations.gyro_error_matrix
        <= without.standard_deviations.gyro_error_matrix * (1 + 1e-4)
    ).all()
    assert len(with_path.turn_residuals) == len(without.turn_residuals) + 1
    wrong = (
        with_path.imu_errors.gyro_error_matrix - truth
    ) / with_path.standard_deviations.gyro_error_matrix
    assert largest(wrong) < 4.9


def test_a_move_counts_by_gravity_unless_it_alone_is_a_closed_path():
    whole = [[0, 0, 2 * np.pi], [2 * np.pi, 0, 0]]
    true, rows = moved([*whole, *np.random.default_rng(2).uniform(-2.5, 2.5, (10, 3))])
    record = log(measure(true, unit(4), NOISE, np.random.default_rng(9)))
    for closed, count in (((), 12), ([(0, 1)], 12), ([(0, 2)], 13), ([(0, 1), (0, 2)], 13)):
        found = calibrate_multi_position(record, rows, gravity=GRAVITY, noise=NOISE, closed=closed)
        assert len(found.turn_residuals) == count


def test_accelerometers_that_are_dead_are_told():
    true, rows = by_hand()
    record = log(true._replace(velocity=np.zeros_like(true.velocity)))
    with pytest.raises(
        ValueError, match=r"^static_intervals: expected accelerometers that feel .* in rest 0"
    ):
        calibrate_multi_position(record, rows, gravity=GRAVITY, noise=NOISE)


def test_too_few_poses_leave_numbers_in_the_dark():
    true, rows = moved([[0.5, 0, 0], [0, 0, 1.0], [-0.4, 0, 0]])
    record = log(measure(true, unit(4), NOISE, np.random.default_rng(1)))
    with pytest.raises(
        ValueError, match=r"^static_intervals: expected poses that show all 21 numbers"
    ) as info:
        calibrate_multi_position(record, rows, gravity=GRAVITY)
    assert "accelerometer bias x" in str(info.value)
    assert "gyro bias" not in str(info.value)  # the rests show it
    found = calibrate_multi_position(record, rows, gravity=GRAVITY, prior=WIDE)
    assert found.standard_deviations.accelerometer_bias[0] == pytest.approx(
        0.1, rel=0.2
    )  # still dark
    assert found.standard_deviations.gyro_bias.max() < 1e-3


@pytest.mark.parametrize(("seed", "most"), [(1, 0.01), (2, 0.002)])
def test_saturated_gyros_are_refused_in_a_sentence(seed, most):
    true, rows = by_hand()
    _, angle, velocity = measure(true, unit(seed), QUIET, 1)
    record = log(Increments(1 / RATE, np.clip(angle, -most, most), velocity))
    with pytest.raises(
        ValueError, match=r"^static_intervals: expected residuals that a fit can settle on"
    ):
        calibrate_multi_position(record, rows, gravity=GRAVITY)


TRUE, ROWS = by_hand()


def test_gravity_of_another_planet_is_warned_of():
    with pytest.warns(
        InconsistentCalibrationWarning, match=r"^gravity: .* got 3\.71 m/s\^2, and they show 9\.8"
    ):
        calibrate_multi_position(log(TRUE), ROWS, gravity=3.71, noise=NOISE)


GOOD = {"recording": log(TRUE), "static_intervals": ROWS, "gravity": GRAVITY, "noise": NOISE}


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"recording": Recording(TRUE.angle, None, 0.02, "increments")}, "^recording: .* without"),
        ({"gravity": None}, "^gravity: expected m/s.2, because the record knows neither"),
        ({"gravity": -9.8}, r"^gravity: expected m/s\^2, 1\.2 to 50, got -9\.8"),
        ({"static_intervals": ROWS[:1]}, "^static_intervals: expected at least two, .* got 1"),
        (
            {"static_intervals": [(0, 500), (500, 900)]},
            "^static_intervals: expected moves between them, got 0 rows",
        ),
        ({"static_intervals": ROWS[::-1]}, "^static_intervals: expected rows in order"),
        (
            {"static_intervals": [*ROWS, (10**6, 10**6 + 9)]},
            "^static_intervals: expected rows in order",
        ),
        ({"body_axes": "mine"}, "^body_axes: expected one of averaged, .*, got 'mine'"),
        ({"closed": [(3, 2)]}, "^closed: expected pairs of rests 0 to 14, the earlier"),
        ({"closed": [(0, 15)]}, "^closed: expected pairs"),
        (
            {"prior": PriorStandardDeviations(scale_factor=0.0)},
            "^prior: expected deviations above zero",
        ),
        ({"gyro_bias": [1.0, 2.0]}, "^gyro_bias: expected shape"),
        ({"gyro_bias": [[1.0, 2.0, 3.0]]}, "^gyro_bias: expected shape"),
    ],
)
def test_refusals(change, words):
    with pytest.raises(ValueError, match=words):
        calibrate_multi_position(**(GOOD | change))


def test_gravity_is_the_records_or_that_of_its_latitude():
    given = Recording(TRUE.angle, TRUE.velocity, 0.02, "increments", gravity=9.7, latitude=0.5)
    place = Recording(TRUE.angle, TRUE.velocity, 0.02, "increments", latitude=0.5)
    assert calibrate_multi_position(given, ROWS, noise=NOISE).gravity == 9.7
    assert 9.78 < calibrate_multi_position(place, ROWS, noise=NOISE).gravity < 9.80
