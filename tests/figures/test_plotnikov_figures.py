"""The figures of Part IV: what they compute, and what their captions claim."""

import inspect
from math import comb

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.constants import arcminute, arcsecond
from scipy.integrate import solve_ivp
from scipy.stats import beta, binom, chi, chi2, kstest

from driftlab.attitude.coning_algorithms import coning_drift
from driftlab.book.ch09_aligning_a_gyrocompass import experiments as alignments
from driftlab.book.ch10_gyrocompass_at_work import experiments as at_work
from driftlab.book.ch10_gyrocompass_at_work.experiments import dial
from driftlab.book.ch11_one_triad import experiments as capstone
from driftlab.book.machinery.publish import PublishedFigure
from driftlab.book.scenarios import SARATOV_LATITUDE, SPEED, SPEED_UP, TURN, ship_manoeuvre
from driftlab.calibration.simulation import TableTrial
from driftlab.earth import EARTH_RADIUS, EARTH_RATE, gravity
from driftlab.frames import from_euler_angles, navigation_frame_rate, to_euler_angles
from driftlab.gyrocompass.alignment import align
from driftlab.gyrocompass.heading_error import speed_error
from driftlab.gyrocompass.simulation import simulate_compass
from driftlab.imu import NO_ERRORS
from driftlab.motion.trajectory import Trajectory
from driftlab.motion.vehicle import smooth_step, static_imu, vehicle_trajectory
from driftlab.quaternion import from_rotation_vector, multiply, rotate
from published import published
from support import order_of, range_distribution

LATITUDE = SARATOV_LATITUDE
GRAVITY = float(gravity(LATITUDE))
LEVEL_RATE = EARTH_RATE * np.cos(LATITUDE)
SCHULER = float(np.sqrt(GRAVITY / EARTH_RADIUS))
HOURLY = np.pi / 180 / 3600  # degree per hour, rad/s


def largest(values) -> float:
    return float(np.abs(values).max())


def chi_bounds(count: int) -> np.ndarray:
    """Bounds of a mean of `count` squares of normal numbers, passed once in a million draws."""
    return chi2.ppf([0.5e-6, 1 - 0.5e-6], count) / count


# Alignment


@published("09-alignment-budget")
def test_the_budget_is_the_sum_of_its_terms_and_off_in_second_order(
    figure: PublishedFigure,
) -> None:
    data = figure.data
    assert data.bars[:4].sum() == pytest.approx(data.bars[4], rel=1e-12)
    assert (data.bars[:4] != 0).all()

    def gap(size: float) -> float:
        gyro_bias, accelerometer_bias = (
            size * alignments.GYRO_BIAS,
            size * alignments.ACCELEROMETER_BIAS,
        )
        part = alignments.alignment_budget(
            gyro_bias=gyro_bias, accelerometer_bias=accelerometer_bias
        )
        pairs = (part.pitch, part.roll, part.latitude, part.attitude, part.bars[4:])
        return largest([first - exact for first, exact in pairs])

    # A hundred times the default errors, which are some 1e-3 in angles.
    assert order_of(lambda size: gap(100 * size)) == pytest.approx(2, abs=0.1)


@published("09-alignment-budget")
def test_the_budget_of_one_heading_is_on_the_curve_of_all(figure: PublishedFigure) -> None:
    data = figure.data
    for heading in data.headings[::9]:
        here = alignments.alignment_budget(heading=heading)
        place = np.flatnonzero(data.headings == heading)
        np.testing.assert_allclose(here.bars[-2], data.first_order[place], rtol=0, atol=1e-15)
        np.testing.assert_allclose(here.bars[-1], data.exact[place], rtol=0, atol=1e-15)
        # Sensors that turn with the body have the same errors of pitch and roll everywhere.
        assert here.pitch == pytest.approx(data.pitch, abs=1e-15)
        assert here.roll == pytest.approx(data.roll, abs=1e-15)


@published("09-alignment-budget")
def test_the_budget_over_all_headings_is_a_mean_and_one_wave(figure: PublishedFigure) -> None:
    """Body-fixed errors stand still in the tangent of the pitch, and go round in the rest."""
    data = figure.data
    waves = np.stack([np.ones(73), np.cos(data.headings), np.sin(data.headings)], axis=-1)
    fitted, *_ = np.linalg.lstsq(waves, data.first_order)
    np.testing.assert_allclose(waves @ fitted, data.first_order, rtol=0, atol=1e-16)
    assert (np.abs(fitted) > 1e-4).all()
    assert largest(data.exact - data.first_order) < 5e-3 * largest(data.exact)


@published("09-alignment-terms")
def test_each_term_goes_with_its_angle(figure: PublishedFigure) -> None:
    data = figure.data
    east, by_cosine, by_sine, by_latitude = np.moveaxis(data.terms["heading"], -1, 0)
    grid = alignments.GRIDS["heading"]
    assert np.ptp(east) == np.ptp(by_latitude) == 0
    for term, wave in ((by_cosine, np.cos(grid)), (by_sine, np.sin(grid))):
        np.testing.assert_allclose(term, largest(term) * np.sign(term @ wave) * wave, atol=1e-15)
    tangent = np.tan(alignments.GRIDS["pitch"])
    for k in (1, 2):
        term = data.terms["pitch"][:, k]
        np.testing.assert_allclose(term, term[-1] / tangent[-1] * tangent, rtol=1e-12)
    place = alignments.GRIDS["latitude"]
    pull = gravity(place)
    laws = (1 / np.cos(place), 1 / pull, 1 / pull, np.tan(place) / pull)
    for k, law in enumerate(laws):
        term = data.terms["latitude"][:, k]
        np.testing.assert_allclose(term, term[-1] / law[-1] * law, rtol=1e-12)


@published("09-alignment-terms")
def test_the_misprint_is_what_separates_the_printed_formula_from_the_exact_error(
    figure: PublishedFigure,
) -> None:
    data = figure.data
    for panel in ("heading", "pitch"):
        corrected = largest(data.terms[panel].sum(axis=-1) - data.exact[panel])
        assert corrected < 0.01
        assert largest(data.printed[panel] - data.exact[panel]) > 20 * corrected
    for panel, grid in alignments.GRIDS.items():
        place = grid if panel == "latitude" else LATITUDE
        third = data.terms[panel][:, 2]
        expected = data.terms[panel].sum(axis=-1) - third + third * np.tan(place)
        np.testing.assert_allclose(data.printed[panel], expected, rtol=0, atol=1e-13)
    # Where the tangent is one the misprint does not show.
    at_45 = np.isclose(alignments.GRIDS["latitude"], np.pi / 4)
    assert at_45.sum() == 1
    right, wrong = data.terms["latitude"].sum(axis=-1), data.printed["latitude"]
    np.testing.assert_allclose(right[at_45], wrong[at_45], rtol=1e-12)


@published("09-over-the-vertical")
def test_over_the_vertical_the_attitude_keeps_what_heading_and_roll_lose(
    figure: PublishedFigure,
) -> None:
    data = figure.data
    up = data.angles < np.pi / 2
    np.testing.assert_allclose(data.heading[up], alignments.HEADING, atol=1e-12)
    np.testing.assert_allclose(data.heading[~up], alignments.HEADING - np.pi, atol=1e-12)
    np.testing.assert_allclose(data.roll[up], 0, atol=1e-12)
    np.testing.assert_allclose(np.abs(data.roll[~up]), np.pi, atol=1e-12)
    assert largest(data.heading_error) > 30 * largest(data.attitude_error)
    assert largest(data.roll_error) > 30 * largest(data.attitude_error)
    assert (data.together_error[up] < 1.1 * data.attitude_error[up]).all()
    # The error of the attitude does not know where the vertical is.
    assert np.ptp(data.attitude_error) < 0.1 * data.attitude_error.min()


@published("09-over-the-vertical")
def test_over_the_vertical_errors_are_as_large_as_the_first_order_says(
    figure: PublishedFigure,
) -> None:
    """Heading: d - e tan(lat) + s tan(pitch); roll: -s/cos(pitch); s = e cos(psi) + n sin(psi).

    d, e and n are what the errors of the East gyro and of two accelerometers are in angles, and
    independent, of one size in each direction of the body.
    """
    data = figure.data
    gyro_bias = largest(alignments.GYRO_BIAS) / LEVEL_RATE
    accelerometer_bias = largest(alignments.ACCELEROMETER_BIAS) / GRAVITY
    pitch = np.minimum(data.angles, np.pi - data.angles)
    cosine, sine = np.cos(data.heading), np.sin(data.heading)

    def size(by_pitch: np.ndarray) -> np.ndarray:
        east, north = cosine * by_pitch - np.tan(LATITUDE), sine * by_pitch
        return np.sqrt(gyro_bias**2 + accelerometer_bias**2 * (east**2 + north**2))

    low, high = np.sqrt(chi_bounds(data.runs))
    expected = {
        "heading_error": size(np.tan(pitch)),
        "roll_error": accelerometer_bias / np.cos(pitch),
        "together_error": size(np.tan(pitch) - 1 / np.cos(pitch)),
        "attitude_error": np.sqrt(
            gyro_bias**2 + accelerometer_bias**2 * (2 + np.tan(LATITUDE) ** 2)
        ),
    }
    # Half a degree from the vertical tilts of a tenth of a degree are not small.
    small = np.abs(data.angles - np.pi / 2) > np.radians(2)
    for name, law in expected.items():
        ratio = (getattr(data, name) / law)[small]
        assert (low < ratio).all()
        assert (ratio < high).all()


# Averages and restarts


@published("09-averaging-window")
def test_averaging_falls_with_the_square_root_down_to_the_slow_part(
    figure: PublishedFigure,
) -> None:
    data = figure.data
    low, high = np.sqrt(chi_bounds(data.runs - 1))
    # Of the heading, to first order: white noise of a sample, 0.5 deg/h, is 3 degrees of it.
    ratio = data.simulated / data.formula
    assert (low < ratio).all()
    assert (ratio < high).all()
    for white, alone in zip(alignments.WHITE, data.white_alone, strict=True):
        expected = white * HOURLY / np.sqrt(data.windows) / LEVEL_RATE
        np.testing.assert_allclose(alone, expected, rtol=1e-12)
    slow = np.sqrt(data.formula**2 - data.white_alone**2)
    floor = alignments.SLOW * HOURLY / LEVEL_RATE
    x = data.windows * 0.1 / 3600
    # The variance of a mean over x correlation times; a sum for an integral.
    expected = floor * np.sqrt(2 * (x + np.expm1(-x))) / x
    np.testing.assert_allclose(slow[:, 2:], np.tile(expected[2:], (2, 1)), rtol=1e-3)
    assert (slow > 0.9 * floor)[:, :-1].all()


@published("10-restarts")
def test_the_printed_noise_needs_more_than_white_noise(figure: PublishedFigure) -> None:
    """0.06 to 0.5 deg/h become 0.01 to 0.02 in one window only if something slow is left."""
    data = figure.data
    before, after = data.deviations.T / HOURLY
    assert list(before.round(2)) == list(alignments.WHITE)
    assert list(after.round(2)) == [0.01, 0.02]
    white_alone = np.array(alignments.WHITE) / np.sqrt(alignments.MOVING_AVERAGE)
    np.testing.assert_allclose(white_alone, [0.0024, 0.02], rtol=1e-12)
    np.testing.assert_allclose(np.sqrt(after**2 - white_alone**2), 0.01, rtol=0.01)


@published("10-restarts")
def test_restarts_spread_as_their_noise_says(figure: PublishedFigure) -> None:
    data = figure.data
    assert data.heading.shape == (at_work.RESTARTS,)
    expected = data.deviations[0, 1] / LEVEL_RATE
    low, high = chi_bounds(at_work.RESTARTS - 1)
    assert low < data.heading.var(ddof=1) / expected**2 < high
    assert abs(data.heading.mean()) < 4.9 * expected / np.sqrt(at_work.RESTARTS)
    window = np.full(alignments.MOVING_AVERAGE, 1 / alignments.MOVING_AVERAGE)
    direct = np.convolve(data.raw, window, mode="valid")
    np.testing.assert_allclose(data.averaged, direct, rtol=0, atol=1e-12 * data.raw.std())
    low, high = chi_bounds(len(data.raw))
    assert low < (data.raw / data.deviations[1, 0]).var() < high


@published("10-restarts")
def test_the_printed_spread_is_too_large_for_its_deviation(figure: PublishedFigure) -> None:
    """A pair that is so far apart follows a beta law; pairs, counted twice or not, are fewer."""
    data = figure.data
    count = at_work.RESTARTS
    ratio = at_work.PRINTED_SPREAD / at_work.PRINTED_DEVIATION
    pair = beta.sf(ratio**2 / (2 * (count - 1)), 0.5, (count - 2) / 2)
    seen = np.count_nonzero(data.ranges >= ratio)
    assert 0 < seen <= binom.ppf(1 - 1e-6, at_work.TRIALS, comb(count, 2) * pair)
    assert comb(count, 2) * pair < 0.001
    # The law of all of them: times an independent deviation they are ranges.
    rng = np.random.default_rng(1)
    deviations = chi(count - 1).rvs(10000, random_state=rng) / np.sqrt(count - 1)
    found = kstest(data.ranges[:10000] * deviations, range_distribution(count))
    assert found.pvalue > 1e-4
    assert data.ranges.shape == (at_work.TRIALS,)


def test_rounding_is_the_least_and_the_most_that_is_printed_so() -> None:
    low, high = at_work.printed_ratio_range()
    spreads, deviations = np.linspace(0.25, 0.35, 101), np.linspace(0.0535, 0.0545, 101)
    assert {f"{spread:.1f}" for spread in spreads[1:-1]} == {f"{at_work.PRINTED_SPREAD:.1f}"}
    inside = {f"{deviation:.3f}" for deviation in deviations[1:-1]}
    assert inside == {f"{at_work.PRINTED_DEVIATION:.3f}"}
    ratios = spreads[:, np.newaxis] / deviations
    assert (low, high) == pytest.approx((ratios.min(), ratios.max()), rel=1e-12)


# On the dial table


@published("10-static-characteristic")
def test_the_shown_unit_follows_its_formula_within_the_noise_of_three_runs(
    figure: PublishedFigure,
) -> None:
    data = figure.data
    noise = at_work.RANDOM / np.sqrt(dial.RUNS) / LEVEL_RATE
    low, high = chi_bounds(len(at_work.DIAL))
    gap = data.runs.mean(axis=0) - data.formula
    assert low < np.mean(gap**2) / noise**2 < high
    assert abs(gap.mean()) < 4.9 * noise / np.sqrt(len(gap))
    assert largest(data.formula) > 5 * noise
    # It is the unit whose largest error is nearest to the printed one.
    worst = largest(data.runs.mean(axis=0))
    shown = data.largest[at_work.SHOWN]
    printed = np.radians(at_work.PRINTED_LARGEST)
    assert worst == shown[np.abs(shown - printed).argmin()]
    assert worst == pytest.approx(printed, rel=0.01)


@published("10-static-characteristic")
def test_the_printed_error_is_the_median_of_the_shown_drift(figure: PublishedFigure) -> None:
    data = figure.data
    medians = np.degrees(np.median(data.largest, axis=1))
    assert (np.diff(medians) > 0).all()
    nearest = np.abs(medians - at_work.PRINTED_LARGEST).argmin()
    assert nearest == at_work.SHOWN
    assert at_work.LASTING[nearest] == 0.04


def test_without_noise_a_unit_has_one_characteristic() -> None:
    """The drift about East and the dial's zero; levelling is of second order like the rest."""
    rng = np.random.default_rng(7)
    errors, gyro_bias, north = at_work.dial_trial(0.02 * HOURLY, 400, rng, random=0.0)
    assert errors.shape == (400, 3, 25)
    assert np.ptp(errors, axis=1).max() < 1e-15
    np.testing.assert_allclose(errors[..., 0], errors[..., -1], rtol=0, atol=1e-14)
    heading = at_work.DIAL + north
    rates = gyro_bias / LEVEL_RATE
    east = -rates[..., 0] * np.sin(heading) + rates[..., 2] * np.cos(heading)
    # Squares of drifts against the Earth's rate, and of tilts, which a rate about Up also shows.
    size = np.linalg.norm(rates, axis=-1).max() + 2 * at_work.LEVELLING
    assert largest(errors - east - north) < size**2 < 0.1 * largest(east)
    low, high = chi_bounds(gyro_bias.size)
    assert low < np.mean((gyro_bias / (0.02 * HOURLY)) ** 2) < high
    assert 0.95 * np.radians(0.1) < largest(north) <= np.radians(0.1)


# Settling


@published("10-settling")
def test_the_horizon_settles_as_an_oscillator_with_its_damping(figure: PublishedFigure) -> None:
    data = figure.data
    # The envelope falls with exp(-zeta wn t); in a whole period by so much.
    decay, ringing = at_work.FREQUENCY * np.sqrt(0.5), at_work.FREQUENCY * np.sqrt(0.5)
    period = round(2 * np.pi / ringing / at_work.SETTLING_INTERVAL)
    expected = np.exp(-decay * period * at_work.SETTLING_INTERVAL)
    early = slice(10, 60)
    ratio = data.tilt[10 + period : 60 + period] / data.tilt[early]
    # While the tilt is not near one of its zeros; half a degree is a small angle within 1e-2.
    whole = data.tilt[early] > 0.3 * data.tilt[0]
    assert whole.sum() > 10
    np.testing.assert_allclose(ratio[whole], expected, rtol=0.05)
    assert data.tilt[0] == pytest.approx(np.linalg.norm(at_work.TILT), rel=0.05)
    assert data.settling_heading[0] > np.radians(10)
    assert data.settling_heading[-1] < np.radians(1e-5)
    assert data.tilt[-1] < 1e-6 * data.tilt[0]


def test_the_swing_of_many_runs_is_as_large_as_the_formulas_say() -> None:
    data = at_work.settling_and_swing(runs=200)
    assert data.heading.shape == (200, 120)
    low, high = chi_bounds(200)
    ratio = np.mean(data.heading**2, axis=0) / data.deviation**2
    # The tilt at the start of the swing, which the formula leaves out, is (ws/wn)^2/2 of it, and
    # counts most where the cosine is zero; there the noise since then is in the formula alone.
    assert (low < ratio).all()
    assert (ratio < high).all()
    # Beginning and growth are independent, so the mean over the time has twice as many numbers.
    low, high = chi_bounds(400)
    assert low < ratio.mean() < high
    # A whole swing later only what new noise has fed is different.
    period = 2 * np.pi / SCHULER
    begun, later = np.interp([60.0, 60.0 + period], data.times, data.deviation * LEVEL_RATE)
    fed = at_work.RANDOM_WALK * SCHULER * np.sqrt(period / 2)
    assert np.sqrt(later**2 - begun**2) == pytest.approx(fed, rel=0.01)


# Under way


def sail(*voyage, gyro_bias=at_work.GYRO_BIAS, accelerometer_bias=(0.0, 0.0, 0.0), **settings):
    """A compass on a voyage: first the arguments of `ship`, then those of `simulate_compass`."""
    own = {name: settings.pop(name) for name in [*settings] if name in SHIP_ARGUMENTS}
    return simulate_compass(
        ship_manoeuvre(*voyage, **own), gyro_bias, accelerometer_bias, **settings
    )


SHIP_ARGUMENTS = inspect.signature(ship_manoeuvre).parameters
STEP = ship_manoeuvre().increments.interval


@pytest.mark.parametrize("damping", [0.0, 0.3])
def test_a_ship_at_rest_solves_the_equations_of_the_working_compass(damping: float) -> None:
    """2 Lambda' = Lambda∘w - w_eta∘Lambda with both gains, by an integrator of high order."""
    heading, pitch, tilt, factor = 0.4, 0.3, 1e-3, 1.5
    gyro_bias = np.array([0.02, 0.04, -0.03]) * HOURLY
    accelerometer_bias = np.array([1e-3, -2e-3, 5e-4])
    found = sail(
        speed=0.0,
        course=heading,
        turn=0.0,
        gyro_bias=gyro_bias,
        accelerometer_bias=accelerometer_bias,
        tuning_factor=factor,
        damping=damping,
        tilt=tilt,
        pitch=pitch,
    )
    rate, force = static_imu(from_euler_angles(heading, pitch, 0.0), LATITUDE)
    rate, force = rate + gyro_bias, force + accelerometer_bias
    start = align(rate, force)
    # Components turn the other way than the horizon, which leans by the tilt about East.
    bent = multiply(from_rotation_vector([0.0, 0.0, -tilt]), start.attitude)
    integral = factor / EARTH_RADIUS
    proportional = 2 * damping * np.sqrt(GRAVITY * factor / EARTH_RADIUS) / GRAVITY
    azimuth = EARTH_RATE * np.sin(start.latitude)

    def rates(state: np.ndarray) -> np.ndarray:
        north, _, east = rotate(state[:4], force)
        return np.array([state[4] + proportional * east, azimuth, state[5] - proportional * north])

    def moves(_: float, state: np.ndarray) -> np.ndarray:
        north, _, east = rotate(state[:4], force)
        body, horizon = np.append(rate, 0.0), np.append(rates(state), 0.0)
        turn = 0.5 * (multiply(state[:4], body) - multiply(horizon, state[:4]))
        return np.array([*turn, integral * east, -integral * north])

    begin = np.array([*bent, start.level_rate, 0.0])
    times = found.times[:1500]
    # At the end of each interval, and in its middle, for the mean of the proportional part.
    both = np.sort(np.concatenate([times, times - 0.5 * STEP]))
    solved = solve_ivp(moves, (0, times[-1]), begin, "DOP853", both, rtol=1e-11, atol=1e-16).y.T
    middles, ends = solved[0::2], solved[1::2]
    level = np.array([rates(state)[[0, 2]] for state in middles]) - middles[:, 4:] + ends[:, 4:]
    compass = np.arctan2(level[:, 1], level[:, 0])
    yaw = to_euler_angles(ends[:, :4]).heading - heading
    # The step is of second order in what swings with 1.5e-3 rad/s: (4 s times that)^2.
    allowed = (STEP * SCHULER * np.sqrt(factor)) ** 2 * largest(compass)
    for name, expected in (
        ("heading_error", compass + yaw),
        ("compass_error", compass),
        ("yaw_error", yaw),
    ):
        assert largest(getattr(found, name)[:1500] - expected) < allowed
    # What the North accelerometer says too much is levelled away; a drop of it is the first step's.
    north = rotate(from_euler_angles(heading, pitch, 0.0), accelerometer_bias)[0]
    assert found.tilt[0, 1] == pytest.approx(tilt - north / GRAVITY, rel=0.02)
    assert largest(found.speed_error) == 0


def arrays_of(trajectory: Trajectory) -> list[np.ndarray]:
    """All that a trajectory holds, in a row of arrays."""
    parts = *trajectory.increments, trajectory.attitude, trajectory.latitude, trajectory.velocity
    return [np.asarray(part) for part in parts]


def test_a_kept_voyage_is_the_voyage_of_its_own_numbers() -> None:
    numbers = {"latitude": 0.9, "speed": 10.0, "course": 0.3, "turn": 1.0, "interval": 60.0}
    numbers["pitch"] = 0.2
    first = ship_manoeuvre(**numbers)
    assert ship_manoeuvre(**numbers) is first
    times = first.times
    heading = 0.3 + smooth_step(times, *TURN)
    way = 10.0 * smooth_step(times, *SPEED_UP)
    velocity = np.stack([way * np.cos(heading), -way * np.sin(heading)], axis=-1)
    made = vehicle_trajectory(0.9, velocity, heading, 0.2, interval=60.0)
    for ours, right in zip(arrays_of(first), arrays_of(made), strict=True):
        np.testing.assert_array_equal(ours, right)
    for name, value in numbers.items():
        other = ship_manoeuvre(**{**numbers, name: 0.5 * value})
        assert any(
            np.shape(a) != np.shape(b) or np.any(a != b)
            for a, b in zip(arrays_of(first), arrays_of(other), strict=True)
        )
        assert ship_manoeuvre(**{**numbers, name: 0.5 * value}) is other
    with pytest.raises(ValueError, match="read-only"):
        first.velocity[0] = 1.0
    with pytest.raises(ValueError, match="latitude: expected one number, got shape"):
        ship_manoeuvre(latitude=[0.9])


def test_a_perfect_compass_on_a_ship_at_rest_shows_no_error() -> None:
    found = sail(speed=0.0, gyro_bias=np.zeros(3))
    # Of second order in the Earth's turn of one step; the swing shows in the heading as its rate.
    step = (STEP * EARTH_RATE) ** 2
    assert largest(found.tilt) < 0.2 * step
    assert largest(found.heading_error) < 0.2 * step * SCHULER / LEVEL_RATE
    assert largest(found.formula.heading) < 0.2 * step * SCHULER / LEVEL_RATE


def test_a_tilt_of_the_aligned_horizon_swings_about_east() -> None:
    tilt = 1e-5
    found = sail(speed=0.0, turn=0.0, gyro_bias=np.zeros(3), tilt=tilt)
    assert found.tilt[0, 1] == pytest.approx(tilt, rel=1e-3)
    # Its plane turns by half of the Earth's turn about Up, as no pendulum's does.
    turned = 0.5 * EARTH_RATE * np.sin(LATITUDE) * found.times
    expected = tilt * np.cos(SCHULER * found.times) * np.cos(turned)
    np.testing.assert_allclose(found.tilt[:, 1], expected, rtol=0, atol=0.05 * tilt)


def test_a_step_of_four_seconds_is_short_enough_under_way() -> None:
    coarse, half, fine = (sail(interval=step) for step in (4.0, 2.0, 0.1))
    np.testing.assert_allclose(coarse.times, fine.times[39::40])
    for name in ("heading_error", "yaw_error", "compass_error", "tilt"):
        true = getattr(fine, name)
        gap = largest(getattr(coarse, name) - true[39::40])
        # Second order; the heading's error is a quarter of a degree.
        assert gap / largest(getattr(half, name) - true[19::20]) == pytest.approx(4, rel=0.1)
        assert gap < 1e-3 * largest(true)


@published("10-operation")
def test_the_heading_error_under_way_is_what_the_formula_says(figure: PublishedFigure) -> None:
    data = figure.data
    gap = data.heading_error - data.formula.heading
    assert largest(gap) < 4e-3 * largest(data.heading_error)
    np.testing.assert_allclose(data.heading_error, data.yaw_error + data.compass_error, atol=1e-16)
    np.testing.assert_array_equal(data.formula.yaw, -data.yaw_error)


def test_the_formula_holds_at_any_latitude_on_any_course_after_any_turn() -> None:
    """What it leaves is of second order in the angles that there are."""
    rng = np.random.default_rng(17)
    for _ in range(12):
        latitude = float(rng.uniform(-1.2, 1.2))
        run = sail(
            latitude,
            float(rng.uniform(0, 30)),
            *map(float, rng.uniform(-np.pi, np.pi, 2)),
            gyro_bias=1e-7 * rng.normal(size=3),
            accelerometer_bias=3e-4 * rng.normal(size=3),
            pitch=float(rng.uniform(-1.2, 1.2)),
            tilt=1e-4 * float(rng.normal()),
            log=True,
        )
        level = EARTH_RATE * np.cos(latitude)
        # Tilts over the cosine of the pitch, and errors of both level rates over the rate itself.
        angles = largest(run.yaw_error) + 4 * largest(run.tilt)
        angles += largest(np.gradient(run.tilt, run.times, axis=0)) / level + 4e-7 / level
        gap = largest(run.compass_error - run.formula.compass_angle)
        # Products of two of them are less than the square of their sum; and there is the step.
        assert gap < 0.3 * angles**2 + 2e-6
        assert gap < 0.1 * largest(run.compass_error)


def test_the_yaw_runs_away_and_the_compass_angle_takes_it_back() -> None:
    """With a drift about Up alone: the yaw is its sum, and half of it or more is taken back."""
    gyro_bias = 0.5 * HOURLY
    data = sail(speed=0.0, gyro_bias=[0.0, gyro_bias, 0.0])
    expected = gyro_bias * data.times
    # The alignment takes the drift for a higher latitude: U cos(latitude)^2 of it is in the rate.
    place = np.arctan2(EARTH_RATE * np.sin(LATITUDE) + gyro_bias, LEVEL_RATE)
    expected = expected - EARTH_RATE * (np.sin(place) - np.sin(LATITUDE)) * data.times
    assert largest(data.yaw_error - expected) < 0.03 * largest(data.yaw_error)
    # It also starts with the North rate of that latitude, and the swing of that comes on top.
    assert data.compass_error[-1] < -0.4 * data.yaw_error[-1]
    assert largest(data.heading_error) < 0.6 * largest(data.yaw_error)


@published("10-operation")
def test_the_speed_deviation_is_that_of_the_course(figure: PublishedFigure) -> None:
    """North at ten metres a second it is the angle of v/R to U cos(latitude); West almost none."""
    data = figure.data
    northward = data.times == 40 * 60
    place = LATITUDE + 10.0 * (28 * 60 + 60) / EARTH_RADIUS
    expected = -np.arctan2(10.0 / EARTH_RADIUS, EARTH_RATE * np.cos(place))
    np.testing.assert_allclose(data.speed_error[northward], expected, rtol=2e-4)
    assert largest(data.speed_error[data.times > 54 * 60]) < 1e-12
    assert largest(data.speed_error[data.times <= 10 * 60]) == 0
    westward = ship_manoeuvre(LATITUDE, 10.0, 0.0, np.pi / 2, 4.0)
    np.testing.assert_allclose(westward.velocity[-1], [0, -10], atol=1e-12)
    np.testing.assert_allclose(
        data.speed_error, speed_error(westward.latitude[1:], westward.velocity[1:])
    )


@published("10-ballistic-error")
def test_schulers_tuning_with_a_log_has_no_tilt(figure: PublishedFigure) -> None:
    runs = figure.data.runs
    plain, log, stiff, soft, damped = runs.values()
    coriolis = 2 * EARTH_RATE * np.sin(LATITUDE) * SPEED / GRAVITY
    assert 0.3 * coriolis < largest(plain.tilt) < 2.1 * coriolis
    assert largest(log.tilt) < 0.005 * largest(plain.tilt)
    assert largest(log.tilt) < 0.001 * arcminute
    assert largest(log.heading_error) < 0.005 * largest(plain.heading_error)
    for wrong in (stiff, soft, damped):
        assert largest(wrong.tilt) > 8 * largest(plain.tilt)
    assert np.degrees(largest(damped.heading_error)) > 20


def test_a_log_is_of_use_on_every_course_and_in_every_attitude() -> None:
    common = {"speed": 25.0, "course": 2.0, "turn": -1.0, "gyro_bias": np.zeros(3), "pitch": 0.5}
    plain, log, short = (
        sail(**common, **setting) for setting in ({}, {"log": True}, {"log": True, "interval": 2.0})
    )
    assert largest(log.tilt) < 0.005 * largest(plain.tilt)
    # What is left is the step, of second order.
    assert largest(log.tilt) > 3.8 * largest(short.tilt)


@pytest.mark.parametrize("factor", [0.5, 2.0])
def test_a_wrong_tuning_swings_with_the_rate_that_it_misses(factor: float) -> None:
    """(k2 R - 1) v/R when the ship has gathered way, as an amplitude of a swing of its own."""
    run = sail(speed=10.0, turn=0.0, gyro_bias=np.zeros(3), tuning_factor=factor)
    expected = abs(factor - 1) * 10.0 / EARTH_RADIUS / (SCHULER * np.sqrt(factor))
    assert largest(run.tilt[:, 1]) == pytest.approx(expected, rel=0.1)


@published("10-ballistic-error")
def test_a_damped_horizon_takes_the_acceleration_for_a_tilt_at_once(
    figure: PublishedFigure,
) -> None:
    """2 zeta ws/g times the acceleration is a rate, and what it is to the Earth's an angle."""
    damped = list(figure.data.runs.values())[-1]
    gathering = (damped.times > 600) & (damped.times < 720)
    # Fastest in the middle of the smooth step: 15/8 of its mean.
    acceleration = 15 / 8 * SPEED / 120
    rate = 2 * 0.5 * SCHULER / GRAVITY * acceleration
    # On top of it, the swing that is beginning.
    found = largest(np.tan(damped.compass_error[gathering])) * LEVEL_RATE
    assert found == pytest.approx(rate, rel=0.12)


@published("10-operating-formula")
def test_every_term_of_the_operating_formula_is_needed(figure: PublishedFigure) -> None:
    data = figure.data
    full, *without = (largest(gap) for gap in data.gaps)
    run = data.run
    np.testing.assert_allclose(
        data.gaps[0], run.compass_error - run.formula.compass_angle, rtol=0, atol=1e-16
    )
    for gap, term in zip(data.gaps[1:], run.formula, strict=True):
        np.testing.assert_allclose(gap - data.gaps[0], term, rtol=0, atol=1e-16)
    assert min(without) > 1.8 * full
    # What all of them leave is of second order: the square of the angles in play.
    angles = largest(run.yaw_error) + largest(run.tilt) * np.tan(at_work.CRAFT["pitch"])
    assert full < angles**2 < 0.05 * largest(run.compass_error)
    short = simulate_compass(
        ship_manoeuvre(**{**at_work.CRAFT, "interval": 0.5}), **at_work.CRAFT_COMPASS
    )
    assert largest(run.compass_error - short.compass_error[1::2]) < 1e-2 * full


# One triad through all


six = st.tuples(*[st.floats(-1e-3, 1e-3)] * 6).map(np.array)


@given(six)
def test_a_bent_triad_is_a_symmetric_bend_and_a_turn(numbers: np.ndarray) -> None:
    matrix = capstone.bent_triad(numbers[:3], numbers[3:])
    np.testing.assert_allclose(capstone.pairs_and_turn(matrix), numbers, rtol=0, atol=1e-18)
    assert not np.diag(matrix).any()
    rate = np.array([0.3, -0.5, 0.7])
    bend = capstone.bent_triad(numbers[:3], np.zeros(3))
    np.testing.assert_array_equal(bend, bend.T)
    turned = np.cross(numbers[3:], rate)
    np.testing.assert_allclose((matrix - bend) @ rate, turned, rtol=0, atol=1e-18)


@published("11-capstone")
def test_turns_find_the_bend_within_their_noise_and_the_filter_both(
    figure: PublishedFigure,
) -> None:
    data = figure.data
    true, turns, filtered = data.known
    # 0.005 degrees a root hour in 36 s; half of the angle, over pi, is the estimate.
    noise = 0.005 * np.pi / 180 * np.sqrt(36 / 3600)
    assert pytest.approx(noise) == capstone.TURNS.angle_noise
    gap = largest(turns[:3] - true[:3])
    assert 0.05 * noise / (2 * np.pi) < gap < 4.9 * noise / (2 * np.pi)
    assert np.isnan(turns[3:]).all()
    np.testing.assert_allclose(true, [*capstone.NON_ORTHOGONALITY, *capstone.MISALIGNMENT])
    np.testing.assert_allclose(
        filtered - true, capstone.pairs_and_turn(capstone.filter_leftover()), rtol=0, atol=1e-18
    )
    assert largest(filtered - true) < 1.5 * arcsecond


@published("11-capstone")
def test_drift_per_turn_is_that_of_what_is_left(figure: PublishedFigure) -> None:
    """2 pi n^T M n; a pure turn of the triad shows in it only in second order."""
    data = figure.data
    found, left = capstone.bent_triad(*np.split(data.known[0], 2)), capstone.filter_leftover()
    by_turns = capstone.bent_triad(data.known[1, :3], np.zeros(3))
    for row, matrix in zip(data.per_turn, (found, found - by_turns, -left), strict=True):
        expected = 2 * np.pi * np.einsum("ni,ij,nj->n", capstone.AXES, matrix, capstone.AXES)
        # The exact drift has half of the square of what is across as well.
        second = np.pi * np.linalg.norm(matrix, 2) ** 2
        np.testing.assert_allclose(row, expected, rtol=0, atol=1.01 * second)
        assert largest(row) > 10 * second
    np.testing.assert_allclose(
        data.per_turn[0, 3:], 2 * np.pi * capstone.NON_ORTHOGONALITY, rtol=0.01
    )


@published("11-capstone")
def test_alignment_errors_of_the_triad_are_the_exact_ones_in_first_order(
    figure: PublishedFigure,
) -> None:
    data = figure.data
    attitude = from_euler_angles(data.headings, 0.0, 0.0)
    rate, force = static_imu(attitude, LATITUDE)
    bent = capstone.bent_triad(*np.split(data.known[0], 2))
    by_turns = capstone.bent_triad(data.known[1, :3], np.zeros(3))
    matrices = (bent, bent - by_turns, -capstone.filter_leftover())
    for aligned, matrix in zip(data.aligned, matrices, strict=True):
        gap = align(rate + rate @ matrix.T, force).heading - data.headings
        gap = np.angle(np.exp(1j * gap))
        second = (np.linalg.norm(matrix, 2) / np.cos(LATITUDE)) ** 2
        np.testing.assert_allclose(aligned, gap, rtol=0, atol=second)
        assert largest(aligned) > 30 * second
    assert largest(data.aligned[2]) < 0.1 * largest(data.aligned[0])


def test_a_coning_mount_adds_one_drift_at_all_stages() -> None:
    still, shaken = (capstone.calibration_stages(half_angle=angle) for angle in (0.0, 0.02))
    cone = coning_drift("two-step-4", 0.02, capstone.CONING_FREQUENCY, capstone.SAMPLE_INTERVAL)
    # About the right axis, of which East gets the cosine of the heading.
    expected = float(cone) * np.cos(still.headings) / LEVEL_RATE
    for before, after in zip(still.aligned, shaken.aligned, strict=True):
        np.testing.assert_allclose(after - before, expected, rtol=0, atol=1e-15)
    assert largest(expected) > 1e-8
    worse = capstone.calibration_stages(half_angle=0.02, algorithm="picard-1")
    assert largest(worse.aligned[2] - still.aligned[2]) > 10 * largest(expected)


def test_errors_under_way_of_bend_and_turn_add_up() -> None:
    nothing = np.zeros(3)
    whole, bend, turn, none = (
        capstone.calibration_stages(*parts).under_way.heading_error[0]
        for parts in (
            (capstone.NON_ORTHOGONALITY, capstone.MISALIGNMENT),
            (capstone.NON_ORTHOGONALITY, nothing),
            (nothing, capstone.MISALIGNMENT),
            (nothing, nothing),
        )
    )
    # Without errors there is the error of the step, which is in all of them.
    np.testing.assert_allclose(whole + none, bend + turn, rtol=0, atol=1e-3 * largest(whole))
    assert min(largest(bend), largest(turn)) > 50 * largest(none)


@published("11-capstone")
def test_each_calibration_makes_the_heading_under_way_better(figure: PublishedFigure) -> None:
    data = figure.data
    errors = np.degrees([largest(error) for error in data.under_way.heading_error])
    assert errors[1] < 0.5 * errors[0]
    assert errors[2] < 0.02 * errors[1]
    # After the turns the turn of the triad is left, and nothing else to speak of.
    turned = capstone.calibration_stages(np.zeros(3)).under_way.heading_error[0]
    assert largest(data.under_way.heading_error[1] - turned) < 0.02 * largest(turned)


@published("11-capstone")
def test_the_step_is_short_enough_for_the_bent_triad(figure: PublishedFigure) -> None:
    coarse = figure.data
    step = int(coarse.under_way.times[0])
    assert step > 1
    fine = capstone.calibration_stages(interval=1.0).under_way
    np.testing.assert_allclose(coarse.under_way.times, fine.times[step - 1 :: step])
    gap = coarse.under_way.heading_error - fine.heading_error[:, step - 1 :: step]
    # A thousandth of what the bent triad has, in each of the stages.
    assert np.degrees(largest(gap)) < 0.0005
    assert np.degrees(largest(fine.heading_error[0])) == pytest.approx(0.797, abs=0.001)
    assert np.degrees(largest(fine.heading_error[1])) == pytest.approx(0.315, abs=0.001)


def test_what_a_real_calibration_leaves_does_not_depend_on_the_bend() -> None:
    kept = capstone.filter_leftover()
    other = capstone.bent_triad(
        np.array([60.0, -40.0, -50.0]) * arcsecond, np.array([-30.0, 45.0, 10.0]) * arcsecond
    )
    imu_errors = NO_ERRORS._replace(gyro_error=other)
    trial = TableTrial(frame="accelerometers", sample_interval=0.1).run(
        np.random.default_rng(capstone.SEED), imu_errors=imu_errors
    )
    left = trial.calibration.imu_errors.gyro_error - other
    default = capstone.bent_triad(capstone.NON_ORTHOGONALITY, capstone.MISALIGNMENT)
    # The two differ in second order: by the squares of the two bends.
    second = sum(np.linalg.norm(matrix, 2) ** 2 for matrix in (other, default))
    assert largest(left - kept) < 2 * second
    assert largest(kept) > 5 * second
    assert not kept.flags.writeable


def test_the_ship_of_the_figures_turns_with_its_local_axes() -> None:
    """The rate about Up that a log tells: that of the local axes, whose sum the gyros have."""
    way = ship_manoeuvre(LATITUDE, 10.0, 0.5, 0.0, 4.0)
    gyros = rotate(way.attitude[:-1], way.increments.angle).sum(axis=0)
    rates = navigation_frame_rate(way.latitude, way.velocity)
    np.testing.assert_allclose(gyros, 4.0 * 0.5 * (rates[1:] + rates[:-1]).sum(axis=0), rtol=1e-5)
