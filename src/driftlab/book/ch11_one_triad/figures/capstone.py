"""One bent triad through all four papers: drift per turn, two calibrations, and the heading."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from scipy.constants import arcsecond, minute

from driftlab.book.machinery.picture import BLACK, SERIES, Picture, legend_above
from driftlab.book.scenarios import DURATION
from driftlab.checks import FloatArray

from ..experiments import AXIS_NAMES, STAGES, Capstone

PARTS = ("forward-\nup", "forward-\nright", "up-\nright", "about\nforward", "about\nup",
         "about\nright")  # fmt: skip
"""Names of the pairs of axes, and of the axes that the whole triad is turned about."""
SECONDS = (20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)
MINUTES = (0.2, 0.5, 1.0, 2.0, 5.0, 15.0, 75.0, 400.0)
DEGREES = (0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 25.0, 200.0)
"""How far the axes may reach."""


def columns(data: Capstone) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the heading under way, each four minutes."""
    rows = slice(14, None, 15)
    table = {"time_s": data.under_way.times[rows]}
    for stage, error in zip(STAGES, data.under_way.heading_error, strict=True):
        table[f"heading_error_deg, {stage}"] = np.degrees(error[rows]).round(6)
    return table


class CapstonePicture(Picture[Capstone]):
    """What is known, what drifts, and what the heading has of it."""

    size = (9.8, 4.9)

    def build(self) -> None:
        panels = self.figure.subplots(2, 2)
        self.figure.subplots_adjust(0.065, 0.135, 0.985, 0.95, wspace=0.17, hspace=0.36)
        known, turns, aligned, under_way = panels.ravel()
        self.stem_panels = known, turns
        self.heading_panels = aligned, under_way
        known.set(title="1 the bend, ″")
        known.set_xlim(-0.6, 5.6)
        known.axhline(0, color=BLACK, linewidth=0.8)
        known.set_xticks(range(6), PARTS)
        turns.set(title="2 drift in one turn, by axis, ″")
        turns.set_xlim(-0.6, 5.6)
        turns.axhline(0, color=BLACK, linewidth=0.8)
        turns.set_xticks(range(6), AXIS_NAMES)
        aligned.set(title="3 heading error after alignment, ′")
        aligned.set(xlabel="heading, °", xlim=(-180, 180))
        aligned.set_xticks(range(-180, 181, 60))
        under_way.set(title="4 heading error under way, °")
        under_way.set(xlabel="time, min", xlim=(0, DURATION / minute))
        labels = ("true", "by turns", "by the filter")
        self.known = [self._stems(known, i, label) for i, label in enumerate(labels)]
        self.turns = [self._stems(turns, i, stage) for i, stage in enumerate(STAGES)]
        self.aligned = [self.line(aligned, **SERIES[i]) for i in range(3)]
        self.under_way = [
            self.line(under_way, **SERIES[i], label=stage) for i, stage in enumerate(STAGES)
        ]
        legend_above(known, 3)
        self.figure.legend(handles=self.under_way, loc="lower center", ncols=3, frameon=False)

    def _stems(self, panel: Axes, number: int, label: str) -> Line2D:
        """Six stems with a marker, as one line that is broken between them."""
        style = {"color": SERIES[number]["color"], "marker": "os^"[number], "markersize": 5.5}
        line = self.line(panel, **style, linewidth=2.0, markevery=(1, 3), label=label)
        line.set_xdata(np.repeat(np.arange(6) + 0.22 * (number - 1), 3))
        return line

    def update(self, data: Capstone) -> None:
        for lines, rows in ((self.known, data.known), (self.turns, data.per_turn)):
            for line, row in zip(lines, rows, strict=True):
                foot, gap = np.zeros(6), np.full(6, np.nan)
                line.set_ydata(np.stack([foot, row / arcsecond, gap], axis=-1).ravel())
        for panel, rows in zip(self.stem_panels, (data.known, data.per_turn), strict=True):
            self.set_reach(panel, "y", 1.1 * rows / arcsecond, SECONDS)
        aligned, under_way = self.heading_panels
        self.set_reach(aligned, "y", 60 * np.degrees(data.aligned), MINUTES)
        errors = np.degrees(data.under_way.heading_error)
        self.set_reach(under_way, "y", errors, DEGREES)
        for line, row in zip(self.aligned, data.aligned, strict=True):
            line.set_data(np.degrees(data.headings), 60 * np.degrees(row))
        for line, error in zip(self.under_way, errors, strict=True):
            line.set_data(data.under_way.times / minute, error)
