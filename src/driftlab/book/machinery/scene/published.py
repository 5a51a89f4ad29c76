"""A scene as a published figure: it moves by itself, and its numbers are in a CSV."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ..figure.publish import FigureDefinition
from ..figure.sheet import SCREEN, Sheet
from .stage import Stage
from .still_figure import still_figure
from .svg import animation
from .view import SceneView

FRAMES = 73
"""Drawn moments; between two of them the page draws straight lines."""


def scene_figure(
    name: str,
    compute: Callable[..., Any],
    view: type[SceneView],
    shows: str,
    on_paper: Callable[[Any], int],
) -> FigureDefinition:
    """Return the definition of a figure that plays the views of a scene again and again.

    `compute` is the scene's experiment, with the published values as defaults; `shows` is its
    caption, to which the magnification is added; `on_paper` returns the moment that a paper
    shows.
    """

    def draw(data: Any, sheet: Sheet = SCREEN) -> Figure | str:
        stage = view().stage(data)
        if sheet.on_paper:
            return still_figure(stage, sheet, [on_paper(data)])
        return animation(replace(stage, plots=(), readouts=()), FRAMES)

    def caption(data: Any) -> str:
        titles = (each.title for each in view().stage(data).views)
        return f"{shows} Drawn: {'; '.join(titles)}."

    def table(data: Any) -> dict[str, Any]:
        return columns(view().stage(data))

    return FigureDefinition(name, compute, draw, caption, columns=table)


def columns(stage: Stage) -> dict[str, Any]:
    """Columns of the figure's CSV: the readouts that are numbers, at every drawn moment."""
    moments = np.linspace(0, len(stage.times) - 1, FRAMES).round().astype(int)
    table = {f"time, {stage.time_unit}": stage.times[moments]}
    for readout in stage.readouts:
        if not readout.words:
            unit = readout.unit.strip()
            table[f"{readout.name}, {unit}" if unit else readout.name] = readout.values[moments]
    return table
