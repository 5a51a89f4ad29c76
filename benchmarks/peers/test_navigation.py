"""pyins' own test flights, its Earth and its Kalman step beside ours; navtk's static alignment."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from driftlab import earth
from driftlab.calibration import kalman
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass import align
from driftlab.increments import Increments
from driftlab.motion import static_imu
from driftlab.strapdown import Navigation, navigate

FETCH = '"python3 lab.py peers" fetches it.'
NED = np.array([[0, 1, 0], [1, 0, 0], [0, 0, -1]])
"""From North, East, Down to East, North, Up, and back."""
DOWN = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])
"""Forward, up, right to forward, right, down; and North, Up, East to North, East, Down."""
STATIONARY = {"metres": (1e-3, 1e-3, 1e-2), "metres a second": (1e-6, 1e-6, 1e-5), "degrees": 1e-8}
SINE = {"metres": (0.1, 0.1, 3.0), "metres a second": (1e-3, 1e-3, 1e-2), "degrees": 1e-6}
"""What pyins' own tests allow pyins, for East, North and Up: `test_strapdown.py` of 1.0.1."""


@pytest.fixture(scope="module")
def pyins():
    """pyins, the package python-ins by N. Mayorov, which compiles itself when it is imported."""
    package = pytest.importorskip("pyins", reason=f"python-ins is not installed: {FETCH}")
    import pyins.earth
    import pyins.kalman
    import pyins.sim
    import pyins.transform
    import pyins.util  # noqa: F401

    return package


def states(pyins, table) -> Navigation:
    """A table of pyins' states in our axes and units."""
    turned = NED @ pyins.transform.mat_from_rph(table[pyins.util.RPH_COLS].to_numpy(float))
    return Navigation(
        np.radians(table["lat"].to_numpy()),
        np.radians(table["lon"].to_numpy()),
        table["alt"].to_numpy(),
        table[["VN", "VE", "VD"]].to_numpy(float) @ NED.T,
        Rotation.from_matrix(turned).as_quat(),
    )


def assert_flies(pyins, flight, interval: float, allowed: dict, part: float = 1.0) -> None:
    """Our navigation along pyins' increments errs by a part of what is allowed."""
    true = states(pyins, flight[0])
    steps = flight[1].to_numpy()[1:]  # the first row is what came before the start
    start = Navigation(*(part[0] for part in true))
    found = navigate(start, Increments(interval, steps[:, :3], steps[:, 3:]))
    true = Navigation(*(part[2::2] for part in true))
    along, across = earth.curvature_radii(true.latitude)
    places = [
        across * np.cos(true.latitude) * (found.longitude - true.longitude),
        along * (found.latitude - true.latitude),
        found.altitude - true.altitude,
    ]
    turned = Rotation.from_quat(true.attitude).inv() * Rotation.from_quat(found.attitude)
    errors = {
        "metres": np.abs(places).max(axis=1),
        "metres a second": np.abs(found.velocity - true.velocity).max(axis=0),
        "degrees": np.degrees(turned.magnitude().max()),
    }
    for name, error in errors.items():
        assert np.all(error < part * np.array(allowed[name])), name


def test_an_hour_at_rest(pyins):
    times = 0.1 * np.arange(36001)
    place, turned = np.tile([55.0, 37.0, 0.0], (36001, 1)), np.tile([-5.0, 10, 110], (36001, 1))
    flight = pyins.sim.generate_imu(times, place, turned, sensor_type="increment")
    assert_flies(pyins, flight, 0.1, STATIONARY)


def test_ten_minutes_of_a_velocity_that_swings(pyins):
    """To a hundredth of what pyins asks of itself in an hour."""
    flight = pyins.sim.generate_sine_velocity_motion(
        1e-2, 600.01, [55, 37, 0], [5, -3, 0], velocity_change_amplitude=[1, 1, 0],
        sensor_type="increment",
    )  # fmt: skip
    assert_flies(pyins, flight, 1e-2, SINE, part=0.01)


def test_the_same_earth(pyins):
    degrees = np.linspace(-89.0, 89.0, 25)
    latitude = np.radians(degrees)
    along, across, _ = pyins.earth.principal_radii(degrees, 0.0)
    np.testing.assert_allclose(earth.curvature_radii(latitude), (along, across), rtol=1e-14)
    theirs = pyins.earth.rate_n(degrees) @ NED.T
    np.testing.assert_allclose(earth.earth_rate(latitude), theirs, atol=1e-18)
    # Their linear term in the height leaves out the flattening and the Earth's turn, ours does not:
    # 2 h/a (f + m) of gravity, 2.2e-7 at 100 m. So the flights above are level, at the surface.
    for height, within in ((0.0, 1e-14), (100.0, 3e-7)):
        theirs = pyins.earth.gravity(degrees, height)
        np.testing.assert_allclose(earth.gravity(latitude, height), theirs, rtol=within)


@pytest.mark.parametrize("measured", [1, 3])
def test_the_same_kalman_step(pyins, measured):
    rng = np.random.default_rng(measured)
    root, noise_root = rng.standard_normal((9, 9)), rng.standard_normal((measured, measured))
    before, noise = root @ root.T, noise_root @ noise_root.T + np.eye(measured)
    seen, innovation = rng.standard_normal((measured, 9)), rng.standard_normal(measured)
    state, after, normalised = pyins.kalman.correct(np.zeros(9), before, innovation, seen, noise)
    ours = kalman.correct(before, innovation, seen, noise)
    np.testing.assert_allclose(ours.correction, state, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(ours.covariance, after, rtol=1e-9, atol=1e-10)
    assert ours.nis == pytest.approx(normalised @ normalised, rel=1e-10)


def test_navtk_aligns_units_with_errors_alike():
    navtk = pytest.importorskip("navtk.inertial", reason=f"navtk is not installed: {FETCH}")
    rng = np.random.default_rng(9)
    for _ in range(50):
        heading, roll = rng.uniform(-np.pi, np.pi, 2)
        attitude = from_euler_angles(heading, rng.uniform(-1.4, 1.4), roll)
        rate, force = static_imu(attitude, rng.uniform(-1.3, 1.3))
        rate = rate + 1e-6 * rng.standard_normal(3)
        force = force + 1e-2 * rng.standard_normal(3)
        theirs = navtk.quaternion_static_alignment(DOWN @ force, DOWN @ rate)
        found = Rotation.from_quat(align(rate, force, heading_tolerance=np.inf).attitude)
        np.testing.assert_allclose(DOWN @ found.as_matrix() @ DOWN.T, theirs, atol=1e-12)
