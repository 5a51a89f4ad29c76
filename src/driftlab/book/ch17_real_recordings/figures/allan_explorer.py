"""Which line is which: a simulated record, its Allan deviation, and the lines of five terms."""

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.drawing import Rows
from driftlab.book.machinery.figure.picture import BLACK, SERIES, Picture
from driftlab.checks import FloatArray
from driftlab.noise_terms import TERMS

from ..experiments.simulated_allan import TIMES

WORDS = ("quantisation", "angle random walk", "bias instability", "rate random walk", "rate ramp")
SHORT_WORDS = ("quantisation", "angle walk", "bias instability", "rate walk", "rate ramp")
"""For a column, where the long ones would reach into the points."""


class AllanPicture(Picture):
    """Points with their intervals, five lines with their names, and their sum."""

    size = (10.5, 3.9)

    def build(self) -> None:
        self.figure, panels = self.sheet.mosaic(
            "a", self.size, (0.075, 0.13, 0.985, 0.93), column_height=2.9
        )
        panel = panels["a"]
        panel.set(xscale="log", yscale="log", xlim=(TIMES[0], TIMES[-1]), ylim=(1e-4, 1e5))
        panel.set(xlabel="averaging time, s", ylabel="Allan deviation, °/h")
        panel.set_title(
            "simulated record and the lines of its noise"
            if self.sheet.narrow
            else "simulated record, its 68 % intervals, and the lines of its noise"
        )
        self.lines = [
            self.curve(panel, "line_time", f"line, {name}", color=series["color"], linewidth=1.3)
            for name, series in zip(TERMS, SERIES, strict=False)
        ]
        self.curve(panel, "line_time", "total", color=BLACK, linewidth=0.8, linestyle=":")
        ends = [Rows("time", end) for end in ("lower", "upper")]
        self.bars = self.record(panel, self.line(panel, color=BLACK, linewidth=1.1), ends)
        size = 2.5 if self.sheet.on_paper else 4
        points = {"color": BLACK, "marker": "o", "markersize": size, "linestyle": "none"}
        self.curve(panel, "time", "deviation", **points)
        style = {"fontsize": "medium", "va": "bottom", "clip_on": True}
        self.names = [
            self.words(panel, color=line.get_color(), ha="right" if i > 2 else "left", **style)
            for i, line in enumerate(self.lines)
        ]
        self.silence = self.words(panel, ha="center", va="center")
        self.silence.set_position((np.sqrt(TIMES[0] * TIMES[-1]), 3.0))

    def update(self, table: DataTable) -> None:
        self.show(table)
        nothing = not table.deviation.any()
        self.silence.set_text("no noise: all means are the same" if nothing else "")
        known = SHORT_WORDS if self.sheet.narrow else WORDS
        for name, words, line, text in zip(TERMS, known, self.lines, self.names, strict=True):
            values = table.shown(f"line, {name}")
            shown = values.any()
            line.set_visible(shown)
            text.set_text(words if shown else "")
            if shown:
                text.set_position(_free_place(values, name))
        lower, upper = table.shown("lower"), table.shown("upper")
        ends = np.stack([lower, upper, np.full_like(lower, np.nan)], axis=-1)
        self.bars.set_data(np.repeat(table.time, 3), ends.ravel())


def _free_place(values: FloatArray, name: str) -> tuple[float, float]:
    """Where a line's name stands: at its left end in the picture, or its right one if it rises."""
    inside = np.flatnonzero((values > 1e-4) & (values < 2e4))
    if not len(inside):
        return TIMES[0], 1e-6
    rises = name in TERMS[3:]
    place = inside[-2] if rises else inside[min(1, len(inside) - 1)]
    return TIMES[place], (1.6 if rises else 1.1) * values[place]
