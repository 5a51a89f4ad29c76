"""Allan plots of a cheap and a dear gyro at rest: what five lines say, and what they cannot."""

from __future__ import annotations

from dataclasses import astuple
from typing import Any

import numpy as np
from scipy.constants import arcsecond

from driftlab.allan import AllanDeviation, allan_deviation
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray, finite_array, positive_number
from driftlab.gyrocompass.inertial_alignment import (
    align_in_inertial_frame,
    inertial_alignment_standard_deviation,
)
from driftlab.gyrocompass.noise_fit import fit_gyro_noise
from driftlab.noise_terms import TERMS, NoiseFit, NoiseTerms, fit_noise_terms
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
COUNT = 0.1 * arcsecond
"""Angle of one count in the laser gyro's file."""
PULSE = 28 / 3 * COUNT
"""Angle of one of its pulses. The file spreads a pulse over neighbouring samples: between two
readings of zero the counts of each gyro add up to a whole number of pulses."""
ROUNDING = PULSE / np.sqrt(12)
"""Standard deviation of an angle that is rounded to whole pulses."""
ROCKING = (0.5, 5.0)
"""Frequencies between which a car rocks, Hz."""


def allan_lines(
    cheap_rest: tuple[float, float] = STILL,
    dear_rest: tuple[float, float] = QUIET,
    cheap_from: float = CHEAP_FROM,
    dear_from: float = DEAR_FROM,
) -> DataTable:
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
    columns: dict[str, tuple[Any, ...]] = {}
    facts: dict[str, tuple[Any, ...]] = {}
    for gyro, (rates, step), fit, begin in (
        ("cheap", cheap, fit_noise_terms(_from(cheap, cheap_from, "cheap_from")), cheap_from),
        ("dear", dear, fit_noise_terms(later), dear_from),
    ):
        drawn = _drawn(allan_deviation(rates, step), fit, float(begin))
        columns |= {f"{gyro}_{name}": entry for name, entry in drawn.items()}
        terms, standard_deviations, bounds = _terms(fit)
        facts |= {
            f"{gyro}_terms": (terms, "", "coefficients in SI units; zero if not seen"),
            f"{gyro}_uncertainty": (standard_deviations, "", "their standard deviations"),
            f"{gyro}_bounds": (bounds, "", "95 % upper bounds of those that are not seen"),
            f"{gyro}_length": (len(rates) * step, "s", f"length of the {gyro} gyro's rest"),
        }
    ends = columns["dear_line_time"][0]
    rounding = NoiseTerms(quantisation=ROUNDING).deviation(ends)
    columns["rounding_time"] = (ends, "s", "averaging time")
    columns["rounding"] = (rounding, "deg_per_h", "Allan deviation of rounded pulses alone")
    walks = np.array([fit_noise_terms(beside).terms.angle_random_walk, walk_by_headings()])
    return DataTable(
        columns,
        {
            **facts,
            "missed": (
                np.exp(np.abs(np.log(ratios)).max(axis=-1)), "",
                "largest ratio of a point to the best fit, without and with a rounded angle",
            ),
            "rocking": (
                float(np.sqrt(density[band].sum() * frequency[1])), "arcsec",
                "deviation of the dear gyro's angle where a car rocks",
            ),
            # what two sensors see at once is not the noise of one
            "shared": (float(shared[band].max()), "", "coherence with the forward gyro there"),
            # rad/√s
            "forward": (walks, "", "walk of the forward gyro by fit, and at most by headings"),
        },
    )  # fmt: skip


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
    bound = float(inertial_alignment_standard_deviation(latitude, LONGER, small))
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


def _terms(fit: NoiseFit) -> FloatArray:
    """Coefficients of the five terms, their deviations, and bounds of those not seen: (3, 5)."""
    told = fit.standard_deviations, fit.upper_bounds
    return np.array(
        [astuple(fit.terms), *([each.get(name, np.nan) for name in TERMS] for each in told)]
    )


def _drawn(allan: AllanDeviation, fit: NoiseFit, begin: float) -> dict[str, tuple[Any, ...]]:
    """Points, the fit, and a line for each term that is seen, or its bound."""
    times, time, unit = allan.averaging_times, "averaging time", "deg_per_h"
    fitted, ends = np.geomspace(max(begin, times[0]), times[-1], 50), times[[0, -1]]
    used = np.where(times >= begin * (1 - 1e-9), "yes", "no")
    columns: dict[str, tuple[Any, ...]] = {
        "time": (times, "s", time),
        "in_the_fit": (used, "", "whether the fit uses the point"),
        "deviation": (allan.deviation, unit, "Allan deviation"),
        "lower": (allan.lower, unit, "lower end of its interval of 68 %"),
        "upper": (allan.upper, unit, "upper end of its interval of 68 %"),
        "fit_time": (fitted, "s", time),
        "fit": (fit.terms.deviation(fitted), unit, "sum of the terms seen"),
        "line_time": (ends, "s", time),
    }
    for name, term, _, bound in zip(TERMS, *_terms(fit), strict=True):
        if np.isfinite(size := float(term if term > 0 else bound)):
            line = NoiseTerms(**{name: size}).deviation(ends)
            columns[name] = (line, unit, "its line" if term > 0 else "line of its upper bound")
    return columns
