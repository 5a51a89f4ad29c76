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

from driftlab.checks import FloatArray, finite_arrays, shown, truth_value
from driftlab.earth import EARTH_RATE, checked_latitude

NOT_KNOWN = np.array(np.nan)
NOT_KNOWN.setflags(write=False)  # what all results without a value share
NOTHING_KNOWN = np.pi / np.sqrt(3)
"""Standard deviation of a heading of which nothing is known, rad: 104 degrees."""
_DEG_PER_HOUR = np.radians(1) / 3600
_LIKE_THE_EARTH = 1.9
"""A rate of another size than the Earth's by more than this factor is hardly one in rad/s. In deg/s
it would be 57 times as large; integrals over half a second are a half."""


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
        Known latitude, rad. Without it a level rate alone can only be too large, larger than the
        whole rate of the Earth.
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

    From two directions little is known of the third. If a spurious rate is isotropic in space, the
    heading's error over `heading_doubt` is, where both are small, Student's t with two degrees of
    freedom: the error is larger than 4.3 times in 5 cases of 100. A body that leans is not such a
    case: its rate has no part about Up, and for leans about level lines evenly spread the error is
    larger than 4.3 times in 20 cases of 100.

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
    truth_value(size_known, "size_known")
    given: dict[str, Any] = {"level_rate": level_rate, "up_rate": up_rate, "latitude": latitude}
    names = [name for name in given if name == "level_rate" or given[name] is not None]
    arrays = finite_arrays(**{name: (given[name],) for name in names})
    known = dict(zip(names, arrays, strict=True))
    level, up, place = known["level_rate"], known.get("up_rate"), known.get("latitude")
    if place is not None:
        checked_latitude(place)
    return _contradiction(level, up, place, size_known)


def _contradiction(
    level: FloatArray, up: FloatArray | None, place: FloatArray | None, size_known: bool
) -> RateContradiction:
    """What `rate_contradiction` returns, of numbers that are checked, or made of such."""
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
    elif size_known:
        seen = [np.where(level > EARTH_RATE, level - EARTH_RATE, np.nan)]
    elif place is not None and up is not None:
        seen = [EARTH_RATE * np.sin(np.minimum(np.abs(turned), np.pi / 2))]
    # Like the root of the mean of the squares, but these may be too large for a number.
    spurious = np.hypot.reduce(np.broadcast_arrays(*seen), axis=0) / np.sqrt(len(seen))
    part = spurious / np.maximum(earth_level, np.finfo(float).tiny)
    error = np.arcsin(np.minimum(part, 1.0))
    every = np.broadcast_arrays(excess, turned, spurious, error, level)[:4]
    return RateContradiction(*(np.array(each)[()] for each in every))


def checked_tolerance(value: object) -> float:
    """Return `heading_tolerance`, rad, a positive number; infinity means no warning."""
    array = np.asarray(value) if np.isscalar(value) or isinstance(value, np.ndarray) else None
    if array is None or array.dtype.kind not in "fiu" or array.ndim or not array > 0:
        raise ValueError(
            "heading_tolerance: expected a positive number, rad, or infinity for no warning, "
            f"got {shown(value)}."
        )
    return float(array)


def sign_slip(found: float, told: float, named: str = "latitude") -> str:
    """What a latitude found that is minus the one told may come from.

    Parameters
    ----------
    found, told : float
        Latitudes, rad.
    named : str
        What the one told is called.

    Returns
    -------
    str
        A sentence without its point; empty if they are not of opposite sign.

    Examples
    --------
    >>> sign_slip(-0.7, 0.71)[:67]
    'the latitude found, -40.1 degrees, is minus the one told: look at t'
    >>> sign_slip(0.7, 0.71)
    ''
    """
    if not 3 * abs(found + told) < abs(found - told):
        return ""
    return (
        f"the latitude found, {np.degrees(found):.3g} degrees, is minus the one told: look at the "
        f"sign of {named}; at those of the gyros, by which the heading would be off by half a "
        "turn; and at those of the accelerometers, by which the body would be upside down, as at "
        "rest they show +g upwards"
    )


def warn_of_contradiction(
    seen: RateContradiction,
    tolerance: float,
    named: str,
    latitude: ArrayLike | None = None,
    stacklevel: int = 3,
) -> None:
    """Warn where a contradiction can turn a heading by more than it may, in one sentence.

    Parameters
    ----------
    seen : RateContradiction
        What was found.
    tolerance : float
        Of the heading, rad; infinity for no warning.
    named : str
        What the rates are called.
    latitude : array_like, shape (...), optional
        Known latitude, rad.
    stacklevel : int
        As in `warnings.warn`: 2 for the caller of this function, 3 for his.

    Warns
    -----
    InconsistentAlignmentWarning
        Of the worst of many, and of the likely slip: another unit, a wrong sign.

    Examples
    --------
    >>> warn_of_contradiction(rate_contradiction(5e-5, 5.308e-5), np.radians(0.5), "angular_rate")
    """
    wrong = np.atleast_1d(seen.heading_doubt > tolerance)
    if not wrong.any():
        return
    worst = int(np.nanargmax(seen.heading_doubt))
    place = np.nan if latitude is None else np.broadcast_to(latitude, wrong.shape).flat[worst]
    excess, turned, doubt = (
        float(np.atleast_1d(each).flat[worst])
        for each in (seen.rate_excess, seen.latitude_excess, seen.heading_doubt)
    )
    parts = []
    for size, words in (
        (excess / _DEG_PER_HOUR, "the whole rate by {:+.3g} deg/h"),
        (np.degrees(turned), "the latitude found by {:+.3g} degrees"),
    ):
        if np.isfinite(size):
            parts.append(words.format(size))
    if not parts:
        drift = float(np.atleast_1d(seen.spurious_rate).flat[worst]) / _DEG_PER_HOUR
        parts.append(f"the level rate by {drift:.3g} deg/h")
    many = f", in {wrong.sum()} of {wrong.size} alignments, at worst" if wrong.size > 1 else ""
    warnings.warn(
        f"{named}: expected the rate of the Earth at rest, got another{many}: it differs in "
        f"{' and in '.join(parts)}; {_likely_reason(1 + excess / EARTH_RATE, turned, place, doubt)}"
        ".",
        InconsistentAlignmentWarning,
        stacklevel=stacklevel,
    )


def _likely_reason(ratio: float, turned: float, place: float, doubt: float) -> str:
    if not np.isnan(ratio) and not 1 / _LIKE_THE_EARTH < ratio < _LIKE_THE_EARTH:
        return (
            f"it is {ratio:.3g} times that of the Earth. Is it in rad/s, and not integrals over an "
            "interval? Otherwise tell rate_unit, the size of its unit in rad/s, or None for "
            "directions alone; if it is, these gyros do not see the Earth, or the body turned"
        )
    return sign_slip(place + turned, place) or (
        "a rate as large across the meridian, where nothing shows it, turns the heading by "
        f"{np.degrees(doubt):.2g} degrees. If the body swayed or leaned, use "
        "align_in_inertial_frame(increments, latitude); if not, calibrate the gyros"
    )
