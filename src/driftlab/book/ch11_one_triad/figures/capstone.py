"""One bent triad through all four papers: drift per turn, two calibrations, and the heading."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from scipy.constants import arcsecond, minute

from driftlab.book.machinery.picture import (
    BLACK,
    GUIDE,
    SERIES,
    Picture,
    legend_above,
    legend_below_all,
)
from driftlab.book.scenarios import DURATION
from driftlab.checks import FloatArray

from ..experiments import AXIS_NAMES, STAGES, Capstone

PARTS = ("forward-\nup", "forward-\nright", "up-\nright", "about\nforward", "about\nup",
         "about\nright")  # fmt: skip
"""Names of the pairs of axes, and of the axes that the whole triad is turned about."""
STEM: dict[str, Any] = {"linewidth": 2.0}
MARKS: tuple[dict[str, Any], ...] = tuple({"marker": marker, "markersize": 5.5} for marker in "os^")
SECONDS = (20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)
MINUTES = (0.2, 0.5, 1.0, 2.0, 5.0, 15.0, 75.0, 400.0)
DEGREES = (0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 25.0, 200.0)
"""How far the axes may reach."""


FOUND = ("true", "by turns", "by the filter")
"""How the bend is known at each of `STAGES`."""


def columns(data: Capstone) -> dict[str, FloatArray | list[str]]:
    """Columns of the figure's CSV, panel after panel; turns say nothing of the misalignment."""
    table: dict[str, FloatArray | list[str]] = {"part": [" ".join(p.split()) for p in PARTS]}
    table |= {
        f"bend_arcsec, {name}": row / arcsecond for name, row in zip(FOUND, data.known, strict=True)
    }
    table["axis"] = list(AXIS_NAMES)
    for name, values in (
        ("drift_arcsec", data.per_turn / arcsecond),
        ("heading_deg", np.degrees(data.headings)),
        ("aligned_error_arcmin", 60 * np.degrees(data.aligned)),
        ("time_min", data.under_way.times / minute),
        ("heading_error_deg", np.degrees(data.under_way.heading_error)),
    ):
        if values.ndim == 1:
            table[name] = values
        else:
            table |= {f"{name}, {s}": row for s, row in zip(STAGES, values, strict=True)}
    return table


class CapstonePicture(Picture[Capstone]):
    """What is known, what drifts, and what the heading has of it."""

    size = (9.8, 4.9)

    def build(self) -> None:
        self.figure, panels = self.sheet.mosaic(
            "ab;cd", self.size, (0.065, 0.135, 0.985, 0.95), spaces=(0.17, 0.36),
            column_height=7.4, page_height=4.4,
        )  # fmt: skip
        known, turns, aligned, under_way = panels.values()
        self.stem_panels = known, turns
        self.heading_panels = aligned, under_way
        known.set(title="1 the bend, ″")
        known.set_xlim(-0.6, 5.6)
        known.axhline(0, color=BLACK, linewidth=0.8, label=GUIDE)
        known.set_xticks(range(6), PARTS)
        turns.set(title="2 drift in one turn, by axis, ″")
        turns.set_xlim(-0.6, 5.6)
        turns.axhline(0, color=BLACK, linewidth=0.8, label=GUIDE)
        turns.set_xticks(range(6), AXIS_NAMES)
        aligned.set(title="3 heading error after alignment, ′")
        aligned.set(xlabel="heading, °", xlim=(-180, 180))
        aligned.set_xticks(range(-180, 181, 60))
        under_way.set(title="4 heading error under way, °")
        under_way.set(xlabel="time, min", xlim=(0, DURATION / minute))
        self.known = [self._stems(known, i, label) for i, label in enumerate(FOUND)]
        self.turns = [self._stems(turns, i, stage) for i, stage in enumerate(STAGES)]
        self.aligned, self.under_way = (
            [self.line(panel, **SERIES[i], label=stage) for i, stage in enumerate(STAGES)]
            for panel in (aligned, under_way)
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

    def _stems(self, panel: Axes, number: int, label: str) -> tuple[Line2D, Line2D]:
        """Six markers, and stems that lead to them, as one line that is broken between them."""
        color = SERIES[number]["color"]
        stems = self.line(panel, color=color, **STEM, label=GUIDE)
        markers = self.line(panel, color=color, linestyle="none", **MARKS[number], label=label)
        return stems, markers

    def update(self, data: Capstone) -> None:
        for artists, rows in ((self.known, data.known), (self.turns, data.per_turn)):
            for number, ((stems, markers), row) in enumerate(zip(artists, rows, strict=True)):
                there = np.flatnonzero(np.isfinite(row))
                place, tip = there + 0.22 * (number - 1), row[there] / arcsecond
                markers.set_data(place, tip)
                foot, gap = np.zeros(len(tip)), np.full(len(tip), np.nan)
                stems.set_data(np.repeat(place, 3), np.stack([foot, tip, gap], axis=-1).ravel())
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
