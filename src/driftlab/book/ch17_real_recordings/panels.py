"""The slider panel of chapter 17."""

from __future__ import annotations

from dataclasses import astuple
from typing import ClassVar

import numpy as np
from scipy.constants import arcsecond, degree, hour, minute

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Explorer, Values
from driftlab.book.machinery.panel.results import ABSENT, Results
from driftlab.book.machinery.panel.units import number_text
from driftlab.checks import FloatArray
from driftlab.noise_terms import NoiseTerms

from .experiments.simulated_allan import SAMPLES, simulated_allan
from .figures.allan_explorer import WORDS, AllanPicture

ROOT_HOUR = np.sqrt(hour)
UNITS = (
    arcsecond, degree / ROOT_HOUR, degree / hour, degree / hour / ROOT_HOUR, degree / hour / hour,
)  # fmt: skip
"""Of the sliders, in SI units."""
UNIT_WORDS = ("″", "°/√h", "°/h", "°/h/√h", "°/h²")
DECADES = (0.0, *(round(k * 10.0**power, 4) for power in range(-4, 3) for k in (1, 3)), 1000.0)
"""Places of the sliders."""
LENGTHS = (1.0, 10.0, 60.0, 600.0, 6000.0)
NONE = {"quantisation": 0.0, "walk": 0.0, "flicker": 0.0, "rate_walk": 0.0, "ramp": 0.0}
NAMES = tuple(NONE)


def noise_of(values: Values) -> NoiseTerms:
    """Return the noise that the sliders say, in SI units."""
    return NoiseTerms(
        *(float(values[name] * unit) for name, unit in zip(NAMES, UNITS, strict=True))
    )


class AllanExplorer(Explorer):
    """Five kinds of noise, and what a record of some length shows of them."""

    title = "Which line is which?"
    picture_class = AllanPicture
    controls = (
        Control("quantisation", "quantisation, ″", 0.0, stops=DECADES, group="noise"),
        Control("walk", "angle walk, °/√h", 0.3, stops=DECADES, group="noise"),
        Control("flicker", "bias instability, °/h", 10.0, stops=DECADES, group="noise"),
        Control("rate_walk", "rate walk, °/h/√h", 30.0, stops=DECADES, group="noise"),
        Control("ramp", "rate ramp, °/h²", 0.0, stops=DECADES, group="noise"),
        Control("length", "record, min", 600.0, stops=LENGTHS, group="record"),
        Control("run", "run", 13, 1, 20, 1, group="record"),
    )
    presets: ClassVar = {
        "A cheap MEMS gyro": {},
        "The same for one minute": {"length": 1.0},
        "A fibre-optic gyro": {
            "walk": 0.003, "flicker": 0.01, "rate_walk": 0.003, "length": 6000.0
        },
        "A laser gyro": {
            **NONE, "quantisation": 0.3, "walk": 0.001, "flicker": 0.001, "ramp": 0.001,
        },
        "Puzzle: two that fall": {**NONE, "quantisation": 300.0, "walk": 1.0, "length": 10.0},
    }  # fmt: skip
    look_for: ClassVar = {
        "A cheap MEMS gyro": "Three lines. Which of them can you read off the plot, and where?",
        "The same for one minute": "The same gyro, one minute. Which of its lines have you lost?",
        "A fibre-optic gyro": "Four days at rest. Shorten the record: what goes first?",
        "A laser gyro": "A line of slope −1. Could it be the table that shakes? How to tell?",
        "Puzzle: two that fall": "Where do the lines cross? Move one until you see it alone.",
    }

    def compute(self, values: Values) -> DataTable:
        return simulated_allan(noise_of(values), values["length"] * minute, values["run"])

    def numbers(self, table: DataTable) -> Results:
        rows = []
        for i, (words, unit) in enumerate(zip(WORDS, UNIT_WORDS, strict=True)):
            size, read = _coefficients(table.noise)[i], _reading(table, i) / UNITS[i]
            put_in = number_text(size) if size else ABSENT
            shown = "nowhere" if np.isnan(read) else number_text(read)
            rows.append((f"{words}, {unit}", put_in, shown if size else ABSENT))
        lowest = int(np.argmin(table.deviation))
        height = number_text(table.shown("deviation")[lowest])
        says = f"{height} °/h at {number_text(table.time[lowest])} s"
        return Results(
            ("lowest point", says if table.deviation.any() else ABSENT), rows, ("put in", "read")
        )

    def call(self, values: Values) -> str:
        sizes = [float(values[name]) for name in NAMES]
        return (
            "import numpy as np\n"
            "from scipy.constants import arcsecond, degree, hour\n"
            "from driftlab.allan import allan_deviation\n"
            "from driftlab.noise_terms import NoiseTerms\n"
            f"q, n, b, k, r = {sizes}\n"
            "noise = NoiseTerms(q * arcsecond, n * degree / hour**0.5, b * degree / hour,\n"
            "    k * degree / hour**1.5, r * degree / hour**2)\n"
            f"count, interval = {SAMPLES}, {values['length']} * 60 / {SAMPLES}\n"
            f"rates = noise.samples(count, interval, np.random.default_rng({values['run']}))\n"
            "found = allan_deviation(rates, interval)\n"
            "lowest = np.argmin(found.deviation)\n"
            "print(found.deviation[lowest] / degree * hour, found.averaging_times[lowest])"
        )


def _coefficients(noise: NoiseTerms) -> FloatArray:
    """Coefficients (5,) in the units of the sliders."""
    return np.array(astuple(noise)) / UNITS


def _reading(table: DataTable, term: int) -> float:
    """Coefficient that the plot gives where this term's line rules, SI units; NaN if nowhere.

    It rules where it makes up nine tenths of the variance, with more than 5 degrees of freedom.
    """
    times, noise = table.time, table.noise
    line = list(noise.lines(times).values())[term]
    size = float(_coefficients(noise)[term] * UNITS[term])
    total = noise.deviation(times)
    # With all sliders at zero there is no noise at all.
    share = np.divide(line, total, out=np.zeros_like(line), where=total > 0) ** 2
    share[table.degrees_of_freedom <= 5] = 0.0
    if share.max() <= 0.9:
        return float("nan")
    place = int(np.argmax(share))
    return size * float(table.deviation[place] / line[place])


PANELS = (AllanExplorer,)
