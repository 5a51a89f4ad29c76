"""Would it pass? A ship's compass on the tests of the marine standards, in simulation.

What the resolutions leave open is taken from a draft of ISO 22090-1 of the year 2000: what settled
means and from what an error is counted (3.10 to 3.13), and what `_type_test_ways` says.

A simulation is not a type approval. It has no heat, no magnetic field, no shock, no scale factor.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from scipy.constants import degree, knot, minute

from driftlab.checks import (
    FloatArray,
    checked_instance,
    finite_array,
    finite_number,
    positive_number,
    whole_number,
)
from driftlab.earth import EARTH_RATE, gravity
from driftlab.motion.trajectory import Trajectory

from ._type_test_ways import BRAKING, REST, SWING, quay, rolling, speeding_up, turning
from .noise import GyroNoise
from .simulation import simulate_compass
from .type_test_limits import LIMITS, TypeTest

_MOST_LATITUDE = np.radians(85.0)
_BETWEEN, _BAND = 30 * minute, 0.7 * degree  # three readings at such times, in such a band: settled
_READINGS, _APART = 10, 20 * minute  # of a settle point
_AT_REST = LIMITS["settling"].size + (_READINGS + 1) * _APART
_NO_NOISE = GyroNoise(white=0.0, slow=0.0)


class Steps(NamedTuple):
    """How finely the tests are simulated.

    Attributes
    ----------
    quay, speed, turn, sea : float
        Interval of the simulation of each, s.
    rolling : float
        Duration of the test at sea, s.

    Examples
    --------
    >>> FINE.turn, COARSE.turn
    (0.5, 3.0)
    """

    quay: float = 60.0
    speed: float = 6.0
    turn: float = 0.5
    sea: float = 0.5
    rolling: float = 25 * minute


FINE = Steps()
COARSE = Steps(quay=200.0, speed=18.0, turn=3.0, sea=1.0)
"""Several times faster; a horizon damped by a log then turns with up to 0.3 degrees too much."""


@dataclass(frozen=True)
class Gyrocompass:
    """What a type test wants to know of a compass.

    Attributes
    ----------
    gyro_bias : tuple of float
        That last from start to start, in body axes forward, up, right, rad/s.
    gyro_noise : GyroNoise
        Of each gyro; its slow part is new at each start.
    accelerometer_bias : tuple of float
        In body axes, m/s^2.
    damping : float
        Damping ratio of the horizon at work.
    log : bool
        Whether a log tells the velocity. Without one the speed error is taken out by the true way,
        as by a table, and the damping feels the accelerations.
    log_scale : float
        Relative error of what the log tells.
    alignment_time : float
        s.

    Examples
    --------
    >>> Gyrocompass(damping=0.5, log=True).alignment_time
    60.0
    """

    gyro_bias: tuple[float, float, float] = (0.0, 0.0, 0.0)
    gyro_noise: GyroNoise = _NO_NOISE
    accelerometer_bias: tuple[float, float, float] = (0.0, 0.0, 0.0)
    damping: float = 0.0
    log: bool = False
    log_scale: float = 0.0
    alignment_time: float = 60.0

    def __post_init__(self) -> None:
        for name in ("gyro_bias", "accelerometer_bias"):
            finite_array(getattr(self, name), name, 3)
        checked_instance(self.gyro_noise, GyroNoise, "gyro_noise")
        positive_number(self.alignment_time, "alignment_time")
        if finite_number(self.log_scale, "log_scale") and not self.log:
            raise ValueError("log_scale: expected zero without a log, got an error of one.")


def marine_type_test(
    compass: Gyrocompass,
    latitude: float,
    *,
    speed: float = 70 * knot,
    starts: int = 3,
    seed: int = 0,
    steps: Steps = FINE,
) -> TypeTest:
    """Put a compass through the tests of the marine standards at one latitude.

    The compass is mounted so that its lasting errors do most harm with the bow to the North, on
    which all tests begin. Errors under way and at sea are counted from the reading before.

    Parameters
    ----------
    compass : Gyrocompass
        The compass.
    latitude : float
        rad, at most 85 degrees from the equator.
    speed : float
        Under way, m/s: 70 knots in A.821(19), 20 in A.424(XI).
    starts : int
        Number of starts at the quay; the settle point error and the scatter are the worst of them,
        the repeatability is the largest difference of two.
    seed : int
        Of the gyros' noise.
    steps : Steps
        How finely each test is simulated.

    Returns
    -------
    TypeTest
        What each test measured.

    Raises
    ------
    ValueError
        If the latitude is too near a pole, and as in `simulate_compass`.

    Examples
    --------
    A drift that is harmless at the quay shows four times in a turn, whose limit has no secant:

    >>> compass = Gyrocompass(gyro_bias=(0.0, 0.0, np.radians(0.05) / 3600))
    >>> shares = marine_type_test(compass, np.radians(75.0)).shares
    >>> {name: round(shares[name], 2) for name in ("settle point", "turn")}
    {'settle point': 0.25, 'turn': 0.93}
    """
    checked_instance(compass, Gyrocompass, "compass")
    place, way = finite_number(latitude, "latitude"), positive_number(speed, "speed")
    if abs(place) > _MOST_LATITUDE:
        raise ValueError(
            "latitude: expected at most 85 degrees from the equator, "
            f"got {place:.6g} rad, that is {np.degrees(place):.6g} degrees."
        )
    mounted = _at_its_worst(compass, place)
    rng = np.random.default_rng(whole_number(seed, "seed", least=0))
    return TypeTest(
        place,
        _at_the_quay(
            mounted, quay(place, _AT_REST, steps.quay), whole_number(starts, "starts", least=2), rng
        )
        | _change_of_speed(mounted, speeding_up(place, way, steps.speed), rng)
        | _turn(mounted, turning(place, way, _turn_step(compass, steps)), way, rng)
        | _at_sea(mounted, rolling(place, steps.sea, steps.rolling), rng),
    )


def _turn_step(compass: Gyrocompass, steps: Steps) -> float:
    """Interval in which a turn is simulated: damping feels what a log does not explain in it."""
    return min(steps.turn, 1.0) if compass.log and compass.damping else steps.turn


def _at_its_worst(compass: Gyrocompass, latitude: float) -> Gyrocompass:
    """The compass turned about Up until its lasting errors do most harm with the bow North."""
    gyro, accelerometer = np.array(compass.gyro_bias), np.array(compass.accelerometer_bias)
    # Both in heading error: what counts is the component to the East.
    error = gyro / (EARTH_RATE * np.cos(latitude))
    error = error - accelerometer * np.tan(latitude) / gravity(latitude)
    aside = np.arctan2(error[0], error[2])
    cosine, sine = np.cos(aside), np.sin(aside)
    turned = np.array([[cosine, 0, -sine], [0, 1, 0], [sine, 0, cosine]])
    return replace(
        compass, gyro_bias=tuple(turned @ gyro), accelerometer_bias=tuple(turned @ accelerometer)
    )


def _heading_errors(
    compass: Gyrocompass,
    way: Trajectory,
    rng: np.random.Generator,
    *starts: int,
    blind: bool = False,
) -> FloatArray:
    """Heading errors (*starts, n) on a way, rad; the log is `blind` to a way that only sways."""
    interval, angle, _ = way.increments
    noise = compass.gyro_noise
    before = max(round(compass.alignment_time / interval), 1)
    slow = replace(noise, white=0.0, quantisation=0.0, interval=interval)
    drift = slow.samples(before - 1 + len(angle), rng, *starts, 3)
    at_start = drift[..., :before].mean(axis=-1)
    fast = replace(
        noise, slow=0.0, interval=interval, white=noise.white * np.sqrt(noise.interval / interval)
    ).samples(len(angle), rng, *starts, 3)
    averaged = max(round(compass.alignment_time / noise.interval), 1)
    fast[..., 0] = replace(noise, slow=0.0).deviation_of_mean(averaged) * rng.standard_normal(
        at_start.shape
    )
    bias = drift[..., before - 1 :] + fast
    bias[..., 0] = at_start + fast[..., 0]
    told = way.velocity * (-1.0 if blind else compass.log_scale)
    run = simulate_compass(
        way,
        np.array(compass.gyro_bias) + np.moveaxis(bias, -2, -1),
        compass.accelerometer_bias,
        damping=compass.damping,
        log=compass.log,
        log_error=told if compass.log else (0.0, 0.0),
    )
    unseen = run.speed_error if blind and not compass.log else 0.0
    return run.heading_error + unseen


def _at_the_quay(
    compass: Gyrocompass, way: Trajectory, starts: int, rng: np.random.Generator
) -> dict[str, float]:
    errors = _heading_errors(compass, way, rng, starts)
    every, apart = (round(time / way.increments.interval) for time in (_BETWEEN, _APART))
    latest = int((LIMITS["settling"].size - compass.alignment_time) // _BETWEEN)
    times, points, scatter = [], [], []
    for row in errors:
        band = [
            np.ptp(row[i * every - 1 : (i + 3) * every - 1 : every]) for i in range(1, latest - 1)
        ]
        settled = next((i + 3 for i, width in enumerate(band) if width <= _BAND), None)
        times.append(np.inf if settled is None else settled * _BETWEEN + compass.alignment_time)
        begin = (settled or latest) * every - 1
        taken = row[begin + apart : begin + _READINGS * apart + 1 : apart]
        points.append(taken.mean())
        scatter.append(taken.std())
    return {
        "settling": float(max(times)),
        "settle point": _most(np.array(points)),
        "scatter": float(max(scatter)),
        "repeatability": float(np.ptp(points)),
    }


def _change_of_speed(
    compass: Gyrocompass, way: Trajectory, rng: np.random.Generator
) -> dict[str, float]:
    errors = _heading_errors(compass, way, rng)
    before, swing = (int(time // way.increments.interval) for time in (REST, SWING))
    off = errors - errors[before - 1]
    return {"steady way": float(abs(off[-swing:].mean())), "change of speed": _most(off)}


def _turn(
    compass: Gyrocompass, way: Trajectory, speed: float, rng: np.random.Generator
) -> dict[str, float]:
    errors = _heading_errors(compass, way, rng)
    before = int((2 * REST + speed / BRAKING) // way.increments.interval) - 1
    return {"turn": _most(errors[before:] - errors[before])}


def _at_sea(compass: Gyrocompass, way: Trajectory, rng: np.random.Generator) -> dict[str, float]:
    errors = _heading_errors(compass, way, rng, blind=True)
    return {"sea": _most(errors - errors[0])}


def _most(errors: FloatArray) -> float:
    return float(np.abs(errors).max())
