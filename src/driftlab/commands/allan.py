"""``python -m driftlab allan``: the noise of a unit that lies still."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.constants import arcsecond, degree, g, hour, micro, milli

from driftlab.allan import AllanDeviation, allan_deviation
from driftlab.checks import FloatArray
from driftlab.noise_terms import TERMS, NoiseFit, fit_noise_terms
from driftlab.recordings.recording import Recording

from .example import OPTIONS
from .findings import AXES, DEG_PER_HOUR, Curve, Findings, Plot, Step, Table, Unit, written
from .record import forces, moved_at, rates, record_plots

STEPS = 7
EXAMPLE = (
    "python -m driftlab example log.csv\n"
    f"python -m driftlab allan log.csv {OPTIONS}"
    " --end 60 --csv deviation.csv"
)
ROOT, MG = hour**0.5, milli * g
# Of each term its name, and its units for gyros and for accelerometers.
_TERMS: tuple[tuple[str, Unit, Unit], ...] = (
    ("quantisation Q", Unit("arcsec", arcsecond), Unit("mm/s", milli)),
    ("random walk N", Unit("deg/√h", degree / ROOT), Unit("m/s/√h", 1 / ROOT)),
    ("bias instability B", DEG_PER_HOUR, Unit("micro-g", micro * g)),
    ("rate random walk K", Unit("deg/h/√h", DEG_PER_HOUR.size / ROOT), Unit("mg/√h", MG / ROOT)),
    ("rate ramp R", Unit("deg/h/h", DEG_PER_HOUR.size / hour), Unit("mg/h", MG / hour)),
)
NAMES, GYRO_UNITS, FORCE_UNITS = zip(*_TERMS, strict=True)
SHOWN = 2  # the unit of bias instability: that of the deviations
FEWEST = 1000  # rows that an Allan plot needs to show more than the first of its lines
# With so many degrees of freedom a deviation is known to 16 %; no fit should miss it by half.
SURE, MISSED = 20, 1.5


@dataclass(frozen=True)
class Triad:
    """A triad's deviations and fits by axis, and the units that they are shown in."""

    name: str
    si: str  # unit of its columns
    units: tuple[Unit, ...]
    axes: dict[str, tuple[AllanDeviation, NoiseFit]]


def find(recording: Recording, options: argparse.Namespace, step: Step) -> Findings:
    """Allan deviation of each sensor, and the terms that fit it."""
    if len(recording) < FEWEST:
        raise ValueError(f"log: expected at least {FEWEST} rows, got {len(recording)}.")

    def triad(name: str, si: str, units: tuple[Unit, ...], rows: FloatArray) -> Triad:
        axes = {}
        for axis, samples in zip(AXES, rows.T, strict=True):
            step(f"{name} {axis}")
            deviation = allan_deviation(samples, recording.interval)
            axes[axis] = deviation, fit_noise_terms(deviation)
        return Triad(name, si, units, axes)

    triads = [triad("gyro", "rad_per_s", GYRO_UNITS, rates(recording))]
    if recording.accelerometer is not None:
        triads.append(triad("accelerometer", "m_per_s2", FORCE_UNITS, forces(recording)))
    step("plots")
    return Findings(
        "Noise at rest: Allan deviation",
        tuple(map(_terms_table, triads)),
        (_best(triads[0]),),
        (*moved(recording), *filter(None, map(_missed, triads))),
        (*record_plots(recording), *map(_plot, triads)),
        tuple(map(_deviation_table, triads)),
        values={one.name: _values(one) for one in triads},
        columns=dict(_columns(triads)),
    )


def _terms_table(one: Triad) -> Table:
    rows = []
    for term, name, unit in zip(TERMS, NAMES, one.units, strict=True):
        cells = []
        for _, fit in one.axes.values():
            if term in fit.standard_deviations:
                cells.append(unit.pair(getattr(fit.terms, term), fit.standard_deviations[term]))
            else:
                bound = unit.text(fit.upper_bounds.get(term, np.inf), digits=2)
                cells.append(bound if bound == "-" else f"< {bound}")
        rows.append((name, *cells, unit.name))
    note = "A term that the record does not show has the bound that it is below with 95 %."
    return Table(f"Noise of the {one.name}s", ("", *AXES, "unit"), tuple(rows), note)


def _deviation_table(one: Triad) -> Table:
    unit, found = one.units[SHOWN], [deviation for deviation, _ in one.axes.values()]
    times = found[0].averaging_times
    rows = []
    for k in np.unique(np.linspace(0, len(times) - 1, 10).round().astype(int)):
        cells = (unit.text(x.deviation[k], (x.upper[k] - x.lower[k]) / 2) for x in found)
        rows.append((written(float(times[k]), digits=4), *cells))
    head = ("time, s", *(f"{axis}, {unit.name}" for axis in AXES))
    return Table(f"Allan deviation of the {one.name}s", head, tuple(rows))


def _best(one: Triad) -> str:
    """The averaging time that helps most, axis by axis."""
    parts, unit = [], one.units[SHOWN]
    for axis, (found, _) in one.axes.items():
        least = int(np.argmin(found.deviation))
        parts.append(
            f"{axis} {unit.text(found.deviation[least], digits=2)} {unit.name} at "
            f"{written(float(found.averaging_times[least]), digits=2)} s"
        )
    return (
        f"Lowest points of the gyros: {'; '.join(parts)}. Averaging for longer helps no further, "
        "unless the lowest point is the last one, and then the record is too short to say."
    )


def _missed(one: Triad) -> str:
    """A warning if the five terms do not make the deviations, where these are well known."""
    worst, where = 1.0, ""
    for axis, (found, fit) in one.axes.items():
        known = (found.degrees_of_freedom > SURE) & (found.deviation > 0)
        ratio = fit.terms.deviation(found.averaging_times[known]) / found.deviation[known]
        factor = np.maximum(ratio, 1 / np.maximum(ratio, 1e-9))
        if len(factor) and factor.max() > worst:
            worst = float(factor.max())
            seconds = float(found.averaging_times[known][int(np.argmax(factor))])
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
    name, size = one.units[SHOWN]
    curves = []
    for axis, (found, fit) in one.axes.items():
        times, y = found.averaging_times, found.deviation / size
        fitted = fit.terms.deviation(times) / size
        curves.append(Curve(axis, times, y, found.lower / size, found.upper / size, fitted))
    title = f"Allan deviation of the {one.name}s, bands of 68 %, and the fit"
    return Plot(title, "averaging time, s", name, tuple(curves), logarithmic=True)


def _values(one: Triad) -> dict[str, Any]:
    return {
        axis: {
            "averaging_times": found.averaging_times,
            "deviation": found.deviation,
            "lower": found.lower,
            "upper": found.upper,
            "terms": {term: getattr(fit.terms, term) for term in TERMS},
            "standard_deviations": fit.standard_deviations,
            "upper_bounds": fit.upper_bounds,
        }
        for axis, (found, fit) in one.axes.items()
    }


def _columns(triads: list[Triad]) -> Iterator[tuple[str, FloatArray]]:
    yield "averaging_time_s", triads[0].axes["x"][0].averaging_times
    for one in triads:
        for axis, (found, _) in one.axes.items():
            yield f"{one.name}_{axis}_{one.si}", found.deviation
            yield f"{one.name}_{axis}_lower", found.lower
            yield f"{one.name}_{axis}_upper", found.upper
