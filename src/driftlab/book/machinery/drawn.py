"""The curves that a figure shows, read off Matplotlib's artists.

What guides the eye is left out: lines through a whole panel (``axhline``), artists labelled
`GUIDE`, panels without axes, which are drawings, and colour bars.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.collections import Collection, LineCollection, PathCollection, PolyCollection
from matplotlib.container import BarContainer
from matplotlib.contour import ContourSet
from matplotlib.figure import Figure
from matplotlib.lines import AxLine, Line2D
from matplotlib.patches import Rectangle
from matplotlib.ticker import FixedLocator, NullLocator

from driftlab.checks import FloatArray

from .picture import GUIDE


class Curve(NamedTuple):
    """One curve, row of points or row of bars.

    Attributes
    ----------
    panel : int
        Counted from 1, in the order of the figure's axes.
    name : str
        Its label; empty if it has none.
    x, y : ndarray, shape (n,)
        In the units of the axes; empty along an axis that counts words.
    """

    panel: int
    name: str
    x: FloatArray
    y: FloatArray


class Field(NamedTuple):
    """Values over a plane, drawn as contours.

    Attributes
    ----------
    panel : int
    x, y, z : ndarray, shape (n,)
        A value at each place, row after row of the grid.
    """

    panel: int
    x: FloatArray
    y: FloatArray
    z: FloatArray


def panels(figure: Figure) -> list[Axes]:
    """Return the panels of a figure that have axes, and so show numbers."""
    return [
        axes for axes in figure.axes if axes.axison and axes.get_label() != "<colorbar>"
    ]  # fmt: skip


def fields(figure: Figure) -> list[Field]:
    """Return what a figure shows as contours, filled by `picture.filled_contours`."""
    found = []
    for number, axes in enumerate(panels(figure), 1):
        for each in axes.collections:
            if isinstance(each, ContourSet) and each.get_label() != GUIDE:
                x, y, z = each.driftlab_values  # type: ignore[attr-defined]
                places = (values.ravel() for values in (*np.meshgrid(x, y), z))
                found.append(Field(number, *places))
    return found


def curves(figure: Figure) -> list[Curve]:
    """Return what a figure shows as curves, points, bars and their ends."""
    found = []
    for number, axes in enumerate(panels(figure), 1):
        no_x, no_y = (_counts_words(axis) for axis in (axes.xaxis, axes.yaxis))
        for name, x, y in _points(axes):
            if np.any(np.isfinite(x) & np.isfinite(y)) and not (no_x and no_y):
                label = "" if name.startswith("_") else name
                found.append(Curve(number, label, x[:0] if no_x else x, y[:0] if no_y else y))
    return found


def _points(axes: Axes) -> Iterator[tuple[str, FloatArray, FloatArray]]:
    for line in axes.lines:
        if _shown(line, axes) and not isinstance(line, AxLine):
            x, y = np.broadcast_arrays(*(np.asarray(each, float) for each in line.get_data()))
            yield str(line.get_label()), x, y
    for collection in axes.collections:
        if isinstance(collection, ContourSet) or not collection.get_visible():
            continue
        if collection.get_label() != GUIDE:
            for x, y in _collected(collection, axes):
                yield str(collection.get_label()), x, y
    for container in axes.containers:
        if isinstance(container, BarContainer) and container.get_label() != GUIDE:
            yield from _bars(container)


def _shown(line: Line2D, axes: Axes) -> bool:
    data = line.get_transform() == axes.transData  # an axhline has parts of the panel in one
    counts = line.get_visible() and line.get_label() != GUIDE
    return data and counts and np.size(line.get_xdata()) > 0


def _collected(collection: Collection, axes: Axes) -> Iterator[tuple[FloatArray, FloatArray]]:
    if isinstance(collection, PathCollection):  # scattered points
        places: FloatArray = np.ma.filled(np.ma.asarray(collection.get_offsets(), float), np.nan)
        yield places[:, 0], places[:, 1]
    elif isinstance(collection, LineCollection):  # error bars, sticks: their two ends
        if collection.get_transform() == axes.transData:
            ends = np.array([segment[[0, -1]] for segment in collection.get_segments()])
            for i in range(2 if len(ends) else 0):
                yield ends[:, i, 0], ends[:, i, 1]
    elif isinstance(collection, PolyCollection):  # what is filled between two curves
        for path in collection.get_paths():
            corners = np.asarray(path.vertices, float)
            n = (len(corners) - 3) // 2
            for edge in (corners[1 : n + 1], corners[n + 2 : 2 * n + 2][::-1]):
                yield edge[:, 0], edge[:, 1]


def _bars(container: BarContainer) -> Iterator[tuple[str, FloatArray, FloatArray]]:
    bars = [bar for bar in container.patches if isinstance(bar, Rectangle)]
    corners = np.array([[b.get_x(), b.get_y(), b.get_width(), b.get_height()] for b in bars])
    x, y, width, height = corners.T
    name = str(container.get_label())
    if container.orientation == "horizontal":
        near, far, middle = x, x + width, y + height / 2
        ends = [(far, middle)] if not np.any(near) else [(near, middle), (far, middle)]
    else:
        near, far, middle = y, y + height, x + width / 2
        ends = [(middle, far)] if not np.any(near) else [(middle, near), (middle, far)]
    for x, y in ends:
        yield name, x, y


def _counts_words(axis: Axis) -> bool:
    """Whether an axis has words at 0, 1, 2, ..., or nothing, rather than a scale."""
    locator, formatter = axis.get_major_locator(), axis.get_major_formatter()
    if isinstance(locator, NullLocator):
        return True
    if not isinstance(locator, FixedLocator):
        return False
    places = list(locator())
    if not places:
        return True
    words = formatter.format_ticks(list(places))
    in_rows = np.array_equal(places, np.arange(len(places)))
    return bool(in_rows and any(not _is_number(str(word)) for word in words))


def _is_number(word: str) -> bool:
    try:
        float(word.replace("−", "-"))
    except ValueError:
        return False
    return True
