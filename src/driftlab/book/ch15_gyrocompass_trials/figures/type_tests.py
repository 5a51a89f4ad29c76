"""Shares of the marine standards' limits that compasses use up: over the latitude, and as bars."""

import numpy as np

from driftlab.book.machinery.figure.drawing import Drawing, from_table
from driftlab.book.machinery.figure.picture import (
    BLACK,
    BLUE,
    GUIDE,
    SERIES,
    VERMILION,
    Picture,
    legend_below_all,
)
from driftlab.gyrocompass.type_test import TESTS, TypeTest

from ..experiments import HIGH, LOW

BEYOND = 70.0
"""Latitude, degrees, up to which A.821(19) sets its limits."""
MARKERS = "os^vDPX*"


@from_table
def draw(drawing: Drawing) -> None:
    """One plot a compass; above one a test is failed."""
    table, sheet = drawing.table, drawing.sheet
    panels = drawing.mosaic(
        "ab;cd", (10.5, 6.6), (0.07, 0.15, 0.985, 0.95), spaces=(0.06, 0.16), page_height=5.2,
        column_height=8.4, sharex=True, sharey=True,
    )  # fmt: skip
    latitudes = table.shown("latitudes")
    ends = min(-2.0, latitudes.min() - 2), max(82.0, latitudes.max() + 2)
    for panel, compass in zip(panels.values(), table.shares, strict=True):
        panel.set(title=compass, yscale="log", ylim=(LOW, HIGH), xlim=ends)
        panel.axhspan(1, HIGH, color="#f6e3da", zorder=0, label=GUIDE)
        panel.axhline(1, color=BLACK, linewidth=1.0, label=GUIDE)
        panel.axvline(BEYOND, color=BLACK, linewidth=0.6, linestyle=":", label=GUIDE)
        words = f"limits up to {BEYOND:g}°"
        panel.text(BEYOND - 1, 1.6 * LOW, words, ha="right",
                   fontsize="medium" if sheet.on_paper else 9)  # fmt: skip
        for test, style, marker in zip(TESTS, SERIES, MARKERS, strict=True):
            drawing.curve(panel, "latitude", "drawn_at", where={"compass": compass, "test": test},
                          **style, marker=marker, markersize=2.5 if sheet.on_paper else 4,
                          label=test, clip_on=False)  # fmt: skip
    for letter in "d" if sheet.narrow else "cd":
        panels[letter].set(xlabel="latitude, degrees")
    for letter in "abcd" if sheet.narrow else "ac":
        panels[letter].set(ylabel="share of the limit")
        panels[letter].yaxis.set_major_formatter("{x:g}")
    legend_below_all(drawing.figure, sheet, panels["a"], 4 if sheet.on_paper else 8)


class BarsPicture(Picture):
    """A bar for each test, against its limit."""

    size = (9.0, 3.6)

    def build(self) -> None:
        self.figure, panels = self.sheet.mosaic(
            "a", self.size, (0.16, 0.14, 0.985, 0.92), column_height=2.6, page_height=2.8
        )
        axes = panels["a"]
        axes.set(xscale="log", xlim=(LOW, HIGH), xlabel="share of the limit")
        axes.set(title="what the compass uses up of each limit")
        axes.set_yticks(range(len(TESTS)), TESTS)
        axes.set_ylim(len(TESTS) - 0.4, -0.6)
        axes.xaxis.set_major_formatter("{x:g}")
        axes.axvspan(1, HIGH, color="#f6e3da", zorder=0)
        axes.axvline(1, color=BLACK, linewidth=1.0)
        wide, size = (8, "medium") if self.sheet.on_paper else (11, 9)
        self.bars = {test: self.line(axes, linewidth=wide, solid_capstyle="butt") for test in TESTS}
        self.notes = {
            test: self.words(axes, va="center", fontsize=size, clip_on=False) for test in TESTS
        }

    def update(self, data: TypeTest) -> None:
        passed = data.passed
        for row, (test, share) in enumerate(data.shares.items()):
            end = float(np.clip(share, LOW, HIGH))
            self.bars[test].set_data([LOW, end], [row, row])
            self.bars[test].set_color(BLUE if passed[test] else VERMILION)
            # A long bar carries its word inside.
            inside = end > HIGH / 6
            self.notes[test].set_position((end * (0.93 if inside else 1.07), row))
            self.notes[test].set(ha="right" if inside else "left")
            self.notes[test].set_color("white" if inside else BLACK)
            self.notes[test].set_text("kept" if passed[test] else "failed")
