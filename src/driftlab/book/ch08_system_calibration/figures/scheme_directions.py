"""Which way is up in body axes, all along the rotation schemes."""

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import minute

from driftlab.book.machinery.picture import SERIES, in_style, legend_below_all
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import SchemeDirections


def columns(data: SchemeDirections) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the times of each scheme, and Up along each body axis."""
    table = {}
    for name, times, up in zip(data.names, data.times, data.up, strict=True):
        table[f"time_min, {name}"] = times / minute
        for axis, values in zip("xyz", up.T, strict=True):
            table[f"up along {axis}, {name}"] = values.round(6) + 0.0  # no negative zero
    return table


def caption(data: SchemeDirections) -> str:
    """Say how long each scheme takes."""
    each = [
        f"{name}: {times[-1] / minute:.1f} minutes with pauses of {scheme.dwell / minute:g} and "
        f"turns of {np.degrees(scheme.rate):g} degrees a second"
        for name, scheme, times in zip(data.names, data.schemes, data.times, strict=True)
    ]
    return f"Which body axis points up along a rotation scheme. {'; '.join(each)}."


@in_style
def draw(data: SchemeDirections, sheet: Sheet) -> Figure:
    """Draw one row a scheme, one line a body axis."""
    letters = [chr(ord("a") + i) for i in range(len(data.names))]
    figure, panels = sheet.mosaic(
        ";".join(letters), (10.5, 2.2 * len(letters)), (0.065, 0.18, 0.985, 0.93),
        column_height=0.6 + 1.3 * len(letters), spaces=(0.2, 0.28), sharex=True, sharey=True,
    )  # fmt: skip
    for letter, name, times, up in zip(letters, data.names, data.times, data.up, strict=True):
        panel = panels[letter]
        panel.set(title=name, ylabel="along Up", ylim=(-1.15, 1.15), yticks=(-1, 0, 1))
        for axis, values, style in zip("xyz", up.T, SERIES, strict=False):
            panel.plot(times / minute, values, **style, label=f"body axis {axis}")
    panels[letters[-1]].set_xlabel("time, minutes")
    legend_below_all(figure, sheet, panels["a"], ncols=3, column=3)
    return figure
