"""What a figure shows, read off Matplotlib's artists: curves, points, bars, contours, levels.

Nothing is left out by its kind: what cannot be read is `Unread`, and the figure's table is refused.
What only guides the eye has the label `GUIDE`, and words are words. Panels without axes are
drawings: there are no units in which their lines could be compared.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.collections import Collection, LineCollection, PathCollection, PolyCollection
from matplotlib.container import BarContainer
from matplotlib.contour import ContourSet
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.lines import AxLine, Line2D
from matplotlib.patches import Polygon, Rectangle
from matplotlib.quiver import Barbs, Quiver
from matplotlib.spines import Spine
from matplotlib.text import Annotation, Text
from matplotlib.ticker import FixedLocator
from matplotlib.transforms import Transform

from driftlab.checks import FloatArray

from .picture import GUIDE


class Curve(NamedTuple):
    """One curve, row of points or row of bars; or one value, a line through a whole panel."""

    panel: int  # counted from 1, in the order of `panels`
    name: str  # its label; empty if it has none
    # (n,), in the units of the axes; empty along an axis that counts words, or that it runs along
    x: FloatArray
    y: FloatArray  # (n,), likewise


class Field(NamedTuple):
    """Values z (n,) over a plane, drawn as contours, row after row of the grid x (n,), y (n,)."""

    panel: int
    x: FloatArray
    y: FloatArray
    z: FloatArray


class Unread(NamedTuple):
    """What is drawn and cannot be read, in words; its panel is 0 if it stands on none."""

    panel: int
    what: str


_Points = tuple[FloatArray, FloatArray]


def panels(figure: Figure) -> list[Axes]:
    """Return all panels of a figure with their insets, but for the scales of colours."""
    return [panel for axes in figure.axes for panel in _with_insets(axes)]


def _with_insets(axes: Axes) -> Iterator[Axes]:
    if not axes.get_visible() or hasattr(axes, "_colorbar"):
        return
    yield axes
    for inset in axes.child_axes:
        if isinstance(inset, Axes):  # a second scale is none
            yield from _with_insets(inset)


def nature(axes: Axes) -> str:
    """Return why nothing of a panel is compared with the table; nothing for any other."""
    if not axes.axison:
        return "a drawing, without axes"
    if counts_words(axes.xaxis) and counts_words(axes.yaxis):
        return "words both ways"
    return ""


def shown(figure: Figure) -> Iterator[Curve | Field | Unread]:
    """Return what a figure shows, panel by panel."""
    for artist in (*figure.lines, *figure.patches, *figure.images, *figure.artists):
        if artist.get_label() != GUIDE:
            yield Unread(0, f"a {type(artist).__name__} on no panel")
    for number, axes in enumerate(panels(figure), 1):
        if axes.name != "rectilinear":
            yield Unread(number, f"{axes.name} axes")
        elif axes.axison:
            yield from _shown(number, axes)


def curves(figure: Figure) -> list[Curve]:
    """Return what a figure shows as curves, points, bars and their ends, and as single values."""
    return [each for each in shown(figure) if isinstance(each, Curve)]


def fields(figure: Figure) -> list[Field]:
    """Return what a figure shows as contours, filled by `picture.filled_contours`."""
    return [each for each in shown(figure) if isinstance(each, Field)]


def _shown(number: int, axes: Axes) -> Iterator[Curve | Field | Unread]:
    words = "".join(axis.axis_name for axis in (axes.xaxis, axes.yaxis) if counts_words(axis))
    names = {id(part): each.get_label() for each in axes.containers for part in each.get_children()}
    bars = [each for each in axes.containers if isinstance(each, BarContainer)]
    rows = {id(bar) for row in bars for bar in row.patches}
    bands: dict[tuple[str, str], list[list[_Points]]] = {}
    artists: list[Artist | BarContainer] = [*bars, *axes.get_children()]
    for artist in artists:
        name = str(names.get(id(artist), artist.get_label()) or "")
        if id(artist) in rows or _is_left_out(artist, axes, name):
            continue
        if isinstance(artist, ContourSet):
            yield _field(number, artist)
            continue
        along, parts = _parts(artist, axes)
        if parts is None:
            yield Unread(
                number, f"a {type(artist).__name__}{f' {name!r}' if name[:1] != '_' else ''}"
            )
        elif isinstance(artist, Rectangle | Polygon):  # the latter before Matplotlib 3.9
            bands.setdefault((name, along), []).append(parts)
        else:
            yield from _curves(number, name, parts, words, along)
    for (name, along), several in bands.items():  # their begins are a row, and their ends
        begins, ends = (np.concatenate([band[i] for band in several], axis=1) for i in (0, 1))
        yield from _curves(number, name, [(begins[0], begins[1]), (ends[0], ends[1])], words, along)


def _curves(
    number: int, name: str, parts: list[_Points], words: str, along: str
) -> Iterator[Curve]:
    for x, y in parts:
        points = _without(x, y, words, along)
        if points is not None:
            yield Curve(number, "" if name.startswith("_") else name, *points)


def _is_left_out(artist: Artist | BarContainer, axes: Axes, name: str) -> bool:
    """Whether an artist is a panel's furniture, words, hidden, or a guide to the eye."""
    if isinstance(artist, BarContainer):
        return name == GUIDE
    if isinstance(artist, Text):  # an arrow without words points at something that must be known
        pure = isinstance(artist, Annotation) and artist.arrow_patch and not artist.get_text()
        return not pure or name == GUIDE
    furniture = artist is axes.patch or isinstance(artist, Axis | Spine | Legend | Axes)
    # Filled contours are never a guide: they are the field itself.
    guide = name == GUIDE and not (isinstance(artist, ContourSet) and artist.filled)
    return furniture or guide or not artist.get_visible()


def _field(number: int, contours: ContourSet) -> Field | Unread:
    values = getattr(contours, "driftlab_values", None)
    if values is None:
        return Unread(number, "contours that filled_contours has not drawn")
    x, y, z = values
    return Field(number, *(each.ravel() for each in (*np.meshgrid(x, y), z)))


def _parts(artist: Artist | BarContainer, axes: Axes) -> tuple[str, list[_Points] | None]:
    """Return which coordinates of an artist are data, and its points; None if it is not read."""
    if isinstance(artist, BarContainer):
        return "xy", _bars(artist)
    coloured = isinstance(artist, Collection) and artist.get_array() is not None
    if coloured or isinstance(artist, Quiver | Barbs):
        return "", None  # its colours, or its arrows, are numbers too
    transform = artist.get_transform()
    points: list[_Points] | None = None
    if isinstance(artist, Line2D) and not isinstance(artist, AxLine):
        x, y = np.broadcast_arrays(*(np.asarray(v, float) for v in artist.get_data(orig=False)))
        points = [(x, y)]
    elif isinstance(artist, PathCollection):  # scattered points
        transform = artist.get_offset_transform()
        places: FloatArray = np.ma.filled(np.ma.asarray(artist.get_offsets(), float), np.nan)
        points = [(places[:, 0], places[:, 1])]
    elif isinstance(artist, LineCollection):
        points = _segments(artist)
    elif isinstance(artist, PolyCollection):
        points = _edges(artist)
    elif isinstance(artist, Rectangle | Polygon):  # axhspan, axvspan; any other has no row
        transform = Artist.get_transform(artist)
        corners = artist.get_patch_transform().transform(artist.get_path().vertices)
        upright = len(corners) == 5 and all(len(set(column)) <= 2 for column in corners.T)
        if transform is not axes.transData and upright:
            points = [(x, y) for x, y in corners[:3:2, :, None]]
    along = _data_coordinates(transform, axes)
    empty = points is not None and not any(x.size for x, _ in points)  # a legend's sample
    return along, points if along or empty else None


def _data_coordinates(transform: Transform, axes: Axes) -> str:
    """Which coordinates are in the units of the axes; the other is a part of the panel."""
    if transform is axes.transData:  # equal are also others, if the axes reach from 0 to 1
        return "xy"
    for direction in "xy":
        if transform is getattr(axes, f"get_{direction}axis_transform")(which="grid"):
            return direction
    return ""


def _without(x: FloatArray, y: FloatArray, words: str, along: str) -> _Points | None:
    """Points without the coordinates that are no numbers; None if none is left."""
    has_x, has_y = ("x" in along and "x" not in words), ("y" in along and "y" not in words)
    there = np.isfinite(x) if has_x else np.isfinite(y)
    x, y = (x[there] if has_x else x[:0]), (y[there] if has_y else y[:0])
    y = np.where(np.isfinite(y), y, np.nan)
    if not np.any(np.isfinite(y if has_y else x)):
        return None
    if along == "xy":
        return x, y
    # A line through the whole panel is one value.
    return tuple(v[:1] if v.size and np.ptp(v) == 0 else v for v in (x, y))  # type: ignore[return-value]


def _segments(collection: LineCollection) -> list[_Points]:
    """Error bars and sticks as the rows of their two ends, longer lines each as a curve."""
    lines = [np.asarray(line, float) for line in collection.get_segments() if len(line)]
    if lines and all(len(line) == 2 for line in lines):
        ends = np.array(lines)
        return [(ends[:, i, 0], ends[:, i, 1]) for i in range(2)]
    return [(line[:, 0], line[:, 1]) for line in lines]


def _edges(collection: PolyCollection) -> list[_Points] | None:
    """The two curves between which is filled; None for other polygons."""
    found = []
    for path in collection.get_paths():
        corners = np.asarray(path.vertices, float)
        n = (len(corners) - 3) // 2
        edges = corners[1 : n + 1], corners[n + 2 : 2 * n + 2][::-1]
        over = [i for i in range(2) if n and np.array_equal(edges[0][:, i], edges[1][:, i])]
        if len(corners) != 2 * n + 3 or not over:
            return None
        found += [tuple(_unstepped(edge, over[0]).T) for edge in edges]
    return found


def _unstepped(edge: FloatArray, i: int) -> FloatArray:
    """The points between which an edge steps, if it does; `i` is the coordinate it is over."""
    over = edge[:, i]
    if len(over) % 2 and len(over) > 1:
        before, after = over[:-2:2] == over[1::2], over[1::2] == over[2::2]
        return edge[::2] if before.all() or after.all() else edge
    if len(over) > 2 and np.array_equal(over[1:-1:2], over[2:-1:2]):  # half-way between points
        points = edge[::2].copy()
        for k, middle in enumerate(over[1:-1:2], 1):
            points[k, i] = 2 * middle - points[k - 1, i]
        return points
    return edge


def _bars(container: BarContainer) -> list[_Points]:
    bars = [bar for bar in container.patches if isinstance(bar, Rectangle)]
    corners = np.array([[b.get_x(), b.get_y(), b.get_width(), b.get_height()] for b in bars])
    x, y, width, height = corners.reshape(-1, 4).T
    if container.orientation == "horizontal":
        near, far, middle = x, x + width, y + height / 2
        ends = [(far, middle)] if not np.any(near) else [(near, middle), (far, middle)]
    else:
        near, far, middle = y, y + height, x + width / 2
        ends = [(middle, far)] if not np.any(near) else [(middle, near), (middle, far)]
    return ends


def counts_words(axis: Axis) -> bool:
    """Whether an axis has words at 0, 1, 2, ... rather than a scale."""
    locator, formatter = axis.get_major_locator(), axis.get_major_formatter()
    places = list(locator()) if isinstance(locator, FixedLocator) else []
    if not places or not np.array_equal(places, np.arange(len(places))):
        return False
    return any(not _is_number(str(word)) for word in formatter.format_ticks(places))


def _is_number(word: str) -> bool:
    try:
        float(word.replace("−", "-"))
    except ValueError:
        return False
    return True
