"""Increments that are made from sampled rates: what is put between the samples."""

import numpy as np
from scipy.interpolate import make_interp_spline

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.checks import FloatArray, positive_number
from driftlab.motion.profiles import Motion
from driftlab.sampled_rates import increments_from_rates

DEGREES = (3, 5, 7)
"""Degrees of the splines."""
MADE_AT: FloatArray = np.geomspace(2.2, 40.0, 60)
"""Samples a round at which increments are compared."""
MARGIN = 20
"""Samples at either end that are not compared, because a spline has one side only there."""


def increments_made(motion: Motion, rate: float, seconds: float) -> dict[str, FloatArray]:
    """Return increments (n, 3) made from a motion's sampled rates in five ways, and the true ones.

    The rate of the samples is in Hz.
    """
    count = round(seconds * rate)
    rates = motion.rate(np.arange(count + 1) / rate)
    made = {"rectangle": rates[:-1] / rate, "trapezoid": (rates[1:] + rates[:-1]) / 2 / rate}
    for degree in DEGREES:
        made[f"spline of degree {degree}"] = increments_from_rates(rates, 1 / rate, degree=degree)
    return made | {"true": motion.increments(1 / rate, count)}


def between_samples(samples: float = 5.0) -> DataTable:
    """Sample an oscillating rate, so many times in a period, and guess it between the samples."""
    each = positive_number(samples, "samples")
    moments = np.arange(np.ceil(-2 * each), np.ceil(4 * each) + 1)
    rates = np.cos(2 * np.pi * moments / each)
    fine = np.linspace(0, 2 * each, 401)
    held = moments.searchsorted(fine, side="right") - 1
    guesses = {
        "true": np.cos(2 * np.pi * fine / each),
        "rectangle": rates[held],
        "trapezoid": np.interp(fine, moments, rates),
        "spline of degree 5": make_interp_spline(moments, rates, 5)(fine),
    }
    shown = (moments >= 0) & (moments <= 2 * each)
    errors: dict[str, list[float]] = {}
    for often in MADE_AT:
        time = np.arange(301) * 2 * np.pi / often
        rows = np.zeros((len(time), 3))
        rows[:, 0], rows[:, 1] = np.cos(time), np.sin(time)
        true = np.diff(np.stack([np.sin(time), -np.cos(time)], axis=-1), axis=0) * often / 2 / np.pi
        largest = np.abs(true).max()
        ways = {"rectangle": rows[:-1], "trapezoid": (rows[1:] + rows[:-1]) / 2}
        for degree in DEGREES:
            ways[f"spline of degree {degree}"] = increments_from_rates(rows, 1.0, degree=degree)
        for name, way in ways.items():
            gap = np.abs(way[:, :2] - true)[MARGIN:-MARGIN].max() / largest
            errors.setdefault(name, []).append(gap)
    return DataTable(
        {
            "moment": (fine / each, "", "time, in periods of the rate"),
            "guess": (guesses, "", "rate, true and as it is guessed"),
            "sampled_at": (moments[shown] / each, "", "time of the samples, in periods"),
            "sampled": (rates[shown], "", "rate in the samples"),
            "samples_a_round": (MADE_AT, "", "samples in a period"),
            "error": ({k: np.array(v) for k, v in errors.items()}, "", "of an increment, relative"),
        },
        {"samples": (each, "", "samples in a period that are drawn")},
    )
