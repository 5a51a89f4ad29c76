"""A log that is a table in memory, of pandas, polars, pyarrow or xarray.

None of these libraries is needed or loaded here: a table is known by what it can do.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from typing import Any

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import FloatArray

from ._table import TableColumns, record_of_table
from ._time_stamps import seconds_since_first
from ._units import is_unit, spelled
from .layout import Layout, checked_layout
from .recording import Recording


def from_dataframe(frame: Any, layout: Layout | None = None, **fields: Any) -> Recording:
    """Take the log of an inertial unit from a table in memory, as `read_csv` does from a file.

    Parameters
    ----------
    frame : DataFrame, Dataset, DataArray or mapping
        Of pandas or polars, or a Table of pyarrow; a Dataset of xarray with variables along one
        dimension; a DataArray with labelled channels along a second one; or columns by name, each
        an array (n,).
    layout : Layout, optional
        What the columns mean, if several tables share it. A number counts columns from 1, without
        the index; where columns are named by numbers, as those of pandas are unless one says
        otherwise, a number that is the name of one and counts another is refused. Units may also
        stand in the attribute ``units`` of variables of xarray. The index, or the coordinate of
        xarray's first dimension, goes by its name, or by "index" if it has none or shares it with a
        column. Dates and times, or spans of time, need no unit. If nothing is said of the time, the
        index is taken, provided that it has dates, times or spans, or says its unit.
    **fields
        The fields of a `Layout`, or those that differ from `layout`.

    Returns
    -------
    Recording
        In SI units, checked by the same guards.

    Raises
    ------
    ValueError
        If `frame` is no table, or empty; a cell is empty, masked, NaN or no number; a column's name
        says one unit and its attribute another; and as for `read_csv`.

    See Also
    --------
    static_intervals : Where the unit lay still.

    Examples
    --------
    Columns by name; a DataFrame is handed in just so:

    >>> log = {"t": [0, 10, 20], "wx (deg/s)": [90, 90, 90], "wy (deg/s)": [1, 2, 3],
    ...        "wz (deg/s)": [0, 0, 1]}
    >>> recording = from_dataframe(log, gyro=("wx", "-wy", "wz"), time=("t", "ms"))
    >>> recording.interval, recording.kind, recording.gyro[0].round(4)
    (0.01, 'rates', array([ 1.5708, -0.0175,  0.    ]))
    """
    layout = checked_layout(layout, fields)
    table, index = _table_of(frame, layout.name or "table")
    if index is not None and layout.time is layout.interval is layout.rate is None:
        if not table.units[index]:
            raise ValueError(
                "time, interval, rate: expected one of them, or an index of dates, times or spans, "
                f"got none and an index of {table.values[index].dtype} without a unit."
            )
        layout = replace(layout, time=table.names[index])
    return record_of_table(table, layout, "")


@dataclass(frozen=True, eq=False)
class _FrameTable(TableColumns):
    """Columns (n,) of a table in memory."""

    called: str
    names: tuple[str, ...]
    units: tuple[str, ...]
    width: int
    values: tuple[NDArray[Any], ...]

    @property
    def title(self) -> str:
        return self.called

    def numbers(self, columns: Sequence[int]) -> FloatArray:
        return np.stack([self._numbers_of(column) for column in columns], axis=1)

    def moments(self, column: int) -> FloatArray:
        values = self.values[column]
        if values.dtype.kind not in "mM":
            raise ValueError(
                f"{self.title}: expected dates and times in column {self.names[column]!r}, "
                f"got {values.dtype}."
            )
        if np.isnat(values).any():
            row = int(np.argmax(np.isnat(values)))
            raise ValueError(f"{self.place(row)}: expected a date and time, got none.")
        return seconds_since_first(values)

    def since_first(self, column: int, values: FloatArray) -> FloatArray:
        found = self.values[column]
        if found.dtype.kind in "iu":  # floats skip whole numbers beyond 2^53
            whole = found.astype(np.int64)
            return (whole - whole[0]).astype(float)  # right of unsigned numbers too, modulo 2^64
        if found.dtype == object and all(isinstance(cell, int | np.integer) for cell in found):
            return np.array([int(cell) - int(found[0]) for cell in found], float)
        return values - values[0]

    def place(self, row: int) -> str:
        return f"{self.title}, row {row + 1}"

    def _numbers_of(self, column: int) -> FloatArray:
        values, name = self.values[column], self.names[column]
        if values.dtype.kind not in "iufO":
            raise ValueError(
                f"{self.title}: expected numbers in column {name!r}, got {values.dtype}."
            )
        found = np.array([_number(cell) for cell in values]) if values.dtype == object else values
        found = found.astype(float)
        if not np.isfinite(found).all():
            row = int(np.argmin(np.isfinite(found)))
            got = repr(str(values[row]))
            raise ValueError(
                f"{self.place(row)}: expected a number in column {name!r}, got {got:.60}."
            )
        return found


def _number(cell: Any) -> float:
    """A cell of a column of objects; NaN if it is no number."""
    try:
        return float("nan") if isinstance(cell, str | bool) else float(cell)
    except (TypeError, ValueError):
        return float("nan")


def _table_of(frame: Any, title: str) -> tuple[_FrameTable, int | None]:
    """The columns of a frame, and which of them is its index."""
    index: Any = None
    label = "index"
    if hasattr(frame, "data_vars") or hasattr(frame, "dims"):
        columns, label = _xarray_columns(frame)
        index = frame.coords.get(label)
    elif hasattr(frame, "iloc") and hasattr(frame, "columns"):  # by place, as names may stand twice
        columns = [(one, frame.iloc[:, i]) for i, one in enumerate(frame.columns)]
        index = getattr(frame, "index", None)
        label = str(getattr(index, "name", None) or label)
    elif hasattr(frame, "column_names"):
        columns = list(zip(frame.column_names, frame.columns, strict=True))
    elif hasattr(frame, "columns"):
        columns = [(one, frame[one]) for one in frame.columns]
    elif isinstance(frame, Mapping):
        columns = list(frame.items())
    else:
        raise ValueError(
            "frame: expected a DataFrame, a Dataset, a DataArray or columns by name, "
            f"got {type(frame).__name__}."
        )
    width = len(columns)
    names: list[str] = []
    units: list[str] = []
    values: list[NDArray[Any]] = []
    for one, column in columns if index is None else [*columns, (label, index)]:
        array = _values(column)
        if array.ndim != 1 or len(array) != len(values[0] if values else array):
            raise ValueError(
                f"frame: expected columns of equal length, got shape {array.shape} for {one!r}."
            )
        name, unit = _name_and_unit(one, column)
        if len(names) == width:  # the index, by a name of its own
            name = next((each for each in (name, "index") if each not in names), "")
        names.append(name)
        values.append(array)
        units.append("iso" if array.dtype.kind in "mM" else unit)
    if not width or not len(values[0]):
        raise ValueError("frame: expected rows of numbers, got an empty table.")
    table = _FrameTable(title, tuple(names), tuple(units), width, tuple(values))
    return table, None if index is None else width


def _name_and_unit(label: Any, column: Any) -> tuple[str, str]:
    """Name of a column, and its unit if the name has it in brackets or an attribute says it."""
    name = " ".join(map(str, label)) if isinstance(label, tuple) else str(label)
    said = getattr(column, "attrs", {}).get("units", "")
    unit = said if isinstance(said, str) and is_unit(said) else ""
    match = re.fullmatch(r"(.*?)\s*[(\[]([^()\[\]]*)[)\]]", name)
    if not match or not is_unit(match[2]):
        return name, unit
    if unit and spelled(match[2]) != spelled(unit):
        raise ValueError(
            f"frame: expected one unit for each column, got {name!r} with the attribute {unit!r}."
        )
    return match[1], match[2]


def _xarray_columns(frame: Any) -> tuple[list[tuple[Any, Any]], str]:
    """Variables of a Dataset, or channels of a DataArray; and the dimension of the rows."""
    if not hasattr(frame, "data_vars"):
        if len(frame.dims) != 2:
            raise ValueError(
                "frame: expected a DataArray of rows and channels, got dimensions "
                f"{tuple(frame.dims)}."
            )
        rows, channels = frame.dims
        labels = np.asarray(frame[channels])
        return [(label.item(), frame[:, i]) for i, label in enumerate(labels)], str(rows)
    along = {variable.dims for variable in frame.data_vars.values()}
    if len(along) != 1 or len(next(iter(along))) != 1:
        raise ValueError(
            "frame: expected a Dataset whose variables have one dimension, the same for all, got "
            f"{' and '.join(map(str, sorted(along)))}; choose the variables first."
        )
    return list(frame.data_vars.items()), str(next(iter(along))[0])


def _values(column: Any) -> NDArray[Any]:
    """A column as an array; what is masked is none, and dates of a time zone are those of UTC."""
    array = column.to_numpy() if hasattr(column, "to_numpy") else column
    if np.ma.is_masked(array):
        there = array.data.astype(array.dtype if array.dtype.kind in "mM" else object)
        there[np.ma.getmaskarray(array)] = None
        array = there
    array = np.asarray(array)
    if array.dtype == object and array.size and isinstance(array.flat[0], datetime):
        if isinstance(getattr(column, "dtype", array.dtype), np.dtype):  # and of no other library
            return np.array([_in_utc(cell) for cell in array.flat])
        return np.asarray(column, dtype="datetime64[ns]")
    return array


def _in_utc(cell: Any) -> np.datetime64:
    """A date and time of Python or pandas, or none."""
    if not isinstance(cell, datetime):
        return np.datetime64("NaT")
    if cell.tzinfo is not None:
        cell = cell.astimezone(UTC).replace(tzinfo=None)
    exact = getattr(cell, "to_datetime64", None)  # where there are ns
    return exact() if exact is not None else np.datetime64(cell, "us")
