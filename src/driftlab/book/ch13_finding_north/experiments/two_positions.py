"""One position, two positions, gravity in inertial space: headings with a slow drift of gyros."""

import numpy as np
from scipy.constants import minute

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import SARATOV_LATITUDE
from driftlab.checks import FloatArray, finite_number, positive_number, whole_number
from driftlab.earth import EARTH_RATE
from driftlab.gyrocompass.alignment import align
from driftlab.gyrocompass.alignment_deviations import two_position_standard_deviation
from driftlab.gyrocompass.inertial_alignment import align_in_inertial_frame
from driftlab.gyrocompass.noise import GyroNoise
from driftlab.gyrocompass.two_position_alignment import align_multi_position
from driftlab.increments import Increments
from driftlab.motion.vehicle import static_imu
from driftlab.quaternion import from_rotation_vector

from .averaging import DEGREE_PER_HOUR, SLOW, WHITE, gyro_noise

UNITS = 300
MINUTES = 10.0
"""Time of both positions together, on the left, min."""
WAYS = ("one position", "two positions", "inertial frame")
TURN_ERROR = float(np.radians(0.1))
"""Deviation of what is known of the turn, on the left."""


def two_positions(
    white: float = WHITE[0] * DEGREE_PER_HOUR,
    gauss_markov: float = SLOW * DEGREE_PER_HOUR,
    duration: float = minute * MINUTES,
    turn_error: float = TURN_ERROR,
    latitude: float = SARATOV_LATITUDE,
    units: int = UNITS,
    seed: int = 97,
) -> DataTable:
    """Headings of many units whose gyros have the quiet noise of the chapter, in three ways."""
    many, place = whole_number(units, "units", least=2), finite_number(latitude, "latitude")
    wrong_turn = positive_number(turn_error, "turn_error")
    half = whole_number(round(positive_number(duration, "duration") / 2), "duration")
    rng = np.random.default_rng(seed)
    noise = gyro_noise(
        positive_number(white, "white") / DEGREE_PER_HOUR,
        positive_number(gauss_markov, "gauss_markov") / DEGREE_PER_HOUR,
    ).sampled_every(1.0)
    turns = np.radians([10.0, 15.0, 20.0, 30.0, 45.0, 60.0, 90.0, 120.0, 150.0, 180.0])
    times = np.array([20.0, 40.0, 90.0, 180.0, 360.0, 800.0, 1800.0])
    means = noise_means(noise, 2, half, rng, many)
    by_turn = [
        [_scatter(means, turn, place, wrong * rng.standard_normal(many)) for turn in turns]
        for wrong in (0.0, wrong_turn)
    ]
    walk = noise.white * np.sqrt(noise.interval)
    change = np.sqrt(2) * float(noise.allan_deviation(half))
    change = np.sqrt(change**2 - 2 * walk**2 / half)
    by_turn_formula = [
        two_position_standard_deviation(
            place, 2.0 * half, walk, turns, turn_error=wrong, gyro_bias_change=change
        )
        for wrong in (0.0, wrong_turn)
    ]
    level = EARTH_RATE * np.cos(place)
    alone = walk / np.sqrt(times) / level
    mean = [noise.standard_deviation_of_mean(round(time)) / level for time in times]
    allan = noise.allan_deviation(times / 2) / (np.sqrt(2) * level)
    by_time = np.array([_by_time(noise, round(time), place, many, rng) for time in times]).T
    by_time_formula = np.stack([mean, allan, _through_the_bell(noise, times) / level])
    known = ("turn known exactly", f"turn known to {np.degrees(wrong_turn):.1g}°")
    kinds, spread = ("simulated", "formula"), "standard deviation of the heading"
    return DataTable(
        {
            "turn": (turns, "deg", "turn between the two positions"),
            "by_turn": (
                np.stack([by_turn, by_turn_formula], axis=1), "deg", spread, [known, kinds]
            ),
            "time": (times, "s", "time of the whole alignment"),
            "by_time": (
                np.stack([by_time, by_time_formula], axis=1), "deg", spread, [WAYS, kinds]
            ),
            "white_noise_alone": (alone, "deg", f"{spread} from one position without a slow part"),
        },
        {
            "duration": (2.0 * half, "min", "time of both positions where the turn varies"),
            "units": (many, "", "units simulated at each point"),
        },
    )  # fmt: skip


def noise_means(
    noise: GyroNoise, parts: int, seconds: int, rng: np.random.Generator, units: int = UNITS
) -> FloatArray:
    """Means (units, parts, 3) of the gyros' noise over stretches that follow each other, rad/s."""
    samples = noise.samples(parts * seconds, rng, units, 3)
    return np.swapaxes(samples.reshape(units, 3, parts, -1).mean(axis=-1), -1, -2)


def _scatter(
    means: FloatArray, turn: float, latitude: float, wrong: FloatArray | float = 0.0
) -> float:
    """Deviation of the heading of level units in two positions."""
    rate, force = static_imu(_about_up([0.0, turn]), latitude)
    believed = _about_up(np.stack(np.broadcast_arrays(0.0, turn + wrong), axis=-1))
    found = align_multi_position(rate + means, force, believed)
    return float(np.std(found.heading))


def _by_time(
    noise: GyroNoise, seconds: int, latitude: float, units: int, rng: np.random.Generator
) -> list[float]:
    """Deviations of the heading by the three ways, with the same noise."""
    means = noise_means(noise, seconds, 1, rng, units)
    rate, force = static_imu([0.0, 0.0, 0.0, 1.0], latitude)
    one = align(rate + means.mean(axis=-2), force, heading_tolerance=np.inf).heading
    halves = means.reshape(units, 2, seconds // 2, 3).mean(axis=-2)
    pieces = 4 if seconds < 80 else 1  # there must be 72 increments
    fine = np.repeat(rate + means, pieces, axis=-2) / pieces
    increments = Increments(1 / pieces, fine, np.broadcast_to(force / pieces, fine.shape))
    carried = align_in_inertial_frame(increments, latitude).heading
    return [float(np.std(one)), _scatter(halves, np.pi, latitude), float(np.std(carried))]


def _through_the_bell(noise: GyroNoise, times: FloatArray) -> FloatArray:
    """Deviation of the drift as `align_in_inertial_frame` weighs it, rad/s."""
    part = (np.arange(400) + 0.5) / 400
    bell = 140 * (part * (1 - part)) ** 3 / 400
    apart = np.abs(part - part[:, np.newaxis])
    lags = times[:, np.newaxis, np.newaxis] / noise.correlation_time * apart
    slow = noise.gauss_markov**2 * np.einsum("i,kij,j->k", bell, np.exp(-lags), bell)
    white = noise.white**2 * noise.interval * 400 * (bell @ bell) / times
    return np.sqrt(white + slow)


def _about_up(angle: object) -> FloatArray:
    angles = np.asarray(angle, float)
    return from_rotation_vector(angles[..., np.newaxis] * np.array([0.0, 1.0, 0.0]))
