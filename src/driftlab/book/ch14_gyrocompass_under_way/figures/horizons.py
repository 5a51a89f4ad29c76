"""Several horizons on one voyage, of which some feel that a ship gathers way."""

from collections.abc import Sequence

import numpy as np
from scipy.constants import arcminute, minute

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import SERIES, legend_below_all
from driftlab.book.scenarios import DURATION
from driftlab.gyrocompass.simulation import HeadingErrors

from .operation import shade_manoeuvres


def reach(runs: Sequence[HeadingErrors], least: tuple[float, float]) -> tuple[float, float]:
    """How far tilts, arc minutes, and heading errors, degrees, reach: so far at least."""
    tilt = max(np.abs(run.tilt[:, 1]).max() for run in runs) / arcminute
    heading = np.degrees(max(np.abs(run.heading_error).max() for run in runs))
    low, narrow = least
    return (low if tilt <= low else 1.1 * tilt), (narrow if heading <= narrow else 1.1 * heading)


@from_table
def draw_ballistic(drawing: Drawing) -> None:
    """Draw all horizons."""
    draw_horizons(drawing, *reach([*drawing.table.runs.values()], (6.0, 6.0)))


def draw_horizons(drawing: Drawing, tilt_reach: float, heading_reach: float) -> None:
    """Draw tilt about East and heading error within arc minutes and degrees."""
    runs, sheet = drawing.table.runs, drawing.sheet
    panels = drawing.mosaic(
        "ab", (10.5, 3.9), (0.06, 0.23, 0.985, 0.91), spaces=(0.16, 0.2), page_height=3.1,
        column_height=4.8,
    )  # fmt: skip
    tilt, heading = panels["a"], panels["b"]
    tilt.set(title="tilt about East, arc minutes", ylim=(-tilt_reach, tilt_reach))
    heading.set(title="heading error without speed error, degrees")
    heading.set(ylim=(-heading_reach, heading_reach))
    for panel in (tilt, heading):
        panel.set(xlabel="time, minutes", xlim=(0, DURATION / minute))
        shade_manoeuvres(panel)
    for name, style in zip(runs, SERIES, strict=False):
        drawing.curve(tilt, "time", f"tilt_east, {name}", **style, label=name)
        drawing.curve(heading, "time", f"heading_error, {name}", **style, label=name)
    rows = 2 if sheet.on_paper and len(runs) > 4 else 1
    legend_below_all(drawing.figure, sheet, tilt, -(-len(runs) // rows))
