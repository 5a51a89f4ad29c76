"""pyins' own test flights through `navigate`, and its Earth and Kalman step beside ours."""

from types import ModuleType
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from driftlab import earth
from driftlab.calibration import kalman
from driftlab.increments import Increments
from driftlab.strapdown import Navigation, navigate

NED = np.array([[0, 1, 0], [1, 0, 0], [0, 0, -1]])
"""From North, East, Down to East, North, Up, and back."""
STATIONARY = {"metres": (1e-3, 1e-3, 1e-2), "metres a second": (1e-6, 1e-6, 1e-5), "degrees": 1e-8}
SINE = {"metres": (0.1, 0.1, 3.0), "metres a second": (1e-3, 1e-3, 1e-2), "degrees": 1e-6}
"""What pyins' own tests allow pyins, for East, North and Up: `test_strapdown.py` of 1.0.1."""


def states(pyins: ModuleType, table: Any) -> Navigation:
    """A table of pyins' states in our axes and units."""
    turned = NED @ pyins.transform.mat_from_rph(table[pyins.util.RPH_COLS].to_numpy(float))
    return Navigation(
        np.radians(table["lat"].to_numpy()),
        np.radians(table["lon"].to_numpy()),
        table["alt"].to_numpy(),
        table[["VN", "VE", "VD"]].to_numpy(float) @ NED.T,
        Rotation.from_matrix(turned).as_quat(),
    )


def errors(pyins: ModuleType, trajectory: Any, imu: Any, interval: float) -> dict[str, Any]:
    """Largest errors of our navigation along pyins' increments."""
    true = states(pyins, trajectory)
    steps = imu.to_numpy()[1:]  # the first row is what came before the start
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
    return {
        "metres": np.abs(places).max(axis=1),
        "metres a second": np.abs(found.velocity - true.velocity).max(axis=0),
        "degrees": np.degrees(turned.magnitude().max()),
    }


def test_an_hour_at_rest(pyins: ModuleType) -> None:
    times = 0.1 * np.arange(36001)
    place, turned = np.tile([55.0, 37.0, 0.0], (36001, 1)), np.tile([-5.0, 10, 110], (36001, 1))
    trajectory, imu = pyins.sim.generate_imu(times, place, turned, sensor_type="increment")
    found = errors(pyins, trajectory, imu, 0.1)
    for name, allowed in STATIONARY.items():
        assert np.all(found[name] < allowed), name


def test_ten_minutes_of_a_velocity_that_swings(pyins: ModuleType) -> None:
    """To a hundredth of what pyins asks of itself in an hour."""
    trajectory, imu = pyins.sim.generate_sine_velocity_motion(
        1e-2, 600.01, [55, 37, 0], [5, -3, 0], velocity_change_amplitude=[1, 1, 0],
        sensor_type="increment",
    )  # fmt: skip
    found = errors(pyins, trajectory, imu, 1e-2)
    for name, allowed in SINE.items():
        assert np.all(100 * found[name] < allowed), name


def test_the_same_earth(pyins: ModuleType) -> None:
    degrees = np.linspace(-89.0, 89.0, 25)
    latitude = np.radians(degrees)
    along, across, _ = pyins.earth.principal_radii(degrees, 0.0)
    np.testing.assert_allclose(earth.curvature_radii(latitude), (along, across), rtol=1e-14)
    np.testing.assert_allclose(
        earth.earth_rate(latitude), pyins.earth.rate_n(degrees) @ NED.T, atol=1e-18
    )
    # Their linear term in the height leaves out the flattening and the Earth's turn, ours does not:
    # 2 h/a (f + m) of gravity, 2.2e-7 at 100 m. So the flights above are level, at the surface.
    np.testing.assert_allclose(
        earth.gravity(latitude), pyins.earth.gravity(degrees, 0.0), rtol=1e-14
    )
    np.testing.assert_allclose(
        earth.gravity(latitude, 100.0), pyins.earth.gravity(degrees, 100.0), rtol=3e-7
    )


@pytest.mark.parametrize("measured", [1, 3])
def test_the_same_kalman_step(pyins: ModuleType, measured: int) -> None:
    rng = np.random.default_rng(measured)
    root, noise_root = rng.standard_normal((9, 9)), rng.standard_normal((measured, measured))
    before, noise = root @ root.T, noise_root @ noise_root.T + np.eye(measured)
    seen, innovation = rng.standard_normal((measured, 9)), rng.standard_normal(measured)
    state, after, normalised = pyins.kalman.correct(np.zeros(9), before, innovation, seen, noise)
    ours = kalman.correct(before, innovation, seen, noise)
    np.testing.assert_allclose(ours.correction, state, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(ours.covariance, after, rtol=1e-9, atol=1e-10)
    assert ours.nis == pytest.approx(normalised @ normalised, rel=1e-10)
