"""A stage as a figure for a paper: its views at a moment, or at several beside each other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product

import matplotlib
import numpy as np
from matplotlib.artist import Artist
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Polygon
from matplotlib.patheffects import withStroke
from matplotlib.text import Text

from driftlab.checks import FloatArray

from ..figure.sheet import Sheet, drawn_in
from .look import colour, look
from .stage import Part, Stage, View
from .svg import VIEW, arrow_lines, faces_reader, flat_corners, from_behind

POINTS = 0.75
"""Width of a line on paper for one unit of the style sheet."""
MOST, TITLE = 3.5, 0.3
"""Width of a panel at most, and room for its title, inches."""
MARGIN = 9.0
"""Around what is seen, for its names, in units of `svg.VIEW`."""


def still_figure(stage: Stage, sheet: Sheet, moments: Sequence[int]) -> Figure:
    """Return a stage on paper, in a column two panels beside each other: for each moment its views.

    If there are several moments, each says when it is.
    """
    width = sheet.width or 0.0
    shown = list(product(moments, stage.views))
    across = min(len(shown), 4) if not sheet.narrow else 1 if len(moments) == 1 else 2
    down = -(-len(shown) // across)
    half_width, half_height = np.max([_reaches(view, stage, moments) for view in stage.views], 0)
    with drawn_in(sheet.style):
        side = min(width / across, MOST if down == 1 else 2.9)
        height = down * (side * half_height / half_width + TITLE)
        figure = Figure(figsize=(width, height), layout="constrained")
        panels = figure.subplots(down, across, squeeze=False).ravel()
        for panel, (moment, view) in zip(panels, shown, strict=False):
            panel.set(xlim=(-half_width, half_width), ylim=(half_height, -half_height))
            panel.set_aspect("equal")
            panel.axis("off")
            title = view.title if len(moments) == 1 else _time(stage, moment)
            panel.set_title(title, fontsize="medium")
            for artist in artists(view, stage, moment):
                panel.add_artist(artist)
        for panel in panels[len(shown) :]:
            panel.set_visible(False)
        FigureCanvasAgg(figure)
    return figure


def _time(stage: Stage, moment: int) -> str:
    time = stage.times[moment]
    unit = stage.time_unit.removesuffix("s") if time == 1 else stage.time_unit
    return f"{time:.3g} {unit}"


def _reaches(view: View, stage: Stage, moments: Sequence[int]) -> FloatArray:
    """How far to the side and up or down a view is seen, (2,), at the most as far as its edge."""
    places = [flat_corners(view, part, stage, k) for part in view.parts for k in moments]
    return np.minimum(np.abs(np.concatenate(places)).max(axis=0) + MARGIN, VIEW)


def artists(view: View, stage: Stage, moment: int) -> Iterator[Artist]:
    """What is seen of a view at a moment, the nearest last, in the units of `svg.VIEW`."""
    for order, part in enumerate(from_behind(view, stage, [moment])):
        corners = flat_corners(view, part, stage, moment)
        if part.since > moment or (part.kind == "face" and not faces_reader(corners)):
            continue
        for artist in _drawn(part, corners):
            artist.set_zorder(2 + order)
            yield artist


def _drawn(part: Part, corners: FloatArray) -> Iterator[Artist]:
    style = look(part.kind, part.style)
    fill = colour(part.fill) if part.fill else style["fill"]
    width = POINTS * style["width"] if style["stroke"] != "none" else 0.0
    if part.kind == "label":
        yield Text(
            corners[0, 0], corners[0, 1], part.text, color=fill, fontsize="small",
            ha="center", va="center", fontweight="bold" if style["bold"] else "normal",
            path_effects=[withStroke(linewidth=1.5, foreground="white")],
        )  # fmt: skip
    elif part.kind == "dot":
        edge = style["stroke"] if width else "none"
        yield Circle(tuple(corners[0]), 2.5, facecolor=fill, edgecolor=edge, linewidth=width)
    elif part.kind == "face":
        # What has no line of its own has one of its colour, or the paper shows between the faces.
        face = matplotlib.colors.to_rgba(fill, style["alpha"])
        edge, line = (style["stroke"], width) if width else (face, 0.3 if part.fill else 0.0)
        yield Polygon(corners, facecolor=face, edgecolor=edge, linewidth=line)
    else:
        lines = arrow_lines(corners) if part.kind == "arrow" else [corners]
        dashes = tuple(POINTS * np.array(style["dashes"])) if style["dashes"] else None
        for line in lines:
            yield Line2D(
                *line.T, color=style["stroke"], linewidth=width,
                linestyle=(0, dashes) if dashes else "-", solid_capstyle="round",
            )  # fmt: skip
