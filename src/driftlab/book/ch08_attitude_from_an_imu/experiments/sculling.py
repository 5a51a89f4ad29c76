"""A body that swings and is shaken in step: the velocity that its accelerometers lose."""

from typing import NamedTuple

import numpy as np
from scipy.constants import g
from scipy.integrate import cumulative_simpson
from scipy.special import j1

from driftlab.attitude.coning_algorithms import Algorithm
from driftlab.attitude.sculling import step_velocities
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray, positive_number, whole_number
from driftlab.quaternion import from_rotation_vector, rotate


class Sculling(NamedTuple):
    """A swing about the first axis, and a force along the body's second, in step with it."""

    swing: float  # amplitude of the swing, rad
    force: float  # amplitude of the specific force, m/s²
    frequency: float  # of both, Hz

    @property
    def mean_force(self) -> float:
        """Mean force along the third reference axis, m/s²: the mean of F sin p sin(α sin p)."""
        return float(self.force * j1(self.swing))

    def increments(self, interval: float, count: int) -> tuple[FloatArray, FloatArray]:
        """Exact increments (count, 3) of angle, rad, and of velocity, m/s."""
        around = 2 * np.pi * self.frequency
        phase = around * interval * np.arange(count + 1)
        angle, velocity = np.zeros((count, 3)), np.zeros((count, 3))
        angle[:, 0] = np.diff(self.swing * np.sin(phase))
        velocity[:, 1] = np.diff(-self.force / around * np.cos(phase))
        return angle, velocity

    def attitude(self, time: FloatArray) -> FloatArray:
        """Exact attitude (..., 4)."""
        swing = self.swing * np.sin(2 * np.pi * self.frequency * time)
        return from_rotation_vector(swing[..., np.newaxis] * np.array([1.0, 0.0, 0.0]))


SHAKER = Sculling(float(np.radians(1.0)), g, 5.0)
"""The bracket again, now swinging about one axis while something shakes it at 1 g."""


def sculling_error(
    motion: Sculling, rate: float, algorithm: Algorithm, *, turning: bool = True
) -> float:
    """Error of the mean force along the third axis over whole seconds, m/s², by an algorithm.

    The attitude at the start of each step is the exact one. Without `turning` the velocity
    increments of a step are only added.
    """
    seconds = algorithm.samples
    count = round(rate * seconds)
    angle, velocity = motion.increments(1 / rate, count)
    if turning:
        steps = step_velocities(angle, velocity, algorithm)
    else:
        steps = velocity.reshape(-1, algorithm.samples, 3).sum(axis=-2)
    starts = np.arange(0, count, algorithm.samples) / rate
    gained = rotate(motion.attitude(starts), steps).sum(axis=0)
    return float(gained[2] / seconds - motion.mean_force)


def sculling_run(
    swing: float = SHAKER.swing,
    frequency: float = SHAKER.frequency,
    force: float = SHAKER.force,
    periods: int = 4,
) -> DataTable:
    """Follow the velocity along the third axis, in space and as sums in the body."""
    shaker = Sculling(
        positive_number(swing, "swing"),
        positive_number(force, "force"),
        positive_number(frequency, "frequency"),
    )
    count = 200 * whole_number(periods, "periods")
    time = np.linspace(0, periods / shaker.frequency, count + 1)
    phase = 2 * np.pi * shaker.frequency * time
    angle, felt = shaker.swing * np.sin(phase), shaker.force * np.sin(phase)
    velocity = cumulative_simpson(felt * np.sin(angle), x=time, initial=0)
    return DataTable(
        {
            "time": (time, "s", "since the start"),
            "angle": (angle, "deg", "turned about the first axis"),
            "felt": (felt / g, "", "specific force along the second axis of the body, g"),
            "velocity": (velocity, "mm_per_s", "along the third axis in space"),
            "mean": (shaker.mean_force * time, "mm_per_s", "mean force times the time"),
        },
        {"mean_force": (shaker.mean_force, "ug", "mean force along the third axis in space")},
    )
