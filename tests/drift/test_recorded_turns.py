"""Turn estimates from increments: the Earth, bias, noise, errors of angle and axis, refusals."""

import numpy as np
import pytest
from scipy.constants import arcsecond, degree, hour
from scipy.integrate import cumulative_trapezoid, trapezoid
from scipy.spatial.transform import Rotation

from driftlab.attitude import integrate
from driftlab.drift.recorded_turns import fit_error_matrix, recorded_turn_estimate
from driftlab.drift.systematic_drift import drift_coefficient
from driftlab.drift.turn_calibration import earth_rate_offset, exact_turn_estimate, turn_estimate
from driftlab.drift.weighing_designs import PAIR_AXES, YATES_AXES, fit_turns, weighing_estimate
from driftlab.earth import EARTH_RATE
from driftlab.imu import NO_ERRORS, ImuNoise
from driftlab.increments import measure
from driftlab.motion.turntable_rotation import TurntableRotation
from driftlab.quaternion import from_rotation_vector, multiply
from support import order_of

BOTH = np.array([1.0, -1.0])
BENT = np.array([[0, -30, 20], [-30, 0, 30], [20, 30, 0]]) * arcsecond
"""The triad of chapter 16."""
SARATOV, RATE = np.radians(51.5), 2 * np.pi / 36


def senses(
    axes,
    axis=None,
    *,
    gyro_error_matrix=NO_ERRORS.gyro_error_matrix,
    bias=(0, 0, 0),
    samples=720,
    **turn,
):
    """Estimates (2, ...) about `axes` in both senses; the body really turns about `axis`."""
    unit = NO_ERRORS._replace(gyro_error_matrix=gyro_error_matrix, gyro_bias=np.asarray(bias))
    settings = {"rate": RATE, "latitude": SARATOV} | turn
    rate, turns = settings.pop("rate"), settings.get("turns", 1)
    found = []
    for sense in BOTH:
        record = TurntableRotation(sense * rate, **settings).increments(
            axes if axis is None else axis, samples
        )
        found.append(recorded_turn_estimate(measure(record, unit).angle, axes, turns))
    return np.array(found)


@pytest.mark.parametrize(("speed", "found"), [(10, 52.46), (30, 17.49), (60, 8.74)])
def test_a_perfect_triad_on_the_earth(speed, found):
    axes = np.random.default_rng(6).normal(size=(8, 3))
    there, back = senses(axes, rate=np.radians(speed), latitude=np.radians(37.5), samples=3600)
    np.testing.assert_allclose(there / arcsecond, found, rtol=0, atol=0.005)
    np.testing.assert_allclose((there + back) / 2 / arcsecond, 0, atol=3e-8)
    # The tangent of (3.3) adds the cube of the Earth's angle, 360 parts in a thousand million.
    offset = earth_rate_offset(np.radians(37.5), np.radians(speed))
    np.testing.assert_allclose(there, offset, rtol=4e-7)


@pytest.mark.parametrize("turns", [1, 3])
@pytest.mark.parametrize("latitude", [SARATOV, -1.3, 0.1])
def test_the_perfect_triad_in_closed_form(turns, latitude):
    """(3.3) of the Earth's own rotation in the time of the turns, which is exact."""
    time = turns * 2 * np.pi / RATE
    half = EARTH_RATE * time / 2
    expected = np.arctan(np.sin(latitude) * np.tan(half)) / (turns * np.pi)
    found = senses(YATES_AXES, turns=turns, samples=3600 * turns, latitude=latitude)
    np.testing.assert_allclose(found, [[expected] * 4, [-expected] * 4], rtol=0, atol=1e-12)


def test_the_triad_of_chapter_11_its_trap_and_its_cures():
    there, back = senses(YATES_AXES, gyro_error_matrix=BENT)
    np.testing.assert_allclose(there[:3] / arcsecond, [37.44, 87.45, 97.45], rtol=0, atol=0.01)
    yates = weighing_estimate(there * [1, 1, 1, 1.5])
    np.testing.assert_allclose(yates / arcsecond, [-13.14, 36.87, 46.87], rtol=0, atol=0.01)
    offset = fit_turns(there, YATES_AXES, "common")
    np.testing.assert_allclose(offset.sigma / arcsecond, [-30, 20, 30], rtol=0, atol=0.01)
    assert offset.scale_factor == pytest.approx(
        earth_rate_offset(SARATOV, RATE), abs=0.01 * arcsecond
    )
    mean = (there + back)[:3] / 2
    np.testing.assert_allclose(mean / arcsecond, [-30, 20, 30], rtol=0, atol=0.005)


@pytest.mark.parametrize("ramp", [0.0, 2.0])
@pytest.mark.parametrize("rest", [0.0, 7.0])
@pytest.mark.parametrize("seed", range(6))
def test_first_order_of_earth_and_bias_with_ramps_and_rest(ramp, rest, seed):
    """Anywhere on the Earth; what is common to all axes leaves an offset, and no more."""
    rng = np.random.default_rng(seed)
    rate, latitude, turns = rng.uniform(0.1, 1.0), rng.uniform(-1.4, 1.4), int(rng.integers(1, 4))
    bias = rng.uniform(-10, 10, 3) * degree / hour
    bent = rng.uniform(-1, 1, (3, 3)) * 1e-3
    np.fill_diagonal(bent, bent[0, 0])
    there, back = found = senses(
        YATES_AXES, gyro_error_matrix=bent, bias=bias, rate=rate, latitude=latitude, ramp=ramp,
        dwell=rest, turns=turns,
    )  # fmt: skip
    mean_rate = BOTH * TurntableRotation(rate, turns, latitude, ramp=ramp, dwell=rest).mean_rate
    n_b = YATES_AXES @ bias
    offset = earth_rate_offset(latitude, mean_rate)[:, None] + n_b / mean_rate[:, None]
    # Second order: squares and products of the bend, and of the Earth and the bias in a turn.
    size = np.linalg.norm(bent) + (EARTH_RATE + np.linalg.norm(bias)) / mean_rate[0]
    close = {"rtol": 0, "atol": size**2}
    along = drift_coefficient(YATES_AXES, bent)
    np.testing.assert_allclose(found, along + offset, **close)
    np.testing.assert_allclose((there + back) / 2, along, **close)
    fit = fit_turns(there - n_b / mean_rate[0], YATES_AXES, "common")
    sigma = (bent + bent.T)[[0, 0, 1], [1, 2, 2]] / 2
    # Its weights for four estimates have squares that add up to two.
    np.testing.assert_allclose(fit.sigma, sigma, rtol=0, atol=2 * np.sqrt(2) * size**2)


def test_an_error_of_the_angle_is_of_first_order_and_the_same_in_both_senses():
    delta = 20 * arcsecond
    for turns in (1, 2):
        plain, beyond = (
            senses(YATES_AXES, gyro_error_matrix=BENT, turns=turns, angle_error=error)
            for error in (0.0, delta)
        )
        np.testing.assert_allclose(beyond - plain, delta / (2 * np.pi * turns), rtol=1e-3)


def test_a_wrong_zero_mark_reverses_and_cancels_in_the_mean():
    delta = 20 * arcsecond  # counter-clockwise on the dial, whatever the sense of the turn
    beyond, short = (
        senses(YATES_AXES, gyro_error_matrix=BENT, angle_error=sign * delta) for sign in (1, -1)
    )
    plain = senses(YATES_AXES, gyro_error_matrix=BENT)
    there, back = beyond[0] - plain[0], short[1] - plain[1]
    np.testing.assert_allclose(there, delta / (2 * np.pi), rtol=1e-3)
    np.testing.assert_allclose(there + back, 0, atol=1e-3 * delta)


def test_an_error_of_the_axis_does_nothing_to_a_perfect_triad_in_inertial_space():
    near = YATES_AXES + 1e-2 * np.array([1.0, -2.0, 0.5])
    found = senses(YATES_AXES, near, latitude=None)
    np.testing.assert_allclose(found, 0, atol=2e-10)  # the algorithm's own error


def test_an_error_of_the_axis_enters_in_products():
    """With M twice e.Sigma n, the same in both senses; with the Earth its level part, reversed."""
    n, e = np.array([1.0, 1.0, 0.0]) / np.sqrt(2), np.array([0.0, 0.0, 1.0])
    shift = 1e-3
    rng = np.random.default_rng(3)
    axes, ways = np.concatenate([[[n], [e]], rng.normal(size=(2, 5, 3))], axis=1)
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    ways = np.cross(np.cross(axes, ways), axes)
    exact, off = (
        senses(axes, axes + s * ways, gyro_error_matrix=BENT, samples=3600) for s in (0.0, shift)
    )
    change = off - exact
    products = shift * 2 * np.einsum("ni,ij,nj->n", ways, BENT, axes)
    rest = 2 * shift**2 * (ways**2).sum(axis=1) * np.linalg.norm(BENT)
    assert (np.abs(change.mean(axis=0) - products) < rest).all()
    earth = np.abs(BOTH @ change / 2)
    assert (earth < shift * np.linalg.norm(ways, axis=1) * EARTH_RATE / RATE).all()
    assert earth[0] > 0

    def product(size):
        bend = size * BENT / np.abs(BENT).max()
        exact = exact_turn_estimate(n, bend)
        return abs(senses(n, n + size * e, gyro_error_matrix=bend, latitude=None)[0] - exact)

    assert order_of(product) == pytest.approx(2, abs=0.05)


def test_noise_of_an_estimate_is_that_of_the_angle():
    noise, count = ImuNoise(angle_random_walk=1e-6), 2000
    turn = TurntableRotation(RATE, 2, SARATOV)
    record = turn.increments(np.tile([1.0, 2, 2], (count, 1)), 16)
    found = recorded_turn_estimate(
        measure(record, NO_ERRORS, noise, np.random.default_rng(1)).angle, [1, 2, 2], 2
    )
    expected = 1e-6 * np.sqrt(turn.duration) / (4 * np.pi)
    # Five standard deviations of a sample's standard deviation.
    assert found.std() == pytest.approx(expected, rel=5 / np.sqrt(2 * count))


@pytest.mark.parametrize("algorithm", ["two-step-4", "rotation-vector-3", "memory-4", "one-step-3"])
@pytest.mark.parametrize("rows", [720, 721, 722])
def test_every_algorithm_takes_every_number_of_rows(algorithm, rows):
    unit = NO_ERRORS._replace(gyro_error_matrix=BENT)
    record = measure(TurntableRotation(RATE, latitude=SARATOV).increments([1, 1, 0], rows), unit)
    found = recorded_turn_estimate(record.angle, [1, 1, 0], 1, algorithm)
    expected = -30 * arcsecond + earth_rate_offset(SARATOV, RATE)
    # Steps of half a degree: errors of third order are below a hundredth of an arc second.
    assert found == pytest.approx(expected, abs=0.01 * arcsecond)


def test_the_sense_is_read_from_the_record():
    record = TurntableRotation(-RATE, latitude=SARATOV).increments([1, 1, 0], 720).angle
    estimates = [recorded_turn_estimate(record, axis) for axis in ([1, 1, 0], [-1, -1, 0])]
    assert (
        estimates[0] == estimates[1] == pytest.approx(-earth_rate_offset(SARATOV, RATE), rel=1e-5)
    )


@pytest.mark.parametrize(
    ("change", "axis", "turns", "sentence"),
    [
        (np.degrees, [1, 1, 0], 1, r"to 1 within 0\.05, .* along the axis, got 57\.31: "),
        (lambda rows: 20 * rows, [1, 1, 0], 1, r"got 20\.01: "),
        (lambda rows: rows, [1, -1, 0], 1, "got .*e-"),
        (lambda rows: rows, [1, 0, 1], 1, r"got 0\.500.: another axis, degrees, rates, or a re"),
        (lambda rows: rows, [1, 1, 0], 2, r"to 2 within 0\.1, .* got 1: "),
        (lambda rows: rows[:670], [1, 1, 0], 1, r"got 0\.9309: .* or a record that is cut\?$"),
        (lambda rows: rows, [1, 1, 0.1], 1, r"at most 0\.05 turns across .* got 0\.07.*: another"),
        (lambda rows: np.tile(rows, (16, 1))[:-361], [1, 1, 0], 15, r"within 0\.5, .* got 15\.5: "),
        (lambda rows: np.tile(rows, (16, 1)), [1, 1, 0], 15, r"to 15 within 0\.5, .* got 16\."),
    ],
)
def test_a_record_of_something_else_is_refused(change, axis, turns, sentence):
    record = TurntableRotation(RATE, latitude=SARATOV).increments([1, 1, 0], 720).angle
    with pytest.raises(ValueError, match=f"^increments: expected angles in rad .*{sentence}"):
        recorded_turn_estimate(change(record), axis, turns)


def test_one_of_several_records_that_is_cut_is_refused_and_told():
    record = TurntableRotation(RATE, latitude=SARATOV).increments([1, 1, 0], 720).angle
    several = np.stack([record, 0.93 * record, record])
    with pytest.raises(ValueError, match=r"^increments: expected angles .* axis, got 0\.930"):
        recorded_turn_estimate(several, [1, 1, 0])


def test_rows_that_are_left_over_turn_the_body_at_the_end():
    phase = 0.7 * np.arange(37)
    across = 0.02 * np.stack([np.cos(phase), np.sin(phase), np.zeros(37)], axis=-1)
    rows = across + np.array([0.0, 0.0, 2 * np.pi / 37])
    end = multiply(integrate(rows[:36], "two-step-4")[-1], from_rotation_vector(rows[36]))
    found = recorded_turn_estimate(rows, [0, 0, 1], 1, "two-step-4")
    assert found == pytest.approx(float(turn_estimate(end, [0, 0, 1])), abs=1e-14)


def test_rows_as_many_as_an_algorithm_needs_are_enough():
    rows = [[0, 0, np.pi], [0, 0, np.pi]]
    assert recorded_turn_estimate(rows, [0, 0, 1], 1, "rotation-vector-2") == pytest.approx(0)


def test_the_default_is_exact_for_few_rows():
    """On the Earth the axis of the rotation wanders by a ten-thousandth, and no more is lost."""
    record = TurntableRotation(RATE, latitude=SARATOV).increments([1, 1, 0], 36).angle
    truth = earth_rate_offset(SARATOV, RATE)
    assert recorded_turn_estimate(record, [1, 1, 0]) == pytest.approx(truth, abs=1e-9)
    lost = recorded_turn_estimate(record, [1, 1, 0], 1, "two-step-4") - truth
    assert lost / arcsecond == pytest.approx(-1.6, abs=0.1)


def test_too_few_rows_are_refused():
    with pytest.raises(ValueError, match=r"^increments: expected at least 2 rows for rot.*, got 1"):
        recorded_turn_estimate([[0, 0, 2 * np.pi]], [0, 0, 1])


def test_a_triad_of_the_simplest_kind_is_not_refused():
    """Scale factors and cross-coupling of 4 %, and the estimate is their own."""
    for triad in (0.04 * np.eye(3), -0.04 * np.eye(3), 0.04 * np.fliplr(np.eye(3))):
        found = senses(YATES_AXES, gyro_error_matrix=triad).mean(axis=0)
        np.testing.assert_allclose(found, exact_turn_estimate(YATES_AXES, triad), atol=1e-6)


WHOLE = np.array([[4, -30, 20], [5, -6, 30], [-11, 8, 7]]) * arcsecond
SIX_AXES = np.vstack([PAIR_AXES, np.eye(3)])


def sums(axes, unit, **turn):
    """Summed increments (2, m, 3) of turns about `axes` in both directions."""
    return np.array(
        [
            measure(TurntableRotation(rate, **turn).increments(axes, 720), unit).angle.sum(axis=-2)
            for rate in (RATE, -RATE)
        ]
    )


def turned(axes, turns):
    """Axes turned by rotation vectors, sums (2, m, 3) of a perfect triad about them."""
    whole = 2 * np.pi * Rotation.from_rotvec(turns).apply(axes)
    return np.array([whole, -whole])


@pytest.mark.parametrize("turn", [{}, {"ramp": 5.0, "dwell": 7.0}, {"turns": 2}])
@pytest.mark.parametrize(
    "axes", [YATES_AXES[:3], SIX_AXES, np.vstack([2 * np.eye(3), [[1, 2, 3]]])]
)
def test_the_sums_of_both_directions_hold_all_nine_entries(axes, turn):
    """On the Earth, with a bias of 100 degrees an hour; exact but for the rounding of the sums."""
    bias = np.array([100.0, -50.0, 30.0]) * degree / hour
    unit = NO_ERRORS._replace(gyro_error_matrix=WHOLE, gyro_bias=bias)
    records = sums(axes, unit, latitude=SARATOV, **turn)
    fit = fit_error_matrix(*records, axes, turn.get("turns", 1), angle_noise=1e-6)
    # 720 additions round the sum by at most 720 eps; the axes have a condition of 2 or less.
    np.testing.assert_allclose(fit.error_matrix, WHOLE, rtol=0, atol=2 * 720 * np.spacing(1.0))
    np.testing.assert_allclose(fit.residuals, 0, atol=2 * 720 * np.spacing(1.0))


@pytest.mark.parametrize(
    ("axes", "turns", "orders"),
    [
        # A body that sits turned in its fixture: three axes spare the symmetric part.
        (np.eye(3), [[0.3, -0.5, 0.7]], (2, 1)),
        # Axes that err one by one: three spare neither, six spare it if it is weighed along them.
        (np.eye(3), [[0.3, -0.5, 0.7], [0.2, 0.4, -0.1], [0.6, 0.1, 0.3]], (1, 1)),
        (
            SIX_AXES,
            [[0.3, -0.5, 0.7], [0.2, 0.4, -0.1], [0.6, 0.1, 0.3]] * 2,
            (2, 1),
        ),
    ],
)
def test_the_price_of_an_error_of_the_axes(axes, turns, orders):
    def part(sign):
        def error(size):
            records = turned(axes, size * np.array(turns))
            # Noise far below the axis error: what is measured across counts for nothing along.
            fit = fit_error_matrix(*records, axes, angle_noise=1e-12, axis_error=size)
            matrix = fit.error_matrix
            return np.abs(matrix + sign * matrix.T).max()

        return error

    assert order_of(part(1)) == pytest.approx(orders[0], abs=0.05)
    assert order_of(part(-1)) == pytest.approx(orders[1], abs=0.05)


@pytest.mark.parametrize("axes", [np.eye(3), SIX_AXES])
@pytest.mark.parametrize(("noise", "axis"), [(2e-5, 0.0), (2e-5, 3e-6), (1e-6, 1e-4)])
@pytest.mark.parametrize("largest", [0.0, 1e-4, 0.01])
def test_the_covariance_of_all_nine_is_that_of_many_calibrations(axes, noise, axis, largest):
    rng, count = np.random.default_rng(5), 2000
    triad = rng.uniform(-largest, largest, (3, 3))
    true = axes + np.cross(axes, rng.normal(0, axis, (count, len(axes), 3)))
    true /= np.linalg.norm(true, axis=-1, keepdims=True)
    true = true @ (np.eye(3) + triad).T
    both = 2 * np.pi * np.array([true, -true]) + rng.normal(0, noise, (2, *true.shape))
    fit = fit_error_matrix(*both, axes, angle_noise=noise, axis_error=axis)
    errors = (fit.error_matrix - triad).reshape(count, 9)
    # Chi-square of nine: mean 9, variance 18; and each variance. Five standard deviations.
    squares = np.einsum("ni,nij,nj->n", errors, np.linalg.inv(fit.covariance), errors)
    assert squares.mean() == pytest.approx(9, abs=5 * np.sqrt(18 / count))
    ratio = (errors**2).mean(axis=0) / fit.covariance.mean(axis=0).diagonal()
    np.testing.assert_allclose(ratio, 1, atol=5 * np.sqrt(2 / count))


@pytest.mark.parametrize("axes", [np.eye(3), SIX_AXES])
@pytest.mark.parametrize("largest", [0.0, 0.01])
def test_without_noise_the_second_order_is_allowed_for(axes, largest):
    """The covariance is cautious then: at most 9 for the nine, and no less than a third of it."""
    rng, count = np.random.default_rng(6), 2000
    triad = rng.uniform(-largest, largest, (3, 3))
    true = axes + np.cross(axes, rng.normal(0, 1e-3, (count, len(axes), 3)))
    true /= np.linalg.norm(true, axis=-1, keepdims=True)
    whole = 2 * np.pi * true @ (np.eye(3) + triad).T
    fit = fit_error_matrix(whole, -whole, axes, angle_noise=1e-12, axis_error=1e-3)
    errors = (fit.error_matrix - triad).reshape(count, 9)
    squares = np.einsum("ni,nij,nj->n", errors, np.linalg.inv(fit.covariance), errors)
    assert 3 < squares.mean() < 9 + 5 * np.sqrt(18 / count)
    assert ((errors**2).mean(axis=0) < 1.2 * fit.covariance.mean(axis=0).diagonal()).all()


def test_the_covariance_allows_for_axes_near_one_plane():
    """Six axes within a degree of a plane: the error of u is some fifty times that of an axis."""
    rng, count = np.random.default_rng(3), 400
    for error in (10 * arcsecond, 300 * arcsecond):
        round_, up = rng.uniform(0, np.pi, 6), np.radians(rng.uniform(-1, 1, 6))
        axes = np.stack([np.cos(round_), np.sin(round_), np.tan(up)], axis=-1)
        axes /= np.linalg.norm(axes, axis=1, keepdims=True)
        true = axes + np.cross(axes, rng.normal(0, error, (count, 6, 3)))
        whole = 2 * np.pi * true / np.linalg.norm(true, axis=-1, keepdims=True)
        fit = fit_error_matrix(whole, -whole, axes, angle_noise=1e-12, axis_error=error)
        found = fit.error_matrix.reshape(count, 9).std(axis=0)
        # Five standard deviations of a standard deviation, and a fifth for first order.
        assert (found < 1.4 * np.sqrt(fit.covariance.mean(axis=0).diagonal())).all()


@pytest.mark.parametrize(("axes", "stated"), [(np.eye(3), 0.5), (SIX_AXES, 0.26)])
def test_an_error_that_all_axes_share_is_skew_and_not_in_the_covariance(axes, stated):
    error = 60 * arcsecond
    fit = fit_error_matrix(
        *turned(axes, [[error, 0, 0]]), axes, angle_noise=1e-12, axis_error=error
    )
    matrix, covariance = fit.error_matrix, fit.covariance.reshape(3, 3, 3, 3)
    assert (matrix[2, 1] - matrix[1, 2]) / 2 == pytest.approx(error, rel=1e-3)
    variance = covariance[2, 1, 2, 1] + covariance[1, 2, 1, 2] - 2 * covariance[2, 1, 1, 2]
    assert variance / 4 / error**2 == pytest.approx(stated, abs=0.01)


@pytest.mark.parametrize(
    ("ramps", "heading", "arc_seconds"),
    [((2, 2), 0, 0.0), ((2, 2), np.pi, 2.98), ((5, 5), np.pi, 7.40), ((2, 6), 0, 0.34)],
)
def test_ramps_leave_the_level_earth_rate_unless_heading_and_profile_agree(
    ramps, heading, arc_seconds
):
    """Turns at 10 degrees per second at 51.5 degrees North; ramps in seconds."""
    rate = 10 * degree
    time = np.linspace(0, 2 * np.pi / rate + sum(ramps) / 2, 20001)
    pace = np.clip(np.minimum(time / ramps[0], (time[-1] - time) / ramps[1]), 0, 1)
    angle = rate * cumulative_trapezoid(pace, time, initial=0)
    directions = np.exp(1j * angle), np.exp(1j * (heading - angle))
    level = EARTH_RATE * np.cos(51.5 * degree)
    there, back = (level * trapezoid(each, time) for each in directions)
    assert abs(there - back) / (4 * np.pi) / arcsecond == pytest.approx(arc_seconds, abs=5e-3)


def test_larins_number_is_the_part_along_the_axis():
    unit = NO_ERRORS._replace(gyro_error_matrix=WHOLE)
    there, back = sums(SIX_AXES, unit, latitude=None)
    along = np.einsum("mi,mi->m", there - back, SIX_AXES) / (4 * np.pi) - 1
    np.testing.assert_allclose(along, drift_coefficient(SIX_AXES, WHOLE), rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"axes": [[1, 0, 0], [0, 1, 0], [1, 1, 0]]}, "axes: expected three that do not lie in"),
        ({"axes": [1, 0, 0]}, r"axes: expected shape \(m, 3\), got shape \(3,\)"),
        ({"backward": 2 * np.pi * np.eye(3)}, r"backward: .* -1 turns .* within 0\.05, got \(1, 0"),
        ({"forward": 360 * np.eye(3)}, r"forward: expected sums in rad of 1 turns .*or degrees\?"),
        ({"forward": np.ones((2, 3))}, r"forward: expected shape \(..., 3, 3\), got shape \(2, 3"),
        ({"turns": 2}, r"forward: expected sums in rad of 2 turns about the axes within 0\.1, got"),
        ({"angle_noise": 0.0}, "angle_noise: expected a positive number"),
        ({"axis_error": -1.0}, "axis_error: expected"),
    ],
)
def test_sums_of_something_else_are_refused(change, sentence):
    whole = 2 * np.pi * np.eye(3)
    arguments = {"forward": whole, "backward": -whole, "axes": np.eye(3), "angle_noise": 1e-6}
    with pytest.raises(ValueError, match=f"^{sentence}"):
        fit_error_matrix(**(arguments | change))
