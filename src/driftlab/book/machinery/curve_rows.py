"""Which rows and columns of a figure's table are one of its curves."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from itertools import combinations
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from driftlab.checks import FloatArray

from .drawn import Curve, Field

Words = Mapping[str, list[str]]
"""Columns of a table by name, as a CSV holds them."""
_Near = Callable[[FloatArray, FloatArray], NDArray[np.bool_]]

_MOST_KEYS = 400
"""Columns of whole numbers with more values than this do not tell curves apart."""
RANK = "rank / number"
"""Ordinate of a distribution function: the abscissa's values, sorted, over their share."""


class Rows(NamedTuple):
    """Which part of a table is a curve.

    Attributes
    ----------
    x, y : str
        Names of columns, with a minus sign before them if the curve is their mirror image; empty
        along an axis that counts words.
    where : dict
        Words or whole numbers of other columns that the rows must have.
    every, first : int
        Only each so many rows, from which on.
    """

    x: str
    y: str
    where: dict[str, str]
    every: int = 1
    first: int = 0

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


def numbers(words: list[str]) -> FloatArray | None:
    """Return a column as numbers, NaN where it has none; None if there are words in it."""
    try:
        return np.array([float(word or "nan") for word in words])
    except ValueError:
        return None


class Finder:
    """Finds curves among the columns of a table."""

    def __init__(self, table: Words) -> None:
        self._table = table
        self._numbers: dict[str, FloatArray] = {}
        keys: dict[str, NDArray[np.str_]] = {}
        for name, words in table.items():
            column = numbers(words)
            if column is not None:
                self._numbers[name] = column
            whole = column is None or bool(np.all(column == np.round(column)))
            if whole and len(set(words)) <= min(_MOST_KEYS, max(len(words) - 1, 1)):
                keys[name] = np.array(words)
        self._groups = list(_groups(keys, len(next(iter(table.values())))))

    def rows(self, curve: Curve, axes: Axes) -> Rows | None:
        """Return where a curve is, in the simplest of the ways there are."""
        near_x, near_y = _closeness(axes, "x"), _closeness(axes, "y")
        if not curve.x.size or not curve.y.size:
            return (
                self._only(curve.y, near_y, "y")
                if curve.y.size
                else self._only(curve.x, near_x, "x")
            )
        abscissae = [name for name in self._numbers if self._holds(name, curve.x, near_x)]
        ordinates = [
            (sign, name)
            for sign in (1.0, -1.0)
            for name in self._numbers
            if self._holds(name, sign * curve.y, near_y)
        ]
        pairs = [(x, sign, y) for x in abscissae for sign, y in ordinates if x != y]
        for where, chosen in self._groups:
            best = np.inf  # two curves may be the same to the eye
            for name, sign, other in pairs:
                x, y = self._numbers[name][chosen], sign * self._numbers[other][chosen]
                there = np.isfinite(x)
                thin = _thinned(x[there], y[there], curve, near_x, near_y)
                if thin:
                    off = y[there][thin[1] :: thin[0]] - curve.y
                    if (away := float(np.nansum(off**2))) < best:
                        signed = other if sign > 0 else f"-{other}"
                        best, rows = away, Rows(name, signed, where, *thin)
            if best < np.inf:
                return rows
        n = len(curve.y)
        if np.allclose(curve.y, np.arange(1, n + 1) / n):
            found = self._only(curve.x, near_x, "x", distribution=True)
            return found and found._replace(y=RANK)
        return None

    def field(self, field: Field) -> tuple[str, str, str] | None:
        """Return the columns of a field: abscissa, ordinate, value."""
        names = [
            next((n for n, column in self._numbers.items() if _same(column, values)), None)
            for values in (field.x, field.y, field.z)
        ]
        x, y, z = names
        return (x, y, z) if x and y and z else None

    def _only(
        self, values: FloatArray, near: _Near, direction: str, distribution: bool = False
    ) -> Rows | None:
        """Where one column has these values and no others, in order or, of a distribution, not."""
        columns = [name for name in self._numbers if self._holds(name, values, near)]
        for where, chosen in self._groups:
            for name in columns:
                there = self._numbers[name][chosen]
                there = there[np.isfinite(there)]
                if len(there) != len(values):
                    continue
                if near(np.sort(there) if distribution else there, values).all():
                    return Rows(*((name, "") if direction == "x" else ("", name)), where)
        return None

    def _holds(self, name: str, values: FloatArray, near: _Near) -> bool:
        """Whether a column has the first and the last of some values at all."""
        column = self._numbers[name]
        ends = values[np.isfinite(values)][[0, -1]]
        return all(near(column, np.full(len(column), end)).any() for end in ends)


def _groups(
    keys: Mapping[str, NDArray[np.str_]], count: int
) -> Iterator[tuple[dict[str, str], NDArray[np.bool_]]]:
    """All rows, then those that have one, two or three words in common."""
    yield {}, np.ones(count, bool)
    for many in (1, 2, 3):
        for names in combinations(keys, many):
            rows = np.stack([keys[name] for name in names], axis=-1)
            for words in dict.fromkeys(map(tuple, rows)):
                yield dict(zip(names, words, strict=True)), np.all(rows == words, axis=-1)


def _same(column: FloatArray, values: FloatArray) -> bool:
    """Whether a column has just these values, to the digits of a CSV."""
    there = column[np.isfinite(column)]
    least = 1e-9 * float(np.abs(values).max())
    return len(there) == len(values) and np.allclose(there, values, rtol=1e-9, atol=least)


def _thinned(
    x: FloatArray, y: FloatArray, curve: Curve, near_x: _Near, near_y: _Near
) -> tuple[int, int] | None:
    """Which rows are a curve, as (every, first); None if they are not it."""
    n = len(curve.x)
    if len(x) < n or (n == 1 and len(x) > 1):  # a single point thins nothing
        return None
    every = 1 if len(x) == n else max((len(x) - 1) // max(n - 1, 1), 1)
    for step in dict.fromkeys((every, every + 1)):
        for first in range(min(step, len(x))):
            rows = slice(first, None, step)
            if len(x[rows]) != n or not near_x(x[rows], curve.x).all():
                continue
            if near_y(y[rows], curve.y).all():
                return step, first
    return None


def _closeness(axes: Axes, direction: str) -> _Near:
    """What is the same to the eye: a two thousandth of a panel, or of a number on a log scale."""
    low, high = getattr(axes, f"get_{direction}lim")()
    linear = getattr(axes, f"get_{direction}scale")() == "linear"
    most = abs(high - low) / 2000 if linear else 0.0
    part = 1e-9 if linear else 1e-3

    def near(a: FloatArray, b: FloatArray) -> NDArray[np.bool_]:
        return np.isclose(a, b, rtol=part, atol=most, equal_nan=True)

    return near
