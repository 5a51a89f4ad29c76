"""Is the filter as good as it says? Squared normalised errors and innovations over many runs."""

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import BLACK, SERIES, legend_below_all

REACH = (0.3, 1.9)
"""Of the means over what they should be, unless some leave it."""


def caption(table: DataTable) -> str:
    """Say how many values lie within their bounds."""
    states = table.states_over_expected
    inside = np.mean((states > table.state_bound_low) & (states < table.state_bound_high))
    return (
        f"{table.runs} calibrations of random units. "
        f"Left: squared normalised errors of all states, each value of one; {inside:.0%} of the "
        "values lie within their bounds, and neighbouring values are correlated. Right: the same "
        f"of the innovations, {table.inside:.1%} within theirs."
    )


@from_table
def draw(drawing: Drawing) -> None:
    """Draw errors of the states, and innovations."""
    table, sheet = drawing.table, drawing.sheet
    panels = drawing.mosaic(
        "ab", (9.0, 3.9), (0.065, 0.22, 0.985, 0.91), spaces=(0.15, 0.2), page_height=2.9
    )
    states, innovations = panels["a"], panels["b"]
    states.set(title=f"{table.size} states", ylabel="mean over what it should be")
    innovations.set(title="innovations")
    if sheet.narrow:
        innovations.set(ylabel="mean over what it should be")
    else:
        states.set(xlabel="time, minutes")
    innovations.set(xlabel="time, minutes")
    drawn = np.concatenate([table.states_over_expected, table.innovations_over_expected])
    low, high = min(REACH[0], 0.9 * drawn.min()), max(REACH[1], 1.1 * drawn.max())
    wide, thin = (1.0, 0.5) if sheet.on_paper else (1.6, 0.7)
    for panel, what, width in ((states, "state", wide), (innovations, "innovation", thin)):
        drawing.curve(
            panel, f"{what}_time", f"{what}s_over_expected", **SERIES[0], linewidth=width,
            label="mean over the runs",
        )  # fmt: skip
        for end, label in (("low", None), ("high", "95 % bounds of each value")):
            drawing.level(panel, y=f"{what}_bound_{end}", color=BLACK, linestyle="--",
                          linewidth=0.75 * wide, label=label)  # fmt: skip
        panel.set(ylim=(low, high), xlim=(0, table.shown(f"{what}_time")[-1]))
    legend_below_all(drawing.figure, sheet, states, ncols=2)
