"""Standard deviations and random walks larger than usual, and the unit behind most of them.

Only the largest can be told from those in the usual other unit: a bias of 0.1 may be that of a
phone in rad/s. So what is listed here is let through with a warning.
"""

from __future__ import annotations

import warnings
from typing import NamedTuple

from ._magnitudes import LARGEST_ACCELEROMETER_BIAS, LARGEST_GYRO_BIAS, UnusualWarning
from ._numbers import nonnegative_number


class _Usual(NamedTuple):
    most: float
    unit: str
    likely: str


_USUAL = {
    # About 0.1 deg/s and 2 mg per root hertz: many times what a phone has.
    "angle_random_walk": _Usual(2e-3, "rad/√s", "deg/√h were meant, np.radians({0:g}) / 60"),
    "velocity_random_walk": _Usual(
        2e-2, "(m/s)/√s", "m/s/√h were meant, {0:g} / 60; of µg/√Hz, {0:g}e-6 * 9.81"
    ),
    "attitude": _Usual(1.0, "rad", "arc minutes were meant, np.radians({0:g} / 60)"),
    "gyro_bias": _Usual(LARGEST_GYRO_BIAS, "rad/s", "deg/h were meant, np.radians({0:g}) / 3600"),
    "accelerometer_bias": _Usual(
        LARGEST_ACCELEROMETER_BIAS, "m/s^2", "mg were meant, {0:g}e-3 * 9.81"
    ),
    "scale": _Usual(1.0, "parts of the scale", "ppm were meant, {0:g}e-6"),
    "installation": _Usual(1.0, "rad", "arc seconds were meant, np.radians({0:g} / 3600)"),
}


def usual_deviation(value: object, name: str) -> float:
    """Return a standard deviation or a random walk, warning of an unusual size.

    Parameters
    ----------
    value : float
        In SI units and radians.
    name : str
        Name of the argument, which says what it is the deviation of: "gyro_bias", "installation".
        Others may have any size.

    Returns
    -------
    float
        The number.

    Raises
    ------
    ValueError
        If it is negative, or no number.

    Warns
    -----
    UnusualWarning
        If it is larger than instruments usually have.

    Examples
    --------
    >>> usual_deviation(40e-6, "scale")
    4e-05
    >>> import warnings
    >>> with warnings.catch_warnings(record=True) as caught:
    ...     warnings.simplefilter("always")
    ...     print(usual_deviation(40, "installation"), caught[0].message)
    40.0 installation: 40 rad is more than instruments usually have. If arc seconds were meant,
    np.radians(40 / 3600).
    """
    number = nonnegative_number(value, name)  # type: ignore[arg-type]  # it refuses the rest itself
    usual = _USUAL.get(name)
    if usual is not None and number > usual.most:
        warnings.warn(
            f"{name}: {number:g} {usual.unit} is more than instruments usually have. "
            f"If {usual.likely.format(number)}.",
            UnusualWarning,
            stacklevel=4,
        )
    return number
