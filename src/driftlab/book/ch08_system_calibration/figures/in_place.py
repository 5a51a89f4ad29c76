"""A calibrated unit navigates in place, with two choices of body axes; Wu Figs. 3-5."""

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import arcsecond, degree, hour, kilo

from driftlab.book.machinery.picture import BLACK, GREY, SERIES, in_style
from driftlab.book.machinery.sheet import Sheet
from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.calibration.schuler_pair import static_error_rates
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
    for (frame, start), curve in data.curves.items():
        for title, quantity, axis, unit, name in PANELS:
            values = getattr(curve, quantity)[rows, axis] / unit
            words = f"analytic {title} in {name}, {FRAMES[frame]}, start from {start}"
            table[words] = values.round(3)
        furthest = np.maximum.accumulate(data.gap((frame, start)))[rows]
        words = f"largest gap so far in m, {FRAMES[frame]}, start from {start}"
        table[words] = furthest.round(1)
    return table


def caption(data: InPlaceErrors) -> str:
    """Say what is seen, and how far the analytic curves are from the simulated ones."""
    gaps = {key: data.gap(key).max() for key in data.runs}
    worst = max(gaps, key=gaps.__getitem__)
    way = np.linalg.norm(data.runs[worst].position, axis=-1).max()
    turned = static_error_rates(TABLE_LATITUDE).foucault * REST_DURATION / degree
    return (
        "The paper's Figs. 3 to 5, simulated from its description: the typical unit of "
        "this chapter, calibrated with either choice of body axes, navigates at rest. If both "
        "computers start from one attitude, each in its own axes, the curves are one. If both "
        "start from the table's axes, each has its own distance to them as initial error. "
        "Thin black: the analytic curves, from what each calibration left over; their position is "
        f"within {gaps[worst]:.0f} m of the simulated one, which goes {way / kilo:.1f} km away. "
        "Dashed and thin: the first of them without its swing, which is the beginning of the "
        f"terms of 24 hours. The swing's plane turns by {turned:.0f} degrees, Foucault's exchange "
        "between East and North."
    )


@in_style
def draw(data: InPlaceErrors, sheet: Sheet) -> Figure:
    """Draw seven panels: three of attitude, two of velocity, two of position."""
    slow = dict(zip((title for title, *_ in PANELS), data.slow.T, strict=True))
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
            panel.plot(run.times / hour, values, **style, label=label, linewidth=2.6)
        for key, curve in data.curves.items():
            values = getattr(curve, quantity)[:, axis] / unit
            label = "analytic" if key == next(iter(data.curves)) else "_"
            panel.plot(curve.times / hour, values, color=BLACK, linewidth=0.7, label=label)
        hours = curve.times / hour
        panel.plot(hours, slow[title] / unit, color=GREY, dashes=(6, 3), linewidth=1.4, zorder=1,
                   label="first one, without\nits swing: 24 hours")  # fmt: skip
    for panel in grid[1]:
        panel.set_xlabel("time, hours")
    handles, labels = panels[0].get_legend_handles_labels()
    corner.legend(handles, labels, loc="center", labelspacing=0.8)
    return figure
