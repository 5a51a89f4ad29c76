"""Apparent drift on a coning motion: measured over many steps, and from one."""

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import degree, hour

from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS
from driftlab.book.machinery.picture import decades, in_style, legend_below_all
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import ConingDrift
from .algorithm_laboratory import styles

DEGREE_PER_HOUR = degree / hour
ALIKE = 0.02
"""Algorithms whose drifts differ by less than this part of them are drawn as one."""
LOW, HIGH = 1e-7, 1e5
"""Least reach of the axis of the drift, deg/h."""
ROUNDING = 1e-9
"""It reaches down no farther: there is nothing there but rounding."""


def columns(data: ConingDrift) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: sizes of the drift, of each algorithm in either way."""
    table = {"frequency_hz": data.frequencies, "rate_hz": data.rates}
    table |= {"formula_frequency_hz": data.fine_frequencies, "formula_rate_hz": data.fine_rates}
    for what, by_frequency, by_rate in (
        ("measured", data.by_frequency, data.by_rate),
        ("formula", data.formula_by_frequency, data.formula_by_rate),
    ):
        for name, over_frequency, over_rate in zip(data.names, by_frequency, by_rate, strict=True):
            table[f"{what}_deg_per_h, {name}, by frequency"] = _shown(over_frequency)
            table[f"{what}_deg_per_h, {name}, by rate"] = _shown(over_rate)
    return table


def _shown(drift: FloatArray) -> FloatArray:
    """Drift in deg/h, but none where there is none: it has no place on a logarithmic axis."""
    return np.where(drift > 0, drift / DEGREE_PER_HOUR, np.nan)


def alike(data: ConingDrift) -> list[list[str]]:
    """Names of algorithms whose drifts cannot be told apart, the one that is drawn first.

    Those of fourth order with the same weights differ in the fourth power of the half angle.
    """
    drifts = np.concatenate([data.formula_by_frequency, data.formula_by_rate], axis=-1)
    groups: list[list[int]] = []
    for i, drift in enumerate(drifts):
        near = (g for g in groups if np.allclose(drift, drifts[g[0]], ALIKE, 0, equal_nan=True))
        if (group := next(near, None)) is None:
            groups.append([i])
        else:
            group.append(i)
    return [
        sorted((data.names[i] for i in group), key=lambda name: -_order(name)) for group in groups
    ]


def _order(name: str) -> int:
    return CONING_ALGORITHMS[name].order if name in CONING_ALGORITHMS else 0


def _label(group: list[str], data: ConingDrift, narrow: bool) -> str:
    *others, last = sorted(group, key=data.names.index)
    if not others:
        return last
    words = f"{', '.join(others)} and {last}, nearly equal"
    return words.replace(", two-step-4", ",\ntwo-step-4") if narrow else words


@in_style
def draw(data: ConingDrift, sheet: Sheet) -> Figure:
    """Draw the drift over coning frequency and over sample rate."""
    figure, panels = sheet.mosaic(
        "ab", (10.5, 4.6), (0.075, 0.2, 0.985, 0.92), spaces=(0.06, 0.2), column_height=5.2,
        page_height=3.6, sharey=True,
    )  # fmt: skip
    by_frequency, by_rate = panels["a"], panels["b"]
    angle = f"half angle {np.degrees(data.half_angle):g}°"
    by_frequency.set(title=f"sampled at {data.sample_rate:g} Hz, {angle}")
    by_frequency.set(xlabel="coning frequency, Hz", ylabel="apparent drift, deg/h")
    by_frequency.set(xscale="log", yscale="log", xlim=(0.8, 40))
    by_frequency.set_xticks([1, 2, 5, 10, 20, 40], ["1", "2", "5", "10", "20", "40"])
    by_rate.set(title=f"coning at {data.frequency:g} Hz, {angle}", xlabel="sample rate, Hz")
    by_rate.set(xscale="log", xlim=(12, 1000))
    by_rate.set_xticks([20, 50, 100, 200, 500], ["20", "50", "100", "200", "500"])
    drawn = _shown(np.concatenate([data.by_frequency, data.by_rate], axis=-1))
    by_frequency.set_ylim(*decades(np.maximum(drawn, ROUNDING), LOW, HIGH))
    for panel in (by_frequency, by_rate):
        panel.minorticks_off()
    looks, handles = styles(data.names, sheet), []
    for group in alike(data):
        i = data.names.index(group[0])
        line = dict(looks[group[0]])
        dots = {"color": line["color"], "linestyle": "none", "marker": line.pop("marker")}
        if not sheet.on_paper:
            dots["markersize"] = line.pop("markersize")
        for panel, fine, formula, at, found in (
            (by_frequency, data.fine_frequencies, data.formula_by_frequency[i],
             data.frequencies, data.by_frequency[i]),
            (by_rate, data.fine_rates, data.formula_by_rate[i], data.rates, data.by_rate[i]),
        ):  # fmt: skip
            panel.plot(fine, _shown(formula), **line, label=f"{group[0]}, formula")
            panel.plot(at, _shown(found), **dots, label=f"{group[0]}, measured")
        words = _label(group, data, sheet.narrow)
        handles += by_frequency.plot([], [], **looks[group[0]], label=words)
    most = min(len(handles), 4 if sheet.on_paper else 5)
    legend_below_all(figure, sheet, handles, most, column=1, points=8)
    return figure
