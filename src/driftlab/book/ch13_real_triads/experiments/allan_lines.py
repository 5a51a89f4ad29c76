"""Allan plots of a cheap and a dear gyro at rest: what five lines say, and what they cannot."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.constants import arcsecond

from driftlab.allan import AllanDeviation, allan_deviation
from driftlab.checks import FloatArray, finite_array, positive_number
from driftlab.gyrocompass.inertial_alignment import (
    align_in_inertial_frame,
    inertial_alignment_deviation,
)
from driftlab.gyrocompass.noise_fit import fit_gyro_noise
from driftlab.noise_identification import NoiseFit, fit_noise_terms
from driftlab.noise_terms import TERMS
from driftlab.recordings.publishers import published
from driftlab.recordings.recording import Recording

from .parked_car import LONGER, spread, stretches

CHEAP, STILL = "mpu9150-1", (149.75, 158.5)
"""A recording of a cheap gyro, and its longest still stretch, s."""
DEAR, QUIET = "laser-gyro", (1050.0, 1490.0)
"""A recording of a laser gyro on a parked car, and its quiet stretch, s."""
CHEAP_FROM, DEAR_FROM = 0.1, 1.0
"""Shortest averaging times in the fits, s. Below, the cheap gyro's spectrum has a hump near 10 Hz,
in all five units and of unknown origin, and under the dear one the car is seen to rock."""
PULSE = 0.1 * arcsecond
"""Angle that one pulse of the laser gyro stands for."""
ROUNDING = PULSE / np.sqrt(12)
"""Standard deviation of an angle that is rounded to whole pulses."""
ROCKING = (0.5, 5.0)
"""Frequencies between which a car rocks, Hz."""


class Lines(NamedTuple):
    """The Allan deviation of one gyro, and the terms that fit it."""

    times: FloatArray  # (k,), s
    deviation: FloatArray  # (k,), rad/s
    lower: FloatArray  # (k,), rad/s
    upper: FloatArray  # (k,), rad/s
    terms: FloatArray  # (5,), coefficients in the order of `TERMS`, SI units; zero if not seen
    uncertainty: FloatArray  # (5,), their standard deviations; NaN if not seen
    bounds: FloatArray  # (5,), 95 % upper bounds of those that are not seen; NaN for the others
    begin: float  # shortest averaging time of the fit, s
    length: float  # of the record at rest, s


class AllanLines(NamedTuple):
    """Two gyros at rest."""

    cheap: Lines  # the z gyro of an MPU-9150
    dear: Lines  # a laser gyro about Up
    # (2,), largest ratio of the laser gyro's points in the fit to the best `GyroNoise` without and
    # with a rounded angle, or the other way round
    missed: FloatArray
    rocking: float  # standard deviation of its angle in the frequencies in which a car rocks, rad
    # largest coherence (squared) of it, in these frequencies, with the forward gyro beside it: what
    # two sensors see at once is not the noise of one
    shared: float
    # (2,), angle random walk of the forward gyro of the same unit, rad/√s: as the same fit to the
    # same stretch has it, and the largest that its headings allow
    forward: FloatArray


def allan_lines(
    cheap_rest: tuple[float, float] = STILL,
    dear_rest: tuple[float, float] = QUIET,
    cheap_from: float = CHEAP_FROM,
    dear_from: float = DEAR_FROM,
) -> AllanLines:
    """Fit the noise terms of both gyros, from the shortest averaging times that are given, s."""
    from scipy.signal import coherence, welch  # take a third of a second to be loaded

    still = _rest(CHEAP, cheap_rest, "cheap_rest")
    cheap = still.gyro[:, 2], still.interval
    quiet = _rest(DEAR, dear_rest, "dear_rest")
    forward, angle = quiet.in_axes("RFU").gyro[:, 1:].T
    interval = quiet.interval
    dear = angle / interval, interval
    later = _from(dear, dear_from, "dear_from")
    beside = _from((forward / interval, interval), dear_from, "dear_from")
    fits = [fit_gyro_noise(later, quantised=quantised) for quantised in (False, True)]
    ratios = [fit.allan_deviation(later.averaging_times) / later.deviation for fit in fits]
    rows = min(8192, len(angle))
    frequency, density = welch(np.cumsum(angle - angle.mean()), 1 / interval, nperseg=rows)
    band = (ROCKING[0] <= frequency) & (frequency < ROCKING[1])
    _, shared = coherence(angle, forward, 1 / interval, nperseg=rows)
    return AllanLines(
        _lines(cheap, fit_noise_terms(_from(cheap, cheap_from, "cheap_from")), cheap_from),
        _lines(dear, fit_noise_terms(later), dear_from),
        np.exp(np.abs(np.log(ratios)).max(axis=-1)),
        float(np.sqrt(density[band].sum() * frequency[1])),
        float(shared[band].max()),
        np.array([fit_noise_terms(beside).terms.angle_random_walk, walk_by_headings()]),
    )


def walk_by_headings() -> float:
    """Largest angle random walk of the forward gyro that the car's headings allow, rad/√s.

    The car looks East, and a heading errs by the drift of the gyro that looks East. What else makes
    the headings scatter makes the bound larger, not smaller. It is the upper end of the interval of
    95 per cent for ten stretches of three minutes.
    """
    recording = published(DEAR, download=False).in_axes("FUR")
    latitude = recording.latitude
    if latitude is None:
        raise ValueError("recording: expected one that knows its latitude.")
    found = align_in_inertial_frame(stretches(recording.increments(), LONGER), latitude)
    small = 1e-9  # rad/√s, for which the deviation is far from that of no knowledge
    bound = float(inertial_alignment_deviation(latitude, LONGER, small))
    return spread(found.heading).high / bound * small


def _rest(recording: str, times: tuple[float, float], name: str) -> Recording:
    """A rest of a published recording, which is at hand."""
    begin, end = finite_array(times, name, 2).tolist()
    return published(recording, download=False).between(begin, end)


def _from(record: tuple[FloatArray, float], shortest: float, name: str) -> AllanDeviation:
    """Allan deviation of rates for twenty averaging times, up to a quarter of the record."""
    rates, interval = record
    length = len(rates) * interval
    if not interval <= positive_number(shortest, name) <= length / 10:
        raise ValueError(
            f"{name}: expected an averaging time from {interval:g} s to a tenth of the rest, "
            f"{length / 10:g} s, got {shortest!r}."
        )
    return allan_deviation(rates, interval, np.geomspace(shortest, length / 4, 20))


def _lines(record: tuple[FloatArray, float], fit: NoiseFit, begin: float) -> Lines:
    rates, interval = record
    allan = allan_deviation(rates, interval)
    return Lines(
        allan.averaging_times,
        allan.deviation,
        allan.lower,
        allan.upper,
        np.array([getattr(fit.terms, name) for name in TERMS]),
        np.array([fit.deviations.get(name, np.nan) for name in TERMS]),
        np.array([fit.upper_bounds.get(name, np.nan) for name in TERMS]),
        float(begin),
        len(rates) * interval,
    )
