"""The block of the book's first puzzle, moving by itself where no script runs."""

from dataclasses import replace

from matplotlib.figure import Figure

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.sheet import SCREEN, Sheet
from driftlab.book.machinery.scene.stage import Stage
from driftlab.book.machinery.scene.still_figure import still_figure
from driftlab.book.machinery.scene.svg import animation
from driftlab.checks import FloatArray

from ..scenes import SAMPLES, TurningBlockView

SHOWN = 2
"""Turns that are played."""
FRAMES = 24 * SHOWN + 1
"""Drawn moments; between two of them the page draws straight lines."""
ON_PAPER = (0, SAMPLES // 2, SAMPLES, SHOWN * SAMPLES)
"""Moments that stand beside each other on paper."""


def stage(data: DataTable) -> Stage:
    """The first turns of the block, without curves and numbers: they would answer the puzzle."""
    whole = TurningBlockView().stage(data)
    moments = slice(SHOWN * SAMPLES + 1)
    (view,) = whole.views
    return replace(
        whole,
        times=whole.times[moments],
        tracks={name: track[moments] for name, track in whole.tracks.items()},
        views=(replace(view, title="the block, and the ghost in its computer"),),
        seconds=8.0,
        plots=(),
        readouts=(),
    )


def draw(data: DataTable, sheet: Sheet = SCREEN) -> str | Figure:
    """Animated SVG of the block and its ghost; on paper, four moments."""
    if sheet.on_paper:
        return still_figure(stage(data), sheet, ON_PAPER)
    return animation(stage(data), FRAMES)


def columns(data: DataTable) -> dict[str, FloatArray]:
    """Columns of the figure's CSV: the error about the axis and perpendicular to it."""
    moments = slice(0, SHOWN * SAMPLES + 1, SAMPLES // 24)
    return {
        "turns": data.turns[moments],
        "along_rad": data.along[moments],
        "perpendicular_rad": data.across[moments],
    }
