"""A figure that is drawn from a table, and keeps which of its columns each curve is.

What a panel with axes shows is drawn by the methods of a `Drawing`, from columns named by their
titles. So the head of the figure's CSV can say of each panel which columns make it:

    # panel 2, "drift": x is "turns", y is "error, arcmin"
    #   "exact": x = turns, y = exact_arcmin, where axis = along
    #   "largest possible": y = most_arcmin
    # panel 3: a drawing, without axes

Axes that count words, and the other axis of a line through a whole panel, have no column. Of a
panel of words both ways, a figure's own tests say that its marks are those of the table. What only
guides the eye has the label `GUIDE`; anything else that is drawn past these methods is refused.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import wraps
from typing import Any, NamedTuple, Protocol

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.container import BarContainer, Container, ErrorbarContainer
from matplotlib.contour import QuadContourSet
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.spines import Spine
from matplotlib.text import Text
from matplotlib.ticker import FixedLocator

from driftlab.checks import FloatArray

from .data_table import DataTable
from .sheet import SCREEN, Sheet, drawn_in

GUIDE = "_guide"
"""Label of what is drawn to guide the eye: it is not in the legend, and not in the CSV."""

Place = str | Sequence[float] | FloatArray
"""A column by its title, with a minus sign before it for its mirror image; or, along an axis that
counts words, where the marks stand: numbers, or the name of a fact that holds them."""
Where = Mapping[str, str]
"""Columns of words, and the word that the rows drawn have there."""


class MissingCurves(ValueError):
    """Something is drawn that is not in the figure's table."""


class Rows(NamedTuple):
    """Which part of a table is drawn."""

    x: Place = ""
    y: Place = ""
    where: Where | None = None
    every: int | str = 1  # only each so many rows, or as many as a fact says
    value: str = ""  # of contours: the column that is drawn over the plane


class Drawn(NamedTuple):
    """What is drawn of a table, and the artist that moves with it, if one does."""

    axes: Axes
    label: str
    rows: Sequence[Rows]
    line: Line2D | None = None


class Drawing:
    """A figure of a table, on a sheet."""

    def __init__(self, table: DataTable | None, sheet: Sheet = SCREEN) -> None:
        self._table, self.sheet = table, sheet
        self.figure = Figure()
        self.drawn: list[Drawn] = []
        self._known: set[Artist] = set()  # drawn from the table

    @property
    def table(self) -> DataTable:
        """What is drawn."""
        assert self._table is not None
        return self._table

    def mosaic(self, wide: str, *arguments: Any, **settings: Any) -> dict[str, Axes]:
        """Make the figure with panels as `Sheet.mosaic` places them, and return these."""
        self.figure, panels = self.sheet.mosaic(wide, *arguments, **settings)
        return panels

    def curve(
        self,
        axes: Axes,
        x: Place,
        y: Place,
        *,
        where: Where | None = None,
        every: int | str = 1,
        method: str = "plot",
        **style: Any,
    ) -> Any:
        """Draw a column over another, and return the artist.

        `method` is that of the axes that draws it: "plot", "step", "scatter". A picture without a
        table yet gets an empty line, which `show` moves.
        """
        rows = Rows(x, y, where, every)
        points = ([], []) if self._table is None else self._values(rows)
        artist = getattr(axes, method)(*points, **style)
        (artist,) = artist if isinstance(artist, list) else (artist,)
        if self._table is None and not isinstance(artist, Line2D):
            raise ValueError(f"method: expected one that draws a line, to move it, got {method!r}.")
        return self.record(axes, artist, [rows], artist if isinstance(artist, Line2D) else None)

    def error_bars(
        self,
        axes: Axes,
        x: Place,
        y: Place,
        low: str,
        high: str,
        *,
        across: bool = False,
        where: Where | None = None,
        **style: Any,
    ) -> ErrorbarContainer:
        """Draw points with bars from one column to another, upright or across."""
        ends = [Rows(e, y, where) if across else Rows(x, e, where) for e in (low, high)]
        rows = [Rows(x, y, where), *ends]
        at, to = self._values(rows[0])
        middle, below, above = (self._values(each)[0 if across else 1] for each in rows)
        sides = [middle - below, above - middle]
        drawn = (
            axes.errorbar(at, to, xerr=sides, **style)
            if across
            else axes.errorbar(at, to, yerr=sides, **style)
        )
        return self.record(axes, drawn, rows)

    def band(
        self, axes: Axes, x: Place, low: str, high: str, *, where: Where | None = None, **style: Any
    ) -> Artist:
        """Fill between two columns over a third; ``step`` is Matplotlib's."""
        rows = [Rows(x, each, where) for each in (low, high)]
        (across, below), (_, above) = map(self._values, rows)
        return self.record(axes, axes.fill_between(across, below, above, **style), rows)

    def bar_chart(
        self,
        axes: Axes,
        at: Place,
        length: str,
        *,
        begin: str = "",
        across: bool = False,
        where: Where | None = None,
        **style: Any,
    ) -> BarContainer:
        """Draw bars that stand, or lie, at places, from zero or another column to a column."""

        def rows_of(end: str) -> Rows:
            return Rows(end, at, where) if across else Rows(at, end, where)

        rows = [rows_of(end) for end in (begin, length) if end]
        ends = [self._values(each) for each in rows]
        places, tops = ends[-1][::-1] if across else ends[-1]
        start = (ends[0][0] if across else ends[0][1]) if begin else np.zeros(len(tops))
        style["left" if across else "bottom"] = start if begin else None
        draw = axes.barh if across else axes.bar
        return self.record(axes, draw(places, tops - start, **style), rows)

    def level(self, axes: Axes, *, x: str = "", y: str = "", **style: Any) -> Line2D:
        """Draw a line through the whole panel at the only value of a column."""
        (value,) = self._values(Rows(x, y))[0 if x else 1]
        line = axes.axvline(value, **style) if x else axes.axhline(value, **style)
        return self.record(axes, line, [Rows(x, y)])

    def spans(self, axes: Axes, begin: str, end: str, *, along: str = "x", **style: Any) -> None:
        """Shade the panel from each value of a column to that of another."""
        rows = [Rows(each, "") if along == "x" else Rows("", each) for each in (begin, end)]
        draw = axes.axvspan if along == "x" else axes.axhspan
        for first, last in zip(*(self.table.shown(each) for each in (begin, end)), strict=True):
            self._known.add(draw(first, last, **style))
        self.drawn.append(Drawn(axes, style.get("label", ""), rows))

    def distribution(self, axes: Axes, values: str, **style: Any) -> Line2D:
        """Draw the part of a column's values that are at most as large, as steps."""
        x = np.sort(np.asarray(self.table.shown(values))[np.isfinite(self.table.shown(values))])
        line, *_ = axes.step(x, np.arange(1, len(x) + 1) / len(x), where="post", **style)
        return self.record(axes, line, [Rows(values, "rank / number")])

    def contours(self, axes: Axes, x: str, y: str, z: str, **style: Any) -> QuadContourSet:
        """Fill the plane by a column over two others, which hold the nodes of a grid row by row."""
        across, up = (np.unique(self.table.shown(each)) for each in (x, y))
        values = np.reshape(self.table.shown(z), (len(up), len(across)))
        filled = axes.contourf(across, up, values, **style)
        self.drawn.append(Drawn(axes, "", [Rows(x, y, value=z)]))
        self._known.add(filled)
        return filled

    def show(self, table: DataTable) -> None:
        """Move all lines to the columns of a table."""
        self._table = table
        for each in self.drawn:
            if each.line is not None:
                each.line.set_data(*self._values(each.rows[0]))

    def _values(self, rows: Rows) -> tuple[Any, Any]:
        """Abscissa and ordinate of what is drawn; empty where there is no column."""
        x, y = (self._column(place, rows) for place in (rows.x, rows.y))
        return x, y

    def _column(self, place: Place, rows: Rows) -> Any:
        if not isinstance(place, str):
            return np.asarray(place, float)
        if not place:
            return np.empty(0)
        values = np.asarray(self.table.shown(place.removeprefix("-")), float)
        values = -values if place.startswith("-") else values
        if rows.where:
            words = [np.asarray(self.table.shown(name)) == w for name, w in rows.where.items()]
            values = values[np.all(words, axis=0)]
        return values[:: self._every(rows)]

    def _every(self, rows: Rows) -> int:
        every = int(self.table.shown(rows.every)) if isinstance(rows.every, str) else rows.every
        if every < 1:
            raise ValueError(f"every: expected at least 1, got {every}.")
        return every

    def record(self, axes: Axes, artist: Any, rows: Sequence[Rows], line: Any = None) -> Any:
        """Keep what an artist shows that was drawn from the table; for what has no method here."""
        parts = artist.get_children() if isinstance(artist, Container) else [artist]
        self._known.update(parts)
        self.drawn.append(Drawn(axes, str(artist.get_label() or ""), rows, line))
        return artist

    def header(self) -> list[str]:
        """Return lines that say which columns make which curve of which panel.

        MissingCurves is raised if something is drawn that is not in the table.
        """
        lines: list[str] = []
        self._refuse_strange("figure", self.figure)
        for number, axes in enumerate(panels(self.figure), 1):
            if axes.axison:
                self._refuse_strange(f"panel {number}{_title(axes)}", axes)
            own = [each for each in self.drawn if each.axes is axes]
            says = nature(axes) or axis_words(axes)
            lines.append(f"panel {number}{_title(axes)}: {says}".rstrip())
            if not nature(axes):
                curves = (
                    f"  {self._label(each)}: {line}" for each in own for line in self._lines(each)
                )
                lines += dict.fromkeys(curves)  # several curves may be made of the same rows
        return lines

    def _refuse_strange(self, name: str, parent: Axes | Figure) -> None:
        """Refuse what is drawn past the table on a panel, or on the figure itself."""
        for artist in parent.get_children():
            furniture = isinstance(artist, Text | Axis | Spine | Legend | Axes)
            # A sample for the legend has no points.
            sample = isinstance(artist, Line2D) and not len(np.atleast_1d(artist.get_xdata()))
            left_out = furniture or sample or artist is parent.patch or not artist.get_visible()
            if not left_out and artist not in self._known and artist.get_label() != GUIDE:
                label = str(artist.get_label())
                named = "" if label.startswith("_") else f" {label!r}"  # Matplotlib's own: _child2
                raise MissingCurves(
                    f"{name}: expected all curves drawn from the table, got "
                    f"a {type(artist).__name__}{named} that is not. Draw it by a method of "
                    "Drawing, or give it label=GUIDE if it only guides the eye."
                )

    def _check(self, drawn: Drawn) -> None:
        """Refuse a curve that is no longer what was drawn."""
        if drawn.line is not None:
            rows = drawn.rows[0]
            places = zip((rows.x, rows.y), drawn.line.get_data(), self._values(rows), strict=True)
            same = [np.array_equal(a, b, True) for place, a, b in places if isinstance(place, str)]
            if drawn.line.axes is None or not all(same):
                raise MissingCurves(f"{self._label(drawn)}: expected the columns that were drawn.")

    def _label(self, drawn: Drawn) -> str:
        if drawn.rows[0].value:
            return "contours"
        label = str(drawn.line.get_label()) if drawn.line is not None else drawn.label
        return f'"{"" if label.startswith("_") else one_line(label)}"'

    def _lines(self, drawn: Drawn) -> Iterator[str]:
        self._check(drawn)
        for rows in drawn.rows:
            parts = []
            for axis, place in (("x", rows.x), ("y", rows.y)):
                if isinstance(place, str) and not self.table.is_fact(place):
                    parts += [f"{axis} = {self._heading(place)}"] if place else []
                elif not counts_words(getattr(drawn.axes, f"{axis}axis")):
                    got = f"the fact {place}" if isinstance(place, str) else "places"
                    raise MissingCurves(
                        f"{self._label(drawn)}: expected a column along {axis}, got {got}; only an "
                        "axis that counts words (set_yticks(rows, words)) takes places."
                    )
            parts += [f"value = {self._heading(rows.value)}"] if rows.value else []
            where = rows.where or {}
            parts += [f"where {self._heading(name)} = {word}" for name, word in where.items()]
            every = self._every(rows)
            parts += [f"every {every} rows from row 0"] if every > 1 else []
            yield ", ".join(parts)

    def _heading(self, place: str) -> str:
        if place == "rank / number":
            return place
        sign = "-" if place.startswith("-") else ""
        return sign + self.table.heading(place.removeprefix("-"))


class Draws(Protocol):
    """What draws a table on a sheet, on a screen if none is named."""

    def __call__(self, table: DataTable, sheet: Sheet = SCREEN) -> Drawing: ...


def from_table(draw: Callable[[Drawing], None]) -> Draws:
    """Let a function draw in its sheet's style, which Matplotlib reads when artists are made."""

    @wraps(draw)
    def styled(table: DataTable, sheet: Sheet = SCREEN) -> Drawing:
        drawing = Drawing(table, sheet)
        with drawn_in(sheet.style):
            draw(drawing)
        FigureCanvasAgg(drawing.figure)
        return drawing

    return styled


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
    """Return why a panel has no columns along its axes; nothing for any other."""
    if not axes.axison:
        return "a drawing, without axes"
    if counts_words(axes.xaxis) and counts_words(axes.yaxis):
        return "words both ways"
    return ""


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


def axis_words(axes: Axes) -> str:
    """Return what is written along the axes of a panel."""
    words = []
    for axis in "xy":
        shared = getattr(axes, f"get_shared_{axis}_axes")().get_siblings(axes)
        labels = [getattr(each, f"get_{axis}label")() for each in (axes, *shared)]
        words += [f'{axis} is "{one_line(label)}"' for label in labels if label][:1]
    return ", ".join(words)


def _title(axes: Axes) -> str:
    title = one_line(axes.get_title("left") or axes.get_title())
    return f', "{title}"' if title else ""


def one_line(text: str) -> str:
    """Return words without line breaks."""
    return " ".join(text.split())
