"""Which rows and columns of a figure's table are one of its curves."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from itertools import combinations, islice
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from driftlab.checks import FloatArray

from .csv_table import Words, numbers as numbers
from .drawn import Curve, Field
from .table_differences import rounding

_Group = tuple[dict[str, str], NDArray[np.intp]]

_MOST_KEYS = 400
"""Columns of whole numbers with more values than this do not tell curves apart."""
_DIGITS = 1e-9
"""How far a number of a table may be off, of its value or of its curve's size."""
_ROUNDED = 1e-5
"""How far a column that is rounded on purpose may be off at most, of the same."""
RANK = "rank / number"
"""Ordinate of a distribution function: the abscissa's values, sorted, over their share."""


class Rows(NamedTuple):
    """Which part of a table is a curve."""

    # x and y are names of columns, with a minus sign before them if the curve is their mirror
    # image; empty along an axis that counts words, and of a line through a whole panel
    x: str
    y: str
    where: dict[str, str]  # words or whole numbers of other columns that the rows must have
    every: int = 1  # only each so many rows
    first: int = 0  # from this one on

    def __str__(self) -> str:
        parts = [f"{axis} = {name}" for axis, name in (("x", self.x), ("y", self.y)) if name]
        parts += [f"where {name} = {word}" for name, word in self.where.items()]
        if self.every > 1:
            parts.append(f"every {self.every} rows from row {self.first}")
        return ", ".join(parts)

    @classmethod
    def read(cls, line: str) -> Rows:
        """Return what ``str`` of it wrote."""
        axes: dict[str, str] = {}
        where: dict[str, str] = {}
        every, first = 1, 0
        for part in re.split(r", (?=x = |y = |where |every \d)", line):
            if thinned := re.fullmatch(r"every (\d+) rows from row (\d+)", part):
                every, first = (int(number) for number in thinned.groups())
            else:
                name, word = part.removeprefix("where ").split(" = ", 1)
                (where if part.startswith("where ") else axes)[name] = word
        return cls(axes.get("x", ""), axes.get("y", ""), where, every, first)


def taken(table: Words, rows: Rows) -> tuple[FloatArray, FloatArray]:
    """Return abscissa and ordinate of a curve from its rows; empty where it has words."""
    chosen = np.ones(len(next(iter(table.values()))), bool)
    for name, word in rows.where.items():
        chosen &= np.array(table[name]) == word
    x, y = (_column(table, name)[chosen] if name else np.empty(0) for name in (rows.x, rows.y))
    if rows.y == RANK:
        x = np.sort(x[np.isfinite(x)])
        return x, np.arange(1, len(x) + 1) / len(x)
    there = np.isfinite(x if x.size else y)
    thin = slice(rows.first, None, rows.every)
    return (x[there][thin] if x.size else x), (y[there][thin] if y.size else y)


def _column(table: Words, name: str) -> FloatArray:
    if name == RANK:
        return np.ones(len(next(iter(table.values()))))
    mirrored = name.startswith("-") and name not in table
    values = numbers(table[name[1:] if mirrored else name])
    assert values is not None
    return -values if mirrored else values


class _Column(NamedTuple):
    """Numbers of a table, and how far they may be off the drawn ones because they are rounded."""

    values: FloatArray
    rounding: float

    def at(self, rows: NDArray[np.intp]) -> _Column:
        return _Column(self.values[rows], self.rounding) if self.values.size else self

    def near(self, drawn: FloatArray, log: bool) -> NDArray[np.bool_]:
        """Whether the numbers are those that are drawn, one by one."""
        most = float(np.nanmax(np.abs(drawn), initial=0.0))
        size = np.abs(drawn) if log else np.full(drawn.shape, most)
        # A rounding that a curve on its axis would show is no excuse.
        rounding = np.where(self.rounding <= _ROUNDED * size, self.rounding, 0.0)
        off = np.abs(self.values - drawn)
        same = off <= _DIGITS * size + rounding
        return same | (~np.isfinite(self.values) & np.isnan(drawn))

    def has_ends_of(self, drawn: FloatArray) -> bool:
        """Whether the first and the last of the drawn numbers are there at all."""
        size = np.nanmax(np.abs(drawn), initial=0.0)
        least = _DIGITS * size + min(self.rounding, _ROUNDED * size)
        ends = drawn[np.isfinite(drawn)][[0, -1]]
        return all(bool(np.any(np.abs(self.values - end) <= least)) for end in ends)


class Finder:
    """Finds curves among the columns of a table, no two different ones in the same rows."""

    def __init__(self, table: Words) -> None:
        self._columns: dict[str, _Column] = {}
        self._made: dict[str, Curve] = {}
        keys: dict[str, NDArray[np.str_]] = {}
        for name, words in table.items():
            values = numbers(words)
            if values is not None:
                self._columns[name] = _Column(values, rounding(words))
            whole = values is None or bool(np.all(values == np.round(values)))
            if whole and len(set(words)) <= min(_MOST_KEYS, max(len(words) - 1, 1)):
                keys[name] = np.array(words)
        self._levels = _Levels(keys, len(next(iter(table.values()))))

    def rows(self, curve: Curve, axes: Axes) -> Rows | None:
        """Return where a curve is, in the simplest of the ways there are."""
        log_x, log_y = (getattr(axes, f"get_{axis}scale")() == "log" for axis in "xy")
        across, up = self._candidates(curve.x), self._candidates(curve.y)
        if curve.x.size and curve.y.size:
            up |= self._candidates(-curve.y, mirrored=True)
        pairs = [(x, y) for x in across for y in up if x != y]
        # Any number may be found somewhere: a level has a column of nothing else.
        level = {curve.x.size, curve.y.size} == {0, 1}
        for groups in islice(self._levels, 1 if level else None):
            found = []
            for where, chosen in groups:
                for x, y in pairs:
                    if x in where or y in where:
                        continue  # it tells apart, and is no curve
                    if thin := _thinned(
                        across[x].at(chosen), up[y].at(chosen), curve, log_x, log_y
                    ):
                        found.append(Rows(x, y, where, *thin))
            if rows := self._best(found, curve):
                return rows
        return self._distribution(curve, log_x)

    def field(self, field: Field) -> tuple[str, str, str] | None:
        """Return the columns of a field: abscissa, ordinate, value."""
        names = []
        for values in (field.x, field.y, field.z):
            for name, column in self._columns.items():
                there = column.at(np.flatnonzero(np.isfinite(column.values)))
                if len(there.values) == len(values) and there.near(values, log=False).all():
                    names.append(name)
                    break
        return (names[0], names[1], names[2]) if len(names) == 3 else None

    def _candidates(self, drawn: FloatArray, mirrored: bool = False) -> dict[str, _Column]:
        """Columns that may hold a coordinate, by name; none with a name where it has no numbers."""
        if not drawn.size:
            return {"": _Column(drawn, 0.0)}
        return {
            f"-{name}" if mirrored else name: _Column(-each.values, each.rounding)
            if mirrored
            else each
            for name, each in self._columns.items()
            if each.has_ends_of(drawn)
        }

    def _best(self, found: list[Rows], curve: Curve) -> Rows | None:
        """Rows in which no other curve is, rather whole ones, named as it is, and not yet taken."""

        def order(rows: Rows) -> tuple[bool, bool, bool]:
            words = (rows.x, rows.y, *rows.where.values())
            named = any(curve.name in word for word in words)
            return rows.every > 1, not named, str(rows) in self._made

        free = [rows for rows in found if _same(self._made.get(str(rows), curve), curve)]
        rows = min(free, key=order, default=None)
        if rows is not None:
            self._made.setdefault(str(rows), curve)
        return rows

    def _distribution(self, curve: Curve, log: bool) -> Rows | None:
        """Where the sorted values of a column are the abscissa of a distribution function."""
        n = len(curve.y)
        if not n or n != len(curve.x) or not np.allclose(curve.y, np.arange(1, n + 1) / n):
            return None
        for name, column in self._candidates(curve.x).items():
            for where, chosen in (group for level in self._levels for group in level):
                values = np.sort(column.values[chosen])
                values = values[np.isfinite(values)]
                if len(values) == n and _Column(values, column.rounding).near(curve.x, log).all():
                    return self._best([Rows(name, RANK, where)], curve)
        return None


class _Levels:
    """Groups of rows: all, then those that have one, two or three words in common.

    Each level is made when it is asked for, and kept: most tables need only the first.
    """

    def __init__(self, keys: Mapping[str, NDArray[np.str_]], count: int) -> None:
        self._keys = {name: np.unique(words, return_inverse=True) for name, words in keys.items()}
        self._made: list[list[_Group]] = [[({}, np.arange(count))]]

    def __iter__(self) -> Iterator[list[_Group]]:
        for many in range(4):
            if many == len(self._made):
                self._made.append(
                    [each for c in combinations(self._keys, many) for each in self._groups(c)]
                )
            yield self._made[many]

    def _groups(self, names: tuple[str, ...]) -> Iterator[_Group]:
        codes = np.stack([self._keys[name][1].ravel() for name in names])
        found, group = np.unique(codes, axis=1, return_inverse=True)
        order = np.argsort(group.ravel(), kind="stable")
        rows = np.split(order, np.cumsum(np.bincount(group.ravel()))[:-1])
        for code, chosen in sorted(zip(found.T, rows, strict=True), key=lambda each: each[1][0]):
            words = (str(self._keys[n][0][c]) for n, c in zip(names, code, strict=True))
            yield dict(zip(names, words, strict=True)), chosen


def _same(one: Curve, other: Curve) -> bool:
    """Whether two curves have the same numbers, to the digits of a table."""
    return all(
        a.shape == b.shape and bool(_Column(a, 0.0).near(b, log=False).all())
        for a, b in ((one.x, other.x), (one.y, other.y))
    )


def _thinned(
    x: _Column, y: _Column, curve: Curve, log_x: bool, log_y: bool
) -> tuple[int, int] | None:
    """Which rows are a curve, as (every, first); None if they are not it."""
    there = np.flatnonzero(np.isfinite(x.values if curve.x.size else y.values))
    n = max(len(curve.x), len(curve.y))
    if len(there) < n or (n == 1 and len(there) > 1):  # a single point thins nothing
        return None
    both = bool(curve.x.size and curve.y.size)
    every = 1 if len(there) == n else max((len(there) - 1) // max(n - 1, 1), 1)
    for step in dict.fromkeys((every, every + 1)) if both else (1,):
        for first in range(min(step, len(there))):
            rows = there[first::step]
            if len(rows) != n or not x.at(rows).near(curve.x, log_x).all():
                continue
            if y.at(rows).near(curve.y, log_y).all():
                return step, first
    return None
