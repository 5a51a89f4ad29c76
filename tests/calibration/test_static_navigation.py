"""Navigation at rest: what a unit shows that stands still is what the error equations say."""

import re

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

from driftlab.body_frames import misalignment_vector
from driftlab.calibration.body_axes import attitude_error, attitude_of_axes, imu_errors_in_frame
from driftlab.calibration.error_model import ERROR_MODELS
from driftlab.calibration.static_navigation import navigate_static
from driftlab.earth import EARTH_RATE, curvature_radii, earth_rate, gravity
from driftlab.imu import (
    NO_ERRORS,
    TYPICAL_ERRORS,
    ImuErrors,
    ImuNoise,
    PriorStandardDeviations,
    random_imu_errors,
)
from driftlab.quaternion import from_rotation_vector, multiply
from driftlab.vectors import cross_matrix
from support import EPS

LATITUDE = float(np.radians(37.5))
STANDING = Rotation.from_euler("xyz", [10, -20, 35], degrees=True).as_quat()
TO_LOCAL = Rotation.from_quat(STANDING).as_matrix()
GRAVITY = float(gravity(LATITUDE))
QUIET = {"latitude": LATITUDE, "interval": 1.0, "output_interval": 60.0}


def tilted(phi, attitude=STANDING):
    """Attitude with an error phi: (I - [phi×]) C."""
    return multiply(from_rotation_vector(-np.asarray(phi)), attitude)


def at_rest(imu_errors=NO_ERRORS, estimated=NO_ERRORS, start=STANDING, duration=60.0, **changes):
    """The errors of a unit that stands in one attitude; nobody told it anything wrong."""
    settings = QUIET | {"reference": STANDING} | changes
    return navigate_static(
        imu_errors, estimated, STANDING, start=start, duration=duration, **settings
    )


def unit_of(gyro_bias=(0, 0, 0), accelerometer_bias=(0, 0, 0)):
    """A unit with biases, given East, North, Up."""
    return NO_ERRORS._replace(
        gyro_bias=np.asarray(gyro_bias, float) @ TO_LOCAL,
        accelerometer_bias=np.asarray(accelerometer_bias, float) @ TO_LOCAL,
    )


def same_errors(one, other):
    """Equal but for rounding; gravitation settles to 1e-7 m, when the slowest of all units does."""
    np.testing.assert_array_equal(one.times, other.times)
    for name, most in (("attitude", 1e-11), ("velocity", 1e-7), ("position", 1e-4)):
        pair = np.broadcast_arrays(getattr(one, name), getattr(other, name))
        np.testing.assert_allclose(*pair, rtol=0, atol=most)


# Units without errors, and with errors that are known


def test_perfect_unit_shows_nothing():
    way = at_rest(duration=6000.0)
    assert way.attitude.shape == (100, 3)
    assert way.velocity.shape == way.position.shape == (100, 2)
    # A drift of 1e-5 deg/h would show 3e-9 rad for each minute and 3e-4 m/s.
    np.testing.assert_allclose(way.attitude, 0, atol=5e-9)
    np.testing.assert_allclose(way.velocity, 0, atol=2e-5)
    np.testing.assert_allclose(way.position, 0, atol=0.03)


@pytest.mark.parametrize("frame", [None, *ERROR_MODELS])
def test_unit_that_is_known_shows_nothing_in_any_axes(frame):
    """If the computer begins with the attitude of the axes in which the errors were found."""
    imu_errors = random_imu_errors(
        PriorStandardDeviations(installation=1e-3, scale_factor=1e-3), np.random.default_rng(1), 3
    )
    found, turn = imu_errors_in_frame(imu_errors, frame)
    attitude = attitude_of_axes(STANDING, turn)
    same_errors(
        at_rest(imu_errors, found, attitude, reference=attitude, duration=600.0),
        at_rest(duration=600.0),
    )


def test_start_in_the_axes_of_the_table_is_wrong_by_the_misalignment():
    """Both triads turned as a whole by k: in the averaged axes the unit is perfect, phi = -C k."""
    k = 1e-4 * np.array([1.0, -2.0, 1.5])
    turned = Rotation.from_rotvec(k).as_matrix() - np.eye(3)
    imu_errors = NO_ERRORS._replace(gyro_error_matrix=turned, accelerometer_error_matrix=turned)
    found, turn = imu_errors_in_frame(imu_errors, "averaged")
    for part in found:
        np.testing.assert_allclose(part, 0, atol=8 * EPS)
    reference = attitude_of_axes(STANDING, turn)
    right = at_rest(imu_errors, found, reference, reference=reference, duration=600.0)
    np.testing.assert_allclose(right.attitude, 0, atol=1e-9)
    wrong = at_rest(imu_errors, found, STANDING, reference=reference, duration=600.0)
    np.testing.assert_allclose(misalignment_vector(turned), k, rtol=1e-7)
    np.testing.assert_allclose(
        attitude_error(STANDING, reference), -TO_LOCAL @ k, rtol=0, atol=4 * EPS
    )
    # From then on all that happens is a tilt at the start.
    tilt = -TO_LOCAL @ k
    other = navigate_static(
        NO_ERRORS,
        NO_ERRORS,
        reference,
        start=tilted(tilt, reference),
        reference=reference,
        duration=600.0,
        **QUIET,
    )
    same_errors(wrong, other)
    drift = (wrong.attitude[0] - tilt) / np.linalg.norm(tilt)
    # In a minute the Earth turns by 4e-3, and Schuler's pendulum by 1/2 of 0.075 squared.
    assert 1e-3 < np.abs(drift).max() < 8e-3


# Long times: a pendulum of Schuler's, and the error equations


def growth(latitude):
    """Wu (6) at rest, for attitude, level velocity, position, drift and acceleration.

    phi' = -w_in × phi + dw_in - C eps, dv' = f × phi - 2 w_ie × dv + C nabla. The local axes of a
    wrong place turn otherwise; unlike the filter, nobody puts the place right here.
    """
    meridian, across = curvature_radii(latitude)
    sine, cosine = np.sin(latitude), np.cos(latitude)
    rates = np.zeros((12, 12))
    phi, velocity, place = slice(0, 3), slice(3, 5), slice(5, 7)
    rates[phi, phi] = -cross_matrix(earth_rate(latitude))
    rates[phi, velocity] = [[0, -1 / meridian], [1 / across, 0], [sine / cosine / across, 0]]
    rates[phi, 6] = np.array([0, -sine, cosine]) * EARTH_RATE / meridian
    rates[phi, 7:10] = -np.eye(3)
    rates[velocity, phi] = float(gravity(latitude)) * np.array([[0, -1, 0], [1, 0, 0]])
    rates[velocity, velocity] = -2 * cross_matrix(earth_rate(latitude))[:2, :2]
    rates[velocity, 10:12] = np.eye(2)
    rates[place, velocity] = np.eye(2)
    return rates


@pytest.mark.parametrize("latitude", [LATITUDE, -1.0])
@pytest.mark.parametrize("cause", ["drift", "acceleration", "tilt", "all"])
def test_errors_are_those_of_the_error_equations(latitude, cause):
    """Over two hours, in which a pendulum swings, the Earth turns, and the place is off."""
    drift, acceleration, tilt = (
        size * np.array(vector) * (cause in (name, "all"))
        for name, size, vector in (
            ("drift", 1e-8, [3.0, -5.0, 7.0]),
            ("acceleration", 1e-4, [1.0, -2.0, 0.0]),
            ("tilt", 1e-5, [1.0, 2.0, -3.0]),
        )
    )
    # Only what is not found counts.
    imu_errors = unit_of(drift + 1e-7, acceleration + 1e-3)
    found = unit_of(np.full(3, 1e-7), np.full(3, 1e-3))
    way = at_rest(
        imu_errors, found, tilted(tilt), latitude=latitude, output_interval=300.0, duration=7200.0
    )
    first = np.concatenate([tilt, np.zeros(4), drift, acceleration[:2]])
    expected = np.array([expm(growth(latitude) * time) @ first for time in way.times])
    for errors, columns in (
        (way.attitude, expected[:, :3]),
        (way.velocity, expected[:, 3:5]),
        (way.position, expected[:, 5:7]),
    ):
        # Second order, the ellipsoid's curvature, and a height that is held each 40 s only.
        most = 2e-3 * np.abs(columns).max(axis=0)
        assert (np.abs(errors - columns) < most).all()


# Noise


def test_random_walks_grow_as_they_should():
    """In a minute: the attitude's N^2 t, the velocity's own V^2 t and the tilts' (g N)^2 t^3/3."""
    noise, runs, time = ImuNoise(1e-6, 4e-4), 300, 60.0
    none = ImuErrors(*(np.broadcast_to(part, (runs, *part.shape)) for part in NO_ERRORS))
    way = at_rest(none, noise=noise, rng=np.random.default_rng(2))
    velocity = (4e-4) ** 2 * time + (GRAVITY * 1e-6) ** 2 * time**3 / 3
    for errors, variance in ((way.attitude, 1e-12 * time), (way.velocity, velocity)):
        squares = (errors[:, 0] ** 2).sum(axis=0) / variance
        # Five components; pendulum and sampling change variances by less than a hundredth.
        low, high = chi2.ppf([0.001, 0.999], runs)
        assert ((low < squares) & (squares < high)).all()
    # Both parts of the velocity's matter.
    assert 0.1 < (4e-4) ** 2 * time / velocity < 0.9


def test_one_unit_with_several_corrections_has_one_noise():
    rng = np.random.default_rng(3)
    several = ImuErrors(*(np.stack([part, part]) for part in TYPICAL_ERRORS))
    way = at_rest(TYPICAL_ERRORS, several, noise=ImuNoise(), rng=rng)
    np.testing.assert_array_equal(way.attitude[0], way.attitude[1])
    other = at_rest(several, TYPICAL_ERRORS, noise=ImuNoise(), rng=rng)
    assert (other.attitude[0] != other.attitude[1]).all()


# Times, leading axes, refusals


@pytest.mark.parametrize(
    ("interval", "output_interval", "duration", "times"),
    [
        (1.0, 60.0, 180.0, [60, 120, 180]),
        (0.5, 60.0, 60.0, [60]),
        (1.0, 60.0, 200.0, [60, 120, 180]),
        (1.0, 60.0, 220.0, [60, 120, 180, 240]),
        (1.0, 1.0, 4.0, [2, 4]),  # steps of the navigation take two increments
        (20.0, 50.0, 100.0, [40, 80]),
    ],
)
def test_results_come_after_pairs_of_increments(interval, output_interval, duration, times):
    drift = 1e-7 * np.array([3.0, -2.0, 4.0])
    way = at_rest(
        unit_of(drift), interval=interval, output_interval=output_interval, duration=duration
    )
    np.testing.assert_array_equal(way.times, times)
    # They are the times of the errors beside them.
    assert way.attitude.shape == (len(times), 3)
    np.testing.assert_allclose(way.attitude, -np.outer(times, drift), rtol=0.06)


def test_several_units_are_each_by_itself():
    rng = np.random.default_rng(4)
    units, found = (
        random_imu_errors(PriorStandardDeviations(), rng, 2, 3),
        random_imu_errors(PriorStandardDeviations(), rng, 3),
    )
    starts = tilted(1e-3 * rng.standard_normal((2, 1, 3)))
    references = tilted(1e-3 * rng.standard_normal((3, 3)))
    together = at_rest(units, found, starts, reference=references, duration=600.0)
    assert together.attitude.shape == (2, 3, 10, 3)
    assert together.velocity.shape == together.position.shape == (2, 3, 10, 2)
    for i, j in np.ndindex(2, 3):
        alone = at_rest(
            ImuErrors(*(part[i, j] for part in units)),
            ImuErrors(*(part[j] for part in found)),
            starts[i, 0],
            reference=references[j],
            duration=600.0,
        )
        same_errors(
            alone,
            together._replace(
                **{
                    name: getattr(together, name)[i, j]
                    for name in ("attitude", "velocity", "position")
                }
            ),
        )


@pytest.mark.parametrize(
    ("name", "bad"),
    [
        ("interval", 61.0),
        ("output_interval", 0.5),
        ("output_interval", 61.0),
        ("duration", 59.0),
    ],
)
def test_times_that_do_not_fit_into_each_other_are_refused(name, bad):
    times = {"interval": 1.0, "output_interval": 60.0, "duration": 60.0} | {name: bad}
    got = ", ".join(map(repr, times.values()))
    with pytest.raises(
        ValueError,
        match=r"^interval, output_interval, duration: expected positive times, each at least "
        rf"as long as the one before, got {re.escape(got)} s\.$",
    ):
        at_rest(**times)


@pytest.mark.parametrize(
    ("name", "bad", "words"),
    [
        ("interval", 0.0, r"a positive number, got 0\.0"),
        ("duration", -60.0, r"a positive number, got -60\.0"),
        ("latitude", np.pi / 2, "at most 89.9 degrees from the equator"),
        ("start", np.zeros(4), "nonzero quaternions, got a zero quaternion"),
        ("start", [0, 0, 1], r"shape \(\.\.\., 4\), got shape \(3,\)"),
        ("reference", np.zeros(4), "nonzero quaternions, got a zero quaternion"),
        ("rng", None, "a numpy Generator to draw the noise, or a seed for one, got None"),
    ],
)
def test_bad_arguments_are_refused_by_name(name, bad, words):
    with pytest.raises(ValueError, match=f"^{name}: expected {words}"):
        at_rest(**{"noise": ImuNoise(), "rng": np.random.default_rng(0)} | {name: bad})
