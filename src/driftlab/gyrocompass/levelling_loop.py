"""The levelling loop as a linear filter: gains, poles, and the response to each disturbance.

Its frequency response to each disturbance is what a Bode diagram shows. One channel, for the tilt
chi about East, of a compass without velocity to the North; the other channel is its mirror image.
With the acceleration a, the error n of the accelerometer, the drift d of the gyro and the log's
velocity v_log, and the gains k1 and k2 as in Plotnikov et al.:

    chi' = -k1 (g chi + a + n - v_log') - k2 ∫(g chi + a + n) dt + ∫a dt/R - d.

Chapter 14 derives it. The tuning k2 = 1/R is Schuler's, *Die Störung von Pendel- und
Kreiselapparaten durch die Beschleunigung des Fahrzeuges*, Physikalische Zeitschrift 24, 1923; the
loop and its oscillation without damping are in K. R. Britting, Inertial Navigation Systems Analysis
(1971).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from driftlab.checks import (
    checked_instance,
    finite_array,
    finite_number,
    one_pull,
    positive_number,
    shown,
    truth_value,
)
from driftlab.earth import EARTH_RADIUS

ComplexArray = NDArray[np.complex128]


class Gains(NamedTuple):
    """Gains by which the horizon follows the accelerometers.

    Attributes
    ----------
    proportional : float
        k1, rad/s for each m/s^2.
    integral : float
        k2, rad/s^2 for each m/s^2.

    Examples
    --------
    >>> Gains(proportional=0.0, integral=1e-5)
    Gains(proportional=0.0, integral=1e-05)
    """

    proportional: float
    integral: float


def schuler_gains(radius: float = EARTH_RADIUS) -> Gains:
    """Gains of Schuler tuning, which has no ballistic error: k1 = 0 and k2 = 1/R.

    Parameters
    ----------
    radius : float
        R of the Earth, m.

    Returns
    -------
    Gains
        With the period of 84 minutes of a pendulum of the Earth's radius.

    Examples
    --------
    >>> gains = schuler_gains()
    >>> round(2 * np.pi / float(np.sqrt(9.8 * gains.integral)) / 60, 1)  # period, minutes
    84.4
    """
    return Gains(0.0, 1 / positive_number(radius, "radius"))


def damped_gains(
    natural_frequency: float, gravity: float, damping: float = float(np.sqrt(0.5))
) -> Gains:
    """Gains of a damped horizon, for accelerated alignment.

    Parameters
    ----------
    natural_frequency : float
        wn, rad/s.
    gravity : float
        g, m/s^2.
    damping : float
        Damping ratio zeta, without unit.

    Returns
    -------
    Gains
        k1 = 2 zeta wn/g and k2 = wn^2/g.

    Examples
    --------
    >>> gains = damped_gains(0.01, 9.8)
    >>> f"{gains.proportional:.2e} {gains.integral:.2e}"
    '1.44e-03 1.02e-05'
    """
    frequency = positive_number(natural_frequency, "natural_frequency")
    pull, ratio = one_pull(gravity), positive_number(damping, "damping")
    return Gains(2 * ratio * frequency / pull, frequency * frequency / pull)


class LoopResponse(NamedTuple):
    """What becomes of one disturbance, as complex gains at n frequencies.

    Attributes
    ----------
    tilt : ndarray, shape (n,)
        Tilt about East, rad for a unit of the disturbance.
    rate : ndarray, shape (n,)
        Error of the integral part of the rate about East, from which the heading is read, without
        the speed error; with a log that is the one that the log tells. rad/s for a unit. Over the
        level rate U cos(latitude) it is the heading error.
    """

    tilt: ComplexArray
    rate: ComplexArray


class LevelLoop(NamedTuple):
    """Result of `level_loop`.

    Attributes
    ----------
    gains : Gains
    gravity : float
        g, m/s^2.
    speed_log : bool
        Whether a log tells the velocity.
    radius : float
        R of the Earth, m.
    """

    gains: Gains
    gravity: float
    speed_log: bool
    radius: float

    def poles(self, vertical_rate: float = 0.0) -> ComplexArray:
        """Poles (2,) of both channels as one complex tilt alpha + i chi, 1/s.

        The Earth couples the channels by `vertical_rate`, U sin(latitude), rad/s. The roots are
        those of s^2 + (k1 g - i U sin(latitude)) s + k2 g, the larger imaginary part first.
        """
        k1, k2 = self.gains
        turning = finite_number(vertical_rate, "vertical_rate")
        found = np.roots([1.0, k1 * self.gravity - 1j * turning, k2 * self.gravity])
        return np.asarray(found[np.argsort(-found.imag)])

    def acceleration(self, frequency: ArrayLike) -> LoopResponse:
        """Response to the ship's acceleration to the North, m/s^2, at frequencies (n,) in rad/s."""
        (k1, k2), g, radius = self.gains, self.gravity, self.radius
        untuned = k2 - 1 / radius
        if self.speed_log:
            return self._response(frequency, [-untuned], [-untuned, -untuned * k1 * g])
        return self._response(frequency, [-k1, -untuned], [-untuned, k1 * g / radius])

    def gyro_bias(self, frequency: ArrayLike) -> LoopResponse:
        """Response to the drift of the gyros about East, rad/s, at frequencies (n,) in rad/s."""
        g, k2 = self.gravity, self.gains.integral
        return self._response(frequency, [-1.0, 0.0], [k2 * g])

    def accelerometer_bias(self, frequency: ArrayLike) -> LoopResponse:
        """Response to an error of the North accelerometer, m/s^2, at frequencies (n,) in rad/s."""
        k1, k2 = self.gains
        return self._response(frequency, [-k1, -k2], [-k2, 0.0])

    def speed_log_error(self, frequency: ArrayLike) -> LoopResponse:
        """Response to an error of the log's North velocity, m/s, at frequencies (n,) in rad/s."""
        (k1, k2), g, radius = self.gains, self.gravity, self.radius
        if not self.speed_log:
            return self._response(frequency, [0.0], [0.0])
        told = [1 / radius, k1 * g * (1 / radius - k2), k2 * g / radius]
        return self._response(frequency, [k1, 0.0, 0.0], told)

    def _response(self, frequency: ArrayLike, tilt: list[float], rate: list[float]) -> LoopResponse:
        swings = np.atleast_1d(finite_array(frequency, "frequency"))
        below = [1.0, self.gains.proportional * self.gravity, self.gains.integral * self.gravity]
        s = 1j * swings
        divisor = np.polyval(below, s)
        return LoopResponse(*(np.polyval(above, s) / divisor for above in (tilt, rate)))


def level_loop(
    gains: Gains, gravity: float, *, speed_log: bool = False, radius: float = EARTH_RADIUS
) -> LevelLoop:
    """Levelling loop of a compass, as a linear filter.

    Parameters
    ----------
    gains : Gains
        Gains of the horizon.
    gravity : float
        g, m/s^2.
    speed_log : bool
        Whether a log tells the velocity, so that k1 acts on what it does not explain.
    radius : float
        R of the Earth, m.

    Returns
    -------
    LevelLoop
        Its methods give poles and responses.

    Raises
    ------
    ValueError
        If a gain is negative, or k2, gravity or radius is not positive.

    Examples
    --------
    >>> loop = level_loop(damped_gains(0.02, 9.8, 1.0), 9.8)
    >>> loop.poles().real.round(6)
    array([-0.02, -0.02])
    >>> loop.gyro_bias([0.0]).rate.real  # a constant drift, all of it
    array([1.])
    """
    checked_instance(gains, Gains, "gains")
    proportional = finite_number(gains.proportional, "gains.proportional")
    if proportional < 0:
        raise ValueError(f"gains.proportional: expected at least 0, got {shown(proportional)}.")
    checked = Gains(proportional, positive_number(gains.integral, "gains.integral"))
    pull, size = one_pull(gravity), positive_number(radius, "radius")
    return LevelLoop(checked, pull, truth_value(speed_log, "speed_log"), size)
