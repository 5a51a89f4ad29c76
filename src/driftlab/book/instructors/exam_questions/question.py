"""What a question of an examination is made of, and how its numbers are drawn and written."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np


class Answer(NamedTuple):
    """A number that is asked for."""

    name: str  # in Markdown
    value: float  # in its unit
    unit: str = ""  # empty for a plain number
    digits: int = 3  # how many count

    def __str__(self) -> str:
        """As the marking scheme has it: "the drift = 86.4 arc seconds"."""
        return f"{self.name} = {shown(self.value, self.digits)}{self.unit and ' '}{self.unit}"


class Part(NamedTuple):
    """A part of a question."""

    asks: str  # what stands on the sheet
    works: str  # the model answer, in words and formulas; empty if the numbers are enough
    answers: tuple[Answer, ...]  # the numbers asked for, in their order; empty if words are
    earns: tuple[tuple[int, str], ...]  # the marks, and what each of them is for
    slips: tuple[str, ...] = ()  # typical errors, and what they still earn

    @property
    def marks(self) -> int:
        """All that the part can earn."""
        return sum(marks for marks, _ in self.earns)


class Question(NamedTuple):
    """A question with its numbers."""

    title: str
    chapter: str  # its number, "03"
    outcome: str  # how the outcome of that chapter begins which it examines, letter for letter
    minutes: int  # for a student who can do it
    given: str  # what stands before the parts
    parts: tuple[Part, ...]  # in the order of their letters

    @property
    def marks(self) -> int:
        """All that the question can earn."""
        return sum(part.marks for part in self.parts)


def drawn_from(edition: str, title: str) -> np.random.Generator:
    """Return where the numbers of one question come from; each question has its own stream."""
    digest = hashlib.sha256(f"{edition}\0{title}".encode()).digest()
    return np.random.default_rng(int.from_bytes(digest[:16], "big"))


def shown(value: float, digits: int = 3) -> str:
    """Return a number with so many digits that count, and without a power of ten if it can be."""
    if value == 0:
        return "0"
    after = max(digits - 1 - int(np.floor(np.log10(abs(value)))), 0)
    # What rounds up to a power of ten would show a digit too many, which does no harm.
    return f"{value:.{after}f}".replace("-", "−")


def two_of(draw: np.random.Generator, first: Part, *others: Part) -> tuple[Part, Part]:
    """Return a part that every sheet has, and one of several that earn the same."""
    return first, others[int(draw.integers(len(others)))]


def plain(value: float) -> str:
    """Return a number that was drawn, with the minus of a printed page."""
    return f"{value:.10g}".replace("-", "−")


def matrix(rows: Iterable[Iterable[float]], form: str = "g") -> str:
    """Return a matrix in LaTeX, for a line of Markdown."""
    body = r" \\ ".join(" & ".join(format(float(x), form) for x in row) for row in rows)
    return rf"\begin{{pmatrix}} {body} \end{{pmatrix}}"
