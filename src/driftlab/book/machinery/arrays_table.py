"""Arrays of different shapes as one table, and back: what a figure restores itself from.

A row is one number: the name of its array, its index there, and its value. So whatever an
experiment returns as a tuple of arrays can be published as CSV and read again.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeVar

import numpy as np

from driftlab.checks import FloatArray

Arrays = TypeVar("Arrays", bound=tuple[Any, ...])


def to_columns(data: Any) -> dict[str, Any]:
    """Return columns ``array``, ``index``, ``value`` of a named tuple of numbers and arrays."""
    names, indices, values = [], [], []
    for name, field in data._asdict().items():
        for index, value in np.ndenumerate(np.asarray(field, float)):
            names.append(name)
            indices.append(" ".join(map(str, index)))
            values.append(float(value))
    return {"array": names, "index": indices, "value": values}


def from_columns(kind: Callable[..., Arrays]) -> Callable[[Mapping[str, Sequence[str]]], Arrays]:
    """Return the function that reads the columns of `to_columns` back into a named tuple.

    Each field becomes an array, a single number one without axes. Other, longer columns may be
    in the table: rows that name no array are passed over.
    """

    def restore(table: Mapping[str, Sequence[str]]) -> Arrays:
        cells: dict[str, dict[tuple[int, ...], float]] = {}
        for name, index, value in zip(table["array"], table["index"], table["value"], strict=True):
            if not name:
                continue
            cells.setdefault(name, {})[tuple(map(int, index.split()))] = float(value)
        return kind(**{name: _array(entries) for name, entries in cells.items()})

    return restore


def _array(entries: Mapping[tuple[int, ...], float]) -> FloatArray:
    """An array from its numbers in order; the last index tells its shape."""
    shape = tuple(k + 1 for k in max(entries))
    return np.array(list(entries.values())).reshape(shape)
