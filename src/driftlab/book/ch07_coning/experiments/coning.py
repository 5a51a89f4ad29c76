"""Coning: the area that the increments go round, and the drift that an algorithm makes of it."""

from collections.abc import Callable
from contextlib import suppress

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS, AnyAlgorithm
from driftlab.attitude.drift_on_cones import coning_drift, simulated_coning_drift
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray, finite_number, positive_number, whole_number
from driftlab.motion.profiles import Coning

from .algorithms import Algorithms, named_algorithms

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


def coning_area(samples: int = 8, half_angle: float = DRAWN_HALF_ANGLE) -> DataTable:
    """Compute the areas inside the sums of the increments of one round on a cone.

    On a cone the integral of the rate runs round a circle. What the rotations add up to about the
    cone's axis is the area inside, to the second power of the half angle. A computer that
    multiplies the increments as small rotations, an even number of them, gets the area of a polygon
    instead, and misses the slivers between the two.
    """
    if whole_number(samples, "samples", least=4) % 2:
        raise ValueError(f"samples: expected an even number, got {samples}.")
    if not 0 < finite_number(half_angle, "half_angle") < np.pi / 2:
        raise ValueError(f"half_angle: expected an angle from 0 to pi/2, got {half_angle!r}.")
    motion = Coning(half_angle, 1.0)
    fine = 24 * samples
    increments = motion.increments(1 / samples, samples)[:, :2]
    radius, corners = float(np.sin(half_angle)), _path(increments)
    # The chords of pairs make a polygon of half as many corners.
    pairs = increments[0::2] + increments[1::2]
    segments = (2 / 3) * _cross(increments[0::2], increments[1::2]).sum()
    paired = float(_area(_path(pairs)) + segments) / radius**2
    third = Rotation.from_quat(motion.attitude(np.arange(fine + 1) / fine)).apply([0, 0, 1])
    circle = _path(motion.increments(1 / fine, fine)[:, :2])
    return DataTable(
        {
            "corners": (corners.T, "rad", "sums of increments across the body's third axis", "xy"),
            "circle": (circle.T, "rad", "integral of the rate across it, along the round", "xy"),
            "third_axis": (third.T, "", "of the body, in the axes of the cone", "xyz"),
        },
        {
            "samples": (samples, "", "increments in one round"),
            "radius": (radius, "rad", "radius of the circle"),
            # In units of the square of the radius.
            "circle_area": (float(np.pi), "", "area of the circle over its radius squared"),
            "polygon_area": (_area(corners) / radius**2, "", "area of the polygon, likewise"),
            "paired_area": (paired, "", "area with two thirds of γ1 × γ2 for each pair, likewise"),
        },
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
) -> DataTable:
    """Compute the drift of algorithms over coning frequencies and over sample rates."""
    chosen = named_algorithms(algorithms)
    angle = positive_number(half_angle, "half_angle")
    cone = positive_number(frequency, "frequency")
    rate = positive_number(sample_rate, "sample_rate")

    def sizes(drift: _Drift, frequencies: FloatArray, rates: FloatArray) -> dict[str, FloatArray]:
        found = {}
        for name, one in chosen.items():
            for way, where in (("by frequency", (frequencies, rate)), ("by rate", (cone, rates))):
                size = _where_it_works(drift, one, angle, *where)
                # No drift at all has no place on a logarithmic axis.
                found[f"{name}, {way}"] = np.where(size > 0, size, np.nan)
        return found

    measured = sizes(simulated_coning_drift, DRIFT_FREQUENCIES, DRIFT_SAMPLE_RATES)
    formula = sizes(coning_drift, FINE_FREQUENCIES, FINE_SAMPLE_RATES)
    return DataTable(
        {
            "frequency": (DRIFT_FREQUENCIES, "Hz", "coning frequency of what is measured"),
            "rate": (DRIFT_SAMPLE_RATES, "Hz", "sample rate of what is measured"),
            "formula_frequency": (FINE_FREQUENCIES, "Hz", "coning frequency of the formula"),
            "formula_rate": (FINE_SAMPLE_RATES, "Hz", "sample rate of the formula"),
            "measured": (measured, "deg_per_h", "size of the drift over many steps"),
            "formula": (formula, "deg_per_h", "size of the drift by the closed formula"),
        },
        {
            "algorithms": ([*chosen], "", "compared"),
            "half_angle": (angle, "deg", "half angle of the cone"),
            "cone_frequency": (cone, "Hz", "coning frequency where the sample rate varies"),
            "sample_rate": (rate, "Hz", "sample rate where the coning frequency varies"),
        },
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
