"""Regions of two free numbers, the integrator's error and a factor, that give Larin's digits."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLACK, SERIES, in_style
from driftlab.book.machinery.sheet import Sheet

from ..experiment_numbers import NAMES, SUM_FACTORS, TRIADS
from ..experiments import FACTORS, FreeNumbers
from .larin_digits import pretty

DOT: dict[str, Any] = {"color": BLACK, "markersize": 4}
TITLES = ("axes as in (2.4)", "third axis of unit length", "symmetric part only")


def columns(data: FreeNumbers) -> dict[str, Any]:
    """Columns of the figure's CSV: bounds of the factor for each reading and number."""
    table: dict[str, Any] = {"step_error_rad": data.step_error}
    for triad, both in zip(TRIADS, data.bounds, strict=True):
        for name, low, high in zip(NAMES, *both, strict=True):
            table |= {f"{triad} {name} from": low, f"{triad} {name} to": high}
    return table


@in_style
def draw(data: FreeNumbers, sheet: Sheet) -> Figure:
    """A panel a reading; what comes out everywhere or nowhere is said below it."""
    figure = Figure(figsize=(11.0, 4.9))
    panels = figure.subplots(1, len(TRIADS), sharey=True)
    figure.subplots_adjust(0.06, 0.3, 0.91, 0.92, wspace=0.08)
    for i, (panel, title) in enumerate(zip(panels, TITLES, strict=True)):
        panel.set(title=title, xlabel=r"error of a step, $10^{-9}$ rad", ylim=FACTORS)
        panel.set_xlim(1e9 * data.step_error[0], 1e9 * data.step_error[-1])
        _regions(panel, data, i)
        errors, factors = np.meshgrid(list(data.formulas.values()), list(SUM_FACTORS.values()))
        label = "a step formula in 100 steps, with a factor"
        panel.plot(1e9 * errors.ravel(), factors.ravel(), "o", **DOT, label=label)
        for line, word in enumerate(("everywhere", "nowhere")):
            where = zip(NAMES, data.extent(i), strict=True)
            names = [pretty(name) for name, extent in where if extent == word]
            text = f"{word}: {', '.join(names) or 'none'}"
            panel.text(0, -0.24 - 0.1 * line, text, transform=panel.transAxes, fontsize=10)
    panels[0].set_ylabel(r"factor before the arc tangent in $\sigma_4^\ast$")
    for factor, name in zip(SUM_FACTORS.values(), ("1", r"$\sqrt{3/2}$", "3/2"), strict=True):
        panels[-1].annotate(name, (1.02, factor), xycoords=("axes fraction", "data"), va="center")
    artists = [panel.get_legend_handles_labels() for panel in panels]
    handles = {label: handle for both in artists for handle, label in zip(*both, strict=True)}
    handles |= {label: handles.pop(label)}  # the dots last
    figure.legend(handles.values(), handles, loc="lower left", ncols=len(handles), fontsize=10)
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
