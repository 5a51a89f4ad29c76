"""Apparent drift on a coning motion: measured over many steps, and from one."""

import numpy as np

from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import decades, legend_below_all

from .algorithm_laboratory import styles

WAYS = ("by frequency", "by rate")
ALIKE = 0.02
"""Algorithms whose drifts differ by less than this part of them are drawn as one."""
LOW, HIGH = 1e-7, 1e5
"""Least reach of the axis of the drift, deg/h."""
ROUNDING = 1e-9
"""It reaches down no farther: there is nothing there but rounding."""


def alike(table: DataTable) -> list[list[str]]:
    """Names of algorithms whose drifts cannot be told apart, the one that is drawn first.

    Those of fourth order with the same weights differ in the fourth power of the half angle.
    """
    drifts = {
        name: np.concatenate([table.formula[f"{name}, {way}"] for way in WAYS])
        for name in table.algorithms
    }
    groups: list[list[str]] = []
    for name, drift in drifts.items():
        near = (g for g in groups if np.allclose(drift, drifts[g[0]], ALIKE, 0, equal_nan=True))
        if (group := next(near, None)) is None:
            groups.append([name])
        else:
            group.append(name)
    orders = {name: one.order for name, one in CONING_ALGORITHMS.items()}
    return [sorted(group, key=lambda name: -orders.get(name, 0)) for group in groups]


def _label(group: list[str], names: list[str], narrow: bool) -> str:
    *others, last = sorted(group, key=names.index)
    if not others:
        return last
    words = f"{', '.join(others)} and {last}, nearly equal"
    return words.replace(", two-step-4", ",\ntwo-step-4") if narrow else words


@from_table
def draw(drawing: Drawing) -> None:
    """Draw the drift over coning frequency and over sample rate."""
    table, sheet = drawing.table, drawing.sheet
    panels = drawing.mosaic(
        "ab", (10.5, 4.6), (0.075, 0.2, 0.985, 0.92), spaces=(0.06, 0.2), column_height=5.2,
        page_height=3.6, sharey=True,
    )  # fmt: skip
    by_frequency, by_rate = panels["a"], panels["b"]
    angle = f"half angle {table.words('half_angle', 'g')}"
    by_frequency.set(title=f"sampled at {table.words('sample_rate', 'g')}, {angle}")
    by_frequency.set(xlabel="coning frequency, Hz", ylabel="apparent drift, deg/h")
    by_frequency.set(xscale="log", yscale="log", xlim=(0.8, 40))
    by_frequency.set_xticks([1, 2, 5, 10, 20, 40], ["1", "2", "5", "10", "20", "40"])
    by_rate.set(title=f"coning at {table.words('cone_frequency', 'g')}, {angle}")
    by_rate.set(xlabel="sample rate, Hz", xscale="log", xlim=(12, 1000))
    by_rate.set_xticks([20, 50, 100, 200, 500], ["20", "50", "100", "200", "500"])
    drawn = np.concatenate([table.shown(f"measured, {each}") for each in table.measured])
    by_frequency.set_ylim(*decades(np.maximum(drawn, ROUNDING), LOW, HIGH))
    for panel in (by_frequency, by_rate):
        panel.minorticks_off()
    looks, handles = styles(table.algorithms, sheet), []
    for group in alike(table):
        name = group[0]
        line = dict(looks[name])
        dots = {"color": line["color"], "linestyle": "none", "marker": line.pop("marker")}
        if not sheet.on_paper:
            dots["markersize"] = line.pop("markersize")
        for panel, way in zip((by_frequency, by_rate), WAYS, strict=True):
            at = way.removeprefix("by ")
            formula, measured = (f"{kind}, {name}, {way}" for kind in ("formula", "measured"))
            drawing.curve(panel, f"formula_{at}", formula, **line, label=f"{name}, formula")
            drawing.curve(panel, at, measured, **dots, label=f"{name}, measured")
        words = _label(group, table.algorithms, sheet.narrow)
        handles += by_frequency.plot([], [], **looks[name], label=words)
    most = min(len(handles), 4 if sheet.on_paper else 5)
    legend_below_all(drawing.figure, sheet, handles, most, column=1, points=8)
