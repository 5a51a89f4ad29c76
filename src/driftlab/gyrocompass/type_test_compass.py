"""What a type test wants to know of a compass, and how finely it is simulated."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from scipy.constants import minute

from driftlab.checks import (
    checked_instance,
    finite_array,
    finite_number,
    keep,
    nonnegative_number,
    positive_number,
    shown,
    truth_value,
)

from .noise import GyroNoise

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
        Damping ratio of the horizon at work, at least 0.
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
            bias = finite_array(getattr(self, name), name, 3)
            if bias.ndim > 1:
                raise ValueError(f"{name}: expected shape (3,), got {bias.shape}.")
            keep(self, **{name: tuple(bias.tolist())})
        checked_instance(self.gyro_noise, GyroNoise, "gyro_noise")
        keep(
            self,
            damping=nonnegative_number(self.damping, "damping"),
            log=truth_value(self.log, "log"),
            alignment_time=positive_number(self.alignment_time, "alignment_time"),
            log_scale=finite_number(self.log_scale, "log_scale"),
        )
        if self.log_scale and not self.log:
            raise ValueError("log_scale: expected zero without a log, got an error of one.")


def checked_steps(steps: Steps) -> Steps:
    """Return steps that are fine enough for each test, none longer than that of `COARSE`."""
    checked_instance(steps, Steps, "steps")
    for name, most in COARSE._asdict().items():
        size = positive_number(getattr(steps, name), f"steps.{name}")
        if name == "rolling":
            if size < minute:
                raise ValueError(f"steps.rolling: expected at least a minute, got {shown(size)}.")
        elif size > most:
            raise ValueError(
                f"steps.{name}: expected at most {most:g} s, as in COARSE, got {shown(size)}."
            )
    return steps
