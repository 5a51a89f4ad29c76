"""How the numbers of a table differ from those of another: not at all, in last digits, or really.

Twelve digits are written. Processors differ in how many numbers they multiply at once, and in what
order they add them, so other machines may round the last few digits otherwise; and earlier what is
left when nearly equal numbers are subtracted, as an entry of a matrix that should be zero, or a
heading after a filter of hundreds of steps. A column that is written to a few decimals differs by
one in the last of them where a number lies between two.
"""

from __future__ import annotations

from collections.abc import Collection
from decimal import Decimal
from pathlib import Path
from typing import NamedTuple

import numpy as np

from .csv_table import Words, numbers, read_table
from .data_table import FACT, facts_in

ROUNDING = 1e-7
"""Numbers are the same, but for rounding, to this of themselves or of their curve's largest."""
RESIDUE = 1e-12
"""What is smaller than this is nothing but rounding: of one, or of the largest number of its unit.

On a logarithmic scale zero has no place, so there a gap stands for it.
"""


class Difference(NamedTuple):
    """How a column differs from the same column elsewhere."""

    column: str  # its name
    written_otherwise: int  # how many of its entries are written otherwise
    entries: int  # of how many
    # largest difference, in units of the largest number of the same curve; infinite if words
    # differ, or a number stands where the other has none
    largest: float
    only_rounding: bool  # whether all of it may come from another processor

    def __str__(self) -> str:
        if np.isinf(self.largest):
            return f"{self.column}: {self.written_otherwise} of {self.entries} entries are others"
        size = f"at most {self.largest:.0e} of the largest"
        return f"{self.column}: {self.written_otherwise} of {self.entries} numbers, {size}"


def table_differences(first: Words, second: Words) -> list[Difference]:
    """Return what differs between two tables as a CSV holds them, column by column."""
    sizes = [{name: len(column) for name, column in table.items()} for table in (first, second)]
    if sizes[0] != sizes[1]:
        raise ValueError(f"Tables: expected the same columns and rows, got {sizes[0]}, {sizes[1]}.")
    curves = np.asarray(first.get("curve", []))
    found = []
    for name, column in first.items():
        other = second[name]
        count = sum(a != b for a, b in zip(column, other, strict=True))
        if count:
            same_unit = [first[each] for each in first if _unit(each) == _unit(name)]
            residue = RESIDUE * max(1.0, *map(_largest, same_unit))
            own = curves if len(curves) == len(column) else np.full(len(column), "")
            largest, allowed = _size(column, other, own, residue, name.startswith(FACT))
            found.append(Difference(name, count, len(column), largest, allowed))
    return found


def _unit(name: str) -> str:
    """Unit of a column, by its name: "arcmin" of "angle_arcmin" and of "angle_arcmin, swing"."""
    return name.split(",")[0].rpartition("_")[2]


def _largest(column: list[str]) -> float:
    """The largest number of a column, 0 if it has none."""
    values = numbers(column)
    return 0.0 if values is None else float(np.max(np.abs(values[np.isfinite(values)]), initial=0))


def _size(
    first: list[str], second: list[str], curves: np.ndarray, residue: float, fact: bool
) -> tuple[float, bool]:
    """Largest difference, curve by curve in units of its largest number, and if it is rounding."""
    here, there = numbers(first), numbers(second)
    if here is None or there is None:
        return np.inf, False
    for values, other in ((here, there), (there, here)):
        values[np.isnan(values) & (np.abs(other) < residue)] = 0.0
    finite = np.isfinite(here) & np.isfinite(there)
    if np.any((np.array(first) != np.array(second)) & ~finite):
        return np.inf, False
    largest, allowed = 0.0, True
    # A fact is written to all its digits, however few they are.
    last_digit = 0.0 if fact else 2 * min(rounding(first), rounding(second))
    for curve in np.unique(curves):
        a, b = (values[(curves == curve) & finite] for values in (here, there))
        if a.size:
            size = max(float(np.max(np.abs(a))), float(np.max(np.abs(b))))
            off = np.abs(a - b)
            largest = max(largest, float(off.max()) / size if size else 0.0)
            least = max(residue, ROUNDING * size, last_digit)
            allowed &= bool(np.all(off <= least + ROUNDING * np.abs(a)))
    return largest, allowed


def rounding(words: list[str]) -> float:
    """Half the last digit of a column that is rounded to some decimals; 0 for whole numbers."""
    exponents = [Decimal(word).as_tuple().exponent for word in words if word]
    last = min((each for each in exponents if isinstance(each, int)), default=0)
    return 0.5001 * 10.0**last if last < 0 else 0.0


def folder_differences(
    first: Path, second: Path, chosen: Collection[str] | None = None
) -> dict[str, list[Difference]]:
    """Return the tables of two folders that differ, by name, and how; all, or those chosen."""
    names = [{path.name for path in folder.glob("*.csv")} for folder in (first, second)]
    if chosen is not None:
        names = [found & {*chosen} for found in names]
    if not names[0] or names[0] != names[1]:
        missing = ", ".join(sorted(names[0] ^ names[1])) or "no table at all"
        raise ValueError(f"Folders: expected the same tables in both, got {missing} in one only.")
    found = {}
    for name in sorted(names[0]):
        try:
            differences = table_differences(*(_with_facts(f / name) for f in (first, second)))
        except ValueError as error:
            raise ValueError(f"{name}: {error}") from None
        if differences:
            found[name] = differences
    return found


def _with_facts(path: Path) -> dict[str, list[str]]:
    """Columns of a CSV, and as further ones the facts of a table that is read again from it."""
    comments, columns = read_table(path)
    return columns | facts_in(comments)
