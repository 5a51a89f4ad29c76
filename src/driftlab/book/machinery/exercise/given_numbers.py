"""The numbers that an exercise gives: the book's, or some of a student's own.

A student's are drawn with the name as seed, so that they are the same on every computer and in
every year; whoever wants others next year puts the year behind the name.
"""

from __future__ import annotations

import hashlib
import unicodedata
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

ALIKE = str.maketrans(dict.fromkeys("’‘ʼ`´", "'") | dict.fromkeys("‐‑–—", "-"))
"""Apostrophes and hyphens as keyboards and word processors have them."""


@dataclass(frozen=True)
class GivenNumbers:
    """What an exercise gives, and how a student's own numbers are drawn."""

    book: Mapping[str, Any]  # the numbers of the book's text by name, in the units of the text
    # gives other numbers by the same names, from a generator of random numbers
    draw: Callable[[np.random.Generator], Mapping[str, Any]]
    units: Mapping[str, str]  # the unit of each number that has one

    def numbers(self, student: str = "") -> dict[str, Any]:
        """Return the numbers of a student, or the book's if there is no name."""
        return dict(self.draw(generator(student)) if student else self.book)


class Given(Mapping[str, Any]):
    """Numbers of an exercise by name; shown as the lines of code that make them."""

    def __init__(self, head: str, numbers: Mapping[str, Any], units: Mapping[str, str]) -> None:
        self._head, self._numbers, self._units = head, numbers, units

    def __getitem__(self, name: str) -> Any:
        return self._numbers[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._numbers)

    def __len__(self) -> int:
        return len(self._numbers)

    def __repr__(self) -> str:
        lines = [f"# {self._head}"]
        for name, value in self._numbers.items():
            unit = f"  # {self._units[name]}" if name in self._units else ""
            lines.append(f"{name} = {_as_code(value)}{unit}")
        return "\n".join(lines)


def same_name(student: str) -> str:
    """Return a student's name without what differs by accident.

    That is capitals, blanks, joined signs, signs that nobody sees, and the kind of an apostrophe
    or a hyphen.
    """
    seen = "".join(sign for sign in student if unicodedata.category(sign) != "Cf")
    folded = unicodedata.normalize("NFKC", seen.translate(ALIKE)).casefold()
    return " ".join(unicodedata.normalize("NFKC", folded).split())


def generator(student: str) -> np.random.Generator:
    """Return the generator of random numbers that belongs to a name."""
    digest = hashlib.sha256(same_name(student).encode("utf-8", "surrogatepass")).digest()
    return np.random.default_rng(int.from_bytes(digest, "big"))


def _as_code(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"np.array({value.tolist()})"
    return repr(value)
