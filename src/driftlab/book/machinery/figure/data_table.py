"""What an experiment returns: numbers with their names, units and meanings, each given once.

Everything else reads them from here: the picture, the CSV below it and its header, the rows beside
a panel. Inside, values are in SI units and radians; a table shows them in the unit that each
column names.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import product
from typing import Any, NamedTuple

import numpy as np
from scipy.constants import arcminute, arcsecond, degree, g, hour, micro, milli, minute

from .csv_table import numbers

UNITS: dict[str, tuple[float, str]] = {
    "": (1.0, ""),
    "1e-3": (milli, "e-3"),
    "ppm": (micro, " ppm"),
    "percent": (0.01, " %"),
    "rad": (1.0, " rad"),
    "mrad": (milli, " mrad"),
    "urad": (micro, " µrad"),
    "nrad": (1e-9, " nrad"),
    "deg": (degree, "°"),
    "arcmin": (arcminute, "′"),
    "arcsec": (arcsecond, "″"),
    "s": (1.0, " s"),
    "min": (minute, " min"),
    "h": (hour, " h"),
    "Hz": (1.0, " Hz"),
    "rad_per_s": (1.0, " rad/s"),
    "deg_per_s": (degree, " °/s"),
    "deg_per_h": (degree / hour, "°/h"),
    "deg_per_sqrt_h": (degree / hour**0.5, "°/√h"),
    "cm": (0.01, " cm"),
    "m": (1.0, " m"),
    "km": (1e3, " km"),
    "nmi": (1852.0, " nautical miles"),
    "m_per_s": (1.0, " m/s"),
    "mm_per_s": (milli, " mm/s"),
    "m_per_s2": (1.0, " m/s²"),
    "mg": (milli * g, " mg"),
    "ug": (micro * g, " µg"),
}
"""Units in which numbers are shown: their size in SI units and radians, and how a page writes them.
"""

KEPT = "read again from: "
"""How the line of a CSV begins from which, with its columns, a table is read again."""


FACT = "fact "
"""How the name of a fact begins where it is compared like a column."""


class Entry(NamedTuple):
    """One column or fact of a table."""

    # numbers in SI units and radians, or words. Several columns in one: a mapping from their names,
    # or an array whose first axes have `names`
    values: Any
    unit: str = ""  # in which it is shown, one of UNITS
    meaning: str = ""  # a phrase: what the numbers are
    names: Sequence[Any] = ()  # of the rows of `values`; for two axes, the names along each
    decimals: int | None = None  # to which a CSV rounds the numbers shown; twelve digits if not


def shown_in(values: Any, unit: str) -> Any:
    """Return values in SI units and radians as numbers of a unit; words stay what they are."""
    if unit == "deg":
        return np.degrees(values)
    size, _ = UNITS[unit]
    return values if size == 1.0 else np.asarray(values) / size


class DataTable:
    """Columns, which a CSV holds and pictures draw, and facts, which stand beside them.

    Values are attributes, in SI units and radians: ``table.heading_error``. Columns may be of
    different lengths. An entry may hold several columns, as a mapping or an array with names; their
    titles are ``"drift, picard-3"``, ``"drift, steady turn, picard-3"``. The head of a CSV lists
    those facts that are one number or words. What is wrong with a table is a TypeError: a panel
    shows a ValueError as a mistake of its reader.

    >>> table = DataTable(
    ...     {"time": (np.array([0.0, 3600.0]), "h", "since the start"),
    ...      "drift": (np.radians([[0, 1], [0, 2]]), "deg", "of each gyro", ("x", "y"))},
    ...     {"rate": (np.radians(1 / 3600), "deg_per_h", "of gyro x")},
    ... )
    >>> list(table.columns())
    ['time_h', 'drift_deg, x', 'drift_deg, y']
    >>> table.shown("drift, y").round(9), table.row("rate")
    (array([0., 2.]), ('of gyro x', '1°/h'))
    """

    def __init__(
        self,
        columns: Mapping[str, tuple[Any, ...]],
        facts: Mapping[str, tuple[Any, ...]] | None = None,
    ) -> None:
        """Take entries by name, each the arguments of an `Entry`: ``(values, unit, meaning)``."""
        facts = facts or {}
        if both := {*columns} & {*facts}:
            raise TypeError(f"columns: expected other names than the facts', got {min(both)!r}.")
        for name, each in {**columns, **facts}.items():
            if not isinstance(each, tuple):
                raise TypeError(
                    f"{name}: expected a tuple (values, unit, meaning), got {type(each).__name__}."
                )
        self._entries = {name: Entry(*each) for name, each in {**columns, **facts}.items()}
        for name, entry in self._entries.items():
            if hasattr(type(self), name):
                raise TypeError(f"{name}: expected another name; a table has a method so named.")
            if entry.unit not in UNITS:
                raise TypeError(
                    f"{name}: expected a unit of {[*UNITS]}, the second of (values, unit, "
                    f"meaning), got {entry.unit!r}."
                )
        self._facts = tuple(facts)
        single = [(n, *each) for n in columns for each in _single(n, self._entries[n])]
        self._columns: dict[str, tuple[str, Any]] = {t: (n, values) for n, t, values in single}
        if len({self.heading(title) for title in self._columns}) < len(single):
            raise TypeError(f"columns: expected other headings for each, got {[*self._columns]}.")
        for title in self._columns:
            if re.search(r'[#"\r\n]', title):
                raise TypeError(
                    f"{title}: expected a name without number sign, quotation mark or line break, "
                    "which the head of a CSV cannot hold."
                )

    def __getattr__(self, name: str) -> Any:
        entries = self.__dict__.get("_entries", {})
        if name not in entries:
            raise AttributeError(f"This table has {', '.join(entries)}, and no {name}.")
        return entries[name].values

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._entries]

    def __repr__(self) -> str:
        return "\n".join(self._meanings(self._entries))

    def entry(self, name: str) -> Entry:
        """Return a column or a fact with its unit and meaning."""
        if name not in self._entries:
            raise KeyError(f"This table has {', '.join(self._entries)}, and no {name}.")
        return self._entries[name]

    def is_fact(self, name: str) -> bool:
        """Return whether a name is that of a fact."""
        return name in self._facts

    def heading(self, title: str) -> str:
        """Return what stands above a column in a CSV: ``drift_deg_per_h, picard-3``."""
        if title not in self._columns:
            raise KeyError(f"This table has {'; '.join(self._columns)}, and no column {title}.")
        name = self._columns[title][0]
        unit = self._entries[name].unit
        kind, comma, rest = title.partition(", ")  # a column's own name may have several words
        return f"{kind}_{unit}{comma}{rest}" if unit else title

    def shown(self, title: str) -> Any:
        """Return a single column or a fact in the unit in which it is shown."""
        name, values = self._columns.get(title) or (title, self.entry(title).values)
        return shown_in(values, self._entries[name].unit)

    def columns(self) -> dict[str, Any]:
        """Return all columns in their units by their headings, as a CSV holds them."""
        found = {}
        for title, (name, _) in self._columns.items():
            decimals, values = self._entries[name].decimals, self.shown(title)
            if np.ndim(values) > 1:
                raise TypeError(
                    f"{title}: expected one column for a CSV, or several with names, got shape "
                    f"{np.shape(values)}."
                )
            # Rounding leaves no negative zero.
            rounded = values if decimals is None else np.round(values, decimals) + 0.0
            found[self.heading(title)] = rounded
        return found

    def words(self, name: str, form: str = ".3g") -> str:
        """Return a fact as words with its unit: ``"3.142′"``."""
        values = self.shown(name)
        if np.size(values) != 1 or isinstance(values, str):
            raise TypeError(f"{name}: expected one number to show in words, got {values!r}.")
        return f"{float(values):{form}}{UNITS[self.entry(name).unit][1]}"

    def row(self, name: str, form: str = ".3g") -> tuple[str, str]:
        """Return a fact's meaning and the fact in words: a row of the table beside a panel."""
        return self.entry(name).meaning, self.words(name, form)

    def notes(self) -> list[str]:
        """Return lines for the head of a CSV: what the columns mean, and the facts."""
        columns = [name for name in self._entries if name not in self._facts]
        lines = [f"  {line}" for line in self._meanings(columns)]
        lines = ["columns:", *lines] if lines else []
        for name in self._facts:
            values, unit, meaning, *_ = self._entries[name]
            if isinstance(values, str | int | float | np.number):
                value = values if isinstance(values, str) else f"{self.shown(name):.6g}"
                lines.append(f"{meaning or name}: {value}{UNITS[unit][1]}")
        return lines

    def _meanings(self, names: Iterable[str]) -> list[str]:
        """A line for each meaning; entries of one kind, ``"error, gyro x"``, may share it."""
        lines = []
        for name in names:
            kind, unit, meaning = name.split(", ")[0], *self._entries[name][1:3]
            lines.append(f"{kind}{f', {unit}' if unit else ''}: {meaning}")
        return [*dict.fromkeys(lines)]

    def as_json(self) -> str:
        """Return on one line what `of_csv` needs besides the columns of a CSV."""
        kept: dict[str, Any] = {"columns": {}, "facts": {}}
        for name, entry in self._entries.items():
            about = {"unit": entry.unit, "meaning": entry.meaning}
            if name in self._facts:
                kept["facts"][name] = {"values": _plain(entry.values), **about}
                continue
            own = {t: values for t, (of, values) in self._columns.items() if of == name}
            headings = {title: self.heading(title) for title in own}
            shape = None if isinstance(entry.values, Mapping) else _names_shape(entry.names)
            kept["columns"][name] = {"headings": headings, "shape": shape, **about}
            # What the words of a CSV do not tell.
            if ends := {t: len(v) for t, v in own.items() if len(v) and str(v[-1]) in ("", "nan")}:
                kept["columns"][name]["rows"] = ends
            if any(
                isinstance(v[0], str) and numbers(v) is not None for v in own.values() if len(v)
            ):
                kept["columns"][name]["words"] = True
        return json.dumps(kept, ensure_ascii=False)

    @classmethod
    def of_csv(cls, comments: Iterable[str], words: Mapping[str, Sequence[str]]) -> DataTable:
        """Return the table of a CSV from its comments, one of them `as_json`, and its columns."""
        (line,) = (line for line in comments if line.startswith(KEPT))
        kept = json.loads(line.removeprefix(KEPT))
        columns = {}
        for name, each in kept["columns"].items():
            shape, unit, rows = each["shape"], each["unit"], each.get("rows", {})
            single = {
                title.removeprefix(f"{name}, "): _from_words(
                    words[heading], unit, rows.get(title, 0), "words" in each
                )
                for title, heading in each["headings"].items()
            }
            values: Any = single
            if shape is not None:
                values = [*single.values()] if shape else single[name]
                values = np.reshape(values, (*shape, -1)) if shape else values
            columns[name] = (values, unit, each["meaning"], [*single] if shape else ())
        facts = {
            name: (_arrays(each["values"]), each["unit"], each["meaning"])
            for name, each in kept["facts"].items()
        }
        return cls(columns, facts)


def facts_in(comments: Iterable[str]) -> dict[str, list[str]]:
    """Return the facts in the head of a CSV by name, each as the words of its numbers."""
    lines = [line.removeprefix(KEPT) for line in comments if line.startswith(KEPT)]
    kept = json.loads(lines[0])["facts"] if lines else {}
    return {f"{FACT}{name}": _words(fact["values"]) for name, fact in kept.items()}


def _words(values: Any) -> list[str]:
    if isinstance(values, dict | list):
        inner = values.values() if isinstance(values, dict) else values
        return [word for each in inner for word in _words(each)]
    return ["" if values is None else str(values)]


def _single(name: str, entry: Entry) -> Iterator[tuple[str, Any]]:
    """Columns one by one, with their titles."""
    if isinstance(entry.values, Mapping):
        for word, values in entry.values.items():
            yield f"{name}, {word}", values
    elif entry.names:
        several = [entry.names] if isinstance(entry.names[0], str) else entry.names
        words = [", ".join(each) for each in product(*several)]
        shape = np.shape(entry.values)
        if np.prod(shape) % len(words):
            raise TypeError(f"{name}: expected rows with the names {words}, got shape {shape}.")
        rows = np.reshape(entry.values, (len(words), -1))
        for word, values in zip(words, rows, strict=True):
            yield f"{name}, {word}", values
    else:
        yield name, entry.values


def _names_shape(names: Sequence[Any]) -> list[int]:
    if not names:
        return []
    return [len(names)] if isinstance(names[0], str) else [len(each) for each in names]


def _from_words(words: Sequence[str], unit: str, rows: int, are_words: bool) -> Any:
    """A column from a CSV, in SI units and radians, of so many rows at least; what is empty below
    its last value is cut."""
    count = max((i + 1 for i, word in enumerate(words) if word), default=0)
    own = list(words[: max(count, rows)])
    values = None if are_words else numbers(own)
    if values is None:
        return own
    return np.radians(values) if unit == "deg" else UNITS[unit][0] * values


def _plain(values: Any) -> Any:
    """Values as JSON has them, numbers to the digits of a CSV."""
    if isinstance(values, np.ndarray | np.generic):
        return _plain(values.tolist())
    if isinstance(values, Mapping):
        return {name: _plain(each) for name, each in values.items()}
    if isinstance(values, list | tuple):
        return [_plain(each) for each in values]
    if values is None or isinstance(values, str | bool | int):
        return values
    return float(f"{values:.12g}")


def _arrays(values: Any) -> Any:
    """Lists of numbers as arrays again."""
    if isinstance(values, dict):
        return {name: _arrays(each) for name, each in values.items()}
    if isinstance(values, list) and not any(isinstance(each, str) for each in values):
        return np.array(values)
    return values
