"""Time stamps of a log: equal steps or jitter; refused if they stand still or leave gaps."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import FloatArray, finite_number, shown


def checked_longest_gap(value: float) -> float:
    """The argument `longest_gap`: how many usual intervals, at least one."""
    number = finite_number(value, "longest_gap")
    if number < 1:
        raise ValueError(
            f"longest_gap: expected a number of usual intervals, at least 1, got {shown(value)}."
        )
    return number


def spacing_of_stamps(
    stamps: FloatArray, longest_gap: float, place: Callable[[int], str]
) -> tuple[float, FloatArray | None]:
    """Return the interval of samples, s, and their times if they are not equally spaced.

    Stamps that are equal steps rounded to their last digit have no times of their own: a logger
    of 102.4 Hz that writes milliseconds has steps of 9 and 10 ms. Refused are a single stamp,
    stamps that do not increase, and a step longer than `longest_gap` median steps.
    """
    if len(stamps) < 2:
        raise ValueError(f"{place(0)}: expected two time stamps at least, got one.")
    steps = np.diff(stamps)
    if not (steps > 0).all():
        row = int(np.argmin(steps > 0)) + 1
        slip = "the same stamp again" if steps[row - 1] == 0 else f"{-steps[row - 1]:.6g} s earlier"
        raise ValueError(
            f"{place(row)}: expected a time stamp after that of the line before, got {slip}; "
            "if stamps are too coarse, say the rate in their stead."
        )
    usual = float(np.median(steps))
    longest = int(np.argmax(steps))
    if steps[longest] / usual > longest_gap * (1 + 1e-9):  # in doubles 0.003 > 1.5 * 0.002
        raise ValueError(
            f"{place(longest + 1)}: expected no gap longer than {longest_gap:g} times the usual "
            f"{usual:.6g} s (longest_gap), got {steps[longest]:.6g} s since the line before; "
            'allow=("gap",) lets it through.'
        )
    # Of rounded stamps the steps have two sizes, one last digit apart, and the stamps lie within
    # that digit of a line.
    sizes = np.unique(np.round(steps / usual, 9))
    if len(sizes) <= 2 and np.ptp(sizes) <= 0.5:  # no lost sample
        rows = np.arange(len(stamps)) - (len(stamps) - 1) / 2
        slope = (rows @ stamps) / (rows @ rows)
        away = stamps - stamps.mean() - slope * rows
        if max(away.max(), -away.min()) < usual * (np.ptp(sizes) + 1e-6):
            return float(f"{slope:.12g}"), None
    return float(f"{usual:.9g}"), stamps


def seconds_since_first(moments: NDArray[Any]) -> FloatArray:
    """Return NumPy's dates and times, or spans of time, as seconds since the first."""
    # First the difference: of the seconds since 1970 the fractions are lost.
    return (moments - moments[0]).astype("timedelta64[ns]").astype(float) * 1e-9
