"""One bent triad through all four papers: drift per turn, two calibrations, and the heading."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from scipy.constants import minute

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.picture import (
    BLACK,
    GUIDE,
    SERIES,
    Picture,
    legend_above,
    legend_below_all,
)
from driftlab.book.scenarios import DURATION

from ..experiments import AXIS_NAMES, FOUND, PARTS, STAGES

STEM: dict[str, Any] = {"linewidth": 2.0}
MARKS: tuple[dict[str, Any], ...] = tuple({"marker": marker, "markersize": 5.5} for marker in "os^")
SECONDS = (20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)
MINUTES = (0.2, 0.5, 1.0, 2.0, 5.0, 15.0, 75.0, 400.0)
DEGREES = (0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 25.0, 200.0)
"""How far the axes may reach."""


class CapstonePicture(Picture):
    """What is known, what drifts, and what the heading has of it."""

    size = (9.8, 4.9)

    def build(self) -> None:
        self.figure, panels = self.sheet.mosaic(
            "ab;cd", self.size, (0.065, 0.135, 0.985, 0.95), spaces=(0.17, 0.36),
            column_height=7.4, page_height=4.4,
        )  # fmt: skip
        known, turns, aligned, under_way = panels.values()
        self.limits = (
            (known, "bend", 1.1, SECONDS), (turns, "drift", 1.1, SECONDS),
            (aligned, "aligned_error", 1.0, MINUTES), (under_way, "heading_error", 1.0, DEGREES),
        )  # fmt: skip
        for panel, title, names in (
            (known, "1 the bend, ″", [part.replace(" ", "\n") for part in PARTS]),
            (turns, "2 drift in one turn, by axis, ″", AXIS_NAMES),
        ):
            panel.set(title=title, xlim=(-0.6, 5.6))
            panel.axhline(0, color=BLACK, linewidth=0.8, label=GUIDE)
            panel.set_xticks(range(6), names)
        aligned.set(title="3 heading error after alignment, ′", xlabel="heading, °")
        aligned.set(xlim=(-180, 180))
        aligned.set_xticks(range(-180, 181, 60))
        under_way.set(title="4 heading error under way, °", xlabel="time, min")
        under_way.set_xlim(0, DURATION / minute)
        self.stems: dict[str, tuple[Line2D, list[float]]] = {}
        self.under_way = []
        for i, (found, stage, style) in enumerate(zip(FOUND, STAGES, SERIES, strict=False)):
            self._stems(known, i, f"bend, {found}", found)
            self._stems(turns, i, f"drift, {stage}", stage)
            self.curve(aligned, "headings", f"aligned_error, {stage}", **style, label=stage)
            self.under_way.append(
                self.curve(under_way, "time", f"heading_error, {stage}", **style, label=stage)
            )
        self._legends(known)

    def _legends(self, known: Axes) -> None:
        stems = [
            known.plot([], [], color=SERIES[i]["color"], **STEM, **MARKS[i], label=label)[0]
            for i, label in enumerate(FOUND)
        ]
        if self.sheet.on_paper:
            # Legends are filled column by column: a row of each on a page, a column of each here.
            handles = [*stems, *self.under_way]
            if not self.sheet.narrow:
                handles = [handles[i] for i in (0, 3, 1, 4, 2, 5)]
            legend_below_all(self.figure, self.sheet, handles, ncols=3)
        else:
            legend_above(known, 3, handles=stems)
            self.figure.legend(handles=self.under_way, loc="lower center", ncols=3, frameon=False)

    def _stems(self, panel: Axes, number: int, column: str, label: str) -> None:
        """Six markers, and stems that lead to them, as one line that is broken between them."""
        color, places = SERIES[number]["color"], [i + 0.22 * (number - 1) for i in range(6)]
        self.stems[column] = self.line(panel, color=color, **STEM, label=GUIDE), places
        marks = {"color": color, "linestyle": "none", **MARKS[number]}
        self.curve(panel, places, column, **marks, label=label)

    def update(self, table: DataTable) -> None:
        self.show(table)
        for column, (line, places) in self.stems.items():
            tip = table.shown(column)
            foot, gap, there = np.zeros(6), np.full(6, np.nan), np.isfinite(tip)
            stems = np.stack([foot, tip, gap], axis=-1)[there]
            line.set_data(np.repeat(np.array(places)[there], 3), stems.ravel())
        for panel, name, room, reaches in self.limits:
            self.set_reach(panel, "y", room * table.shown(name), reaches)
