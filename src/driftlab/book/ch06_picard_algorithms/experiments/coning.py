"""Coning: the area that the increments go round, and the drift that an algorithm makes of it."""

from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS, Algorithms, named_algorithms
from driftlab.attitude.measured_drift import measured_coning_drift
from driftlab.checks import FloatArray, whole_number
from driftlab.motion.profiles import Coning

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
    """

    samples: int
    cone: FloatArray
    circle: FloatArray
    corners: FloatArray
    circle_area: float
    polygon_area: float
    paired_area: float


class ConingDrift(NamedTuple):
    """Sizes of the drift on a cone, by algorithm.

    Attributes
    ----------
    frequencies : ndarray, shape (m,)
        Coning frequencies, Hz.
    by_frequency : ndarray, shape (algorithm, m)
        Drift at these frequencies, sampled at `BRACKET_SAMPLE_RATE`, rad/s.
    rates : ndarray, shape (n,)
        Sample rates, Hz.
    by_rate : ndarray, shape (algorithm, n)
        Drift on `BRACKET` at these sample rates, rad/s.
    names : tuple of str
        The algorithms.
    """

    frequencies: FloatArray
    by_frequency: FloatArray
    rates: FloatArray
    by_rate: FloatArray
    names: tuple[str, ...]


def coning_area(samples: int = 8) -> ConingArea:
    """Compute the areas inside the sums of the increments of one round on a cone.

    On a cone the integral of the rate runs round a circle. What the rotations add up to about the
    cone's axis is the area inside, to the second power of the half angle. A computer that knows
    only the sums of the increments sees a polygon in its place, and misses the slivers between the
    two.

    Parameters
    ----------
    samples : int
        Increments in one round, an even number.

    Returns
    -------
    ConingArea

    Raises
    ------
    ValueError
        If `samples` is odd or less than four.
    """
    if whole_number(samples, "samples", least=4) % 2:
        raise ValueError(f"samples: expected an even number, got {samples}.")
    motion = Coning(DRAWN_HALF_ANGLE, 1.0)
    fine = 24 * samples
    increments = motion.increments(1 / samples, samples)[:, :2]
    radius = np.sin(DRAWN_HALF_ANGLE)
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
    )


def _path(increments: FloatArray) -> FloatArray:
    return np.concatenate([np.zeros((1, 2)), np.cumsum(increments, axis=0)])


def _cross(a: FloatArray, b: FloatArray) -> FloatArray:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def _area(closed: FloatArray) -> float:
    return 0.5 * float(_cross(closed[:-1], closed[1:]).sum())


def drift_by_frequency_and_rate(algorithms: Algorithms = tuple(CONING_ALGORITHMS)) -> ConingDrift:
    """Measure the drift of algorithms over coning frequencies and over sample rates.

    Parameters
    ----------
    algorithms : mapping or iterable
        Algorithms by name, or names, as in `driftlab.attitude.named_algorithms`.

    Returns
    -------
    ConingDrift
    """
    chosen = named_algorithms(algorithms)
    angle, frequency = BRACKET.half_angle, BRACKET.frequency
    by_frequency = [
        np.abs(measured_coning_drift(one, angle, DRIFT_FREQUENCIES, 1 / BRACKET_SAMPLE_RATE))
        for one in chosen.values()
    ]
    by_rate = [
        np.abs(measured_coning_drift(one, angle, frequency, 1 / DRIFT_SAMPLE_RATES))
        for one in chosen.values()
    ]
    return ConingDrift(
        DRIFT_FREQUENCIES,
        np.array(by_frequency),
        DRIFT_SAMPLE_RATES,
        np.array(by_rate),
        tuple(chosen),
    )
