"""The levelling loop, frequency by frequency: its transfer functions, and the compass itself."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.constants import degree, hour, minute

from driftlab.book.ch14_gyrocompass_under_way.experiments import DAMPING
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import SARATOV_LATITUDE, SCHULER_PERIOD
from driftlab.checks import FloatArray, finite_array, positive_number
from driftlab.earth import EARTH_RADIUS, EARTH_RATE, gravity
from driftlab.gyrocompass.levelling_loop import LevelLoop, damped_gains, level_loop, schuler_gains
from driftlab.gyrocompass.simulation import simulate_gyrocompass
from driftlab.motion.vehicle import vehicle_trajectory

from .settling import FREQUENCY

SWELL, DAY = 8.0, 24 * hour
"""Periods of a swell and of a day, s."""
DISTURBANCES = ("acceleration", "gyro_bias", "accelerometer_bias", "speed_log_error")
"""Methods of `LevelLoop`."""
DRIVEN = (SWELL, 10 * minute, SCHULER_PERIOD, 6 * hour)
"""Periods at which the compass itself is driven, s."""


GAINS = {
    "tilt, by 0.01 m/s² of acceleration": ("acceleration", "tilt", 0.01),
    "heading, by 0.01 m/s² of acceleration": ("acceleration", "rate", 0.01),
    "heading, by 0.01 °/h of drift": ("gyro_bias", "rate", 0.01 * degree / hour),
    "heading, by 0.1 m/s of the log": ("speed_log_error", "rate", 0.1),
    "heading, by 0.01 m/s² of offset": ("accelerometer_bias", "rate", 0.01),
}
"""What is shown: of which disturbance, which part of the response, and for which size."""


def four_loops(
    latitude: float = SARATOV_LATITUDE, damping: float = DAMPING, frequency: float = FREQUENCY
) -> dict[str, LevelLoop]:
    """Return the loops of the figure; the last is that of accelerated alignment."""
    pull = float(gravity(latitude))
    damped = damped_gains(float(np.sqrt(pull / EARTH_RADIUS)), pull, damping)
    return {
        "Schuler's tuning": level_loop(schuler_gains(), pull),
        f"damped, ratio {damping:g}": level_loop(damped, pull),
        f"damped, ratio {damping:g}, with a log": level_loop(damped, pull, speed_log=True),
        "stiff, for levelling": level_loop(damped_gains(frequency, pull), pull),
    }


def damped_loop(disturbance: str, loops: Mapping[str, LevelLoop]) -> LevelLoop:
    """Damped loop that is driven by a disturbance: by a log if the log errs, else without."""
    _, alone, by_log, _ = loops.values()
    return by_log if disturbance == "speed_log_error" else alone


def frequency_response(
    latitude: float = SARATOV_LATITUDE,
    damping: float = DAMPING,
    frequency: float = FREQUENCY,
    driven_periods: Sequence[float] = DRIVEN,
) -> DataTable:
    """Return the responses of four loops, and those of the compass at a few periods."""
    damping = positive_number(damping, "damping")
    driven_at = finite_array(driven_periods, "driven_periods")
    loops = four_loops(latitude, damping, frequency)
    periods = np.geomspace(2 * DAY, 3.0, 241)
    driven = {
        disturbance: np.transpose(
            [driven_compass(disturbance, float(p), loops, latitude, damping) for p in driven_at]
        )
        for disturbance in DISTURBANCES
    }
    swing = np.sqrt(gravity(latitude) / EARTH_RADIUS)
    poles = np.array([loop.poles() for loop in loops.values()]) / swing
    upper, lower = next(iter(loops.values())).poles(EARTH_RATE * np.sin(latitude))
    split = np.array([upper.imag, -lower.imag]) / swing
    columns: dict[str, tuple[Any, ...]] = {
        "loop": ([name for name in loops for _ in range(2)], "", "of each pole"),
        "pole_real": (poles.real.ravel(), "", "over Schuler's frequency"),
        "pole_imaginary": (poles.imag.ravel(), "", "over Schuler's frequency"),
        "undamped_pole_on_the_turning_earth_real": (np.zeros(2), "", "likewise"),
        "undamped_pole_on_the_turning_earth": (split, "", "likewise, size of imaginary part"),
        "period": (periods, "s", "of a disturbance"),
        "driven_period": (driven_at, "s", "with which the compass is driven"),
    }
    answering, level, rates = {}, EARTH_RATE * np.cos(latitude), 2 * np.pi / periods
    for name, (disturbance, part, size) in GAINS.items():
        answers = {loop: getattr(each, disturbance)(rates) for loop, each in loops.items()}
        answering[name] = [loop for loop, answer in answers.items() if answer.rate.any()]
        unit, scale = ("arcmin", size) if part == "tilt" else ("deg", size / level)
        for loop in answering[name]:
            values = scale * getattr(answers[loop], part)
            columns[f"{name}, {loop}"] = (np.abs(values), unit, "amplitude")
            columns[f"phase, {name}, {loop}"] = (np.angle(values), "deg", "its lead", (), 4)
        if disturbance == "accelerometer_bias":
            # The whole rate is that of the tilt: nothing else turns the horizon.
            for loop, answer in answers.items():
                if not loops[loop].speed_log:
                    values = scale * rates * np.abs(answer.tilt)
                    columns[f"{name}, whole rate, {loop}"] = (values, unit, "in the whole rate")
        seen = scale * np.abs(driven[disturbance][0 if part == "tilt" else 1])
        columns[f"{name}, simulated"] = (seen, unit, "amplitude of the driven compass")
    compared = _gain_and_lead(driven, driven_at, loops)
    return DataTable(
        columns,
        {
            "loops": (loops, "", "undamped, damped, with a log, and for accelerated alignment"),
            "answering": (answering, "", "loops that each disturbance moves"),
            "driven": (driven, "", "tilt and rate of the compass for a unit, complex"),
            "gain_and_lead": (compared, "", "simulated over derived: gains less 1 and leads"),
        },
    )


def driven_compass(
    disturbance: str, period: float, loops: Mapping[str, LevelLoop], latitude: float, damping: float
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
    size = {"acceleration": 1e-2 / swing, "speed_log_error": 0.1}.get(disturbance, 1e-7)
    velocity, error = np.zeros((2, count + 1, 2))
    drift = np.zeros((count, 3))
    mean = -np.diff(np.cos(swing * times)) / (swing * interval)  # of the wave, in each interval
    if disturbance == "acceleration":
        velocity[:, 0] = size * wave
    elif disturbance == "speed_log_error":
        error[:, 0] = size * wave
    elif disturbance == "gyro_bias":
        drift[:, 2] = size * mean
    way = vehicle_trajectory(latitude, velocity, 0.0, interval=interval)
    if disturbance == "accelerometer_bias":
        size = 1e-4
        push = way.increments.velocity + interval * size * mean[:, np.newaxis] * [1.0, 0.0, 0.0]
        way = way._replace(increments=way.increments._replace(velocity=push))
    run = simulate_gyrocompass(
        way, drift, damping=damping, speed_log=loop.speed_log, speed_log_error=error
    )
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


def _gain_and_lead(
    driven: Mapping[str, NDArray[np.complex128]],
    periods: FloatArray,
    loops: Mapping[str, LevelLoop],
) -> dict[str, FloatArray]:
    """Simulated over derived response, by disturbance: (2, 2, m) gains less 1 and leads.

    For tilt and rate, leads in rad; NaN where the derived response is zero.
    """
    compared = {}
    for disturbance, seen in driven.items():
        answer = getattr(damped_loop(disturbance, loops), disturbance)
        known = np.stack(answer(2 * np.pi / periods))
        # At Schuler's frequency a log's error passes to 1e-16 or so, which is nothing.
        passing = np.abs(known) > 1e-9 * np.abs(known).max(axis=-1, keepdims=True)
        ratio = np.divide(seen, known, out=np.full_like(known, np.nan), where=passing)
        compared[disturbance] = np.stack([np.abs(ratio) - 1, np.angle(ratio)], axis=1)
    return compared
