"""``python -m driftlab allan``: the noise of a unit that lies still."""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.constants import arcsecond, degree, g, hour, micro, milli

from driftlab.allan import AllanDeviation, allan_deviation
from driftlab.checks import FloatArray
from driftlab.noise_terms import TERMS, NoiseFit, fit_noise_terms
from driftlab.recordings.recording import Recording

from .example import OPTIONS
from .findings import Curve, Findings, Plot, Table
from .numbers import Unit, with_deviation, written
from .progress import Steps
from .record import AXES, forces, moved_at, rates, record_plots

STEPS = 7
EXAMPLE = (
    "python -m driftlab example log.csv\n"
    f"python -m driftlab allan log.csv {OPTIONS}"
    " --end 60 --csv deviation.csv"
)
_ROOT = hour**0.5
_WEIGHT = milli * g
NAMES = (
    "quantisation Q",
    "random walk N",
    "bias instability B",
    "rate random walk K",
    "rate ramp R",
)
"""Of the terms, in their order, as of the units."""
GYRO_UNITS = (
    Unit("arcsec", arcsecond),
    Unit("deg/√h", degree / _ROOT),
    Unit("deg/h", degree / hour),
    Unit("deg/h/√h", degree / hour / _ROOT),
    Unit("deg/h/h", degree / hour / hour),
)
FORCE_UNITS = (
    Unit("mm/s", milli),
    Unit("m/s/√h", 1 / _ROOT),
    Unit("micro-g", micro * g),
    Unit("mg/√h", _WEIGHT / _ROOT),
    Unit("mg/h", _WEIGHT / hour),
)
FEWEST = 1000
"""Rows that an Allan plot needs to show more than the first of its lines."""

SURE, MISSED = 20, 1.5
"""With so many degrees of freedom a deviation is known to 16 %; no fit should miss it by half."""


@dataclass(frozen=True)
class Triad:
    """A triad's three deviations and fits, and the units that it is shown in."""

    name: str
    shown: Unit
    units: tuple[Unit, ...]
    allan: tuple[AllanDeviation, ...]
    fits: tuple[NoiseFit, ...]


def find(recording: Recording, options: argparse.Namespace, step: Steps) -> Findings:
    """Allan deviation of each sensor, and the terms that fit it."""
    if len(recording) < FEWEST:
        raise ValueError(f"log: expected at least {FEWEST} rows, got {len(recording)}.")
    triads = [triad("gyro", rates(recording), recording.interval, GYRO_UNITS, step)]
    if recording.accelerometer is not None:
        rows = forces(recording)
        triads.append(triad("accelerometer", rows, recording.interval, FORCE_UNITS, step))
    step("plots")
    return Findings(
        "Noise at rest: Allan deviation",
        tuple(map(_terms_table, triads)),
        (_best(triads[0]),),
        (*moved(recording), *filter(None, map(_missed, triads))),
        (*record_plots(recording), *map(_plot, triads)),
        tuple(map(_deviation_table, triads)),
        values={one.name: _values(one) for one in triads},
        columns=_columns(triads),
    )


def triad(
    name: str, rows: FloatArray, interval: float, units: tuple[Unit, ...], step: Steps
) -> Triad:
    """Deviations and fits of three columns (n, 3)."""
    found = []
    for axis, samples in zip(AXES, rows.T, strict=True):
        step(f"{name} {axis}")
        found.append(allan_deviation(samples, interval))
    fits = tuple(fit_noise_terms(one) for one in found)
    return Triad(name, units[2], units, tuple(found), fits)


def _terms_table(one: Triad) -> Table:
    rows = []
    for term, name, unit in zip(TERMS, NAMES, one.units, strict=True):
        cells = []
        for fit in one.fits:
            value, deviation = getattr(fit.terms, term), fit.deviations.get(term)
            if deviation is not None:
                shown, spread, _ = with_deviation(value, deviation, unit)
                cells.append(f"{shown} ± {spread}")
            else:
                bound = fit.upper_bounds.get(term, np.inf) / unit.size
                cells.append(f"< {written(bound, digits=2)}" if np.isfinite(bound) else "-")
        rows.append((name, *cells, unit.name))
    note = "A term that the record does not show has the bound that it is below with 95 %."
    return Table(f"Noise of the {one.name}s", ("", *AXES, "unit"), tuple(rows), note)


def _deviation_table(one: Triad) -> Table:
    times = one.allan[0].averaging_times
    chosen = np.unique(np.linspace(0, len(times) - 1, 10).round().astype(int))
    rows = []
    for place in chosen:
        cells = []
        for each in one.allan:
            spread = (each.upper[place] - each.lower[place]) / 2 / one.shown.size
            cells.append(written(each.deviation[place] / one.shown.size, spread))
        rows.append((written(float(times[place]), digits=4), *cells))
    head = ("time, s", *(f"{axis}, {one.shown.name}" for axis in AXES))
    return Table(f"Allan deviation of the {one.name}s", head, tuple(rows))


def _best(one: Triad) -> str:
    """The averaging time that helps most, axis by axis."""
    parts = []
    for axis, each in zip(AXES, one.allan, strict=True):
        least = int(np.argmin(each.deviation))
        parts.append(
            f"{axis} {written(each.deviation[least] / one.shown.size, digits=2)} {one.shown.name} "
            f"at {written(float(each.averaging_times[least]), digits=2)} s"
        )
    return (
        f"Lowest points of the gyros: {'; '.join(parts)}. Averaging for longer helps no further, "
        "unless the lowest point is the last one, and then the record is too short to say."
    )


def _missed(one: Triad) -> str:
    """A warning if the five terms do not make the deviations, where these are well known."""
    worst, where = 1.0, ""
    for axis, each, fit in zip(AXES, one.allan, one.fits, strict=True):
        known = (each.degrees_of_freedom > SURE) & (each.deviation > 0)
        ratio = fit.terms.deviation(each.averaging_times[known]) / each.deviation[known]
        factor = np.maximum(ratio, 1 / np.maximum(ratio, 1e-9))
        if len(factor) and factor.max() > worst:
            worst = float(factor.max())
            seconds = float(each.averaging_times[known][int(np.argmax(factor))])
            where = f"{axis} by a factor of {worst:.2g} at {written(seconds, digits=2)} s"
    if worst < MISSED:
        return ""
    return (
        f"the five terms miss the deviation of {one.name} {where}. There is more in the record "
        "than these kinds of noise, shaking say, and the terms have it in them: look at the plot."
    )


def moved(recording: Recording) -> list[str]:
    """A warning if the unit was moved."""
    if (moment := moved_at(recording)) is None:
        return []
    return [
        f"the unit seems to have been moved at {moment:.6g} s: choose a stretch at rest by --begin "
        "and --end, as an Allan deviation takes every turn for noise."
    ]


def _plot(one: Triad) -> Plot:
    curves, size = [], one.shown.size
    for axis, each, fit in zip(AXES, one.allan, one.fits, strict=True):
        times = each.averaging_times
        fitted = fit.terms.deviation(times) / size
        curves.append(
            Curve(axis, times, each.deviation / size, each.lower / size, each.upper / size, fitted)
        )
    title = f"Allan deviation of the {one.name}s, bands of 68 %, and the fit"
    return Plot(title, "averaging time, s", one.shown.name, tuple(curves), logarithmic=True)


def _values(one: Triad) -> dict[str, Any]:
    return {
        axis: {
            "averaging_times": each.averaging_times,
            "deviation": each.deviation,
            "lower": each.lower,
            "upper": each.upper,
            "terms": {term: getattr(fit.terms, term) for term in TERMS},
            "deviations": fit.deviations,
            "upper_bounds": fit.upper_bounds,
        }
        for axis, each, fit in zip(AXES, one.allan, one.fits, strict=True)
    }


def _columns(triads: list[Triad]) -> dict[str, Any]:
    columns: dict[str, Any] = {"averaging_time_s": triads[0].allan[0].averaging_times}
    si = {"gyro": "rad_per_s", "accelerometer": "m_per_s2"}
    for one in triads:
        for axis, each in zip(AXES, one.allan, strict=True):
            columns[f"{one.name}_{axis}_{si[one.name]}"] = each.deviation
            columns[f"{one.name}_{axis}_lower"] = each.lower
            columns[f"{one.name}_{axis}_upper"] = each.upper
    return columns
