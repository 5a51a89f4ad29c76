"""What a command has found: tables and sentences to read, plots, and the numbers themselves."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from driftlab.checks import FloatArray

Shading = tuple[float, float]
"""A stretch of the abscissa, from and to."""


@dataclass(frozen=True)
class Table:
    """Rows of words under a head; `note` is a sentence below."""

    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    note: str = ""


@dataclass(frozen=True)
class Curve:
    """A line of a plot, or its points if it has a `marker`.

    `low` and `high` bound a band; `fitted` makes `y` points, and is the line.
    """

    name: str
    x: FloatArray
    y: FloatArray
    low: FloatArray | None = None
    high: FloatArray | None = None
    fitted: FloatArray | None = None
    marker: str = ""
    dashed: bool = False


@dataclass(frozen=True)
class Plot:
    """Curves in one pair of axes, in the units that their labels name."""

    title: str
    across: str
    up: str
    curves: tuple[Curve, ...]
    shaded: tuple[Shading, ...] = ()
    logarithmic: bool = False


@dataclass(frozen=True)
class Findings:
    """What a command has found; `details` are tables which on a page come after the plots."""

    title: str
    tables: tuple[Table, ...]
    sentences: tuple[str, ...] = ()  # what the numbers say, in words
    warnings: tuple[str, ...] = ()  # what speaks against them
    plots: tuple[Plot, ...] = ()  # for the report
    details: tuple[Table, ...] = ()
    # The numbers for other programs, SI units and radians; arrays and numbers, in Mappings.
    values: Mapping[str, Any] = field(default_factory=dict)
    # Columns of equal length for a CSV, by their headings, which name the units.
    columns: Mapping[str, Any] = field(default_factory=dict)


def outline(x: FloatArray, y: FloatArray, bins: int = 500) -> tuple[FloatArray, FloatArray]:
    """Thin out a long line so that it looks the same: the least and the largest of each bin."""
    size = len(y) // bins
    if size < 4:
        return x, y
    whole = bins * size
    parts = y[:whole].reshape(bins, size)
    seen = np.stack([parts.min(axis=1), parts.max(axis=1)], axis=1).ravel()
    return np.repeat(x[:whole:size], 2), seen


def lines(x: FloatArray, rows: FloatArray, names: tuple[str, str, str]) -> tuple[Curve, ...]:
    """Three curves of the columns of `rows` (n, 3)."""
    return tuple(Curve(name, *outline(x, y)) for name, y in zip(names, rows.T, strict=True))
