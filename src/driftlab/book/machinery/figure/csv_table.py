"""Columns of numbers and words as a CSV file, below lines that each begin with a number sign.

``pandas.read_csv(path, comment="#")`` has the columns.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from driftlab.checks import FloatArray

Words = Mapping[str, list[str]]
"""Columns of a table by name, as a CSV holds them."""


def as_words(columns: Mapping[str, Any]) -> dict[str, list[str]]:
    """Return columns as a CSV holds them: numbers to twelve digits, nothing for NaN.

    Columns may be of different lengths; the shorter have nothing below their values.
    """
    rows = max(len(column) for column in columns.values())
    return {
        name: [*map(_word, column), *[""] * (rows - len(column))]
        for name, column in columns.items()
    }


def _word(value: Any) -> str:
    if isinstance(value, str):
        return value
    return "" if value != value else f"{value:.12g}"


def numbers(words: list[str]) -> FloatArray | None:
    """Return a column as numbers, NaN where it has none; None if there are words in it."""
    try:
        return np.array([float(word or "nan") for word in words])
    except ValueError:
        return None


def write_table(path: Path, table: Words, comments: list[str]) -> None:
    """Write comments, each after a #, and the columns below them."""
    with path.open("w", encoding="utf-8", newline="") as file:
        file.writelines(f"# {line}".rstrip() + "\n" for line in comments)
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(table)
        writer.writerows(zip(*table.values(), strict=True))


def read_table(path: Path) -> tuple[list[str], dict[str, list[str]]]:
    """Return the comments and the columns, as words, of a file that `write_table` wrote."""
    lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
    count = next(i for i, line in enumerate(lines) if not line.startswith("#"))
    titles, *rows = csv.reader(lines[count:])
    columns = zip(*rows, strict=True) if rows else [()] * len(titles)
    found = {title: list(column) for title, column in zip(titles, columns, strict=True)}
    return [line[2:].rstrip("\n") for line in lines[:count]], found
