"""IMO A.821(19), 4.2.1: finding North on a ship that rolls, pitches and sways, and may turn."""

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import degree, g, micro, minute

from driftlab.book.ch13_finding_north.experiments import WHITE, gyro_noise
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import SARATOV_LATITUDE
from driftlab.calibration.filter import calibrate
from driftlab.checks import FloatArray, finite_array, whole_number
from driftlab.core.vectors import wrap_angle
from driftlab.earth import EARTH_RADIUS, EARTH_RATE
from driftlab.frames import FROM_EAST_NORTH_UP, to_euler_angles
from driftlab.gyrocompass.inertial_alignment import align_in_inertial_frame
from driftlab.gyrocompass.levelling import LevelFrame, propagate_level_frame
from driftlab.gyrocompass.levelling_loop import damped_gains
from driftlab.gyrocompass.type_test import LIMITS
from driftlab.imu import ImuNoise, PriorStandardDeviations
from driftlab.increments import Increments
from driftlab.motion.trajectory import Trajectory
from driftlab.motion.vehicle import vehicle_trajectory
from driftlab.quaternion import conjugate, from_rotation_vector, multiply

from .settling import FREQUENCY, TILT
from .type_tests import LASTING_DRIFT

LEAN, PUSH = 5 * degree, 0.22
"""Of 4.2.1: largest roll and pitch, rad, and horizontal acceleration, m/s^2."""
HORIZONS = {"stiff": FREQUENCY, "soft": 0.004, "Schuler's": float(np.sqrt(g / EARTH_RADIUS))}
"""Natural frequencies of damped horizons, rad/s; the first is that of *Setting out*."""
DAMPING = float(np.sqrt(0.5))
"""Their damping ratio."""
OFFSET, SWAY = 100 * micro * g, 0.25
"""Deviations of each accelerometer's offset, m/s^2, and of the sway as the filter takes it, m/s."""
PERIODS = (6.0, 7.7, 10.0, 12.3, 15.0)
TURNS: FloatArray = np.radians([0.0, 15.0, 30.0, 60.0, 90.0, 135.0, 180.0])


def ship_at_sea(
    latitude: float, periods: tuple[float, float], duration: float, interval: float, turn: float = 0
) -> Trajectory:
    """A ship with its bow North that rolls and pitches with two periods, and turns halfway, rad.

    It is pushed North and back with the period of the roll.
    """
    times = interval * np.arange(round(duration / interval) + 1)
    roll, pitch = (2 * np.pi / period for period in periods)
    north = PUSH / roll * np.sin(roll * times + 1.0)
    return vehicle_trajectory(
        latitude, np.stack([north, 0 * north], axis=-1),
        turn * np.clip((times - duration / 2) / 90 + 0.5, 0.0, 1.0),
        LEAN * np.cos(pitch * times), LEAN * np.sin(roll * times), interval=interval,
    )  # fmt: skip


def sensed(way: Trajectory) -> Increments:
    """Increments over five intervals each; in one the rates of a trajectory are constant."""
    interval, *rows = way.increments
    return Increments(5 * interval, *(each.reshape(-1, 5, 3).sum(axis=1) for each in rows))


def horizon_headings(way: Trajectory, frequency: float, damping: float = DAMPING) -> FloatArray:
    """Headings (n,) of a damped horizon that begins out of level, without an idea of North."""
    start = LevelFrame(multiply(from_rotation_vector(TILT), way.attitude[0]), np.zeros(2))
    azimuth_rate = EARTH_RATE * np.sin(way.latitude[0])
    gains = damped_gains(frequency, g, damping)
    return propagate_level_frame(start, way.increments, gains, azimuth_rate).heading


def fine_alignment(read: Increments, latitude: float) -> tuple[FloatArray, FloatArray]:
    """Headings (...) at the end by a filter that takes the ship's velocity for zero and a sway.

    And their deviations as it states them. It starts from gravity in inertial space, after five
    minutes of the record, and looks for biases alone.
    """
    coarse = align_in_inertial_frame(read.part(0, round(5 * minute / read.interval)), latitude)
    quiet = gyro_noise(WHITE[0])
    found = calibrate(
        read, latitude=latitude, model="averaged", check=False,
        start=multiply(conjugate(FROM_EAST_NORTH_UP), coarse.start_attitude),
        prior=PriorStandardDeviations(1 * degree, LASTING_DRIFT, OFFSET, 0.0, 0.0, velocity=SWAY),
        noise=ImuNoise(quiet.white * float(np.sqrt(quiet.interval)), 0.0, SWAY),
    )  # fmt: skip
    attitude = multiply(FROM_EAST_NORTH_UP, found.attitude[..., -1, :])
    return to_euler_angles(attitude).heading, found.standard_deviations[..., -1, 2]


def spreads(way: Trajectory, units: int, rng: np.random.Generator) -> tuple[float, float, float]:
    """Errors (root mean square) of units' headings in inertial space and by the filter, and stated.

    The units have the quiet gyros of the paper, with a lasting drift in each.
    """
    interval, angle, velocity = sensed(way)
    rate = np.moveaxis(gyro_noise(WHITE[0]).samples(len(angle), rng, units, 3), -1, -2)
    drift, offset = (size * rng.normal(size=(units, 1, 3)) for size in (LASTING_DRIFT, OFFSET))
    read = Increments(interval, angle + interval * (rate + drift), velocity + interval * offset)
    latitude, true = float(way.latitude[0]), to_euler_angles(way.attitude[-1]).heading
    by_filter, stated = fine_alignment(read, latitude)
    errors = np.array([align_in_inertial_frame(read, latitude).heading, by_filter]) - true
    return *np.sqrt(np.mean(wrap_angle(errors) ** 2, axis=1)), float(stated.mean())


def settling_at_sea(
    periods: ArrayLike = PERIODS, turns: ArrayLike = TURNS, units: int = 40,
    latitude: float = SARATOV_LATITUDE, seed: int = 421,
) -> DataTable:  # fmt: skip
    """Let perfect compasses settle at sea, then align units for 20 minutes on a ship that turns.

    Settled is a heading that from then on keeps the limit of the settle point, in the waves. The
    ship turns in the middle of the record.
    """
    waves, angles = finite_array(periods, "periods"), finite_array(turns, "turns")
    times, swings = np.transpose([_settled(latitude, wave) for wave in waves.tolist()], (2, 1, 0))
    many = whole_number(units, "units", least=2)
    ships = (ship_at_sea(latitude, (10.0, 10.0), 20 * minute, 0.02, turn) for turn in angles)
    # The same units at each turn.
    spread = np.transpose([spreads(ship, many, np.random.default_rng(seed)) for ship in ships])
    ways, kinds = [*HORIZONS, "inertial"], ["inertial frame", "filter", "stated by the filter"]
    return DataTable(
        {
            "period": (waves, "s", "of roll, pitch and sway"),
            "settling": (times, "min", "none if it never settles", ways),
            "swing": (swings, "", "of the heading at the end, over the limit", ways),
            "turn": (angles, "deg", "of the ship, during the alignment"),
            "deviation": (spread, "deg", "of the heading", kinds),
        }
    )


def _settled(latitude: float, wave: float) -> list[tuple[float, float]]:
    """Time of settling, s, by each way, and the largest error at the end over the limit."""
    limit, periods = LIMITS["settle point"].at(latitude), (wave, wave)
    way = ship_at_sea(latitude, periods, LIMITS["settling at sea"].size, 0.5)
    found = [(way.times[1:], horizon_headings(way, each)) for each in HORIZONS.values()]
    read = sensed(ship_at_sea(latitude, periods, 10 * minute, 0.02))
    times = np.arange(90.0, 601.0, 10.0)
    parts = (read.part(0, round(time / read.interval)) for time in times)
    found.append((times, np.array([align_in_inertial_frame(p, latitude).heading for p in parts])))
    rows = []
    for times, errors in found:
        share = np.abs(errors) / limit
        swing = share[-len(share) // 10 :].max()
        first = np.flatnonzero(share > 1).max(initial=-1) + 1
        rows.append((times[first] if swing <= 1 else np.nan, swing))
    return rows
