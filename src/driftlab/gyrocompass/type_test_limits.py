"""What the marine standards want of a gyrocompass, and how far a compass uses each limit up.

The limits are those of the International Maritime Organization: Resolution A.821(19), 1995, for
high-speed craft, and A.424(XI), 1979, for other ships. Most grow with the latitude as its secant,
as the error of a gyro does; two do not. Only the numbers are taken. `Limit.source` says where each
stands, and `Limit.read` whether that place was read or is known at second hand.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.constants import degree, hour


class Limit(NamedTuple):
    """One limit of the standards.

    Attributes
    ----------
    size : float
        At the equator: rad, or s for a time.
    secant : bool
        Whether it is multiplied by the secant of the latitude.
    source : str
        Document and paragraph.
    read : bool
        Whether that paragraph was read for this book; else the number is known at second hand.

    Examples
    --------
    >>> limit = LIMITS["settle point"]
    >>> float(np.degrees(limit.at(np.radians(60.0))).round(6))
    1.5
    """

    size: float
    secant: bool
    source: str
    read: bool = True

    def at(self, latitude: float) -> float:
        """Limit at a latitude.

        Parameters
        ----------
        latitude : float
            rad.

        Returns
        -------
        float
            rad, or s.

        Examples
        --------
        >>> LIMITS["turn"].at(1.0) == LIMITS["turn"].at(0.0)
        True
        """
        return self.size / float(np.cos(latitude)) if self.secant else self.size


LIMITS: dict[str, Limit] = {
    "settling": Limit(6 * hour, False, "A.821(19), 4.1.1"),
    "settle point": Limit(0.75 * degree, True, "A.821(19), 4.1.2"),
    "scatter": Limit(0.25 * degree, True, "A.821(19), 4.1.2"),
    "repeatability": Limit(0.25 * degree, True, "A.821(19), 4.1.3"),
    "steady way": Limit(0.25 * degree, True, "A.821(19), 4.2.3"),
    "change of speed": Limit(2.0 * degree, False, "A.821(19), 4.2.3"),
    "turn": Limit(3.0 * degree, False, "A.821(19), 4.2.3"),
    "sea": Limit(1.0 * degree, True, "A.424(XI)", read=False),
}
"""By test. A.424(XI), at second hand, has the first two as well, and that of a steady way for 20
knots in place of 70."""


class TypeTest(NamedTuple):
    """What a compass did on each test at one latitude.

    Attributes
    ----------
    latitude : float
        rad.
    measured : dict of float
        By test, as in `LIMITS`: rad, or s.

    Examples
    --------
    >>> found = TypeTest(0.0, {"turn": 1.5 * degree, "settling": np.inf})
    >>> found.shares["turn"], found.passed
    (0.5, {'turn': True, 'settling': False})
    """

    latitude: float
    measured: dict[str, float]

    @property
    def shares(self) -> dict[str, float]:
        """Measured over limit.

        Returns
        -------
        dict of float
            By test, without unit; more than 1 fails.

        Examples
        --------
        >>> TypeTest(0.0, {"turn": np.radians(6.0)}).shares
        {'turn': 2.0}
        """
        return {n: float(x / LIMITS[n].at(self.latitude)) for n, x in self.measured.items()}

    @property
    def passed(self) -> dict[str, bool]:
        """Whether it is within the limit.

        Returns
        -------
        dict of bool
            By test.

        Examples
        --------
        >>> TypeTest(0.0, {"turn": np.radians(6.0)}).passed
        {'turn': False}
        """
        return {name: share <= 1 for name, share in self.shares.items()}
