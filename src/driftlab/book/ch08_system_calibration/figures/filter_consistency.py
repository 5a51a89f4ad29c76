"""Is the filter as good as it says? Squared normalised errors and innovations over many runs."""

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import minute

from driftlab.book.machinery.picture import BLACK, SERIES, in_style, legend_below_all
from driftlab.book.machinery.sheet import Sheet
from driftlab.checks import FloatArray

from ..experiments import FilterConsistency

REACH = (0.3, 1.9)
"""Of the means over what they should be, unless some leave it."""


def columns(data: FilterConsistency) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    return {
        "state_time_min": data.times / minute,
        "states_over_expected": data.states,
        "innovation_time_min": data.innovation_times / minute,
        "innovations_over_expected": data.innovations,
        "state_bound_low": np.array(data.state_bounds[:1]),
        "state_bound_high": np.array(data.state_bounds[1:]),
        "innovation_bound_low": np.array(data.innovation_bounds[:1]),
        "innovation_bound_high": np.array(data.innovation_bounds[1:]),
    }


def caption(data: FilterConsistency) -> str:
    """Say how many values lie within their bounds."""
    low, high = data.state_bounds
    inside = np.mean((data.states > low) & (data.states < high))
    return (
        f"{data.runs} calibrations of random units. "
        f"Left: squared normalised errors of all states, each value of one; {inside:.0%} of the "
        "values lie within their bounds, and neighbouring values are correlated. Right: the same "
        f"of the innovations, {data.inside:.1%} within theirs."
    )


@in_style
def draw(data: FilterConsistency, sheet: Sheet) -> Figure:
    """Draw errors of the states, and innovations."""
    figure, panels = sheet.mosaic(
        "ab", (9.0, 3.9), (0.065, 0.22, 0.985, 0.91), spaces=(0.15, 0.2), page_height=2.9
    )
    states, innovations = panels["a"], panels["b"]
    states.set(title=f"{data.size} states", ylabel="mean over what it should be")
    innovations.set(title="innovations")
    if sheet.narrow:
        innovations.set(ylabel="mean over what it should be")
    else:
        states.set(xlabel="time, minutes")
    innovations.set(xlabel="time, minutes")
    drawn = np.concatenate([data.states, data.innovations])
    low, high = min(REACH[0], 0.9 * drawn.min()), max(REACH[1], 1.1 * drawn.max())
    wide, thin = (1.0, 0.5) if sheet.on_paper else (1.6, 0.7)
    for panel, times, values, bounds, width in (
        (states, data.times, data.states, data.state_bounds, wide),
        (innovations, data.innovation_times, data.innovations, data.innovation_bounds, thin),
    ):
        panel.plot(times / minute, values, **SERIES[0], linewidth=width, label="mean over the runs")
        for bound in bounds:
            panel.axhline(bound, color=BLACK, linestyle="--", linewidth=0.75 * wide)
        panel.lines[-1].set_label("95 % bounds of each value")
        panel.set(ylim=(low, high), xlim=(0, times[-1] / minute))
    legend_below_all(figure, sheet, states, ncols=2)
    return figure
