"""The levelling loop as a linear filter: its poles, and what disturbs it, frequency by frequency.

Its frequency response to each disturbance is what a Bode diagram shows. The tuning is Schuler's,
*Die Störung von Pendel- und Kreiselapparaten durch die Beschleunigung des Fahrzeuges*,
Physikalische Zeitschrift 24, 1923; gains k1 and k2 as in Plotnikov et al.

One channel, for the tilt chi about East, of a compass without velocity to the North; the other
channel is its mirror image. With the acceleration a, the error n of the accelerometer, the drift d
of the gyro and the log's velocity v_log:

    chi' = -k1 (g chi + a + n - v_log') - k2 ∫(g chi + a + n) dt + ∫a dt/R - d.

Chapter 10 derives it. The tuning k2 = 1/R is that of M. Schuler (Physikalische Zeitschrift 24,
1923); the loop and its oscillation without damping are in K. R. Britting, Inertial Navigation
Systems Analysis (1971).
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

from .gains import Gains

ComplexArray = NDArray[np.complex128]


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

    Examples
    --------
    >>> response = level_loop(Gains(1e-4, 1.6e-7), 9.8).gyro_bias([0.0])
    >>> response.rate.real  # a constant drift, all of it
    array([1.])
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
    log : bool
        Whether a log tells the velocity.
    radius : float
        R of the Earth, m.

    Examples
    --------
    >>> from driftlab.gyrocompass.gains import schuler_gains
    >>> 1e3 * level_loop(schuler_gains(), 9.8).poles().round(6)  # 1/s
    array([0.+1.24j, 0.-1.24j])
    """

    gains: Gains
    gravity: float
    log: bool
    radius: float

    def poles(self, vertical_rate: float = 0.0) -> ComplexArray:
        """Poles of both channels together, as one complex tilt alpha + i chi.

        Parameters
        ----------
        vertical_rate : float
            U sin(latitude), by which the Earth couples the channels, rad/s. Then the poles of
            alpha - i chi are the complex conjugates of these.

        Returns
        -------
        ndarray, shape (2,)
            Roots of s^2 + (k1 g - i U sin(latitude)) s + k2 g, 1/s; the larger imaginary part
            first.

        Examples
        --------
        With half of the critical damping a swing leaves a fortieth of itself:

        >>> from driftlab.gyrocompass.gains import damped_gains
        >>> pole, _ = level_loop(damped_gains(0.02, 9.8, 0.5), 9.8).poles()
        >>> round(float(np.exp(2 * np.pi * pole.real / pole.imag)), 3)
        0.027
        """
        k1, k2 = self.gains
        turning = finite_number(vertical_rate, "vertical_rate")
        found = np.roots([1.0, k1 * self.gravity - 1j * turning, k2 * self.gravity])
        return np.asarray(found[np.argsort(-found.imag)])

    def acceleration(self, frequency: ArrayLike) -> LoopResponse:
        """Response to the ship's acceleration to the North.

        Parameters
        ----------
        frequency : array_like, shape (n,)
            rad/s.

        Returns
        -------
        LoopResponse
            For m/s^2; zeros with Schuler's k2 and no k1, or with a log.

        Examples
        --------
        >>> from driftlab.gyrocompass.gains import schuler_gains
        >>> level_loop(schuler_gains(), 9.8).acceleration([1e-3]).tilt
        array([0.+0.j])
        """
        (k1, k2), g, radius = self.gains, self.gravity, self.radius
        untuned = k2 - 1 / radius
        if self.log:
            return self._response(frequency, [-untuned], [-untuned, -untuned * k1 * g])
        return self._response(frequency, [-k1, -untuned], [-untuned, k1 * g / radius])

    def gyro_bias(self, frequency: ArrayLike) -> LoopResponse:
        """Response to the drift of the gyros about East.

        Parameters
        ----------
        frequency : array_like, shape (n,)
            rad/s.

        Returns
        -------
        LoopResponse
            For rad/s.

        Examples
        --------
        Far above its natural frequency the loop follows the gyros, and the integral does not:

        >>> from driftlab.gyrocompass.gains import damped_gains
        >>> abs(level_loop(damped_gains(0.02, 9.8), 9.8).gyro_bias([2.0]).rate).round(6)
        array([0.0001])
        """
        g, k2 = self.gravity, self.gains.integral
        return self._response(frequency, [-1.0, 0.0], [k2 * g])

    def accelerometer_bias(self, frequency: ArrayLike) -> LoopResponse:
        """Response to an error of the accelerometer to the North.

        Parameters
        ----------
        frequency : array_like, shape (n,)
            rad/s.

        Returns
        -------
        LoopResponse
            For m/s^2.

        Examples
        --------
        A constant one tilts the horizon by itself over g, and the rate does not show it:

        >>> from driftlab.gyrocompass.gains import damped_gains
        >>> found = level_loop(damped_gains(0.02, 10.0), 10.0).accelerometer_bias([0.0])
        >>> found.tilt.real.round(6), found.rate.real + 0.0
        (array([-0.1]), array([0.]))
        """
        k1, k2 = self.gains
        return self._response(frequency, [-k1, -k2], [-k2, 0.0])

    def log_error(self, frequency: ArrayLike) -> LoopResponse:
        """Response to an error of the log's velocity to the North.

        Parameters
        ----------
        frequency : array_like, shape (n,)
            rad/s.

        Returns
        -------
        LoopResponse
            For m/s; the rate has the error of the speed error that is subtracted. Zeros without a
            log.

        Examples
        --------
        At the Schuler frequency, with Schuler's k2, both parts of the heading error cancel:

        >>> from driftlab.gyrocompass.gains import damped_gains
        >>> swing = np.sqrt(9.8 / EARTH_RADIUS)
        >>> found = level_loop(damped_gains(swing, 9.8), 9.8, log=True).log_error([0.0, swing])
        >>> abs(EARTH_RADIUS * found.rate).round(6)
        array([1., 0.])
        """
        (k1, k2), g, radius = self.gains, self.gravity, self.radius
        if not self.log:
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
    gains: Gains, gravity: float, *, log: bool = False, radius: float = EARTH_RADIUS
) -> LevelLoop:
    """Levelling loop of a compass, as a linear filter.

    Parameters
    ----------
    gains : Gains
        Gains of the horizon.
    gravity : float
        g, m/s^2.
    log : bool
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
    >>> from driftlab.gyrocompass.gains import damped_gains
    >>> level_loop(damped_gains(0.02, 9.8, 1.0), 9.8).poles().real.round(6)
    array([-0.02, -0.02])
    """
    checked_instance(gains, Gains, "gains")
    proportional = finite_number(gains.proportional, "gains.proportional")
    if proportional < 0:
        raise ValueError(f"gains.proportional: expected at least 0, got {shown(proportional)}.")
    checked = Gains(proportional, positive_number(gains.integral, "gains.integral"))
    pull, size = one_pull(gravity), positive_number(radius, "radius")
    return LevelLoop(checked, pull, truth_value(log, "log"), size)
