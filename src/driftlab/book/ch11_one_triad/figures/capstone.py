"""One bent triad through all four papers: drift per turn, two calibrations, and the heading."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from scipy.constants import arcsecond, minute

from driftlab.book.machinery.picture import BLACK, SERIES, Picture
from driftlab.book.scenarios import DURATION
from driftlab.checks import FloatArray

from ..experiments import AXIS_NAMES, STAGES, Capstone


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
        self.figure.subplots_adjust(0.065, 0.085, 0.985, 0.95, wspace=0.17, hspace=0.36)
        known, turns, aligned, under_way = panels.ravel()
        self.heading_panels = aligned, under_way
        known.set(title="1 the bend and what is found of it, arc seconds", ylim=(-110, 150))
        known.set_xlim(-0.6, 5.6)
        known.axhline(0, color=BLACK, linewidth=0.8)
        known.set_xticks(range(6), ["fu", "fr", "ur", "turn f", "turn u", "turn r"])
        turns.set(title="2 drift in one turn about an axis, arc seconds", ylim=(-700, 900))
        turns.set_xlim(-0.6, 5.6)
        turns.axhline(0, color=BLACK, linewidth=0.8)
        turns.set_xticks(range(6), AXIS_NAMES)
        aligned.set(title="3 heading error after alignment, arc minutes")
        aligned.set(xlabel="heading, degrees", xlim=(-180, 180))
        aligned.set_xticks(range(-180, 181, 60))
        under_way.set(title="4 heading error under way, degrees")
        under_way.set(xlabel="time, minutes", xlim=(0, DURATION / minute))
        labels = ("true", "found by turns", "found by the filter")
        self.known = [self._stems(known, i, label) for i, label in enumerate(labels)]
        self.turns = [self._stems(turns, i, stage) for i, stage in enumerate(STAGES)]
        self.aligned = [self.line(aligned, **SERIES[i]) for i in range(3)]
        self.under_way = [
            self.line(under_way, **SERIES[i], label=stage) for i, stage in enumerate(STAGES)
        ]
        known.legend(loc="upper right", ncols=3, fontsize=7.5)
        turns.legend(loc="upper right", ncols=3, fontsize=7.5)
        under_way.legend(loc="lower left", ncols=3, fontsize=7.5)

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
        aligned, under_way = self.heading_panels
        self.set_reach(aligned, "y", 60 * np.degrees(data.aligned), (3.0, 15.0, 75.0, 400.0))
        errors = np.degrees(data.under_way.heading_error)
        self.set_reach(under_way, "y", errors, (1.0, 5.0, 25.0, 200.0))
        for line, row in zip(self.aligned, data.aligned, strict=True):
            line.set_data(np.degrees(data.headings), 60 * np.degrees(row))
        for line, error in zip(self.under_way, errors, strict=True):
            line.set_data(data.under_way.times / minute, error)
