"""Is the filter as good as it says? Squared normalised errors and innovations over many runs."""

from matplotlib.figure import Figure

from driftlab.book.machinery.picture import BLACK, SERIES, in_style, long_table
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import FilterConsistency


def columns(data: FilterConsistency) -> dict[str, FloatArray]:
    """Columns of the figure's CSV; innovations each minute."""
    curves = {
        "states over time in s": (data.times, data.states),
        "innovations over time in s": (data.innovation_times[19::20], data.innovations[19::20]),
    }
    table = long_table(curves)
    return {**table, "y": table["y"].round(3)}


@in_style
def draw(data: FilterConsistency, sheet: Sheet) -> Figure:
    """Draw errors of the states, and innovations."""
    figure = Figure(figsize=(9.0, 3.9))
    states, innovations = figure.subplots(1, 2)
    figure.subplots_adjust(0.065, 0.22, 0.985, 0.91, wspace=0.15)
    states.set(title="27 states", xlabel="time, minutes", ylabel="mean over what it should be")
    innovations.set(title="innovations", xlabel="time, minutes")
    for panel, times, values, bounds, width in (
        (states, data.times, data.states, data.state_bounds, 1.6),
        (innovations, data.innovation_times, data.innovations, data.innovation_bounds, 0.7),
    ):
        panel.plot(times / 60, values, **SERIES[0], linewidth=width, label="mean over the runs")
        for bound in bounds:
            panel.axhline(bound, color=BLACK, linestyle="--", linewidth=1.2)
        panel.lines[-1].set_label("95 % bounds of each value")
        panel.set(ylim=(0.3, 1.9), xlim=(0, times[-1] / 60))
    handles, labels = states.get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncols=2)
    return figure
