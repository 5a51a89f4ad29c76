"""Several horizons on one voyage: tunings that feel that a ship gathers way, and dampings."""

from collections.abc import Iterable

import numpy as np
from matplotlib.figure import Figure
from scipy.constants import arcminute, minute

from driftlab.book.machinery.picture import SERIES, in_style, legend_below_all
from driftlab.book.machinery.sheet import Sheet
from driftlab.book.scenarios import DURATION
from driftlab.checks import FloatArray
from driftlab.gyrocompass.simulation import HeadingErrors

from ..experiments import Horizons
from .operation import shade_manoeuvres

SHOWN = slice(2, None, 3)
"""Steps of the voyage that are drawn."""


def columns(data: Horizons) -> dict[str, FloatArray]:
    """Columns of the figure's CSV."""
    table = {"time_min": next(iter(data.runs.values())).times[SHOWN] / minute}
    for name, run in data.runs.items():
        table[f"tilt_east_arcmin, {name}"] = run.tilt[SHOWN, 1] / arcminute
        table[f"heading_error_deg, {name}"] = np.degrees(run.heading_error[SHOWN])
    return table


def reach(runs: Iterable[HeadingErrors], least: tuple[float, float]) -> tuple[float, float]:
    """How far tilts, arc minutes, and heading errors, degrees, reach: so far at least."""
    sizes = [
        (np.abs(run.tilt[:, 1]).max() / arcminute, np.degrees(np.abs(run.heading_error).max()))
        for run in runs
    ]
    tilt, heading = (float(x) for x in np.max(sizes, axis=0))
    return tuple(  # type: ignore[return-value]
        low if size <= low else 1.1 * size for low, size in zip(least, (tilt, heading), strict=True)
    )


@in_style
def draw_ballistic(data: Horizons, sheet: Sheet) -> Figure:
    """Draw all horizons."""
    return _drawn(data, sheet, *reach(data.runs.values(), (6.0, 6.0)))


@in_style
def draw_damping(data: Horizons, sheet: Sheet) -> Figure:
    """Draw all horizons; the damped one without a log may leave the panels."""
    return _drawn(data, sheet, *damping_reach(data))


def damping_reach(data: Horizons) -> tuple[float, float]:
    """Reach of all horizons but the damped one without a log."""
    undamped, _, *by_log = data.runs.values()
    return reach((undamped, *by_log), (0.4, 0.5))


def _drawn(data: Horizons, sheet: Sheet, tilt_reach: float, heading_reach: float) -> Figure:
    """Draw tilt about East and heading error within arc minutes and degrees."""
    figure, panels = sheet.mosaic(
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
    for (name, run), style in zip(data.runs.items(), SERIES, strict=False):
        minutes = run.times[SHOWN] / minute
        tilt.plot(minutes, run.tilt[SHOWN, 1] / arcminute, **style, label=name)
        heading.plot(minutes, np.degrees(run.heading_error[SHOWN]), **style, label=name)
    rows = 2 if sheet.on_paper and len(data.runs) > 4 else 1
    legend_below_all(figure, sheet, tilt, -(-len(data.runs) // rows))
    return figure
