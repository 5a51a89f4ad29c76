"""The levelling loop, frequency by frequency: its transfer functions, and the compass itself."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.constants import hour, minute

from driftlab.book.scenarios import SARATOV_LATITUDE, SCHULER_PERIOD
from driftlab.checks import FloatArray, finite_array, positive_number
from driftlab.earth import EARTH_RADIUS, EARTH_RATE, gravity
from driftlab.gyrocompass.gains import damped_gains, schuler_gains
from driftlab.gyrocompass.levelling_loop import LevelLoop, LoopResponse, level_loop
from driftlab.gyrocompass.simulation import simulate_compass
from driftlab.motion.vehicle import vehicle_trajectory

from .settling import FREQUENCY
from .voyages import DAMPING

SWELL, DAY = 8.0, 24 * hour
"""Periods of a swell and of a day, s."""
DISTURBANCES = ("acceleration", "gyro_bias", "accelerometer_bias", "log_error")
"""Methods of `LevelLoop`."""
DRIVEN = (SWELL, 10 * minute, SCHULER_PERIOD, 6 * hour)
"""Periods at which the compass itself is driven, s."""


class FrequencyResponse(NamedTuple):
    """Gains and phases of the loops, and of a simulated compass with damping."""

    latitude: float  # rad
    damping: float  # damping ratio
    # undamped, damped, damped with a log, and that of accelerated alignment
    loops: dict[str, LevelLoop]
    periods: FloatArray  # (n,), s
    # by disturbance and loop, each (n,); without those that are zero
    curves: dict[str, dict[str, LoopResponse]]
    driven_periods: FloatArray  # (m,), s
    # (2, m) each, tilt and rate for a unit of each disturbance, complex, from `simulate_compass`
    driven: dict[str, NDArray[np.complex128]]


def four_loops(
    latitude: float = SARATOV_LATITUDE, damping: float = DAMPING, frequency: float = FREQUENCY
) -> dict[str, LevelLoop]:
    """Return the loops of the figure; the last is that of accelerated alignment."""
    pull = float(gravity(latitude))
    damped = damped_gains(float(np.sqrt(pull / EARTH_RADIUS)), pull, damping)
    return {
        "Schuler's tuning": level_loop(schuler_gains(), pull),
        f"damped, ratio {damping:g}": level_loop(damped, pull),
        f"damped, ratio {damping:g}, with a log": level_loop(damped, pull, log=True),
        "stiff, for levelling": level_loop(damped_gains(frequency, pull), pull),
    }


def damped_loop(disturbance: str, loops: Mapping[str, LevelLoop]) -> LevelLoop:
    """Damped loop that is driven by a disturbance: by a log if the log errs, else without."""
    _, alone, by_log, _ = loops.values()
    return by_log if disturbance == "log_error" else alone


def frequency_response(
    latitude: float = SARATOV_LATITUDE,
    damping: float = DAMPING,
    frequency: float = FREQUENCY,
    driven_periods: Sequence[float] = DRIVEN,
) -> FrequencyResponse:
    """Return the responses of four loops, and those of the compass at a few periods."""
    damping = positive_number(damping, "damping")
    driven_at = finite_array(driven_periods, "driven_periods")
    loops = four_loops(latitude, damping, frequency)
    periods = np.geomspace(2 * DAY, 3.0, 241)
    curves: dict[str, dict[str, LoopResponse]] = {}
    for disturbance in DISTURBANCES:
        answers = {
            name: getattr(loop, disturbance)(2 * np.pi / periods) for name, loop in loops.items()
        }
        curves[disturbance] = {name: each for name, each in answers.items() if each.rate.any()}
    driven = {
        disturbance: np.transpose(
            [
                driven_compass(disturbance, float(period), loops, latitude, damping)
                for period in driven_at
            ]
        )
        for disturbance in DISTURBANCES
    }
    return FrequencyResponse(latitude, damping, loops, periods, curves, driven_at, driven)


def driven_compass(
    disturbance: str,
    period: float,
    loops: Mapping[str, LevelLoop],
    latitude: float,
    damping: float,
) -> NDArray[np.complex128]:
    """Tilt and rate (2,) of a simulated compass for a unit of a disturbance that swings.

    A ship heads North. What a wave leaves of the loop's own swing is fitted away.
    """
    loop, swing = damped_loop(disturbance, loops), 2 * np.pi / period
    interval = min(period / 40, 60.0)
    # Some of the loop's own swing must be seen, or it cannot be told from the wave.
    count = round(max(3 * period, min(40 * period, 2 * SCHULER_PERIOD)) / interval)
    times = interval * np.arange(count + 1)
    wave = np.sin(swing * times)
    size = {"acceleration": 1e-2 / swing, "log_error": 0.1}.get(disturbance, 1e-7)
    velocity, error = np.zeros((2, count + 1, 2))
    drift = np.zeros((count, 3))
    mean = -np.diff(np.cos(swing * times)) / (swing * interval)  # of the wave, in each interval
    if disturbance == "acceleration":
        velocity[:, 0] = size * wave
    elif disturbance == "log_error":
        error[:, 0] = size * wave
    elif disturbance == "gyro_bias":
        drift[:, 2] = size * mean
    way = vehicle_trajectory(latitude, velocity, 0.0, interval=interval)
    if disturbance == "accelerometer_bias":
        size = 1e-4
        push = way.increments.velocity + interval * size * mean[:, np.newaxis] * [1.0, 0.0, 0.0]
        way = way._replace(increments=way.increments._replace(velocity=push))
    run = simulate_compass(way, drift, damping=damping, log=loop.log, log_error=error)
    seen = np.stack([run.tilt[:, 1], EARTH_RATE * np.cos(latitude) * run.heading_error])
    unit = size * 1j * swing if disturbance == "acceleration" else size
    return _wave_in(run.times, seen, swing, loop) / unit


def _wave_in(
    times: FloatArray, seen: FloatArray, swing: float, loop: LevelLoop
) -> NDArray[np.complex128]:
    """Complex amplitudes (m,) of sin(swing t) in signals (m, n), beside the loop's own swing."""
    pole = loop.poles()[0]
    own = np.exp(pole * times)
    shapes = [np.sin(swing * times), np.cos(swing * times), np.ones_like(times), own.real, own.imag]
    sine, cosine, *_ = np.linalg.lstsq(np.stack(shapes, axis=-1), seen.T, rcond=None)[0]
    return np.asarray(sine + 1j * cosine)


def gain_and_lead(data: FrequencyResponse) -> dict[str, FloatArray]:
    """Simulated over derived response, by disturbance: (2, 2, m) gains less 1 and leads.

    For tilt and rate, leads in rad; NaN where the derived response is zero.
    """
    compared = {}
    for disturbance, driven in data.driven.items():
        answer = getattr(damped_loop(disturbance, data.loops), disturbance)
        known = np.stack(answer(2 * np.pi / data.driven_periods))
        # At Schuler's frequency a log's error passes to 1e-16 or so, which is nothing.
        passing = np.abs(known) > 1e-9 * np.abs(known).max(axis=-1, keepdims=True)
        ratio = np.divide(driven, known, out=np.full_like(known, np.nan), where=passing)
        compared[disturbance] = np.stack([np.abs(ratio) - 1, np.angle(ratio)], axis=1)
    return compared
