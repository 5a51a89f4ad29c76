"""Regions of two free numbers, the integrator's error and a factor, that give Larin's digits."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLACK, SERIES, in_style, legend_below_all
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiment_numbers import NAMES, SUM_FACTORS, TRIADS
from ..experiments import FreeNumbers
from .larin_digits import pretty

DOT: dict[str, Any] = {"color": BLACK, "markersize": 4}
TITLES = ("axes as in (2.4)", "third axis of unit length", "symmetric part only")


def columns(data: FreeNumbers) -> dict[str, Any]:
    """Columns of the figure's CSV: where each number comes out, and below the step formulas."""
    triad, number, place = np.nonzero(~np.isnan(data.bounds[:, 0]))
    errors, factors = _formulas(data)
    return {
        "reading": [TRIADS[i] for i in triad],
        "number": [NAMES[i] for i in number],
        "step_error_1e-9rad": 1e9 * data.step_error[place],
        "factor_from": data.bounds[triad, 0, number, place],
        "factor_to": data.bounds[triad, 1, number, place],
        "formula_error_1e-9rad": errors,
        "formula_factor": factors,
    }


def _formulas(data: FreeNumbers) -> tuple[FloatArray, FloatArray]:
    """Error of a step, 1e-9 rad, and factor of each step formula with each way to form sigma4*."""
    factors = np.array(list(SUM_FACTORS.values()))
    errors = 1e9 * np.array(list(data.formulas.values()))
    return np.tile(errors, len(factors)), np.repeat(factors, len(errors))


@in_style
def draw(data: FreeNumbers, sheet: Sheet) -> Figure:
    """A panel a reading; what comes out everywhere or nowhere is said below it."""
    figure, by_letter = sheet.mosaic(
        "abc", (11.0, 4.9), (0.06, 0.3, 0.91, 0.92), spaces=(0.08, 0.2), sharey=True,
        column_height=7.4, page_height=3.6,
    )  # fmt: skip
    panels = list(by_letter.values())
    first, apart = (-29, 11) if sheet.on_paper else (-43, 21)
    size = "medium" if sheet.on_paper else 10
    for i, (panel, title) in enumerate(zip(panels, TITLES, strict=True)):
        panel.set(title=title, xlabel=r"error of a step, $10^{-9}$ rad", ylim=data.factors)
        panel.set_xlim(1e9 * data.step_error[0], 1e9 * data.step_error[-1])
        _regions(panel, data, i)
        label = "a step formula in 100 steps, with a factor"
        panel.plot(*_formulas(data), "o", **DOT, label=label)
        for line, word in enumerate(("everywhere", "nowhere")):
            where = zip(NAMES, data.extent(i), strict=True)
            names = [pretty(name) for name, extent in where if extent == word]
            text = f"{word}: {', '.join(names) or 'none'}"
            below: dict[str, Any] = {
                "xycoords": "axes fraction",
                "textcoords": "offset points",
                "va": "top",
            }
            panel.annotate(text, (0, 0), (0, first - apart * line), fontsize=size, **below)
        if panel is panels[0] or sheet.narrow:
            panel.set_ylabel(
                r"factor in $\sigma_4^\ast$"
                if sheet.on_paper
                else r"factor before the arc tangent in $\sigma_4^\ast$"
            )
    for factor, name in zip(SUM_FACTORS.values(), ("1", r"$\sqrt{3/2}$", "3/2"), strict=True):
        if data.factors[0] <= factor <= data.factors[1]:
            at: dict[str, Any] = {"xycoords": ("axes fraction", "data"), "va": "center"}
            panels[-1].annotate(name, (1.02, factor), **at)
    artists = [panel.get_legend_handles_labels() for panel in panels]
    handles = {label: handle for both in artists for handle, label in zip(*both, strict=True)}
    handles |= {label: handles.pop(label)}  # the dots last
    entries = list(handles.values())
    if sheet.on_paper:
        legend_below_all(figure, sheet, entries, len(entries), column=1, labels=list(handles))
    else:
        figure.legend(entries, handles, loc="lower left", ncols=len(entries), fontsize=10)
    return figure


def _regions(panel: Axes, data: FreeNumbers, triad: int) -> None:
    """Fill the region of each number that comes out in a part of the panel."""
    for index, where in enumerate(data.extent(triad)):
        if where != "in part":
            continue
        colour = SERIES[index % len(SERIES)]["color"]
        low, high = data.bounds[triad, :, index]
        inside = ~np.isnan(low)
        panel.fill_between(
            1e9 * data.step_error[inside],
            low[inside],
            high[inside],
            color=colour,
            alpha=0.45,
            linewidth=1.5,
            label=f"{pretty(NAMES[index])} comes out",
        )
