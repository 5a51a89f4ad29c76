"""The voyages of several chapters: kept, true to their numbers, turning with their local axes."""

import numpy as np
import pytest

from driftlab.book.scenarios import SPEED_UP, TURN, ship_manoeuvre
from driftlab.frames import navigation_frame_rate
from driftlab.motion.trajectory import Trajectory
from driftlab.motion.vehicle import smooth_step, vehicle_trajectory
from driftlab.quaternion import rotate
from saratov import LATITUDE


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


def test_the_ship_of_the_figures_turns_with_its_local_axes() -> None:
    """The rate about Up that a log tells: that of the local axes, whose sum the gyros have."""
    way = ship_manoeuvre(LATITUDE, 10.0, 0.5, 0.0, 4.0)
    gyros = rotate(way.attitude[:-1], way.increments.angle).sum(axis=0)
    rates = navigation_frame_rate(way.latitude, way.velocity)
    np.testing.assert_allclose(gyros, 4.0 * 0.5 * (rates[1:] + rates[:-1]).sum(axis=0), rtol=1e-5)
