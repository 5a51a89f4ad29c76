"""A calibrated unit navigates in place, with two choices of body axes; Wu Figs. 3-5."""

from matplotlib.figure import Figure
from scipy.constants import arcsecond, hour, kilo

from driftlab.book.machinery.picture import SERIES, in_style
from driftlab.checks import FloatArray

from ..experiments import FRAMES, REST_DURATION, InPlaceErrors

PANELS = (
    ("attitude East", "attitude", 0, arcsecond, "arc seconds"),
    ("attitude North", "attitude", 1, arcsecond, "arc seconds"),
    ("attitude Up", "attitude", 2, arcsecond, "arc seconds"),
    ("velocity East", "velocity", 0, 1.0, "m/s"),
    ("velocity North", "velocity", 1, 1.0, "m/s"),
    ("position East", "position", 0, kilo, "km"),
    ("position North", "position", 1, kilo, "km"),
)


def columns(data: InPlaceErrors) -> dict[str, FloatArray]:
    """Columns of the figure's CSV, each five minutes."""
    rows = slice(4, None, 5)
    first = next(iter(data.runs.values()))
    table = {"time_s": first.times[rows]}
    for (frame, start), run in data.runs.items():
        for title, quantity, axis, unit, name in PANELS:
            values = getattr(run, quantity)[rows, axis] / unit
            table[f"{title} in {name}, {FRAMES[frame]}, start from {start}"] = values.round(3)
    return table


@in_style
def draw(data: InPlaceErrors) -> Figure:
    """Draw seven panels: three of attitude, two of velocity, two of position."""
    figure = Figure(figsize=(10.5, 5.4))
    grid = figure.subplots(2, 4, sharex=True)
    figure.subplots_adjust(0.055, 0.1, 0.99, 0.94, wspace=0.27, hspace=0.25)
    corner = grid[0, 3]
    corner.axis("off")
    panels = [*grid[0, :3], *grid[1]]
    for panel, (title, quantity, axis, unit, name) in zip(panels, PANELS, strict=True):
        panel.set_title(f"{title}, {name}", fontsize=9)
        panel.set_xlim(0, REST_DURATION / hour)
        for ((frame, start), run), style in zip(data.runs.items(), SERIES, strict=False):
            values = getattr(run, quantity)[:, axis] / unit
            label = f"{FRAMES[frame]},\nstart: {start}"
            panel.plot(run.times / hour, values, **style, label=label)
    for panel in grid[1]:
        panel.set_xlabel("time, hours")
    handles, labels = panels[0].get_legend_handles_labels()
    corner.legend(handles, labels, loc="center", labelspacing=1.0)
    return figure
