"""The picture of a run: who is faster, and how time grows."""

from pathlib import Path

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .growth import Growth
from .measuring import Result, ratio
from .verdicts import ahead_of

_BLUE, _VERMILLION, _GREY = "#0072B2", "#D55E00", "0.5"
_STYLES = ("o-", "s--", "^-.", "v:", "D-", "P--", "X-.")


def write_plot(results: list[Result], growths: list[Growth], path: Path) -> None:
    """Draw those rows that have others to compare with, and the growths."""
    compared = [each for each in results if each.others and each.row.subject != "import"]
    with matplotlib.rc_context({"svg.hashsalt": "speed", "svg.fonttype": "path", "font.size": 8}):
        figure = Figure(figsize=(8.5, 3.2 + 0.32 * len(compared)), layout="constrained")
        above, below = figure.subplots(2, 1, height_ratios=[0.32 * len(compared) + 0.1, 2.6])
        _ratios(above, compared)
        _growths(below, growths)
        figure.savefig(path, metadata={"Date": None})


def _ratios(axes: Axes, results: list[Result]) -> None:
    axes.axvline(1.0, color="black", linewidth=0.8)
    for height, result in enumerate(results):
        for timing in (*result.peers, *result.floor):
            found = ratio(timing, result.ours)
            peer = timing in result.peers
            behind = peer and not ahead_of(result, timing)
            colour = (_VERMILLION if behind else _BLUE) if peer else _GREY
            marker = ("s" if behind else "o") if peer else "|"
            axes.plot([found.low, found.high], [height, height], color=colour, linewidth=1)
            axes.plot(found.median, height, marker, color=colour, markersize=5)
            axes.annotate(
                timing.name.split(",")[0].split(" ")[0] if peer else timing.name.split(" ")[0],
                (found.median, height),
                xytext=(0, 4),
                textcoords="offset points",
                ha="center",
                fontsize=5.5,
                color=colour,
            )
    titles = [f"{each.row.subject}: {each.row.title}" for each in results]
    axes.set_yticks(range(len(results)), [t if len(t) < 66 else t[:64] + "…" for t in titles])
    axes.set_ylim(len(results) - 0.4, -0.8)
    axes.set_xscale("log")
    axes.set_xlabel(
        "time as a multiple of ours: right of 1 we are faster. Round: peers that are behind, "
        "square: ahead or more exact; bar: floor"
    )


def _growths(axes: Axes, growths: list[Growth]) -> None:
    for style, growth in zip(_STYLES, growths, strict=False):
        axes.loglog(growth.sizes, growth.seconds, style, markersize=4, label=growth.name)
    axes.set_xlabel("increments, cases or samples")
    axes.set_ylabel("time, s")
    if growths:
        axes.legend(ncols=2)
