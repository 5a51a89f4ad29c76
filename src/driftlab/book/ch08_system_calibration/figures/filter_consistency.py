"""Is the filter as good as it says? Squared normalised errors and innovations over many runs."""

from matplotlib.figure import Figure
from scipy.constants import arcsecond

from driftlab.body_frames import BODY_FRAMES
from driftlab.book.machinery.picture import BLACK, SERIES, in_style, long_table
from driftlab.checks import FloatArray

from ..experiments import FilterConsistency


def columns(data: FilterConsistency) -> dict[str, FloatArray]:
    """Columns of the figure's CSV; innovations each minute."""
    curves = {
        "states over time in s": (data.times, data.states),
        "innovations over time in s": (data.innovation_times[19::20], data.innovations[19::20]),
    }
    for name, values in zip(BODY_FRAMES, data.by_frame, strict=True):
        curves[f"states over installation errors in rad, {name}"] = (data.sizes, values)
    table = long_table(curves)
    return {**table, "y": table["y"].round(3)}


@in_style
def draw(data: FilterConsistency) -> Figure:
    """Draw errors of the states, innovations, and the choice of axes."""
    figure = Figure(figsize=(10.5, 3.9))
    states, innovations, frames = figure.subplots(1, 3)
    figure.subplots_adjust(0.055, 0.26, 0.985, 0.91, wspace=0.22)
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
    frames.set(title="27 states at the end", xscale="log", yscale="log")
    frames.set(xlabel="installation errors, arc seconds")
    arc_seconds = data.sizes / arcsecond
    for frame, values, style, marker in zip(
        BODY_FRAMES, data.by_frame, SERIES, "os^D", strict=False
    ):
        frames.plot(arc_seconds, values, **style, marker=marker, markersize=4, label=frame)
    frames.set_xticks(arc_seconds, [f"{size:.0f}" for size in arc_seconds])
    frames.set_yticks([1, 2, 5, 10, 20], ["1", "2", "5", "10", "20"])
    frames.minorticks_off()
    handles, labels = states.get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower left", ncols=2, bbox_to_anchor=(0.12, 0.04))
    frames.legend(loc="upper center", bbox_to_anchor=(0.45, -0.17), ncols=2)
    return figure
