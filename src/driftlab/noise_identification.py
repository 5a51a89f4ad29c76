"""Identification of noise terms: what an Allan deviation tells of them, and what it cannot tell."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from .allan import AllanDeviation
from .checks import FloatArray, checked_instance, some_of
from .core import noise_identification as core
from .core.allan import term_variances
from .noise_terms import TERMS, NoiseTerms

_BOUND = 0.95
"""Probability that stands behind an upper bound."""


@dataclass(frozen=True)
class NoiseFit:
    """Noise terms that fit an Allan deviation.

    Attributes
    ----------
    terms : NoiseTerms
        What the record shows; zero for a term that it does not show.
    deviations : dict of str to float
        Standard deviations of the terms that it shows.
    upper_bounds : dict of str to float
        For each term that was sought and is not seen: with 95 % probability it is smaller.
        Infinite if the record is too short to say anything.
    covariance : ndarray, shape (5, 5)
        Of the squared coefficients, in the order of `TERMS`; zero for terms that are not seen.
    misfit : float
        Root mean square of the points' distances from the fit, in standard deviations of each: 1
        or less for noise of these kinds. If it is much more, none of the other numbers holds.
    """

    terms: NoiseTerms
    deviations: dict[str, float]
    upper_bounds: dict[str, float]
    covariance: FloatArray
    misfit: float


def fit_noise_terms(allan: AllanDeviation, terms: Iterable[str] = TERMS) -> NoiseFit:
    """Find the noise terms behind an Allan deviation, and what it cannot tell.

    Parameters
    ----------
    allan : AllanDeviation
        Of one sensor, with at least as many averaging times as terms.
    terms : iterable of str
        Those that are sought, from `TERMS`; the others are taken to be zero.

    Returns
    -------
    NoiseFit
        With a standard deviation for each term that is seen, and an upper bound for each other.

    Raises
    ------
    ValueError
        If there are several sensors, too few averaging times, or unknown terms.

    See Also
    --------
    driftlab.allan.allan_deviation : What it fits.
    driftlab.gyrocompass.fit_gyro_noise : For the heading of a gyrocompass.

    Notes
    -----
    Least squares without negative terms, each point with the weight of its own degrees of freedom.
    But the points of an Allan plot share their samples, and thirty of them are worth far fewer
    independent ones: the deviations of the terms come from the covariance of all points under the
    fitted noise. A term is seen if its square is above twice its standard deviation; the
    weakest is dropped first, and the rest fitted again. An upper bound counts the other unseen
    terms as zero. An absent term is seen by mistake in a few records of a hundred; a weak one only
    where chance has made it larger, by two of its deviations if it is seldom seen. All of this is
    good for noise of these five kinds. What is none, an engine's shaking or the temperature of a
    day, is put on the nearest line all the same: look at the plot.

    References
    ----------
    - IEEE, *IEEE Standard Specification Format Guide and Test Procedure for Single-Axis
      Interferometric Fiber Optic Gyros*, IEEE Std 952, 1997.
    - N. El-Sheimy, H. Hou, X. Niu, *Analysis and modeling of inertial sensors using Allan
      variance*, IEEE Transactions on Instrumentation and Measurement 57(1), 2008.

    Examples
    --------
    >>> from driftlab.allan import allan_deviation
    >>> noise = NoiseTerms(quantisation=1e-6, angle_random_walk=1e-6)
    >>> rates = noise.samples(20_000, 0.1, np.random.default_rng(1))
    >>> found = fit_noise_terms(allan_deviation(rates, 0.1))
    >>> print(f"{found.terms.angle_random_walk:.2e}", f"{found.terms.quantisation:.2e}")
    9.79e-07 9.99e-07
    >>> list(found.upper_bounds)
    ['bias_instability', 'rate_random_walk', 'rate_ramp']
    """
    found = checked_instance(
        allan, AllanDeviation, "allan", "from allan_deviation(rates, interval)"
    )
    sought = list(dict.fromkeys(some_of(terms, TERMS, "terms")))
    if found.deviation.ndim != 1:
        raise ValueError(
            "allan: expected that of one sensor, deviation of shape (k,), "
            f"got shape {found.deviation.shape}; take allan.row(0), say."
        )
    # One time that comes twice says no more than once.
    _, places = np.unique(found.averaging_times, return_index=True)
    places = places[found.deviation[places] > 0]
    if not sought or len(places) < len(sought):
        raise ValueError(
            "allan: expected at least as many averaging times with a deviation above zero as "
            f"terms, {max(len(sought), 1)} different ones, got {len(places)}."
        )
    times, freedom = found.averaging_times[places], found.degrees_of_freedom[places]
    counts = np.round(times / found.interval).astype(int)
    variance = found.deviation[places] ** 2
    points = core.Points(variance, freedom, counts, found.count, found.interval)
    kept, squares, covariance = core.fit_seen(points, sorted(map(TERMS.index, sought)))
    roots, spread = np.sqrt(squares), np.sqrt(np.diagonal(covariance))
    expected = term_variances(times) @ squares
    unseen = [name for name in sought if TERMS.index(name) not in kept]
    return NoiseFit(
        NoiseTerms(*map(float, roots)),
        {TERMS[i]: float(spread[i] / (2 * roots[i])) for i in kept},
        {
            name: float(np.sqrt(core.upper_bound(points, squares, TERMS.index(name), _BOUND)))
            for name in unseen
        },
        covariance,
        float(np.sqrt(np.mean((variance / expected - 1) ** 2 * freedom / 2))),
    )
