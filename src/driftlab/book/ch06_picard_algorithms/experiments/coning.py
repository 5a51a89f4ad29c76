"""Coning: the area that the increments go round, and the drift that an algorithm makes of it."""

from collections.abc import Callable
from contextlib import suppress
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from driftlab.attitude.coning_algorithms import (
    CONING_ALGORITHMS,
    Algorithms,
    AnyAlgorithm,
    named_algorithms,
)
from driftlab.attitude.drift_on_cones import coning_drift
from driftlab.attitude.measured_drift import measured_coning_drift
from driftlab.checks import FloatArray, finite_number, positive_number, whole_number
from driftlab.motion.profiles import Coning

_Drift = Callable[[AnyAlgorithm, ArrayLike, ArrayLike, ArrayLike], FloatArray]

DRAWN_HALF_ANGLE = float(np.radians(25.0))
"""Half angle of the cone of `coning_area`, rad: wide, so that it can be seen."""
BRACKET = Coning(float(np.radians(1.0)), 5.0)
"""Motion of the shaking bracket of the chapter's puzzle."""
BRACKET_SAMPLE_RATE = 100.0
"""At which the gyros on the bracket are read, Hz."""
DRIFT_FREQUENCIES: FloatArray = np.array([1.0, 2, 3, 5, 8, 12, 18, 25, 33])
"""Coning frequencies of `drift_by_frequency_and_rate`, Hz."""
DRIFT_SAMPLE_RATES: FloatArray = np.array([15.0, 20, 30, 50, 100, 200, 400, 800])
"""Sample rates of `drift_by_frequency_and_rate`, Hz."""
FINE_FREQUENCIES: FloatArray = np.geomspace(0.8, 40, 200)
FINE_SAMPLE_RATES: FloatArray = np.geomspace(12, 1000, 200)
"""Where the formula's curves are drawn, Hz."""


class ConingArea(NamedTuple):
    """One round on a cone, as the integral of the rate across the cone's axis sees it.

    Areas are in units of the square of the circle's radius.

    Attributes
    ----------
    samples : int
        Increments in one round.
    cone : ndarray, shape (m, 3)
        Third body axis, in the axes of the cone, all along the round.
    circle : ndarray, shape (m, 2)
        Integral of the rate across the cone's axis, rad.
    corners : ndarray, shape (samples + 1, 2)
        The same, summed from increments, rad.
    circle_area, polygon_area : float
        Areas inside these two.
    paired_area : float
        Area that the increments give if two thirds of γ1 × γ2 are added for each pair.
    radius : float
        Of the circle, rad.
    """

    samples: int
    cone: FloatArray
    circle: FloatArray
    corners: FloatArray
    circle_area: float
    polygon_area: float
    paired_area: float
    radius: float


class ConingDrift(NamedTuple):
    """Sizes of the drift on a cone, by algorithm; NaN where one refuses so few samples a round.

    Attributes
    ----------
    names : tuple of str
        The algorithms.
    half_angle, frequency, sample_rate : float
        Of the cone, rad and Hz, and of the gyros, Hz: what is not varied.
    frequencies : ndarray, shape (m,)
        Coning frequencies, Hz.
    by_frequency : ndarray, shape (algorithm, m)
        Drift at these frequencies, measured over many steps, rad/s.
    rates : ndarray, shape (n,)
        Sample rates, Hz.
    by_rate : ndarray, shape (algorithm, n)
        Drift at these sample rates, measured, rad/s.
    fine_frequencies : ndarray, shape (p,)
        Hz.
    formula_by_frequency : ndarray, shape (algorithm, p)
        Drift by the closed formula, rad/s.
    fine_rates : ndarray, shape (q,)
        Hz.
    formula_by_rate : ndarray, shape (algorithm, q)
        Drift by the closed formula, rad/s.
    """

    names: tuple[str, ...]
    half_angle: float
    frequency: float
    sample_rate: float
    frequencies: FloatArray
    by_frequency: FloatArray
    rates: FloatArray
    by_rate: FloatArray
    fine_frequencies: FloatArray
    formula_by_frequency: FloatArray
    fine_rates: FloatArray
    formula_by_rate: FloatArray


def coning_area(samples: int = 8, half_angle: float = DRAWN_HALF_ANGLE) -> ConingArea:
    """Compute the areas inside the sums of the increments of one round on a cone.

    On a cone the integral of the rate runs round a circle. What the rotations add up to about the
    cone's axis is the area inside, to the second power of the half angle. A computer that knows
    only the sums of the increments sees a polygon in its place, and misses the slivers between the
    two.

    Parameters
    ----------
    samples : int
        Increments in one round, an even number.
    half_angle : float
        Of the cone, rad, between zero and a right angle; a narrow one is not to be seen.

    Returns
    -------
    ConingArea

    Raises
    ------
    ValueError
        If `samples` is odd or less than four, or `half_angle` is not between these.
    """
    if whole_number(samples, "samples", least=4) % 2:
        raise ValueError(f"samples: expected an even number, got {samples}.")
    if not 0 < finite_number(half_angle, "half_angle") < np.pi / 2:
        raise ValueError(f"half_angle: expected an angle from 0 to pi/2, got {half_angle!r}.")
    motion = Coning(half_angle, 1.0)
    fine = 24 * samples
    increments = motion.increments(1 / samples, samples)[:, :2]
    radius = float(np.sin(half_angle))
    corners = _path(increments)
    # The chords of pairs make a polygon of half as many corners.
    pairs = increments[0::2] + increments[1::2]
    segments = (2 / 3) * _cross(increments[0::2], increments[1::2]).sum()
    third = Rotation.from_quat(motion.attitude(np.arange(fine + 1) / fine)).apply([0, 0, 1])
    return ConingArea(
        samples,
        third,
        _path(motion.increments(1 / fine, fine)[:, :2]),
        corners,
        float(np.pi),
        _area(corners) / radius**2,
        float(_area(_path(pairs)) + segments) / radius**2,
        radius,
    )


def _path(increments: FloatArray) -> FloatArray:
    return np.concatenate([np.zeros((1, 2)), np.cumsum(increments, axis=0)])


def _cross(a: FloatArray, b: FloatArray) -> FloatArray:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def _area(closed: FloatArray) -> float:
    return 0.5 * float(_cross(closed[:-1], closed[1:]).sum())


def drift_by_frequency_and_rate(
    algorithms: Algorithms = tuple(CONING_ALGORITHMS),
    half_angle: float = BRACKET.half_angle,
    frequency: float = BRACKET.frequency,
    sample_rate: float = BRACKET_SAMPLE_RATE,
) -> ConingDrift:
    """Compute the drift of algorithms over coning frequencies and over sample rates.

    Parameters
    ----------
    algorithms : mapping or iterable
        Algorithms by name, or names, as in `driftlab.attitude.named_algorithms`:
        ``{"mine": my_function, "two-step-4": "two-step-4"}``.
    half_angle : float
        Of the cone, rad.
    frequency : float
        Of the cone whose sample rate is varied, Hz.
    sample_rate : float
        At which cones of all frequencies are sampled, Hz.

    Returns
    -------
    ConingDrift
    """
    chosen = named_algorithms(algorithms)
    angle = positive_number(half_angle, "half_angle")
    cone, rate = (
        positive_number(frequency, "frequency"),
        positive_number(sample_rate, "sample_rate"),
    )

    def sizes(drift: _Drift, frequencies: ArrayLike, rates: ArrayLike) -> FloatArray:
        return np.array(
            [_where_it_works(drift, one, angle, frequencies, rates) for one in chosen.values()]
        )

    return ConingDrift(
        tuple(chosen),
        angle,
        cone,
        rate,
        DRIFT_FREQUENCIES,
        sizes(measured_coning_drift, DRIFT_FREQUENCIES, rate),
        DRIFT_SAMPLE_RATES,
        sizes(measured_coning_drift, cone, DRIFT_SAMPLE_RATES),
        FINE_FREQUENCIES,
        sizes(coning_drift, FINE_FREQUENCIES, rate),
        FINE_SAMPLE_RATES,
        sizes(coning_drift, cone, FINE_SAMPLE_RATES),
    )


def _where_it_works(
    drift: _Drift, algorithm: AnyAlgorithm, angle: float, frequencies: ArrayLike, rates: ArrayLike
) -> FloatArray:
    """Sizes (n,) of a drift, rad/s; NaN where the algorithm refuses so few samples a round."""
    try:
        return np.abs(drift(algorithm, angle, frequencies, 1 / np.asarray(rates)))
    except ValueError:
        pairs = np.broadcast_arrays(frequencies, rates)
    found = np.full(len(pairs[0]), np.nan)
    for i, (frequency, rate) in enumerate(zip(*pairs, strict=True)):
        with suppress(ValueError):
            found[i] = abs(drift(algorithm, angle, frequency, 1 / rate))
    if np.isnan(found).all():  # it is not the samples: let it say what
        drift(algorithm, angle, *(values[-1] for values in (pairs[0], 1 / pairs[1])))
    return found
