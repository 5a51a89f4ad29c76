"""The picture of a run: who is faster, and how time grows."""

from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from textwrap import fill

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from .contenders import IN_C
from .growth import Growth
from .measuring import Ratio, Result, Timing, ratio
from .verdicts import ahead_of

_BLUE, _VERMILLION, _GREY = "#0072B2", "#D55E00", "0.45"
_STYLES = ("o-", "s--", "^-.", "v:", "D-", "P--", "X-.")
_SHORT = {"copy of the data": "copy", IN_C: "C"}
_LETTER = 0.018
"""Width of a letter of a name, of the width of the picture."""
_MARKS = {
    "a peer that is behind: slower, or less exact": Line2D([], [], marker="o", ls="", color=_BLUE),
    "a peer that is not": Line2D([], [], marker="s", ls="", color=_VERMILLION),
    "the floor, or the same one by one": Line2D([], [], marker="|", ls="", color=_GREY),
}


def write_plot(results: list[Result], growths: list[Growth], path: Path) -> None:
    """Draw those rows that have others to compare with, and the growths."""
    compared = [each for each in results if each.others and each.row.subject != "import"]
    heights = [0.36 * len(compared) + 0.8, 3.2] if growths else [0.36 * len(compared) + 0.8]
    with matplotlib.rc_context({"svg.hashsalt": "speed", "svg.fonttype": "path", "font.size": 8}):
        figure = Figure(figsize=(9.5, sum(heights)), layout="constrained")
        panels = np.ravel(figure.subplots(len(heights), 1, height_ratios=heights))
        _ratios(panels[0], compared)
        if growths:
            _growths(panels[1], growths)
        figure.savefig(path, metadata={"Date": None})


def _ratios(axes: Axes, results: list[Result]) -> None:
    axes.axvline(1.0, color="black", linewidth=0.8)
    found = [[(each, ratio(each, result.ours)) for each in (*result.peers, *result.floor)]
             for result in results]  # fmt: skip
    ends = [end for row in found for _, each in row for end in each[1:]]
    decades = np.log10(max(ends) / min(ends)) if ends else 1.0
    for height, (result, row) in enumerate(zip(results, found, strict=True)):
        for (timing, size), above in zip(row, _levels(row, _LETTER * decades), strict=True):
            peer = timing in result.peers
            behind = peer and not ahead_of(result, timing)
            colour = (_VERMILLION if behind else _BLUE) if peer else _GREY
            marker = ("s" if behind else "o") if peer else "|"
            axes.plot([size.low, size.high], [height, height], color=colour, linewidth=1)
            axes.plot(size.median, height, marker, color=colour, markersize=4)
            axes.annotate(
                _name(timing),
                (size.median, height),
                xytext=(0, 4 if above else -4),
                textcoords="offset points",
                ha="center",
                va="bottom" if above else "top",
                fontsize=5.5,
                color=colour,
            )
    titles = [f"{each.row.subject}: {each.row.title}" for each in results]
    axes.set_yticks(range(len(results)), [fill(title, 58) for title in titles])
    axes.set_ylim(len(results) - 0.4, -0.8)
    axes.set_xscale("log")
    axes.set_xlabel("time as a multiple of ours: right of 1 we are faster")
    axes.legend(_MARKS.values(), _MARKS, loc="lower center", bbox_to_anchor=(0.4, 1.0), ncols=3)


def _name(timing: Timing) -> str:
    """A word that tells a contender from the others of its row."""
    return _SHORT.get(timing.name, timing.name.split(",")[0].split(" ")[0])


def _levels(row: list[tuple[Timing, Ratio]], letter: float) -> Iterator[bool]:
    """Whether each name stands above its mark, or below it since the last one is too near."""
    places = [np.log10(size.median) for _, size in row]
    widths = [letter * len(_name(timing)) for timing, _ in row]
    above = dict.fromkeys(range(len(row)), True)
    order = np.argsort(places)
    for last, this in pairwise(order):
        if places[this] - places[last] < (widths[this] + widths[last]) / 2:
            above[this] = not above[last]
    yield from above.values()


def _growths(axes: Axes, growths: list[Growth]) -> None:
    for style, growth in zip(_STYLES, growths, strict=False):
        axes.loglog(growth.sizes, growth.seconds, style, markersize=4, label=growth.name)
    axes.set_xlabel("increments, cases or samples")
    axes.set_ylabel("time, s")
    axes.legend(ncols=2)
