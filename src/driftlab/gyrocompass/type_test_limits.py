"""What the marine standards want of a gyrocompass, and how far a compass uses each limit up.

The limits are those of the International Maritime Organization, the IMO: Resolution A.821(19),
1995, for high-speed craft, and A.424(XI), 1979, for other ships. Most grow with the latitude as its
secant, as the error of a gyro does; two do not. Only the numbers are taken. `Limit.source` says
where each stands, and `Limit.read` whether that place was read or is known at second hand. How to
test is said by ISO 8728, which was not to be had.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.constants import degree, hour

from driftlab.checks import finite_number
from driftlab.earth import checked_latitude


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
            rad; not a pole.

        Returns
        -------
        float
            rad, or s.

        Raises
        ------
        ValueError
            If the latitude is a pole or beyond, as one in degrees is.

        Examples
        --------
        >>> LIMITS["turn"].at(1.0) == LIMITS["turn"].at(0.0)
        True
        """
        place = float(checked_latitude(finite_number(latitude, "latitude")))
        return self.size / float(np.cos(place)) if self.secant else self.size


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

        Raises
        ------
        ValueError
            If a test is none of `LIMITS`.

        Examples
        --------
        >>> TypeTest(0.0, {"turn": np.radians(6.0)}).shares
        {'turn': 2.0}
        """
        if unknown := self.measured.keys() - LIMITS.keys():
            raise ValueError(
                f"measured: expected some of {', '.join(LIMITS)}, got {unknown.pop()!r}."
            )
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
