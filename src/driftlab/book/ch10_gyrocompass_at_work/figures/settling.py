"""Accelerated alignment, then Schuler's tuning: how noise becomes a swing that nothing damps."""

from typing import NamedTuple

import numpy as np
from scipy.constants import degree, hour, minute

from driftlab.book.machinery.picture import BLACK, GREY, SERIES, Picture
from driftlab.book.scenarios import SARATOV_LATITUDE as LATITUDE
from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RADIUS, EARTH_RATE, gravity
from driftlab.gyrocompass.levelling import Horizon, damped_tuning, operate, schuler_tuning
from driftlab.gyrocompass.noise import settled_deviation, swing_deviation
from driftlab.motion.vehicle import sensed_at_rest
from driftlab.quaternion import from_rotation_vector, to_rotation_vector

INTERVAL = 1.0
SETTLING = 20 * minute
WORKING = 2 * hour
FREQUENCY = 0.02
"""Natural frequency of the damped horizon, rad/s."""
RANDOM_WALK = 0.002 * degree / float(np.sqrt(hour))
"""Of each gyro, rad/sqrt(s)."""
TILT: FloatArray = np.radians([0.5, 0.0, 0.4])
"""Of the horizon at the start, about North and about East, rad."""
RUNS = 40
SEED = 10


class Settling(NamedTuple):
    """Many runs with one start and noise of their own, and one run without noise."""

    settling_times: FloatArray  # (m,), s
    tilt: FloatArray  # (m,), rad: without noise
    settling_heading: FloatArray  # (m,), rad: without noise
    times: FloatArray  # (n,), s since the horizon was left to itself
    heading: FloatArray  # (RUNS, n), rad
    deviation: FloatArray  # (n,), rad: of the heading, by the closed formulas


def compute() -> Settling:
    """Let the horizon settle for twenty minutes and work for two hours."""
    rng = np.random.default_rng(SEED)
    pull, azimuth_rate = float(gravity(LATITUDE)), EARTH_RATE * np.sin(LATITUDE)
    rate, force = sensed_at_rest([0.0, 0.0, 0.0, 1.0], LATITUDE)
    # Not level, and without an idea of where North is.
    start = Horizon(from_rotation_vector(TILT), np.zeros(2))
    damped = damped_tuning(FREQUENCY, pull)

    def increments(duration: float, *runs: int) -> tuple[FloatArray, FloatArray]:
        size = (*runs, round(duration / INTERVAL), 3)
        noise = RANDOM_WALK * np.sqrt(INTERVAL) * rng.standard_normal(size) if runs else 0.0
        return np.broadcast_to(INTERVAL * rate, size) + noise, np.broadcast_to(
            INTERVAL * force, size
        )

    quiet = operate(start, *increments(SETTLING), INTERVAL, damped, azimuth_rate)
    noisy = operate(start, *increments(SETTLING, RUNS), INTERVAL, damped, azimuth_rate)
    working = operate(
        noisy.last, *increments(WORKING, RUNS), INTERVAL, schuler_tuning(), azimuth_rate, every=60
    )
    # The swing begins with the rate error of the moment; the tilt adds little to it.
    phase = np.sqrt(pull / EARTH_RADIUS) * working.times
    begun = settled_deviation(RANDOM_WALK, FREQUENCY) * np.cos(phase)
    grown = swing_deviation(RANDOM_WALK, working.times, pull)
    level = EARTH_RATE * np.cos(LATITUDE)
    return Settling(
        quiet.times,
        np.linalg.norm(to_rotation_vector(quiet.attitude)[:, [0, 2]], axis=-1),
        np.abs(quiet.heading),
        working.times,
        working.heading,
        np.hypot(begun, grown) / level,
    )


def columns(data: Settling) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the right panel, each four minutes."""
    rows = slice(3, None, 4)
    return {
        "time_s": data.times[rows],
        "formula_deg": np.degrees(data.deviation[rows]).round(8),
        "simulated_deg": np.degrees(data.heading.std(axis=0)[rows]).round(7),
    }


class SettlingPicture(Picture[Settling]):
    """The horizon settles; and what noise does to the heading afterwards."""

    size = (10.5, 3.8)

    def build(self) -> None:
        self.panels = self.figure.subplots(1, 2)
        self.figure.subplots_adjust(0.065, 0.14, 0.985, 0.91, wspace=0.17)
        left, right = self.panels
        left.set(title="accelerated alignment without noise, degrees", xlabel="time, minutes")
        left.set(yscale="log", ylim=(1e-6, 200), xlim=(0, SETTLING / minute))
        right.set(title="then Schuler's tuning, with noise: heading error, degrees")
        right.set(xlabel="time since then, minutes", xlim=(0, WORKING / minute))

    def update(self, data: Settling) -> None:
        left, right = self.panels
        minutes = data.settling_times / minute
        left.plot(minutes, np.degrees(data.settling_heading), **SERIES[0], label="heading error")
        left.plot(minutes, np.degrees(data.tilt), **SERIES[1], label="tilt")
        left.legend(loc="upper right", fontsize=8)
        minutes = data.times / minute
        right.plot(minutes, np.degrees(data.heading.T), color=GREY, linewidth=0.5, alpha=0.6)
        spread = np.degrees(data.heading.std(axis=0))
        bound = np.degrees(data.deviation)
        for sign in (1, -1):
            right.plot(minutes, sign * bound, **SERIES[1],
                       label="formula, one deviation" if sign > 0 else None)  # fmt: skip
            right.plot(minutes, sign * spread, color=BLACK,
                       label=f"deviation of {RUNS} runs" if sign > 0 else None)  # fmt: skip
        right.legend(loc="upper left", fontsize=8)
