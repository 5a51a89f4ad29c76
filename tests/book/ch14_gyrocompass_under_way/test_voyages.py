"""The figures and voyages of chapter 14: the compass of a ship under way."""

import inspect

import numpy as np
import pytest
from scipy.constants import arcminute
from scipy.integrate import solve_ivp

from driftlab.book.ch14_gyrocompass_under_way import experiments as at_work
from driftlab.book.ch14_gyrocompass_under_way.experiments import voyages
from driftlab.book.machinery.figure.publish import PublishedFigure
from driftlab.book.scenarios import SPEED, ship_manoeuvre
from driftlab.earth import EARTH_RADIUS, EARTH_RATE
from driftlab.frames import from_euler_angles, to_euler_angles
from driftlab.gyrocompass.alignment import align
from driftlab.gyrocompass.heading_error import speed_error
from driftlab.gyrocompass.simulation import simulate_gyrocompass
from driftlab.motion.vehicle import static_imu
from driftlab.quaternion import from_rotation_vector, multiply, rotate
from published import published
from saratov import GRAVITY, HOURLY, LATITUDE, LEVEL_RATE, SCHULER
from support import largest

SHIP_ARGUMENTS = inspect.signature(ship_manoeuvre).parameters
STEP = ship_manoeuvre().increments.interval


def sail(*voyage, gyro_bias=at_work.GYRO_BIAS, accelerometer_bias=(0.0, 0.0, 0.0), **settings):
    """A compass on a voyage: arguments of `ship_manoeuvre` and of `simulate_gyrocompass`."""
    own = {name: settings.pop(name) for name in [*settings] if name in SHIP_ARGUMENTS}
    return simulate_gyrocompass(
        ship_manoeuvre(*voyage, **own), gyro_bias, accelerometer_bias, **settings
    )


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

    def moves(_: float, state: np.ndarray) -> np.ndarray:
        north, _, east = rotate(state[:4], force)
        level = state[4:] + proportional * np.array([east, -north])
        body, horizon = np.append(rate, 0.0), np.array([level[0], azimuth, level[1], 0.0])
        turn = 0.5 * (multiply(state[:4], body) - multiply(horizon, state[:4]))
        return np.array([*turn, integral * east, -integral * north])

    begin = np.array([*bent, start.level_rate, 0.0])
    times = found.times[:1500]
    ends = solve_ivp(moves, (0, times[-1]), begin, "DOP853", times, rtol=1e-11, atol=1e-16).y.T
    compass = np.arctan2(ends[:, 5], ends[:, 4])  # of the integrals
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


def test_a_step_of_four_seconds_is_short_enough_under_way() -> None:
    coarse, half, fine = (sail(interval=step) for step in (4.0, 2.0, 0.1))
    np.testing.assert_allclose(coarse.times, fine.times[39::40])
    for name in ("heading_error", "yaw_error", "compass_error", "tilt"):
        true = getattr(fine, name)
        gap = largest(getattr(coarse, name) - true[39::40])
        # Second order; the heading's error is a quarter of a degree.
        assert gap / largest(getattr(half, name) - true[19::20]) == pytest.approx(4, rel=0.1)
        assert gap < 1e-3 * largest(true)


@published("14-operation")
def test_the_heading_error_under_way_is_what_the_formula_says(figure: PublishedFigure) -> None:
    data = figure.data
    assert largest(data.heading_error - data.formula) < 4e-3 * largest(data.heading_error)
    parts = data.yaw_error + data.compass_angle_error
    np.testing.assert_allclose(data.heading_error, parts, atol=1e-16)
    np.testing.assert_array_equal(sail().formula.yaw, -data.yaw_error)


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
            speed_log=True,
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


@published("14-operation")
def test_the_speed_deviation_is_that_of_the_course(figure: PublishedFigure) -> None:
    """North at ten metres a second it is the angle of v/R to U cos(latitude); West almost none."""
    data = figure.data
    northward = data.time == 40 * 60
    place = LATITUDE + 10.0 * (28 * 60 + 60) / EARTH_RADIUS
    expected = -np.arctan2(10.0 / EARTH_RADIUS, EARTH_RATE * np.cos(place))
    np.testing.assert_allclose(data.speed_error[northward], expected, rtol=2e-4)
    assert largest(data.speed_error[data.time > 54 * 60]) < 1e-12
    assert largest(data.speed_error[data.time <= 10 * 60]) == 0
    westward = ship_manoeuvre(LATITUDE, 10.0, 0.0, np.pi / 2, 4.0)
    np.testing.assert_allclose(westward.velocity[-1], [0, -10], atol=1e-12)
    np.testing.assert_allclose(
        data.speed_error, speed_error(westward.latitude[1:], westward.velocity[1:])
    )


@published("14-ballistic-error")
def test_schulers_tuning_with_a_log_has_no_tilt(figure: PublishedFigure) -> None:
    runs = figure.data.runs
    plain, with_log, stiff, soft, damped = runs.values()
    coriolis = 2 * EARTH_RATE * np.sin(LATITUDE) * SPEED / GRAVITY
    assert 0.3 * coriolis < largest(plain.tilt) < 2.1 * coriolis
    assert largest(with_log.tilt) < 0.005 * largest(plain.tilt)
    assert largest(with_log.tilt) < 0.001 * arcminute
    assert largest(with_log.heading_error) < 0.005 * largest(plain.heading_error)
    for wrong in (stiff, soft, damped):
        assert largest(wrong.tilt) > 8 * largest(plain.tilt)
    assert largest(damped.heading_error) > 8 * largest(plain.heading_error)


@published("14-operating-formula")
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
    angles = largest(run.yaw_error) + largest(run.tilt) * np.tan(voyages.CRAFT["pitch"])
    assert full < angles**2 < 0.05 * largest(run.compass_error)
    short = simulate_gyrocompass(
        ship_manoeuvre(**{**voyages.CRAFT, "interval": 0.5}), **voyages.CRAFT_COMPASS
    )
    assert largest(run.compass_error - short.compass_error[1::2]) < 1e-2 * full
