"""A stage as an SVG picture: at one moment, or moving by itself where a page runs no script.

It draws what ``space.js`` and ``curves.js`` draw, in the same units; a test compares the two.
"""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from importlib.resources import files

import numpy as np

from driftlab.checks import FloatArray
from driftlab.core.quaternion import rotate

from ..figure.picture import project
from .spans import ticks_between
from .stage import Part, Plot, Stage, View

STYLE = (files(__package__) / "scene.css").read_text("utf-8")

VIEW = 100.0
"""Half the width of a view in its own units: its reach."""
WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 400.0, 140.0, 40.0, 100.0, 22.0, 22.0
"""Size of a plot, and what is kept free at its sides."""
VIEW_SIZE = 310
"""Width of a view on the page, in pixels."""
LINE = 20
"""Height of a line of text on the page, in pixels."""


def still(stage: Stage, moment: int = -1) -> str:
    """Return an SVG document that shows a stage at one moment, the last if not given."""
    return _document(stage, [range(len(stage.times))[moment]])


def animation(stage: Stage, frames: int = 60) -> str:
    """Return an SVG document that plays a stage again and again, through `frames` moments."""
    return _document(stage, np.linspace(0, len(stage.times) - 1, frames).round().astype(int))


def place(part: Part, stage: Stage, moment: int) -> FloatArray:
    """Corners (p, 3) of a part in space at a moment; of a trace those up to now."""
    if part.kind == "trace":
        points = part.points[: moment + 1]
    else:
        points = part.points[moment] if np.ndim(part.points) == 3 else part.points
    return rotate(stage.tracks[part.track][moment], points) if part.track else points


def flat_corners(view: View, part: Part, stage: Stage, moment: int) -> FloatArray:
    """Corners (p, 2) in the units of a view, whose ordinate points down the page."""
    corners = project(place(part, stage, moment), view.azimuth, view.elevation)
    return corners * np.array([1.0, -1.0]) * VIEW / view.reach


def from_behind(view: View, stage: Stage, moments: Sequence[int] | FloatArray) -> list[Part]:
    """Parts of a view in the order in which they are drawn: what is nearest, at these moments,
    last."""
    a, e = np.radians([view.azimuth, view.elevation])
    out = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    depths = [
        np.mean([(place(part, stage, k) @ out).mean() for k in moments]) + part.nearness
        for part in view.parts
    ]
    return [view.parts[i] for i in np.argsort(depths, kind="stable")]


def part_path(part: Part, corners: FloatArray) -> str:
    """Path of a part with flat corners (p, 2); of a dot or a label its place."""
    if part.kind == "face":
        return f"M{_places(corners)}Z"
    if part.kind == "arrow":
        return "".join(f"M{_places(line)}" for line in arrow_lines(corners))
    return f"M{_places(corners)}"


def plot_places(plot: Plot, stage: Stage, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Abscissa and ordinate (n,) of a curve in the units of a plot."""
    first, last = stage.times[0], stage.times[-1]
    x = LEFT + (WIDTH - LEFT - RIGHT) * (stage.times - first) / (last - first)
    y = TOP + (HEIGHT - TOP - BOTTOM) * (plot.high - values) / (plot.high - plot.low)
    return x, y


def _document(stage: Stage, moments: Sequence[int] | FloatArray) -> str:
    side = 430 if stage.plots or stage.readouts else 0
    tall = LINE + VIEW_SIZE
    beside = LINE * (1.5 + len(stage.readouts)) + 150 * len(stage.plots)
    width, height = len(stage.views) * (VIEW_SIZE + 8) + side, max(tall, beside)
    parts = [
        '<?xml version="1.0" encoding="utf-8"?>',
        f'<svg xmlns="http://www.w3.org/2000/svg" class="dl-scene" '
        f'viewBox="0 0 {width:g} {height:g}" width="{width:g}" height="{height:g}">',
        f"<style>{STYLE}</style>",
        f'<rect width="{width:g}" height="{height:g}" style="fill: var(--dl-paper)"/>',
    ]
    for i, view in enumerate(stage.views):
        left = i * (VIEW_SIZE + 8)
        parts += [
            f'<text x="{left + 6}" y="14" style="fill: var(--dl-ink)">{escape(view.title)}</text>',
            f'<svg x="{left}" y="{LINE}" width="{VIEW_SIZE}" height="{VIEW_SIZE}" '
            f'viewBox="{-VIEW:g} {-VIEW:g} {2 * VIEW:g} {2 * VIEW:g}">',
            *_view(view, stage, moments),
            "</svg>",
        ]
    left, down = len(stage.views) * (VIEW_SIZE + 8), 0.0
    for index, plot in enumerate(stage.plots):
        parts += [
            f'<svg class="dl-plot" x="{left}" y="{down:g}" width="{WIDTH:g}" height="{HEIGHT:g}">',
            *_plot(plot, stage, moments, f"past-{index}"),
            "</svg>",
        ]
        down += 150
    for readout in stage.readouts:
        down += LINE
        said = f"{readout.name}: {readout.said(moments[-1])}" if len(moments) == 1 else ""
        parts.append(f'<text x="{left + 44}" y="{down:g}">{escape(said)}</text>' if said else "")
    return "\n".join(filter(None, [*parts, "</svg>"])) + "\n"


def _view(view: View, stage: Stage, moments: Sequence[int] | FloatArray) -> list[str]:
    elements = []
    for part in from_behind(view, stage, moments):
        flat = [flat_corners(view, part, stage, k) for k in moments]
        name = f'class="dl-{part.kind} dl-{part.style}"'
        fill = f' style="fill: {part.fill}"' if part.fill else ""
        there = [k >= part.since for k in moments]
        if part.kind == "face":
            there = [k and faces_reader(c) for k, c in zip(there, flat, strict=True)]
        shown = ["visible" if each else "hidden" for each in there]
        appears = _animated("visibility", shown, stage.seconds)
        if shown[-1] == "hidden" or appears:
            fill += f' visibility="{shown[-1]}"'
        if part.kind in ("dot", "label"):
            x, y = ([f"{c[0, j]:.2f}" for c in flat] for j in (0, 1))
            if part.kind == "dot":
                size = f'r="{5 if part.handle else 2.5}"'
                moves = (
                    _animated("cx", x, stage.seconds) + _animated("cy", y, stage.seconds) + appears
                )
                elements.append(
                    f'<circle {name}{fill} {size} cx="{x[-1]}" cy="{y[-1]}">{moves}</circle>'
                )
            else:
                moves = (
                    _animated("x", x, stage.seconds) + _animated("y", y, stage.seconds) + appears
                )
                text = escape(part.text)
                elements.append(f'<text {name}{fill} x="{x[-1]}" y="{y[-1]}">{text}{moves}</text>')
            continue
        paths = [part_path(part, c) for c in flat]
        moves = _animated("d", paths, stage.seconds) + appears
        elements.append(f'<path {name}{fill} d="{paths[-1]}">{moves}</path>')
    return elements


def _plot(plot: Plot, stage: Stage, moments: Sequence[int] | FloatArray, clip: str) -> list[str]:
    x, _ = plot_places(plot, stage, stage.times)
    right, bottom = WIDTH - RIGHT, HEIGHT - BOTTOM
    elements = [f'<text class="dl-title" x="{LEFT:g}" y="13">{escape(plot.title)}</text>']
    for tick, text in plot.ticks:
        _, y = plot_places(plot, stage, np.full(len(x), tick))
        elements += [
            f'<path class="dl-rule" d="M{LEFT:g},{y[0]:.2f}H{right:g}"/>',
            f'<text class="dl-tick dl-end" x="{LEFT - 5:g}" y="{y[0]:.2f}">{text}</text>',
        ]
    for tick in ticks_between(stage.times[0], stage.times[-1], 6):
        at = float(np.interp(tick, stage.times, x))
        elements.append(
            f'<text class="dl-tick dl-middle" x="{at:.2f}" y="{bottom + 14:g}">{tick:g}</text>'
        )
    elements.append(
        f'<text class="dl-tick" x="{right + 8:g}" y="{bottom + 14:g}">{stage.time_unit}</text>'
    )
    cursor = x[np.asarray(moments)]
    widths = [f"{c - LEFT + 4:.2f}" for c in cursor]
    elements.append(
        f'<clipPath id="{clip}"><rect x="{LEFT - 4:g}" y="0" height="{HEIGHT:g}" '
        f'width="{widths[-1]}">{_animated("width", widths, stage.seconds)}</rect></clipPath>'
    )
    taken: list[float] = []
    for curve in plot.curves:
        _, y = plot_places(plot, stage, curve.values)
        if curve.moments is not None:
            dots = np.stack([x, y], axis=-1)[curve.moments]
            path = "".join(f"M{_places(dot[np.newaxis])}h0" for dot in dots)
        else:
            path = curve_path(x, y)
        name = f"dl-curve dl-{curve.style}" + ("" if curve.moments is None else " dl-moments")
        elements += [
            f'<path class="{name} dl-future" d="{path}"/>',
            f'<path class="{name}" d="{path}" clip-path="url(#{clip})"/>',
        ]
        known = y[np.isfinite(y)]
        if curve.name and known.size:
            at = float(np.clip(known[-1], TOP + 4, bottom))
            away = -1 if at > HEIGHT / 2 else 1  # towards the middle, where there is room
            while any(abs(other - at) < 11 for other in taken):
                at += away
            taken.append(at)
            elements.append(
                f'<text class="dl-name dl-{curve.style}" x="{right + 8:g}" y="{at:.2f}">'
                f"{escape(curve.name)}</text>"
            )
    paths = [f"M{c:.2f},{TOP:g}V{bottom:g}" for c in cursor]
    elements.append(
        f'<path class="dl-cursor" d="{paths[-1]}">{_animated("d", paths, stage.seconds)}</path>'
    )
    return elements


def curve_path(x: FloatArray, y: FloatArray) -> str:
    """Path through points (n,), with a gap wherever an ordinate is NaN."""
    path = ""
    for k in np.flatnonzero(np.isfinite(y)):
        begins = k == 0 or np.isnan(y[k - 1])
        path += f"{'M' if begins else 'L'}{x[k]:.2f},{y[k]:.2f}"
    return path


def _animated(attribute: str, values: list[str], seconds: float) -> str:
    if len(set(values)) == 1:
        return ""
    mode = ' calcMode="discrete"' if attribute == "visibility" else ""
    return (
        f'<animate attributeName="{attribute}" dur="{seconds:g}s" repeatCount="indefinite"{mode} '
        f'values="{";".join(values)}"/>'
    )


def _places(corners: FloatArray) -> str:
    return "L".join(f"{x:.2f},{y:.2f}" for x, y in corners)


def faces_reader(corners: FloatArray) -> bool:
    """Whether the outside of a face with flat corners (p, 2) is seen."""
    # Twice the area; on a page whose ordinate points down, negative if counter-clockwise.
    x, y = corners.T
    return bool(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) < 0)


def arrow_lines(corners: FloatArray) -> list[FloatArray]:
    """Shaft and head of an arrow with flat corners (2, 2), each as a line (p, 2)."""
    start, tip = corners
    along = tip - start
    length = float(np.hypot(*along))
    if length < 1:
        return [corners]
    size = min(8.0, length / 2) / length
    aside = 0.4 * np.array([along[1], -along[0]])
    barbs = [tip - size * (along + side * aside) for side in (1, -1)]
    return [corners, np.array([barbs[0], tip, barbs[1]])]
