"""Exercise 15.1: a damping ratio, and what it lets through."""

import numpy as np

from driftlab.book.machinery.exercise.answers import Value
from driftlab.book.machinery.exercise.exercise import Exercise
from driftlab.book.scenarios import SARATOV_LATITUDE as LATITUDE, SCHULER_PERIOD
from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RATE, gravity
from driftlab.gyrocompass.levelling_loop import damped_gains, level_loop

from ..experiments import SWELL

LEFT = 0.1
"""Of a swing, after one of its periods."""
SWAYING = 1.0
"""Amplitude of the velocity to the North, m/s."""


def _answer(
    slower: bool = True, accelerated: bool = False, part: str = "rate", level: bool = True
) -> FloatArray:
    """Damping ratio, and two amplitudes in degrees, right or with one slip."""
    decrement = np.log(1 / LEFT) / (2 * np.pi)
    ratio = decrement / np.sqrt(1 + decrement**2) if slower else decrement
    swing, pull = 2 * np.pi / np.array([SCHULER_PERIOD, SWELL]), float(gravity(LATITUDE))
    loop = level_loop(damped_gains(float(swing[0]), pull, float(ratio)), pull)
    tilt, rate = (np.abs(each) for each in loop.acceleration(swing))
    passed = {"rate": rate, "tilt": tilt, "whole": swing * tilt}[part]
    north = EARTH_RATE * (np.cos(LATITUDE) if level else 1.0)
    push = SWAYING * (1.0 if accelerated else swing)
    return np.array([ratio, *np.degrees(push * passed / (1.0 if part == "tilt" else north))])


EXERCISES: dict[str, Exercise] = {
    "15.1": Value(
        kind="compute",
        right=_answer,
        absolute=(0.004, 0.003, 6e-6),
        mistakes={
            "A damped swing is slower than an undamped one, by √(1 − ξ²); count in its own "
            "period.": lambda: _answer(slower=False),
            "The velocity has this amplitude; the acceleration has it times the frequency.": (
                lambda: _answer(accelerated=True)
            ),
            "That is the tilt of the horizon; the heading is read from the integral of the "
            "force.": lambda: _answer(part="tilt"),
            "That is what the whole rate shows; the heading is read from its integral part.": (
                lambda: _answer(part="whole")
            ),
            "Only the level part of the Earth's rate tells where North is.": (
                lambda: _answer(level=False)
            ),
        },
        remark="At its own frequency any damping leaves as much; above it, damping lets more "
        "through.",
    )
}
