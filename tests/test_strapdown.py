"""Strapdown navigation against the navigation equations, closed forms and the turntable."""

import warnings
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from driftlab.attitude.sculling import step_velocities
from driftlab.checks import UnusualWarning
from driftlab.core import strapdown as core
from driftlab.core.earth import gravity_north
from driftlab.earth import EARTH_RATE, curvature_radii, earth_rate, gravity
from driftlab.increments import Increments
from driftlab.motion.scheme import NINETEEN_POSITIONS, Scheme
from driftlab.motion.turntable import static_trajectory, turntable_trajectory
from driftlab.quaternion import multiply, pure, rotate
from driftlab.strapdown import Navigation, checked_interval, final_state, navigate, stationary_state
from support import EPS, order_of, random_quaternions, replaced, same_rotation

RADIUS = 6.4e6  # m, about the Earth's
SETTLED = 2e-7  # m: a way that is cut into chunks otherwise is found within this
UNTURNED = np.array([0.0, 0.0, 0.0, 1.0])


# The navigation equations in East, North, Up, written out


def radii_and_transport(latitude, altitude, velocity):
    """Radii along the meridian and across it, and the rate of the local axes over the Earth."""
    along, across = (float(radius) + altitude for radius in curvature_radii(latitude))
    east, north, _ = velocity
    transport = np.array([-north / along, east / across, east * np.tan(latitude) / across])
    return along, across, transport


def derivative(latitude, altitude, velocity, attitude, rate, force):
    """Time derivatives of latitude, longitude, altitude, velocity and attitude, in one row."""
    along, across, transport = radii_and_transport(latitude, altitude, velocity)
    earth = earth_rate(latitude)
    acceleration = rotate(attitude, force) - np.cross(2 * earth + transport, velocity)
    acceleration[1] += gravity_north(latitude, altitude)
    acceleration[2] -= gravity(latitude, altitude)
    turning = multiply(attitude, pure(rate)) - multiply(pure(earth + transport), attitude)
    place = [velocity[1] / along, velocity[0] / (across * np.cos(latitude)), velocity[2]]
    return np.concatenate([place, acceleration, turning / 2])


def state_of(row):
    """The state in a row or in a table of rows (n, 10)."""
    row = np.asarray(row)
    return Navigation(row[..., 0], row[..., 1], row[..., 2], row[..., 3:6], row[..., 6:])


def row_of(state):
    return np.concatenate([[state.latitude, state.longitude, state.altitude], *state[3:]])


def solution(start, motion, times, level=False):
    """States (n,) at `times` from the equations; at constant altitude if `level`."""
    free = np.ones(10)
    if level:
        free[[2, 5]] = 0
    answer = solve_ivp(
        lambda time, y: (
            free * derivative(y[0], y[2], y[3:6], y[6:], motion.rate(time), motion.force(time))
        ),
        (0, times[-1]),
        row_of(start),
        method="DOP853",
        t_eval=times,
        rtol=1e-12,
        # Angles to 1e-6 m on the ground; then metres, metres per second, and components.
        atol=[1e-13, 1e-13, 1e-7, *[1e-10] * 3, *[1e-13] * 4],
    )
    return state_of(answer.y.T)


def waves(mean, amplitude, frequency, phase):
    """Vectors a + b sin(w t + p) of time, and their integrals."""
    a, b, w, p = (np.asarray(part, float) for part in (mean, amplitude, frequency, phase))
    return (
        lambda t: a + b * np.sin(w * t + p),
        lambda t: a * t - b / w * np.cos(w * t + p),
    )


def motion_of(rate, force):
    """A motion given by what gyros and accelerometers feel; each argument as of `waves`."""
    (rate, angle), (force, push) = waves(*rate), waves(*force)

    def increments(interval, count):
        times = interval * np.arange(count + 1)[:, np.newaxis]
        return np.diff(angle(times), axis=0), np.diff(push(times), axis=0)

    return SimpleNamespace(rate=rate, force=force, increments=increments)


# A climbing turn at 100 m/s, a radian in 20 s with the force to the left that it takes, while the
# body sways about all axes.
TURN = motion_of(
    rate=([0.0, 0.0, 0.05], [0.06, -0.08, 0.03], [0.5, 0.9, 0.3], [1.6, 1.5, 0.4]),
    force=([0.1, 5.0, 9.9], [1.0, -0.7, 0.9], [0.4, 1.1, 0.7], [0.3, 0.0, 2.0]),
)
AIRBORNE = Navigation(
    np.array(0.96),
    np.array(2.1),
    np.array(3000.0),
    np.array([80.0, 60.0, 3.0]),
    Rotation.from_euler("ZXY", [-40, 3, -5], degrees=True).as_quat(),
)


def errors(found, expected):
    """Largest errors: position in m, velocity in m/s, attitude in quaternion components."""
    sign = np.sign(np.sum(found.attitude * expected.attitude, axis=-1, keepdims=True))
    east = (found.longitude - expected.longitude + np.pi) % (2 * np.pi) - np.pi
    return (
        max(
            RADIUS * np.abs(found.latitude - expected.latitude).max(),
            RADIUS * np.abs(np.cos(expected.latitude) * east).max(),
            np.abs(found.altitude - expected.altitude).max(),
        ),
        np.abs(found.velocity - expected.velocity).max(),
        np.abs(found.attitude - sign * expected.attitude).max(),
    )


# Against the equations


@pytest.fixture(scope="module")
def flight():
    """States of `AIRBORNE` along `TURN` after each 10 s of a minute."""
    return solution(AIRBORNE, TURN, 10.0 * np.arange(1, 7))


def flown(interval):
    """The same by `navigate`."""
    increments = TURN.increments(interval, round(60 / interval))
    return navigate(AIRBORNE, Increments(interval, *increments), every=round(10 / interval))


def test_vehicle_that_climbs_and_turns_follows_the_navigation_equations(flight):
    position, velocity, attitude = errors(flown(0.01), flight)
    # The trapezoid rule for the way leaves step^2/12 times the growth of the acceleration, which
    # changes by at most 14 m/s^2 here. The velocity loses angle^3/24 of each push of 0.2 m/s to
    # terms that are left out, at up to 0.16 rad/s. The equations are solved to 1e-5 m or so.
    assert position < 0.02**2 / 12 * 14 + 2e-5
    assert velocity < 3000 * 0.0032**3 / 24 * 0.2 + 1e-8
    assert attitude < 1e-10
    assert np.ptp(flight.altitude) > 50  # it climbs,
    assert np.abs(flight.velocity[-1] - AIRBORNE.velocity).max() > 100  # and turns


def test_errors_fall_with_the_interval(flight):
    coarse, fine = (np.array(errors(flown(interval), flight)) for interval in (0.1, 0.05))
    position, velocity, attitude = np.log2(coarse / fine)
    # The trapezoid rule is of second order, and the attitude of fourth, but for the next terms.
    assert position > 1.9
    assert velocity > 2.9
    assert attitude > 3.6


def test_velocity_over_a_step_is_good_to_the_fourth_power_of_its_length():
    def error(interval):
        answer = solve_ivp(
            lambda time, y: np.concatenate(
                [0.5 * multiply(y[:4], pure(rate(time))), rotate(y[:4], force(time))]
            ),
            (0, 2 * interval),
            [*UNTURNED, 0, 0, 0],
            method="DOP853",
            rtol=1e-13,
            atol=1e-17,
        )
        angle, push = (np.diff(f(interval * np.arange(3)[:, None]), axis=0) for f in integrals)
        return float(np.linalg.norm(step_velocities(angle, push)[0] - answer.y[4:, -1]))

    parts = [
        waves([7, -11, 4], [5, 3, -8], [4, 3, 5], [1, 2, 3]),
        waves([1, 2, 9.8], [-3, 8, 5], [6, 4, 3], [3, 1, 2]),
    ]
    (rate, force), integrals = zip(*parts, strict=True)
    # A local error of fourth order would be 4 exactly, but for the next term.
    assert order_of(error) > 3.9


def test_velocity_over_a_step_is_exact_where_nothing_turns():
    push = np.random.default_rng(1).normal(size=(5, 8, 3))
    pairs = step_velocities(np.zeros((5, 8, 3)), push)
    np.testing.assert_array_equal(pairs, push[:, ::2] + push[:, 1::2])


@pytest.mark.parametrize("latitude", [-0.7, 0.0, 1.2])
def test_eastward_motion_is_pushed_up_and_towards_the_equator(latitude):
    """Coriolis and centrifugal force on a unit that is carried level to the East."""
    speed, seconds = 300.0, 1.0
    velocity = np.array([speed, 0.0, 0.0])
    _, across, transport = radii_and_transport(latitude, 0.0, velocity)
    carried = SimpleNamespace(
        rate=earth_rate(latitude) + transport, force=np.array([0, 0, float(gravity(latitude))])
    )
    start = stationary_state(latitude, UNTURNED)._replace(velocity=velocity)
    increments = (np.tile(0.05 * part, (20, 1)) for part in (carried.rate, carried.force))
    end = final_state(navigate(start, Increments(0.05, *increments)))
    sine, cosine = np.sin(latitude), np.cos(latitude)
    turning = 2 * EARTH_RATE + speed / (across * cosine)
    expected = speed * turning * np.array([0, -sine, cosine]) * seconds
    # What is gained acts back: another turning, and as much by the change of gravity with the way.
    bound = speed * (turning * seconds) ** 2
    np.testing.assert_allclose(end.velocity - velocity, expected, rtol=0, atol=bound)


# At rest


def test_unit_at_rest_stays_for_an_hour():
    latitude, interval, hours = 0.9, 0.1, 1.0
    start = stationary_state(latitude, random_quaternions(1, seed=2)[0], 1.5, 200.0)
    record = static_trajectory(start.attitude, latitude, interval, 36_000, 200.0)
    found = navigate(start, record.increments, every=600)
    # Gravity in inertial axes turns by earth_rate squared, and the trapezoid rule adds step^2/12
    # of that: an acceleration which a vertical channel makes grow like cosh, in closed form.
    growth = np.sqrt(2 * 9.81 / RADIUS) * 3600 * hours
    left = 0.2**2 / 12 * 9.81 * EARTH_RATE**2 / (2 * 9.81 / RADIUS)
    # Rounding, of an altitude to an eps of the radius and of chunks, grows in the same way.
    bound = (left + 4 * RADIUS * EPS + SETTLED) * np.cosh(growth)
    position, velocity, attitude = errors(found, start)
    assert position < bound
    assert velocity < bound * np.sqrt(2 * 9.81 / RADIUS)
    assert attitude < 1e-10


def test_unit_on_the_turntable_stays_where_it_is():
    record = turntable_trajectory(NINETEEN_POSITIONS, 0.9, 0.02, multiple_of=2)
    found = navigate(stationary_state(0.9, record.attitude[0]), record.increments)
    assert same_rotation(found.attitude, record.attitude[2::2], 1e-10)
    # Turns of 10 degrees/s, 0.007 rad a step: 160 s of them at angle^3/24 of gravity at most.
    assert np.abs(found.velocity).max() < 160 * 9.81 * 0.007**3 / 24
    assert len(found.latitude) == len(record.increments.angle) // 2


def test_errors_on_the_turntable_fall_with_the_fourth_power_of_the_interval():
    """Force stands still on the Earth there, so what is left out comes back in the whole."""
    scheme = Scheme("+90X -180Y +90Z", dwell=4.0, rate=np.pi / 4)

    def error(interval):
        record = turntable_trajectory(scheme, 0.8, interval, multiple_of=round(0.5 / interval))
        start = stationary_state(0.8, record.attitude[0])
        found = final_state(navigate(start, record.increments))
        return errors(found, start._replace(attitude=record.attitude[-1]))

    coarse, fine = np.array(error(0.125)), np.array(error(0.03125))
    assert (np.log2(coarse / fine) / 2 > 3.9).all()


def test_altitude_runs_away_as_the_hyperbolic_cosine():
    """A metre too high at first: weight falls by 2 g/a for a metre, which drives it further up."""
    latitude = np.radians(89)  # so that there is next to no Coriolis force
    record = static_trajectory(UNTURNED, latitude, 0.5, 3600)
    start = stationary_state(latitude, UNTURNED, altitude=1.0)
    found = navigate(start, record.increments, every=120)
    growth = np.sqrt(float(gravity(latitude, -0.5) - gravity(latitude, 0.5)))
    assert growth == pytest.approx(np.sqrt(2 * float(gravity(latitude)) / 6378137.0), rel=1e-3)
    expected = np.cosh(growth * 60 * np.arange(1, 31))
    # The Coriolis force of the rise takes 4 earth_rate^2 cos^2 of it: 1e-6 of the rate squared.
    np.testing.assert_allclose(found.altitude, expected, rtol=2e-5)


# Schuler


def test_tilted_unit_swings_like_a_pendulum_as_long_as_the_radius():
    """At the equator, tilted about the East: the level channels do not mix there."""
    tilt, latitude, interval = 1e-4, 0.0, 0.5
    true = static_trajectory(UNTURNED, latitude, interval, 12_000)
    tilted = Rotation.from_rotvec([tilt, 0, 0]).as_quat()
    states = navigate(
        stationary_state(latitude, tilted), true.increments, every=240, hold_altitude=True
    )
    times = 120.0 * np.arange(1, 51)
    along, _ = curvature_radii(latitude)
    schuler = np.sqrt(float(gravity(latitude)) / float(along))
    # A tilt forward takes part of gravity for a force backward. The Earth's rotation, which turns
    # the tilted axes, is 17 times slower, and enters by its square.
    share = (EARTH_RATE / schuler) ** 2
    swing = tilt * float(gravity(latitude)) / schuler
    bound = 2 * share * (1 + schuler * times)
    np.testing.assert_array_less(
        np.abs(states.velocity[:, 1] / swing + np.sin(schuler * times)), bound
    )
    # In 100 minutes it has been forth and back: 84.4 minutes at the mean radius.
    assert 2 * np.pi / schuler / 60 == pytest.approx(84.4, abs=0.5)


def test_tilted_unit_follows_the_level_equations(monkeypatch):
    latitude, interval, chunk = 0.8, 0.5, 4.0
    monkeypatch.setattr(core, "CHUNK", chunk)
    record = static_trajectory(UNTURNED, latitude, interval, 12_000)
    tilted = Rotation.from_rotvec([1e-4, -2e-4, 3e-4]).as_quat()
    start = stationary_state(latitude, tilted, altitude=100.0)
    found = navigate(start, record.increments, every=1200, hold_altitude=True)
    still = SimpleNamespace(
        rate=lambda time: record.increments.angle[0] / interval,
        force=lambda time: record.increments.velocity[0] / interval,
    )
    expected = solution(start, still, 600.0 * np.arange(1, 11), level=True)
    position, velocity, attitude = errors(found, expected)
    # Between two times at which the altitude is put back, Coriolis force of up to 2 W v lifts the
    # unit by W v chunk^2; the rise has a Coriolis force in turn, which takes at most 2 W^2 v
    # chunk^2 of the speed, 6000 s / chunk times. The trapezoid rule leaves the acceleration of
    # the test of rest, here for a Schuler frequency of 1/800 s.
    speed = np.abs(expected.velocity).max()
    bound = 2 * EARTH_RATE**2 * speed * chunk * 6000 + 1 / 12 * 9.81 * EARTH_RATE**2 * 800
    assert velocity < bound
    assert position < 800 * bound
    assert attitude < bound * 800 / RADIUS
    assert speed > 1  # it swings by kilometres


# Altitude held


def test_altitude_is_put_back_every_chunk_and_the_level_motion_goes_on(monkeypatch):
    chunk, interval = 10.0, 0.01
    monkeypatch.setattr(core, "CHUNK", chunk)
    # So far north it hardly matters what a put-back does to the speed that the Earth turns with.
    latitude = np.radians(89.8)
    start = AIRBORNE._replace(latitude=np.array(latitude))
    found = navigate(
        start, Increments(interval, *TURN.increments(interval, 3500)), hold_altitude=True
    )
    np.testing.assert_array_equal(found.altitude, np.full(1750, 3000.0))
    np.testing.assert_array_equal(found.velocity[:, 2], np.zeros(1750))
    here, rises = start, 0.0
    for leg, seconds in enumerate([10.0, 10.0, 10.0, 5.0]):
        later = SimpleNamespace(
            rate=lambda time, leg=leg: TURN.rate(chunk * leg + time),
            force=lambda time, leg=leg: TURN.force(chunk * leg + time),
        )
        here = final_state(solution(here, later, np.array([seconds])))
        rises += abs(float(here.altitude - start.altitude))
        here = here._replace(altitude=start.altitude, velocity=here.velocity * [1, 1, 0])
    position, velocity, attitude = errors(final_state(found), here)
    # From nothing, if the speed over the ground is kept, to twice W h, if the moment of momentum.
    speed = 2 * EARTH_RATE * np.cos(latitude) * rises
    way = 25 * speed + 0.02**2 / 12 * 14
    assert velocity < speed + 2e-7
    assert position < way + 2e-5
    assert attitude < (way + 2e-5) / RADIUS / np.cos(latitude)
    # Altitudes not put back would show: ways are longer by a share of the radius.
    assert 100 * 15 * rises / 2 / RADIUS > 2 * way


def test_held_altitude_is_that_of_each_start():
    start = stationary_state([0.3, 0.4], UNTURNED, altitude=[[-50.0], [9000.0], [0.0]])
    record = static_trajectory(UNTURNED, 0.35, 0.5, 200)
    found = navigate(start, record.increments, every=100, hold_altitude=True)
    np.testing.assert_array_equal(
        found.altitude, np.broadcast_to(start.altitude[..., None], (3, 2, 2))
    )


# Any way to the same result


def same_states(found, expected, metres=SETTLED):
    """Equal within `metres` and what a minute of them does to speeds and angles."""
    position, velocity, attitude = errors(found, expected)
    assert position < metres
    assert velocity < 0.01 * metres
    assert attitude < 64 * EPS


def part(state, index):
    return Navigation(*(component[index] for component in state))


def test_each_result_is_that_of_its_time():
    increments = TURN.increments(0.02, 600)
    fine = navigate(AIRBORNE, Increments(0.02, *increments))
    for every in (2, 4, 30, 600):
        coarse = navigate(AIRBORNE, Increments(0.02, *increments), every=every)
        for one, other in zip(coarse, fine, strict=True):
            np.testing.assert_allclose(one, other[every // 2 - 1 :: every // 2], rtol=4 * EPS)


def test_two_calls_in_a_row_are_one():
    angle, push = TURN.increments(0.02, 4000)
    whole = navigate(AIRBORNE, Increments(0.02, angle, push), every=100)
    first = navigate(AIRBORNE, Increments(0.02, angle[:1400], push[:1400]), every=100)
    second = navigate(final_state(first), Increments(0.02, angle[1400:], push[1400:]), every=100)
    same_states(part(whole, np.s_[:14]), whole.__class__(*first))
    # Latitude and longitude carry 1e-11 rad of Bowring's formula at most, 6e-5 m, between calls.
    same_states(part(whole, np.s_[14:]), second, 1e-4)


@pytest.mark.parametrize("chunk", [1e-9, 0.5, 7.77, 1e3])
def test_length_of_a_chunk_does_not_matter(monkeypatch, chunk):
    increments = TURN.increments(0.02, 3000)
    usual = navigate(AIRBORNE, Increments(0.02, *increments), every=100)
    monkeypatch.setattr(core, "CHUNK", chunk)
    same_states(navigate(AIRBORNE, Increments(0.02, *increments), every=100), usual)


@pytest.mark.parametrize("hold_altitude", [False, True])
def test_many_at_once_are_as_one_by_one(hold_altitude):
    rng = np.random.default_rng(7)
    start = Navigation(
        np.array([[0.4], [-1.1]]),
        np.array([[3.0], [-2.0]]),
        np.array([[0.0], [1200.0]]),
        np.array([[[10.0, -70.0, 1.0]], [[0.0, 30.0, -2.0]]]),
        random_quaternions(2, 1, seed=7),
    )
    angle, push = TURN.increments(0.05, 1600)
    angle = angle + 1e-4 * rng.normal(size=(3, 1, 3))
    push = push + 1e-3 * rng.normal(size=(3, 1, 3))
    kwargs = {"every": 400, "hold_altitude": hold_altitude}
    together = navigate(start, Increments(0.05, angle, push), **kwargs)
    assert together.latitude.shape == (2, 3, 4)
    assert together.velocity.shape == (2, 3, 4, 3)
    assert together.attitude.shape == (2, 3, 4, 4)
    for i, j in np.ndindex(2, 3):
        alone = navigate(part(start, (i, 0)), Increments(0.05, angle[j], push[j]), **kwargs)
        same_states(part(together, (i, j)), alone)


@pytest.mark.parametrize("degrees", [179.99, -179.99])
def test_longitude_goes_on_at_the_other_side(degrees):
    speed = np.copysign(200.0, degrees)
    start = AIRBORNE._replace(
        longitude=np.array(np.radians(degrees)), velocity=np.array([speed, 0.0, 0.0])
    )
    increments = TURN.increments(0.02, 1000)
    found = navigate(start, Increments(0.02, *increments))
    other = navigate(start._replace(longitude=np.array(0.0)), Increments(0.02, *increments))
    assert np.abs(found.longitude).max() <= np.pi
    assert np.sign(found.longitude[0]) == -np.sign(found.longitude[-1]) == np.sign(degrees)
    way = (found.longitude - np.radians(degrees) + np.pi) % (2 * np.pi) - np.pi
    np.testing.assert_allclose(way, other.longitude, rtol=0, atol=16 * EPS)
    # Nothing else knows the longitude.
    for one, another in zip(found._replace(longitude=0), other._replace(longitude=0), strict=True):
        np.testing.assert_array_equal(one, another)


# States


def test_state_at_rest_is_on_the_ellipsoid_at_longitude_zero_unless_told():
    state = stationary_state(0.3, UNTURNED)
    assert (state.latitude, state.longitude, state.altitude) == (0.3, 0, 0)


# Refusals


GOOD = {
    "start": stationary_state(0.5, UNTURNED),
    "increments": Increments(0.1, np.zeros((12, 3)), np.zeros((12, 3))),
}


@pytest.mark.parametrize(
    ("bad", "words"),
    [
        ({"increments.interval": 0}, r"increments\.interval: expected a positive number, got 0\."),
        (
            {"increments.interval": 21.0},
            r"increments\.interval: expected a positive time of at most 20 s, got 21",
        ),
        ({"every": 3}, r"every: expected an even divisor .*increments, 12, got 3\."),
        ({"every": 0}, r"every: expected a whole number of at least 2, got 0\."),
        (
            {"increments.angle": np.zeros((10, 3))},
            r"increments\.velocity: expected as many as increments\.angle, 10, got 12\.",
        ),
        ({"increments.angle": np.zeros(3)}, r"increments\.angle: expected shape \(\.\.\., n, 3\)"),
        (
            {"increments.velocity": np.zeros(3)},
            r"increments\.velocity: expected shape \(\.\.\., n, 3\), got shape \(3,\)",
        ),
        (
            {"start": GOOD["start"]._replace(latitude=np.array(np.pi / 2))},
            r"latitude: expected at most 89\.9 degrees .* that is 90 degrees",
        ),
    ],
    ids=lambda case: case if isinstance(case, str) else "",
)
def test_bad_input_is_refused_by_name(bad, words):
    with pytest.raises(ValueError, match=f"^{words}"):
        navigate(**replaced(GOOD, bad))


@pytest.mark.parametrize("interval", [0.001, 0.01, 0.5])
@pytest.mark.parametrize("runs", [(), (3,)])
def test_of_increments_that_gravity_does_not_make_a_warning_says_so(interval, runs):
    """At rest, on the Moon and in a turn of 5 g it does; exchanged, or of accelerations, not."""
    turned = np.broadcast_to(interval * earth_rate(0.8), (*runs, 4, 3))
    up = np.broadcast_to(np.array([0.6, 0.0, 0.8]), (*runs, 4, 3))
    start = stationary_state(0.8, UNTURNED)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for force in (1.201, 9.8, 49.999):
            navigate(start, Increments(interval, turned, force * interval * up))
    for force in (1.199, 50.001, 0.0):
        pushed = force * interval * up
        with pytest.warns(UnusualWarning, match=r"^increments\.velocity: .* where gravity") as seen:
            navigate(start, Increments(interval, turned, pushed))
        assert seen[0].filename == __file__
    with pytest.warns(UnusualWarning, match="not an angle"):
        navigate(start, Increments(interval, 0.1 * interval * up, turned))


@pytest.mark.parametrize(("factor", "said"), [(1e-3, "0.0098"), (100.0, "9.8e[+]02")])
def test_one_run_of_many_that_gravity_does_not_make_is_warned_of(factor, said):
    pushed = np.tile([0.0, 0.0, 0.098], (10, 4, 1))
    pushed[7] *= factor
    increments = Increments(0.01, np.zeros((10, 4, 3)), pushed)
    with pytest.warns(
        UnusualWarning, match=rf"^increments\.velocity: {said} m/s\^2 on the average"
    ):
        navigate(stationary_state(0.8, UNTURNED), increments)


def test_of_many_places_one_past_the_moon_is_refused():
    start = stationary_state(0.8, UNTURNED)._replace(altitude=np.array([0.0, 1e10]))
    with pytest.raises(ValueError, match=r"^start\.altitude: expected m, .* got 0 to 1e\+10"):
        navigate(start, GOOD["increments"])


def test_no_time_is_no_interval():
    assert checked_interval(20.0) == 20.0
    for interval in (0.0, -0.1, 20.1):
        with pytest.raises(ValueError, match=r"^increments\.interval: expected a positive time of"):
            checked_interval(interval)


def test_attitudes_are_brought_to_unit_norm():
    state = stationary_state(0.8, [0, 0, 0, 2])
    np.testing.assert_array_equal(state.attitude, [0, 0, 0, 1])
    record = static_trajectory([0, 0, 0, 1], 0.8, 0.1, 20)
    doubled = state._replace(attitude=2 * state.attitude)
    once, twice = (navigate(start, record.increments) for start in (state, doubled))
    np.testing.assert_allclose(twice.velocity, once.velocity, rtol=0, atol=1e-9)
    with pytest.raises(ValueError, match="attitude: expected nonzero quaternions"):
        stationary_state(0.8, np.zeros(4))


def test_numbers_of_a_state_may_be_pythons():
    good = stationary_state(0.8, [0, 0, 0, 1])
    record = static_trajectory([0, 0, 0, 1], 0.8, 0.1, 20)
    plain = good._replace(latitude=0.8, longitude=0.0, altitude=0.0)
    assert navigate(plain, record.increments).latitude.shape == (10,)


@pytest.mark.parametrize("runs", [2, 3])
@pytest.mark.parametrize("alone", ["angle", "velocity"])
def test_leading_axes_of_one_kind_of_increments_hold_for_both(runs, alone):
    """Three runs and three components are easily taken for each other."""
    rng = np.random.default_rng(21)
    rows = Increments(0.5, 0.1 * rng.normal(size=(4, 3)), rng.normal(size=(4, 3)))
    many = getattr(rows, alone) * rng.uniform(0.5, 1.5, (runs, 1, 1))
    start = stationary_state(0.7, [0, 0, 0, 1])
    together = navigate(start, rows._replace(**{alone: many}))
    assert together.velocity.shape == (runs, 2, 3)
    for run in range(runs):
        single = navigate(start, rows._replace(**{alone: many[run]}))
        for one, all_runs in zip(single, together, strict=True):
            np.testing.assert_allclose(
                np.broadcast_to(all_runs, (runs, *one.shape))[run], one, rtol=0, atol=1e-9
            )


def test_speeds_that_nothing_has_are_refused():
    good, record = (
        stationary_state(0.8, [0, 0, 0, 1]),
        static_trajectory([0, 0, 0, 1], 0.8, 0.1, 20),
    )
    with pytest.raises(ValueError, match=r"^start\.velocity: expected m/s, slower than light, got"):
        navigate(good._replace(velocity=np.array([0.0, -4e8, 0.0])), record.increments)
    fast = record.increments._replace(velocity=np.full((20, 3), 4e8))
    with pytest.raises(ValueError, match=r"^increments\.velocity: expected m/s, slower than light"):
        navigate(good, fast)
