"""How far the rates of a body at rest contradict the Earth's, and what of the heading that spoils.

At rest the gyros feel the Earth and nothing else. Its whole rate is known, and with the latitude
its part along the level and its part about Up. A spurious rate, of a body that leans meanwhile or
of a gyro that drifts, shows in those. Across the meridian it does not show: there it turns the
heading. So the size of what shows is the only thing that tells of the size of what does not.
"""

from __future__ import annotations

import warnings
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from driftlab.checks import FloatArray, finite_arrays
from driftlab.earth import EARTH_RATE, checked_latitude

NOT_KNOWN = np.array(np.nan)


class InconsistentAlignmentWarning(UserWarning):
    """Warning that the rates of an alignment are not those of a body at rest on the Earth.

    Examples
    --------
    A body that is not at rest, at a latitude of 45 degrees:

    >>> import warnings
    >>> from driftlab.gyrocompass import align
    >>> with warnings.catch_warnings(record=True) as caught:
    ...     warnings.simplefilter("always")
    ...     found = align([5e-5, 5.6e-5, 0.0], [0.0, 9.8, 0.0], latitude=np.pi / 4)
    >>> caught[0].category.__name__
    'InconsistentAlignmentWarning'
    """


class RateContradiction(NamedTuple):
    """How far rates contradict what is known of them; NaN where nothing is known. Each (...).

    Attributes
    ----------
    rate_excess : ndarray, shape (...)
        Whole rate found less that of the Earth, 7.292e-5 rad/s, in rad/s.
    latitude_excess : ndarray, shape (...)
        Latitude found less that which is known, rad.
    spurious_rate : ndarray, shape (...)
        Size of the contradiction in one direction, rad/s: the root mean square over the directions
        in which the Earth's rate is known.
    heading_doubt : ndarray, shape (...)
        By how much a spurious rate of that size can turn the heading, rad, at most pi/2.

    Examples
    --------
    A rate that is a tenth too large, of nobody knows which latitude:

    >>> seen = rate_contradiction(1.1 * 5e-5, 1.1 * 5.308e-5)
    >>> round(float(seen.rate_excess / EARTH_RATE), 3), float(seen.latitude_excess)
    (0.1, nan)
    """

    rate_excess: FloatArray
    latitude_excess: FloatArray
    spurious_rate: FloatArray
    heading_doubt: FloatArray


def rate_contradiction(
    level_rate: ArrayLike,
    up_rate: ArrayLike | None = None,
    latitude: ArrayLike | None = None,
    *,
    size_known: bool = True,
) -> RateContradiction:
    """How far the level and the vertical rate of a body at rest contradict the Earth's.

    Parameters
    ----------
    level_rate : array_like, shape (...)
        Horizontal component of the angular rate, rad/s.
    up_rate : array_like, shape (...), optional
        Component about Up, rad/s. Where the gyros turn with a body that sways there is none.
    latitude : array_like, shape (...), optional
        Known latitude, rad.
    size_known : bool
        Whether the rates are in rad/s. Otherwise only their ratio counts, the latitude found.

    Returns
    -------
    RateContradiction
        What is left when the known is taken away, and what it can do to the heading.

    Raises
    ------
    ValueError
        Within 0.1 degrees of a pole.

    Notes
    -----
    Let s be the spurious rate and L the level part of the Earth's rate, as known or, without a
    latitude, as found, but no more than the whole. A level rate s that stands across what is found
    turns the heading by arcsin(s/L), and no rate of this size turns it farther. With no unit the
    least spurious rate is that across the line of the known latitude, U sin(difference of the
    latitudes).

    From two directions little is known of the third. If a spurious rate has no favourite direction,
    the heading's error over `heading_doubt` is, where both are small, Student's t with two degrees
    of freedom: the error is larger than 4.3 times in 5 cases of 100. A car that rolls as people get
    in and out has a favourite direction.

    Examples
    --------
    A level rate that is a hundredth of the Earth's rate too large, at 60 degrees:

    >>> place = np.radians(60.0)
    >>> rates = EARTH_RATE * (np.cos(place) + 0.01), EARTH_RATE * np.sin(place)
    >>> seen = rate_contradiction(*rates, place)
    >>> round(float(seen.spurious_rate / EARTH_RATE), 5)  # of two directions
    0.00707
    >>> round(float(np.degrees(seen.heading_doubt)), 2)
    0.81
    """
    given: dict[str, Any] = {"level_rate": level_rate, "up_rate": up_rate, "latitude": latitude}
    names = [name for name in given if name == "level_rate" or given[name] is not None]
    arrays = finite_arrays(**{name: (given[name],) for name in names})
    known = dict(zip(names, arrays, strict=True))
    level, up, place = known["level_rate"], known.get("up_rate"), known.get("latitude")
    if place is not None:
        checked_latitude(place)
    excess = turned = NOT_KNOWN
    earth_level = np.minimum(level, EARTH_RATE) if place is None else EARTH_RATE * np.cos(place)
    seen = [NOT_KNOWN]
    if up is not None and size_known:
        excess = np.hypot(level, up) - EARTH_RATE
    if up is not None and place is not None:
        turned = np.arctan2(up, level) - place
    if size_known and place is not None:
        seen = [level - earth_level]
        if up is not None:
            seen.append(up - EARTH_RATE * np.sin(place))
    elif size_known and up is not None:
        seen = [excess]
    elif place is not None and up is not None:
        seen = [EARTH_RATE * np.sin(np.minimum(np.abs(turned), np.pi / 2))]
    spurious = np.sqrt(np.mean(np.square(np.broadcast_arrays(*seen)), axis=0))
    part = spurious / np.maximum(earth_level, np.finfo(float).tiny)
    error = np.arcsin(np.minimum(part, 1.0))
    every = np.broadcast_arrays(excess, turned, spurious, error, level)[:4]
    return RateContradiction(*(np.array(each)[()] for each in every))


def warn_of_contradiction(
    seen: RateContradiction, tolerance: float, named: str, stacklevel: int = 3
) -> None:
    """Warn where a contradiction can turn a heading by more than it may, in one sentence.

    Parameters
    ----------
    seen : RateContradiction
        What was found.
    tolerance : float
        Of the heading, rad; infinity for no warning.
    named : str
        What the rates are called, and in which unit they are taken.
    stacklevel : int
        As in `warnings.warn`: 2 for the caller of this function, 3 for his.

    Warns
    -----
    InconsistentAlignmentWarning
        Of the worst of many.

    Examples
    --------
    >>> warn_of_contradiction(rate_contradiction(5e-5, 5.308e-5), np.radians(0.5), "angular_rate")
    """
    wrong = np.atleast_1d(seen.heading_doubt > tolerance)
    if not wrong.any():
        return
    worst = np.argmax(seen.heading_doubt)
    parts = []
    for value, unit, words in (
        (seen.rate_excess, np.radians(1) / 3600, "the whole rate by {:+.3g} deg/h"),
        (seen.latitude_excess, np.radians(1), "the latitude found by {:+.3g} degrees"),
    ):
        size = float(np.atleast_1d(value).flat[worst]) / unit
        if np.isfinite(size):
            parts.append(words.format(size))
    many = f", in {wrong.sum()} of {wrong.size} alignments, at worst" if wrong.size > 1 else ""
    degrees = np.degrees(np.atleast_1d(seen.heading_doubt).flat[worst])
    warnings.warn(
        f"{named}: expected the rate of the Earth at rest, got another{many}: it differs in "
        f"{' and in '.join(parts)}; a rate as large across the meridian, where nothing shows it, "
        f"turns the heading by {degrees:.2g} degrees. If the body swayed or leaned, use "
        "align_in_inertial_frame(increments, latitude); if not, calibrate the gyros.",
        InconsistentAlignmentWarning,
        stacklevel=stacklevel,
    )
