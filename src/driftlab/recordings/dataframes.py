"""A log that is a table in memory: a DataFrame of pandas or polars, or a Dataset of xarray.

None of these libraries is needed or loaded here: a table is known by what it can do.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import FloatArray

from ._record_of_table import Columns, Time, record_of_table
from ._table_columns import TableColumns
from ._time_stamps import seconds_since_first
from .recording import Recording
from .units import is_unit


def from_dataframe(
    frame: Any,
    *,
    gyro: Columns,
    accelerometer: Columns | None = None,
    units: str | Sequence[str] | None = None,
    zeros: Sequence[float] = (0.0, 0.0),
    time: Time | None = None,
    interval: float | None = None,
    rate: float | None = None,
    longest_gap: float = 1.5,
    axes: str = "",
    latitude: float | None = None,
    gravity: float | None = None,
    name: str = "",
    source: str = "",
    licence: str = "",
    allow: Sequence[str] = (),
) -> Recording:
    """Take the log of an inertial unit from a table in memory, as `read_csv` does from a file.

    Parameters
    ----------
    frame : DataFrame, Dataset, DataArray or mapping
        Of pandas or polars; a Dataset of xarray with variables along one dimension; a DataArray
        with labelled channels along a second one; or columns by name, each an array (n,).
    gyro, accelerometer : sequence of str or int
        Three columns each, in the order of the axes: names, without units, or numbers counted
        from 1. A minus before either changes the sign.
    units, zeros : optional
        As for `read_csv`. Without `units` they must stand in the names, in brackets, or in the
        attribute ``units`` of variables of xarray.
    time : str, int or tuple, optional
        Column of time stamps, with its unit as for `read_csv`; the index, or the coordinate of
        xarray's first dimension, goes by its name or by "index". Columns of dates and times, or of
        spans of time, need no unit. If nothing is said of the time, the index is taken, provided
        that it has dates, times or spans, or says its unit.
    interval, rate : float, optional
        Between samples, s, or how many there are in a second, in place of `time`.
    longest_gap, axes, latitude, gravity, name, source, licence, allow : optional
        As for `read_csv`.

    Returns
    -------
    Recording
        In SI units, checked by the same guards.

    Raises
    ------
    ValueError
        If `frame` is no table; a cell is empty, NaN or no number; and as for `read_csv`.

    Examples
    --------
    Columns by name; a DataFrame is handed in just so:

    >>> log = {"t": [0, 10, 20], "wx (deg/s)": [90, 90, 90], "wy (deg/s)": [1, 2, 3],
    ...        "wz (deg/s)": [0, 0, 1]}
    >>> recording = from_dataframe(log, gyro=("wx", "-wy", "wz"), time=("t", "ms"))
    >>> recording.interval, recording.kind, recording.gyro[0].round(4)
    (0.01, 'rates', array([ 1.5708, -0.0175,  0.    ]))
    """
    table, index = _table_of(frame, name or "table")
    if time is None and interval is None and rate is None and index is not None:
        if not table.units[index]:
            raise ValueError(
                "time, interval, rate: expected one of them, or an index of dates, times or spans, "
                f"got none and an index of {table.values[index].dtype} without a unit."
            )
        time = table.names[index]
    return record_of_table(
        table,
        gyro=gyro,
        accelerometer=accelerometer,
        units=units,
        zeros=zeros,
        time=time,
        interval=interval,
        rate=rate,
        longest_gap=longest_gap,
        axes=axes,
        latitude=latitude,
        gravity=gravity,
        name=name,
        source=source,
        licence=licence,
        allow=allow,
    )


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
    elif hasattr(frame, "columns"):
        places = enumerate(frame.columns)
        by_place = hasattr(frame, "iloc")  # where names may stand twice
        columns = [(one, frame.iloc[:, i] if by_place else frame[one]) for i, one in places]
        index = getattr(frame, "index", None)
        label = str(getattr(index, "name", None) or label)
    elif isinstance(frame, Mapping):
        columns = list(frame.items())
    else:
        raise ValueError(
            "frame: expected a DataFrame, a Dataset, a DataArray or columns by name, "
            f"got {type(frame).__name__}."
        )
    names: list[str] = []
    units: list[str] = []
    values: list[NDArray[Any]] = []
    if index is not None and label not in (str(one) for one, _ in columns):
        columns.append((label, index))
    for one, column in columns:
        array = _values(column)
        if array.ndim != 1 or len(array) != len(values[0] if values else array):
            raise ValueError(
                f"frame: expected columns of equal length, got shape {array.shape} for {one!r}."
            )
        name = " ".join(map(str, one)) if isinstance(one, tuple) else str(one)
        said = getattr(column, "attrs", {}).get("units", "")
        unit = said if isinstance(said, str) and is_unit(said) else ""
        match = re.fullmatch(r"(.*?)\s*[(\[]([^()\[\]]*)[)\]]", name)
        if match and is_unit(match[2]):
            name, unit = match[1], match[2]
        names.append(name)
        values.append(array)
        units.append("iso" if array.dtype.kind in "mM" else unit)
    table = _FrameTable(title, tuple(names), tuple(units), len(names), tuple(values))
    return table, len(names) - 1 if index is not None and names[-1] == label else None


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
    """A column as an array; dates of a time zone as those of UTC."""
    array = np.asarray(column.to_numpy() if hasattr(column, "to_numpy") else column)
    if array.dtype == object and array.size and hasattr(array.flat[0], "tzinfo"):
        array = np.asarray(column, dtype="datetime64[ns]")
    return array
