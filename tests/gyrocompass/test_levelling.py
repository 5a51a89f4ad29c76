"""The working compass against closed forms, and the paper's error formula against the compass."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from driftlab.core.vectors import left_jacobian
from driftlab.earth import EARTH_RADIUS, EARTH_RATE, gravity
from driftlab.frames import from_euler_angles, navigation_frame_rate
from driftlab.gyrocompass.alignment import align, alignment_errors
from driftlab.gyrocompass.heading_error import operating_heading_error, speed_error
from driftlab.gyrocompass.levelling import (
    LevelFrame,
    LevellingHistory,
    initial_level_frame,
    propagate_level_frame,
)
from driftlab.gyrocompass.levelling_loop import Gains, damped_gains, schuler_gains
from driftlab.increments import Increments
from driftlab.motion.vehicle import smooth_step, static_imu, vehicle_trajectory
from driftlab.quaternion import (
    conjugate,
    from_rotation_vector,
    multiply,
    rotate,
    to_rotation_vector,
)
from support import EPS, replaced, same_rotation

LATITUDE = np.radians(51.5)
GRAVITY = float(gravity(LATITUDE))
AZIMUTH_RATE = EARTH_RATE * np.sin(LATITUDE)
LEVEL_RATE = EARTH_RATE * np.cos(LATITUDE)
SCHULER = np.sqrt(GRAVITY / EARTH_RADIUS)


def at_rest(attitude, duration, interval, drift=(0, 0, 0), offset=(0, 0, 0)):
    """Increments of a body at rest, with errors in body axes."""
    rate, force = static_imu(attitude, LATITUDE)
    count = round(duration / interval)
    rows = (
        np.broadcast_to(interval * (true + np.array(error)), (count, 3))
        for true, error in ((rate, drift), (force, offset))
    )
    return Increments(interval, *rows)


def level_start(attitude=(0.0, 0.0, 0.0, 1.0)):
    """Horizon that is North, Up, East exactly."""
    return LevelFrame(np.array(attitude), np.array([LEVEL_RATE, 0.0]))


def horizon_error(operation, true):
    """Rotation vector (k, 3) from North, Up, East to the components in the modelled horizon."""
    return to_rotation_vector(multiply(operation.attitude, conjugate(true)))


def test_a_perfect_compass_at_rest_stands_still():
    attitude = from_euler_angles(0.7, 0.3, -0.4)
    found = propagate_level_frame(
        level_start(attitude),
        at_rest(attitude, 7200, 10.0),
        schuler_gains(),
        AZIMUTH_RATE,
        every=10,
    )
    assert np.allclose(found.heading, 0.7, atol=1e-9)
    assert np.allclose(found.times, 100.0 * np.arange(1, 73))
    assert np.allclose(np.linalg.norm(found.attitude, axis=-1), 1, atol=1e-14)
    angles = found.yaw_pitch_roll
    assert np.allclose(angles.pitch, 0.3, atol=1e-9)
    assert np.allclose(angles.roll, -0.4, atol=1e-9)


def test_a_tilt_swings_with_schulers_period_and_keeps_its_amplitude():
    tilt = 1e-5
    start = level_start(from_rotation_vector([0.0, 0.0, tilt]))
    period = 2 * np.pi / SCHULER
    duration = 10.0 * round(3 * period / 10)
    found = propagate_level_frame(
        start, at_rest([0, 0, 0, 1], duration, 10.0), schuler_gains(), AZIMUTH_RATE
    )
    error = horizon_error(found, np.array([0, 0, 0, 1.0]))
    # The plane of the swing turns by half of U sin(latitude): a pendulum's would by all of it, but
    # this loop has no Coriolis term.
    turn = 0.5 * AZIMUTH_RATE * found.times
    expected = tilt * np.cos(SCHULER * found.times)
    assert np.abs(error[:, 2] - expected * np.cos(turn)).max() < 0.03 * tilt
    assert np.abs(np.abs(error[:, 0]) - np.abs(expected * np.sin(turn))).max() < 0.03 * tilt


@pytest.mark.parametrize("x", [0.05, 0.3, 0.9])
def test_an_undamped_swing_keeps_its_amplitude_for_a_hundred_periods(x):
    """Free of the Earth's rate; x is the phase of one step."""
    g, tilt = 9.81, 1e-6
    start = LevelFrame(from_rotation_vector([0.0, 0.0, tilt]), np.zeros(2))
    count = round(200 * np.pi / x)
    increments = np.zeros((count, 3)), np.tile([0.0, g, 0.0], (count, 1))
    found = propagate_level_frame(start, Increments(1.0, *increments), Gains(0.0, x**2 / g), 0.0)
    late = to_rotation_vector(found.attitude[-round(7 / x) :])[:, 2]
    # The steps do not meet the extremes: a cosine sampled at x is at least cos(x/2) somewhere.
    assert np.cos(x / 2) * tilt * 0.999 < np.abs(late).max() < 1.2 * tilt


@pytest.mark.parametrize(
    ("x", "damping"),
    [(0.01, 0.05), (0.01, 0.7), (0.01, 3.0), (0.16, 0.05), (0.16, 3.0), (0.7, 0.7), (0.9, 0.05)],
)
def test_tunings_up_to_the_limit_are_stable(x, damping):
    g = 9.8
    gains = damped_gains(x, g, damping)
    start = LevelFrame(from_rotation_vector([0.0, 0.0, 1e-3]), np.zeros(2))
    count = round(40 / (x * min(damping, 1 / damping)))
    increments = np.zeros((count, 3)), np.tile([0.0, g, 0.0], (count, 1))
    found = propagate_level_frame(start, Increments(1.0, *increments), gains, 0.0)
    assert np.abs(to_rotation_vector(found.attitude[-1])).max() < 1e-6


def test_a_spinning_body_at_rest_stays_level():
    """Exact increments of a body that turns by a tenth of a radian in each interval."""
    spin = 0.1 * np.array([1.0, 1.0, 0.5]) / 1.5
    count = 3000
    body = from_rotation_vector(spin * np.arange(count)[:, np.newaxis])
    # Without the Earth's rate; the mean of a vector that stands still while the body turns.
    force = left_jacobian(-spin)
    velocity = np.einsum("ij,nj->ni", force, rotate(conjugate(body), [0.0, GRAVITY, 0.0]))
    found = propagate_level_frame(
        LevelFrame(np.array([0, 0, 0, 1.0]), np.zeros(2)),
        Increments(1.0, np.broadcast_to(spin, (count, 3)), velocity),
        damped_gains(0.05, GRAVITY),
        0.0,
    )
    true = from_rotation_vector(spin * np.arange(1, count + 1)[:, np.newaxis])
    assert np.abs(horizon_error(found, true)[-500:]).max() < 2e-6


def test_a_horizon_that_turns_fast_is_turned_exactly():
    """Half a tenth of a radian in each interval, against SciPy's rotations."""
    found = propagate_level_frame(
        LevelFrame(np.array([0.1, 0.2, 0.3, 0.9]), np.array([0.04, -0.03])),
        Increments(1.0, np.broadcast_to([0.3, -0.2, 0.1], (50, 3)), np.zeros((50, 3))),
        Gains(0.0, 0.0),
        0.007,
    )
    horizon = Rotation.from_rotvec([0.04, 0.007, -0.03])
    body = Rotation.from_rotvec([0.3, -0.2, 0.1])
    expected = Rotation.from_quat([0.1, 0.2, 0.3, 0.9])
    for attitude in found.attitude:
        expected = horizon.inv() * expected * body
        assert same_rotation(attitude, expected.as_quat(), 1e-10)
        assert np.linalg.norm(attitude) == pytest.approx(1, abs=1e-12)


@pytest.mark.parametrize("damping", [0.5, np.sqrt(0.5), 1.5])
def test_the_damped_loop_is_a_linear_oscillator(damping):
    frequency, tilt = 0.02, 1e-5
    start = level_start(from_rotation_vector([0.0, 0.0, tilt]))
    found = propagate_level_frame(
        start,
        at_rest([0, 0, 0, 1], 600, 0.1),
        damped_gains(frequency, GRAVITY, damping),
        AZIMUTH_RATE,
    )
    error = horizon_error(found, np.array([0, 0, 0, 1.0]))[:, 2]
    # x'' + 2 zeta wn x' + wn^2 x = 0, x(0) = tilt, x'(0) = -2 zeta wn tilt.
    roots = frequency * (-damping + np.sqrt(complex(damping**2 - 1)) * np.array([1, -1]))
    pair = np.linalg.solve([[1, 1], roots], [tilt, -2 * damping * frequency * tilt])
    expected = (pair * np.exp(np.outer(found.times, roots))).sum(axis=1).real
    assert np.abs(error - expected).max() < 0.005 * tilt


def test_accelerated_alignment_ends_where_the_trigonometric_one_does():
    attitude = from_euler_angles(0.5, 0.1, -0.2)
    drift, offset = np.radians([0.02, -0.03, 0.04]) / 3600, np.array([3e-4, -2e-4, 4e-4])
    rate, force = static_imu(attitude, LATITUDE)
    goal = align(rate + drift, force + offset)
    # Set out 0.5 and 0.4 degrees out of level and without knowing where North is.
    bent = multiply(from_rotation_vector(np.radians([0.5, 40.0, 0.4])), goal.attitude)
    gains = damped_gains(0.02, GRAVITY)
    azimuth_rate = EARTH_RATE * np.sin(goal.latitude)
    found = propagate_level_frame(
        LevelFrame(bent, np.zeros(2)),
        at_rest(attitude, 3600, 0.1, drift, offset),
        gains,
        azimuth_rate,
        every=600,
    )
    # The biased vertical rate is not U sin of the aligned latitude exactly, so the horizon turns
    # slowly in azimuth. The force that must turn the integrals lags them behind it by k1/k2.
    vertical = rotate(goal.attitude, rate + drift)[1]
    lag = gains.proportional / gains.integral * (vertical - azimuth_rate)
    assert 1e-6 < abs(lag) < 1e-5
    assert found.heading[-1] - goal.heading == pytest.approx(lag, rel=1e-3)
    whole = np.arctan2(*found.horizon_rate[-1, ::-1]) + found.yaw_pitch_roll.heading[-1]
    assert whole == pytest.approx(goal.heading, abs=1e-9)
    assert found.yaw_pitch_roll.pitch[-1] == pytest.approx(goal.pitch, abs=1e-7)
    assert found.yaw_pitch_roll.roll[-1] == pytest.approx(goal.roll, abs=1e-7)
    formula = alignment_errors(
        0.5,
        0.1,
        LATITUDE,
        *(rotate(attitude, error) for error in (drift, offset)),
    )
    assert found.heading[-1] - 0.5 == pytest.approx(formula.heading, rel=0.01)


def manoeuvre(integral, north=10.0, east=0.0):
    """Compass and truth of a ship that gathers way within two minutes."""
    interval = 1.0
    rise = smooth_step(interval * np.arange(7201), 600, 120)
    way = vehicle_trajectory(
        LATITUDE, np.stack([north * rise, east * rise], axis=-1), 0.3, interval=interval
    )
    found = propagate_level_frame(
        level_start(way.attitude[0]),
        way.increments,
        Gains(0.0, integral),
        AZIMUTH_RATE,
    )
    return found, way


def test_schulers_tuning_has_no_ballistic_error():
    found, way = manoeuvre(1 / EARTH_RADIUS)
    after = found.times > 720
    error = horizon_error(found, way.attitude[1:])[:, [0, 2]]
    # What is left is Coriolis: with the Earth's turn and the ship's, 2 U sin(latitude) v.
    coriolis = 2 * AZIMUTH_RATE * 10.0 / GRAVITY
    assert np.abs(error[~after]).max() < 0.1 * coriolis
    assert np.abs(error).max() < 2.1 * coriolis
    for factor in (0.5, 2.0):
        wrong, way = manoeuvre(factor / EARTH_RADIUS)
        swing = horizon_error(wrong, way.attitude[1:])[:, 2]
        # The horizon's rate is off by (factor - 1) v/R when the ship has gathered way.
        expected = abs(factor - 1) * 10.0 / EARTH_RADIUS / (SCHULER * np.sqrt(factor))
        assert np.abs(swing).max() == pytest.approx(expected, rel=0.1)
        assert np.abs(swing).max() > 3 * np.abs(error).max()


def test_the_azimuth_channel_is_open_and_the_heading_is_not():
    """A drift about Up adds up in the yaw; the compass angle takes it back."""
    drift = np.radians(0.05) / 3600
    found = propagate_level_frame(
        level_start(),
        at_rest([0, 0, 0, 1], 7200, 1.0, drift=(0, drift, 0)),
        schuler_gains(),
        AZIMUTH_RATE,
    )
    yaw = found.yaw_pitch_roll.heading
    assert np.abs(yaw - drift * found.times).max() < 0.005 * yaw.max()
    # The compass follows the drift with a Schuler swing of its own.
    assert np.allclose(
        found.heading, drift / SCHULER * np.sin(SCHULER * found.times), atol=0.02 * drift / SCHULER
    )


def piecewise(start, angle, velocity, interval, gains, way, piece=100):
    """Level rates (k, 2), yaws, and tilts (k, 2) along a way, the azimuth rate told by pieces.

    So the yaw runs away by what the case under test does to it, and by nothing else.
    """
    runs = []
    for first in range(0, len(angle), piece):
        here = slice(first, first + piece)
        middle = first + piece // 2
        rate = navigation_frame_rate(way.latitude[middle], way.velocity[middle])[1]
        runs.append(
            propagate_level_frame(
                start, Increments(interval, angle[here], velocity[here]), gains, rate
            )
        )
        start = runs[-1].last
    attitude = np.concatenate([run.attitude for run in runs])
    rates = np.concatenate([run.rate for run in runs])
    yaw = np.concatenate([run.yaw_pitch_roll.heading for run in runs])
    # The horizon is turned by minus the vector that turns the components.
    tilt = -to_rotation_vector(multiply(attitude, conjugate(way.attitude[1:])))[:, [0, 2]]
    return rates, yaw, tilt


@pytest.mark.parametrize("case", ["drift", "offset", "tilt", "tuning", "everything"])
def test_the_operating_formula_term_by_term_against_the_nonlinear_simulation(case):
    """A fast craft gathers way and turns, bow up; the formula gets the tilts that really were."""
    interval, pitch = 0.5, 1.2
    times = interval * np.arange(7201)
    heading = 0.4 + 1.2 * smooth_step(times, 1500, 300)
    speed = 30 * smooth_step(times, 400, 120)
    course = np.stack([speed * np.cos(heading), -speed * np.sin(heading)], axis=-1)
    way = vehicle_trajectory(LATITUDE, course, heading, pitch, interval=interval)
    # Errors given in local axes, so that it is known which they are.
    drift, offset, tilt, factor = np.zeros(3), np.zeros(3), np.zeros(3), 1.0
    if case in ("drift", "everything"):
        drift = np.radians([0.03, 0.05, -0.04]) / 3600
    if case in ("offset", "everything"):
        offset = np.array([2e-4, 0.0, -3e-4])
    if case in ("tilt", "everything"):
        tilt = np.array([1e-4, 2e-3, -5e-5])
    if case in ("tuning", "everything"):
        factor = 1.02
    to_body = conjugate(way.attitude[:-1])
    begin = multiply(from_rotation_vector(tilt), way.attitude[0])
    rates, yaw, tilts = piecewise(
        LevelFrame(begin, np.array([LEVEL_RATE, 0.0])),
        way.increments.angle + interval * rotate(to_body, drift),
        way.increments.velocity + interval * rotate(to_body, offset),
        interval,
        Gains(0.0, factor / EARTH_RADIUS),
        way,
    )
    yaw_error = yaw - heading[1:]
    formula = operating_heading_error(
        way.latitude[1:],
        way.velocity[1:],
        tilts,
        np.gradient(tilts, interval, axis=0),
        drift[[0, 2]],
        yaw_error,
        heading[1:],
        pitch,
    )
    true_rates = navigation_frame_rate(way.latitude[1:], way.velocity[1:])[:, [0, 2]]
    simulated = np.arctan2(rates[:, 1], rates[:, 0]) - speed_error(
        way.latitude[1:], way.velocity[1:]
    )
    # The formula is of first order: what it leaves is of second order in the angles.
    angles = np.linalg.norm(rates - true_rates, axis=-1) / LEVEL_RATE + np.abs(yaw_error)
    second_order = (angles.max() + np.abs(tilts).max() * np.tan(pitch)) ** 2

    def gap(expected):
        return np.abs(simulated - expected)[1:-1].max()

    assert gap(formula.compass_angle) < second_order
    assert second_order < 0.05 * np.abs(simulated).max()
    total = simulated + yaw_error
    assert np.abs(total - formula.heading)[1:-1].max() < second_order
    if case == "everything":
        # Each term is needed, the last two included.
        for term in formula:
            assert gap(formula.compass_angle - term) > 3 * gap(formula.compass_angle)


@pytest.mark.parametrize("number", [3, 9])
def test_many_runs_at_once_are_each_what_it_is_alone(number):
    rng = np.random.default_rng(4)
    tilts = from_rotation_vector(1e-4 * rng.normal(size=(number, 1, 3)))
    angle = 1e-3 * rng.normal(size=(2, 40, 3))
    velocity = 0.1 * np.array([0, GRAVITY, 0]) + 1e-3 * rng.normal(size=(2, 40, 3))
    gains = damped_gains(0.05, GRAVITY)
    rate = np.array([LEVEL_RATE, 1e-6])
    together = propagate_level_frame(
        LevelFrame(tilts, rate), Increments(0.1, angle, velocity), gains, AZIMUTH_RATE, every=4
    )
    assert together.attitude.shape == (number, 2, 10, 4)
    assert together.rate.shape == (number, 2, 10, 2)
    for i in range(number):
        for j in range(2):
            alone = propagate_level_frame(
                LevelFrame(tilts[i, 0], rate),
                Increments(0.1, angle[j], velocity[j]),
                gains,
                AZIMUTH_RATE,
                every=4,
            )
            assert np.allclose(alone.attitude, together.attitude[i, j], rtol=0, atol=1e-15)
            bound = 40 * EPS * np.abs(alone.rate).max()  # steps, each rounded
            assert np.allclose(alone.rate, together.rate[i, j], rtol=1e-12, atol=bound)
            assert np.allclose(alone.last.rate, together.last.rate[i, j], rtol=1e-12)


@pytest.mark.parametrize("lead", [(), (2,), (7, 2)])
def test_a_horizon_that_cannot_follow_is_refused_in_one_run_and_in_many(lead):
    # Upside down under two g the proportional part divides by zero.
    velocity = np.broadcast_to([0.0, -19.6, 0.0], (*lead, 4, 3))
    start = LevelFrame([0.0, 0.0, 0.0, 1.0], [0.0, 0.0])
    with np.errstate(all="ignore"), pytest.raises(ValueError, match="that a horizon can follow"):
        propagate_level_frame(
            start, Increments(1.0, np.zeros((4, 3)), velocity), Gains(1 / 9.8, 0.0), 0.0
        )


@pytest.mark.parametrize("gains", [damped_gains(0.02, GRAVITY), schuler_gains()])
def test_a_run_in_two_parts_is_one_run(gains):
    rows = at_rest([0.1, 0.2, 0.3, 0.9], 400, 1.0, drift=(1e-7, 0, 2e-7))
    whole = propagate_level_frame(level_start(), rows, gains, AZIMUTH_RATE)
    first = propagate_level_frame(level_start(), rows.part(0, 150), gains, AZIMUTH_RATE)
    second = propagate_level_frame(first.last, rows.part(150, 400), gains, AZIMUTH_RATE)
    assert np.allclose(second.attitude[-1], whole.attitude[-1], rtol=0, atol=1e-13)


@pytest.mark.parametrize("gains", [Gains(0.0, 1e-4), damped_gains(0.05, GRAVITY)])
def test_the_step_is_of_second_order(gains):
    """On a ship that gathers way and turns, against a run with a very short step."""

    def end(interval):
        times = interval * np.arange(round(64 / interval) + 1)
        rise = smooth_step(times, 4.0, 40.0)
        way = vehicle_trajectory(
            LATITUDE, np.stack([10 * rise, -5 * rise], axis=-1), 0.5 * rise, interval=interval
        )
        return propagate_level_frame(level_start(), way.increments, gains, AZIMUTH_RATE).attitude[
            -1
        ]

    fine = end(2.0**-6)
    coarse, half = (np.abs(end(h) - fine).max() for h in (0.5, 0.25))
    assert coarse / half == pytest.approx(4, rel=0.15)


def test_a_horizon_begins_as_its_alignment():
    rate, force = static_imu(from_euler_angles([0.1, 0.2], 0.3, 0.4), LATITUDE)
    horizon = initial_level_frame(align(rate, force))
    assert horizon.attitude.shape == (2, 4)
    assert np.allclose(horizon.rate, [LEVEL_RATE, 0.0])
    assert np.allclose(navigation_frame_rate(LATITUDE)[0], LEVEL_RATE)


GOOD = {
    "start": LevelFrame(np.array([0, 0, 0, 1.0]), np.array([LEVEL_RATE, 0.0])),
    "increments": Increments(1.0, np.zeros((4, 3)), np.ones((4, 3))),
    "gains": Gains(0.0, 1e-7),
    "azimuth_rate": 5e-5,
}


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"increments.velocity": np.ones((3, 3))}, r"^increments\.velocity: expected as many"),
        ({"increments.angle": np.zeros(3)}, r"^increments\.angle: expected shape \(..., n, 3\)"),
        ({"every": 3}, "^every: expected a divisor"),
        (
            {"gains": Gains(1.0, 0.0)},
            "^gains, increments.interval: expected a horizon that follows",
        ),
        ({"gains": Gains(-1e-3, 1e-7)}, "^gains, increments.interval: .* got -0.0098"),
        ({"gains": Gains(0.0, 0.11)}, "^gains, increments.interval: expected"),
        (
            {"gains": Gains(0.0, 0.03), "increments.interval": 2.0},
            "^gains, increments.interval: expected",
        ),
        ({"azimuth_rate": 0.9}, "^azimuth_rate: expected rad/s near U .* got 0.9. Is it a lat"),
        ({"azimuth_rate": [0.0, 0.0, 7.5, 0.0]}, "^azimuth_rate: .* got 7.5. Is it a latitude"),
        (
            {"azimuth_rate": 7e-3, "increments.interval": 20.0},
            "^azimuth_rate: expected rad/s that turn the horizon by at most",
        ),
        (
            {"start": align([5e-5, 5.3e-5, 0.0], [0.0, 9.8, 0.0])},
            r"^start: .* got an alignment; say initial_level_frame\(alignment\)",
        ),
        (
            {"start": LevelFrame(np.ones(4), np.array([15.0, 0.0]))},
            r"^start\.rate: expected rad/s that turn",
        ),
        (
            {"increments.velocity": np.tile([1e50, 0, 0], (4, 1)), "gains": Gains(0.1, 0.1)},
            "^increments: expected increments that a horizon",
        ),
        ({"azimuth_rate": np.zeros((2, 4)), "increments.angle": np.zeros((3, 4, 3))}, "broadcast"),
    ],
)
def test_refusals(arguments, words):
    with pytest.raises(ValueError, match=words):
        propagate_level_frame(**replaced(GOOD, arguments))


def test_a_ship_under_way_shows_the_speed_deviation():
    found, way = manoeuvre(1 / EARTH_RADIUS)
    deviation = speed_error(way.latitude[1:], way.velocity[1:])
    gap = np.abs(found.heading - 0.3 - deviation)
    assert np.abs(deviation).max() > np.radians(1.9)
    assert gap.max() < np.radians(0.03)


def test_an_error_of_the_latitude_acts_like_a_drift_about_up():
    """The computer then turns its horizon in azimuth by U cos(latitude) times the error less."""
    error = np.radians(0.1)
    drift = EARTH_RATE * (np.sin(LATITUDE + error) - np.sin(LATITUDE))
    common = (7200, 10.0)
    wrong = propagate_level_frame(
        level_start(), at_rest([0, 0, 0, 1], *common), schuler_gains(), AZIMUTH_RATE + drift
    )
    drifting = propagate_level_frame(
        level_start(),
        at_rest([0, 0, 0, 1], *common, drift=(0, -drift, 0)),
        schuler_gains(),
        AZIMUTH_RATE,
    )
    swing = drift / SCHULER
    assert np.allclose(wrong.heading, drifting.heading, rtol=0, atol=0.01 * swing)
    assert np.abs(wrong.heading).max() == pytest.approx(swing, rel=0.02)


def test_how_the_heading_is_shared_at_the_start_does_not_matter():
    """The alignment's heading as yaw, or as compass angle with a yaw of zero by definition."""
    body, drift = from_euler_angles(0.7, 0.4, -0.3), np.array([2e-7, -1e-7, 3e-7])
    rate, force = static_imu(body, LATITUDE)
    found = align(rate + drift, force)
    as_yaw = initial_level_frame(found)
    turned = from_euler_angles(0.0, found.pitch, found.roll)
    level = found.level_rate * np.array([np.cos(found.heading), np.sin(found.heading)])
    increments = Increments(
        10.0, *(np.tile(10.0 * part, (720, 1)) for part in (rate + drift, force))
    )
    runs = [
        propagate_level_frame(start, increments, schuler_gains(), AZIMUTH_RATE)
        for start in (as_yaw, LevelFrame(turned, level))
    ]
    assert np.abs(runs[1].yaw_pitch_roll.heading[0]) < 0.01 * runs[0].yaw_pitch_roll.heading[0]
    np.testing.assert_allclose(runs[1].heading, runs[0].heading, rtol=0, atol=1e-9)


def test_the_heading_is_wrapped():
    run = LevellingHistory(
        np.ones(1),
        from_euler_angles([3.0], 0.0, 0.0),
        np.array([[-1.0, 0.5]]),
        np.array([[3.0, -2.0]]),  # is not read
        level_start(),
    )
    assert run.heading == pytest.approx(3.0 + np.arctan2(0.5, -1.0) - 2 * np.pi)


def test_the_swing_is_in_the_heading_many_times_larger():
    tilt = 1e-6
    start = level_start(from_rotation_vector([0.0, 0.0, tilt]))
    found = propagate_level_frame(
        start, at_rest([0, 0, 0, 1], 5070, 10.0), schuler_gains(), AZIMUTH_RATE
    )
    gain = SCHULER / LEVEL_RATE
    assert np.abs(found.heading).max() == pytest.approx(gain * tilt, rel=0.05)
    assert gain > 25
