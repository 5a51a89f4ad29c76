"""A scene as a published figure: it moves by itself, and its numbers are in a CSV."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ..publish import FigureDefinition
from .stage import Stage
from .svg import animation
from .view import SceneExplorer

FRAMES = 73
"""Drawn moments; between two of them the page draws straight lines."""


def scene_figure(
    name: str, scene: type[SceneExplorer], preset: str, shows: str
) -> FigureDefinition:
    """Return the definition of a figure that plays the views of a scene again and again.

    Parameters
    ----------
    name : str
        File name without ending; begins with the chapter's number.
    scene : type of SceneExplorer
    preset : str
        What of it is played.
    shows : str
        One sentence or more; what is magnified is added to them.
    """

    def compute() -> Stage:
        explorer = scene(preset)
        view = explorer.view
        assert isinstance(view, scene.picture_class)
        return view.stage(explorer.compute(explorer.values))

    def caption(stage: Stage) -> str:
        return f"{shows} Drawn: {'; '.join(view.title for view in stage.views)}."

    return FigureDefinition(name, compute, draw, columns, caption)


def draw(stage: Stage) -> str:
    """Animated SVG of the views."""
    return animation(replace(stage, plots=(), readouts=()), FRAMES)


def columns(stage: Stage) -> dict[str, Any]:
    """Columns of the figure's CSV: the readouts that are numbers, at every drawn moment."""
    moments = np.linspace(0, len(stage.times) - 1, FRAMES).round().astype(int)
    table = {f"time, {stage.time_unit}": stage.times[moments]}
    for readout in stage.readouts:
        if not readout.words:
            unit = readout.unit.strip()
            table[f"{readout.name}, {unit}" if unit else readout.name] = readout.values[moments]
    return table
