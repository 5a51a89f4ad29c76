"""What a question of an examination is made of, and how its numbers are drawn and written."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np


class Answer(NamedTuple):
    """A number that is asked for.

    Attributes
    ----------
    name : str
        In Markdown.
    value : float
        In its unit.
    unit : str
        Empty for a plain number.
    digits : int
        How many count.
    """

    name: str
    value: float
    unit: str = ""
    digits: int = 3

    def __str__(self) -> str:
        """As the marking scheme has it: "the drift = 86.4 arc seconds"."""
        return f"{self.name} = {shown(self.value, self.digits)}{self.unit and ' '}{self.unit}"


class Part(NamedTuple):
    """A part of a question.

    Attributes
    ----------
    asks : str
        What stands on the sheet.
    works : str
        The model answer, in words and formulas; empty if the numbers are enough.
    answers : tuple of Answer
        The numbers asked for, in their order; empty if words are.
    earns : tuple of (int, str)
        The marks, and what each of them is for.
    slips : tuple of str
        Typical errors, and what they still earn.
    """

    asks: str
    works: str
    answers: tuple[Answer, ...]
    earns: tuple[tuple[int, str], ...]
    slips: tuple[str, ...] = ()

    @property
    def marks(self) -> int:
        """All that the part can earn."""
        return sum(marks for marks, _ in self.earns)


class Question(NamedTuple):
    """A question with its numbers.

    Attributes
    ----------
    title, chapter : str
        The chapter by its number, "03".
    outcome : str
        How the outcome of that chapter begins which it examines, letter for letter.
    minutes : int
        For a student who can do it.
    given : str
        What stands before the parts.
    parts : tuple of Part
        In the order of their letters.
    """

    title: str
    chapter: str
    outcome: str
    minutes: int
    given: str
    parts: tuple[Part, ...]

    @property
    def marks(self) -> int:
        """All that the question can earn."""
        return sum(part.marks for part in self.parts)


def drawn_from(edition: str, title: str) -> np.random.Generator:
    """Return where the numbers of one question come from; each question has its own stream."""
    digest = hashlib.sha256(f"{edition}\0{title}".encode()).digest()
    return np.random.default_rng(int.from_bytes(digest[:16], "big"))


def shown(value: float, digits: int = 3) -> str:
    """Return a number with so many digits that count, and without a power of ten if it can be.

    Examples
    --------
    >>> [shown(number) for number in (86.397, -0.00123456, 12345.6, 0.0)]
    ['86.4', '−0.00123', '12346', '0']
    """
    if value == 0:
        return "0"
    after = max(digits - 1 - int(np.floor(np.log10(abs(value)))), 0)
    # What rounds up to a power of ten would show a digit too many, which does no harm.
    return f"{value:.{after}f}".replace("-", "−")


def plain(value: float) -> str:
    """Return a number that was drawn, with the minus of a printed page."""
    return f"{value:.10g}".replace("-", "−")


def matrix(rows: Iterable[Iterable[float]], form: str = "g") -> str:
    """Return a matrix in LaTeX, for a line of Markdown."""
    body = r" \\ ".join(" & ".join(format(float(x), form) for x in row) for row in rows)
    return rf"\begin{{pmatrix}} {body} \end{{pmatrix}}"
