"""Which way is up in body axes, all along the two rotation schemes."""

from matplotlib.figure import Figure

from driftlab.book.machinery.picture import SERIES, in_style, long_table
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import SchemeDirections


def columns(data: SchemeDirections) -> dict[str, FloatArray]:
    """Columns of the figure's CSV, each thirtieth second."""
    return long_table({
        f"{name}, {axis}": (times[::30], up[::30, i].round(12))
        for name, times, up in zip(data.names, data.times, data.up, strict=True)
        for i, axis in enumerate("xyz")
    })  # fmt: skip


@in_style
def draw(data: SchemeDirections, sheet: Sheet) -> Figure:
    """Draw one row a scheme, one line a body axis."""
    figure = Figure(figsize=(10.5, 4.4))
    panels = figure.subplots(len(data.names), 1, sharex=True, sharey=True)
    figure.subplots_adjust(0.065, 0.18, 0.985, 0.93, hspace=0.28)
    for panel, name, times, up in zip(panels, data.names, data.times, data.up, strict=True):
        panel.set(title=name, ylabel="along Up", ylim=(-1.15, 1.15), yticks=(-1, 0, 1))
        for axis, values, style in zip("xyz", up.T, SERIES, strict=False):
            panel.plot(times / 60, values, **style, label=f"body axis {axis}")
    panels[-1].set_xlabel("time, minutes")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncols=3)
    return figure
