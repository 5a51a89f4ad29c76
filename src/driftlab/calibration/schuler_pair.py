"""The rates at which errors at rest oscillate: a day, and Schuler's, split by the turning Earth.

The split is that of Foucault's pendulum, as far as the ellipsoid does not make it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from driftlab.checks import finite_number
from driftlab.earth import EARTH_RATE, checked_latitude, curvature_radii, gravity


class StaticErrorRates(NamedTuple):
    """Rates at which errors at rest oscillate.

    Attributes
    ----------
    earth : float
        The Earth's: a day, rad/s.
    slow, fast : float
        Schuler's pair, split by the Earth's turn under the pendulum, rad/s.

    Examples
    --------
    >>> rates = static_error_rates(np.radians(45.0))  # periods in minutes
    >>> [round(2 * np.pi / rate / 60, 1) for rate in rates]
    [1436.1, 88.0, 81.0]
    """

    earth: float
    slow: float
    fast: float

    @property
    def schuler(self) -> float:
        """Geometric mean of the pair: Schuler's rate, sqrt(g/R).

        Returns
        -------
        float
            rad/s.

        Examples
        --------
        >>> round(2 * np.pi / static_error_rates(np.radians(45.0)).schuler / 60, 1)  # min
        84.5
        """
        return float(np.sqrt(self.slow * self.fast))

    @property
    def foucault(self) -> float:
        """Half the difference of the pair: near the Earth's rate times the sine of the latitude.

        Returns
        -------
        float
            rad/s, not negative.

        Examples
        --------
        >>> rates = static_error_rates(np.radians(-45.0))
        >>> round(rates.foucault / rates.earth, 3)
        0.707
        """
        return (self.fast - self.slow) / 2


def static_error_rates(latitude: float) -> StaticErrorRates:
    """Rates of the oscillations in the errors at rest.

    Parameters
    ----------
    latitude : float
        rad; not a pole.

    Returns
    -------
    StaticErrorRates

    Notes
    -----
    The characteristic equation is s (s^2 + U^2) times that of the pendulum,
    s^4 + s^2 (w_E^2 + w_N^2 + 4 U^2 sin^2 L) + w_E^2 w_N^2 = 0, with U the Earth's rate and
    w_E^2 = g/R_E, w_N^2 = g/R_N of the two radii of curvature. On a sphere its roots are
    U sin L ± sqrt(w^2 + U^2 sin^2 L), near w ± U sin L.

    Examples
    --------
    >>> rates = static_error_rates(0.0)
    >>> bool(rates.foucault < 0.002 * rates.schuler)  # no turn of the Earth about Up
    True
    """
    place = checked_latitude(finite_number(latitude, "latitude"))
    pull = float(gravity(place))
    squares = [pull / float(radius) for radius in curvature_radii(place)]
    vertical = EARTH_RATE * float(np.sin(place))
    both = sum(squares) + 4 * vertical**2
    product = squares[0] * squares[1]
    larger = (both + np.sqrt(both**2 - 4 * product)) / 2
    return StaticErrorRates(EARTH_RATE, float(np.sqrt(product / larger)), float(np.sqrt(larger)))
