"""Anybody's log as text in columns; and the forms of the programs IMU-TK and PSINS.

NumPy's parser reads a file of numbers at once. If it stumbles, it gets the lines once more in plain
form, without decimal commas, quotes and words in other columns. If that fails too, a last look at
one line after the other finds the sentence that says which is wrong and why.
"""

from __future__ import annotations

import os
import re
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from io import BytesIO, TextIOWrapper
from itertools import chain, islice
from pathlib import Path
from typing import Any, BinaryIO, TextIO

import numpy as np

from driftlab import earth
from driftlab.checks import FloatArray, checked_path

from ._table import TableColumns, record_of_table
from ._text_form import (
    BLANK,
    COMMENTS,
    NUMBER,
    code_of,
    header,
    number_delimiter,
    plain,
    refuse_cut,
    split_cells,
)
from ._time_stamps import seconds_since_first
from .guards import _without_problems
from .layout import Layout, checked_layout
from .recording import Recording

_DATE = re.compile(r"(\d{4}-\d\d-\d\d[T ]\d\d:\d\d:\d\d(?:\.\d+)?)(Z|[-+][\d:]+)?")
_BLOCK = 1 << 16
"""Bytes or characters that are read at once."""
_WHOLE = 2.0**53
"""Beyond it floats skip whole numbers."""


def read_csv(path: str | Path, layout: Layout | None = None, **fields: Any) -> Recording:
    """Read the log of an inertial unit from a text file with columns.

    Logs in other forms (ULog, rosbag, what vendors write) come with tools that write CSV.

    Parameters
    ----------
    path : str or Path
        Numbers between commas, semicolons, tabs or blanks, with decimal points, or with decimal
        commas if the delimiter is another; lines that begin with %, # or // are comments.
    layout : Layout, optional
        What the columns mean, if several logs share it.
    **fields
        The fields of a `Layout`, or those that differ from `layout`.

    Returns
    -------
    Recording
        In SI units, with `times` since the first sample if the stamps are not equally spaced.

    Raises
    ------
    ValueError
        With the number of the line: if a cell is empty, NaN or no number, a line is too short or
        too long, or time stamps stand still or leave a gap. If a column or unit is unknown, rates
        stand beside increments, or `data_problems` has some.
    OSError
        If the file cannot be read.

    See Also
    --------
    static_intervals : Where the unit lay still.
    Recording.increments : What filters and algorithms take.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> header = "t,Gyroscope x (deg/s),Gyroscope y (deg/s),Gyroscope z (deg/s)"
    >>> with TemporaryDirectory() as folder:
    ...     log = Path(folder, "phone.csv")
    ...     _ = log.write_text(header + "\\n0,90,1,0\\n10,90,2,0\\n20,90,3,1\\n", encoding="utf-8")
    ...     columns = ("Gyroscope x", "-Gyroscope y", "Gyroscope z")
    ...     recording = read_csv(log, gyro=columns, time=("t", "ms"))
    >>> recording.interval, recording.kind, recording.gyro[0].round(4)
    (0.01, 'rates', array([ 1.5708, -0.0175,  0.    ]))
    """
    table = _read_table(checked_path(path, "path"))
    return record_of_table(table, checked_layout(layout, fields), table.path.stem)


def read_imu_tk(
    accelerometer_path: str | Path,
    gyro_path: str | Path,
    layout: Layout | None = None,
    **fields: Any,
) -> Recording:
    """Read a log in the form of IMU-TK: two files with a time stamp and three numbers in a line.

    Parameters
    ----------
    accelerometer_path, gyro_path : str or Path
        The two files. Their time stamps must be the same.
    layout : Layout, optional
        As for `read_csv`; the columns are 1, the time, 2 to 4, the gyros, and 5 to 7.
    **fields
        Fields of a `Layout`: units, if they are not ("rad/s", "m/s^2") but counts, say, as
        ("1/4778 rad/s", "1/415 m/s^2"), with their zeros, axes, gravity and so on.

    Returns
    -------
    Recording
        In SI units.

    Raises
    ------
    ValueError
        If the two have not the same stamps, or as for `read_csv`.
    OSError
        If a file cannot be read.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     acc, gyro = Path(folder, "acc.mat"), Path(folder, "gyro.mat")
    ...     _ = acc.write_text("0.00 0.1 0.2 9.7\\n0.01 0.1 0.1 9.8\\n0.02 0.2 0.1 9.9\\n")
    ...     _ = gyro.write_text("0.00 0.1 0.2 0.3\\n0.01 0.1 0.1 0.2\\n0.02 0.2 0.1 0.1\\n")
    ...     recording = read_imu_tk(acc, gyro)
    >>> recording.interval, recording.gyro[:, 2]
    (0.01, array([0.3, 0.2, 0.1]))
    """
    usual = {"gyro": (2, 3, 4), "accelerometer": (5, 6, 7), "time": (1, "s")}
    layout = checked_layout(layout, fields, units=("rad/s", "m/s^2"), **usual)
    acc_path = checked_path(accelerometer_path, "accelerometer_path")
    tables = [_read_table(path) for path in (checked_path(gyro_path, "gyro_path"), acc_path)]
    for table in tables:
        if table.width != 4:
            raise ValueError(
                f"{table.path.name}: expected a time stamp and three numbers in a line, got "
                f"{table.width} cells."
            )
    gyro, accelerometer = (table.numbers(range(4)) for table in tables)
    if len(gyro) != len(accelerometer) or (gyro[:, 0] != accelerometer[:, 0]).any():
        raise ValueError(
            f"gyro_path: expected the time stamps of {tables[1].path.name}, got others: the triads "
            "were not sampled together, and this reader resamples nothing."
        )
    both = replace(
        tables[0], names=(), units=(), width=7, rows=np.hstack([gyro, accelerometer[:, 1:]])
    )
    return record_of_table(both, layout, both.path.stem)


def read_psins(path: str | Path, *, allow: Sequence[str] = (), **known: Any) -> Recording:
    """Read a log of PSINS, which says itself what its columns mean.

    Parameters
    ----------
    path : str or Path
        A text file: comments (%); attitude in degrees and velocity; latitude and longitude in
        degrees, height, start, interval in ms, gravity; arc seconds and µg a pulse; then lines of
        six pulses.
    allow : sequence of str
        Names of `RULES` that this log may break.
    **known
        Fields of the `Recording` that the file does not tell, or not rightly: name, source,
        licence; axes, latitude, gravity.

    Returns
    -------
    Recording
        Increments in the axes right, forward, up (RFU), the toolbox's convention. The latitude is
        the header's, "maybe inaccurate" as they put it; gravity that of the ellipsoid there.

    Raises
    ------
    ValueError
        If the file is no such log, a line is no line of six numbers, or `data_problems` has some.
    OSError
        If it cannot be read.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     log = Path(folder, "ring.imu")
    ...     head = "0 0 -90 0 0 0\\n30 0 0 0 10 9.78\\n.1 .1 .1 125 125 125\\n"
    ...     _ = log.write_text(head + "1 0 2 0 0 80\\n")
    ...     recording = read_psins(log)
    >>> recording.axes, recording.interval, recording.accelerometer
    ('RFU', 0.01, array([[0.    , 0.    , 0.0978]]))
    """
    table = _read_table(checked_path(path, "path"))
    if table.width != 6:
        raise ValueError(f"{table.path.name}: expected six numbers in a line, got {table.width}.")
    rows = table.numbers(range(6))
    if len(rows) < 4:
        raise ValueError(
            f"{table.path.name}: expected three lines of header and then samples, got {len(rows)} "
            "lines."
        )
    for row, values in ((1, rows[1, 4:]), (2, rows[2])):
        if not (values > 0).all():
            raise ValueError(
                f"{table.place(row)}: expected interval, gravity and "
                f"scale above zero, got {values.min():g}."
            )
    latitude = float(earth.checked_latitude(np.radians(rows[1, 0])))
    _, _, height, _, milliseconds, one_g = rows[1].tolist()
    recording = Recording(
        np.radians(rows[2, :3] / 3600) * rows[3:, :3],
        1e-6 * one_g * rows[2, 3:] * rows[3:, 3:],
        milliseconds / 1000,
        "increments",
        axes="RFU",
        latitude=latitude,
        gravity=float(earth.gravity(latitude, height)),
        name=table.path.stem,
    )
    return _without_problems(replace(recording, **known), allow)


@dataclass(frozen=True, eq=False)
class _TextTable(TableColumns):
    """The numbers in a text file, which begin in a line counted from 1; None are blanks.

    What can be read once only has its content here, and numbers that are read already theirs.
    """

    path: Path
    content: bytes | None
    names: tuple[str, ...] = ()
    units: tuple[str, ...] = ()
    first_line: int = 1
    delimiter: str | None = None
    comment: str = "#"
    width: int = 0
    rows: FloatArray | None = None

    @property
    def title(self) -> str:
        return self.path.name

    @cached_property
    def code(self) -> str:
        """How the characters are coded, as the beginning shows."""
        with self._bytes() as file:
            return code_of(file.read(_BLOCK) + file.readline())

    def text(self) -> TextIO:
        """The open file, with one kind of line end; numbers are alike in all codes."""
        return TextIOWrapper(self._bytes(), self.code, errors="backslashreplace")

    def _bytes(self) -> BinaryIO:
        return self.path.open("rb") if self.content is None else BytesIO(self.content)

    def numbers(self, columns: Sequence[int]) -> FloatArray:
        rows = self.rows
        if rows is None and self._may_be_cut():
            refuse_cut(self.title, self._lines(), self.delimiter)
        rows = self._at_once() if rows is None else rows
        if rows is not None:
            whole = list(columns) == list(range(rows.shape[1]))
            return rows if whole else rows[:, columns]
        fault = ""
        try:
            rows = np.loadtxt(
                chain.from_iterable(self._even_blocks()),
                delimiter=self.delimiter,
                usecols=columns,
                comments=None,
                ndmin=2,
            )
        except ValueError as error:
            fault = str(error)
        if rows is None or not np.isfinite(rows).all():
            self._refuse(columns, fault)
        assert rows is not None
        return rows

    def _at_once(self, **more: Any) -> Any:
        """The whole file by NumPy's parser, or None if it is not so plain."""
        if self.content is not None:
            return None
        try:
            rows = np.loadtxt(
                self.path,
                delimiter=self.delimiter,
                comments=self.comment,
                skiprows=self.first_line - 1,
                encoding=self.code,
                ndmin=2,
                **more,
            )
        except (ValueError, DeprecationWarning):
            return None
        return rows if np.isfinite([rows.min(), rows.max()]).all() else None

    def _may_be_cut(self) -> bool:
        """Whether the last line has no end, and all others have longer last cells."""
        with self._bytes() as file:
            file.seek(max(file.seek(0, os.SEEK_END) - _BLOCK, 0))
            end = file.read().replace(b"\0", b"")  # of UTF-16
            if end.endswith((b"\n", b"\r")):
                return False
            last = self._last_cell(end.rpartition(b"\n")[2])
            file.seek(0)
            lines = islice(file, self.first_line - 1, None)
            cells = (self._last_cell(line) for line in lines if b"\n" in line)
            return all(len(cell) > len(last) for cell in cells if cell)

    def _last_cell(self, line: bytes) -> bytes:
        """The last cell of a line; none if there is a comment."""
        if any(mark.encode() in line for mark in COMMENTS):
            return b""
        cells = line.replace(b"\0", b"").strip(b" \r\n")
        return cells.rpartition((self.delimiter or " ").encode())[2]

    def _blocks(self) -> Iterator[list[str]]:
        """Lines from the first with numbers to the last, plain, some thousand at a time."""
        with self.text() as file:
            for _ in islice(file, self.first_line - 1):
                pass
            blank = ""  # at the end it is no part of the table
            while block := file.read(_BLOCK):
                text = blank + block + file.readline()
                if size := len(text.rstrip(BLANK)):
                    end = text.find("\n", size) if "\n" in text[size:] else len(text)
                    body, blank = plain(text[:end], self.delimiter), text[end + 1 :]
                    lines = body.split("\n")
                    yield [line.strip(" ") for line in lines] if " " in body else lines
                else:
                    blank = text

    def _lines(self) -> Iterator[tuple[int, str]]:
        """Each plain line that has something in it, with its number."""
        lines = chain.from_iterable(self._blocks())
        return ((i, line) for i, line in enumerate(lines, self.first_line) if line)

    def _even_blocks(self) -> Iterator[list[str]]:
        """The lines, all with as many cells as the first: NumPy looks at some columns alone."""
        mark = self.delimiter
        for lines in self._blocks():
            if mark is None:
                widths = {len(line.split()) for line in lines if line}
            else:
                widths = {line.count(mark) + 1 for line in lines if line}
            if not widths <= {self.width}:
                raise ValueError("lines of several lengths")
            yield lines

    def since_first(self, column: int, values: FloatArray) -> FloatArray:
        if np.abs(values).max() <= _WHOLE:
            return values - values[0]
        with warnings.catch_warnings():
            warnings.simplefilter("error", DeprecationWarning)  # of a point or an exponent
            whole = self._at_once(usecols=[column], dtype=np.int64)
        if whole is not None:
            return (whole[:, 0] - whole[0, 0]).astype(float)
        exact = (int(text) for text in self._texts(column))
        try:
            first = next(exact)
            return np.fromiter(chain([0], (each - first for each in exact)), float)
        except ValueError:
            return values - values[0]

    def moments(self, column: int) -> FloatArray:
        dates = (self._date(row, text) for row, text in enumerate(self._texts(column)))
        return seconds_since_first(np.fromiter(dates, "datetime64[ns]"))

    def _date(self, row: int, text: str) -> str:
        """A date and time without its zone."""
        if match := _DATE.fullmatch(text):
            return match[1]
        raise ValueError(
            f"{self.place(row)}: expected a date and time such as 2024-05-01T12:00:00.25, got "
            f"{text!r:.60}."
        )

    def place(self, row: int) -> str:
        number, _ = next(islice(self._lines(), row, None))
        return f"{self.title}, line {number}"

    def _texts(self, column: int) -> Iterator[str]:
        return (line.split(self.delimiter)[column].strip() for _, line in self._lines())

    def _refuse(self, columns: Sequence[int], fault: str) -> None:
        """Say what is wrong with the first line that something is wrong with."""
        for number, line in self._lines():
            cells = split_cells(line, self.delimiter)
            where = f"{self.title}, line {number}: expected"
            if len(cells) != self.width:
                raise ValueError(
                    f"{where} {self.width} cells as in line {self.first_line}, got {len(cells)}: "
                    f"{line!r:.60}."
                )
            for column in columns:
                if not NUMBER.fullmatch(cells[column]) or "n" in cells[column].lower():
                    name = self.names[column] if any(self.names) else ""
                    got = repr(cells[column]) if cells[column] else "an empty cell"
                    raise ValueError(
                        f"{where} a number in column {name or column + 1}, got {got:.60}."
                    )
        raise ValueError(f"{self.title}: expected lines of numbers, got one: {fault}.")


def _read_table(path: Path) -> _TextTable:
    """Find the numbers in a text file: its header, its delimiter and its decimal sign.

    Cells are separated by commas, semicolons, tabs or blanks. Decimal commas, if the delimiter
    is not a comma, become points. Lines that begin with %, # or // are comments, and so is the
    rest of a line of numbers after % or #. A file without numbers is refused.
    """
    # A pipe can be read once only; and by the end of their names NumPy unpacks files.
    whole = not path.is_file() or path.suffix in (".gz", ".bz2", ".xz")
    table = _TextTable(path, path.read_bytes() if whole else None)
    head: list[str] = []
    with table.text() as file:
        for line in (line.strip(" \n") for line in file):
            if not line.startswith(COMMENTS) and (found := number_delimiter(line)) is not None:
                break
            head.append(line)
        else:
            rows = len("\n".join(head).rstrip(BLANK).split("\n"))
            got = f"none in {rows} lines" if any(head) else "an empty file"
            raise ValueError(f"{path.name}: expected lines of numbers, got {got}.")
    delimiter = found or None
    names, units = header(head, delimiter, len(split_cells(line, delimiter)))
    return replace(
        table,
        names=names,
        units=units,
        first_line=len(head) + 1,
        delimiter=delimiter,
        comment="%" if any(line.startswith("%") for line in head) else "#",
        width=len(plain(line, delimiter).split(delimiter)),
    )
