"""Order of each attitude algorithm, measured on motions that show it and motions that hide it."""

import numpy as np
from matplotlib.figure import Figure

from driftlab.book.machinery.picture import in_style, legend_below_all
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import AlgorithmOrders
from .algorithm_laboratory import draw_slopes, styles

SLOPES_FROM = 1e-11
"""Error at which the lines of known order begin, rad."""


def columns(data: AlgorithmOrders) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the errors of each algorithm on each motion."""
    table = {"rate_hz": data.rates}
    for motion, errors in zip(data.motions, data.worst, strict=True):
        for name, column in zip(data.names, errors, strict=True):
            table[f"error_rad, {name}, {motion}"] = _shown(column)
    return table


def _shown(errors: FloatArray) -> FloatArray:
    """Errors as they are drawn: no error at all has no place on a logarithmic axis."""
    return np.where(errors > 0, errors, np.nan)


@in_style
def draw(data: AlgorithmOrders, sheet: Sheet) -> Figure:
    """Draw one panel a motion."""
    letters = "abcdefghijklmnop"[: len(data.motions)]
    padded = letters + "." * (len(letters) % 2 if len(letters) > 1 else 0)
    rows = [padded[i : i + 2] for i in range(0, len(padded), 2)]
    figure, mosaic = sheet.mosaic(
        ";".join(rows), (10.0, 3.6 * len(rows)), (0.085, 0.27 / len(rows), 0.985, 0.955),
        spaces=(0.06, 0.16), column_height=0.8 + 1.9 * len(letters), sharex=True, sharey=True,
    )  # fmt: skip
    panels = [mosaic[letter] for letter in letters]
    first, last = data.rates[[0, -1]]
    looks, top = styles(data.names, sheet), 3.0 if np.nanmax(data.worst) < 3 else 10.0
    for panel, title, worst in zip(panels, data.motions, data.worst, strict=True):
        panel.set(title=title, xscale="log", yscale="log", ylim=(1e-16, top))
        panel.set(xlim=(0.875 * first, 1.172 * last))
        panel.set_xticks(data.rates, [f"{rate:g}" for rate in data.rates])
        panel.minorticks_off()
        if _leave_room(worst, data.rates):
            named = (2, 4) if sheet.narrow else (2, 3, 4)
            size = "small" if sheet.on_paper else None
            draw_slopes(panel, first, SLOPES_FROM, named, fontsize=size)
        for name, errors in zip(data.names, worst, strict=True):
            panel.plot(data.rates, _shown(errors), **looks[name], label=name)
        place, across = panels.index(panel), 1 if sheet.narrow else 2
        if place >= len(panels) - across:
            panel.set_xlabel("sample rate, Hz")
        if place % across == 0:
            of_what = "" if sheet.on_paper else " of attitude"
            panel.set_ylabel(f"largest error{of_what}, rad")
    handles, _ = panels[0].get_legend_handles_labels()
    most = min(len(handles), 4 if sheet.on_paper else 7)
    legend_below_all(figure, sheet, handles, most, points=8)
    return figure


def _leave_room(errors: FloatArray, rates: FloatArray) -> bool:
    """Whether no error lies where the lines of known order and their names stand."""
    there = rates < 14 * rates[0]
    line = SLOPES_FROM * (rates[there] / rates[0]) ** -2.0
    return bool(np.all(_shown(errors)[:, there] > 2 * line))
