"""What a question of an examination is made of, and how its numbers are drawn and written."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable
from typing import NamedTuple, SupportsFloat

import numpy as np


class Answer(NamedTuple):
    """A number that is asked for."""

    value: float  # in its unit
    name: str  # in Markdown
    unit: str = ""  # empty for a plain number
    digits: str = "3"  # how many are significant

    def __str__(self) -> str:
        """As the marking scheme has it: "the drift = 86.4 arc seconds"."""
        return f"{self.name} = {shown(self.value, int(self.digits))}{self.unit and ' '}{self.unit}"


class Part(NamedTuple):
    """A part of a question."""

    asks: str  # what stands on the sheet
    works: str  # the model answer, in words and formulas
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


def question(draw: np.random.Generator, text: str, values: Iterable[SupportsFloat]) -> Question:
    """Return a question from its text, with one of its parts (a) and one of its parts (b).

    Before the parts come chapter, minutes and title, the outcome, and what is given. In a part "="
    begins the model answer, "2:" what earns two marks, "-" a typical error, and ">" the numbers
    asked for, with their units, whose values are taken in this order.
    """
    head, given, *rest = text.strip().split("\n\n")
    about, outcome = (flow(line) for line in head.split("\n"))
    chapter, minutes, title = re.split(", | minutes: ", about, maxsplit=2)
    left = iter(values)
    choices: dict[str, list[Part]] = {"(a)": [], "(b)": []}
    for each in rest:
        asks, *lines = (flow(line) for line in re.split(r"\n\s*(?=(?:=|-|>|\d:) )", each))
        said = {sign: [line[2:].strip() for line in lines if line[0] == sign] for sign in "=->"}
        names = [name.strip() for line in said[">"] for name in line.split("|")]
        answers = tuple(Answer(float(next(left)), *name.split(": ")) for name in names)
        marks = " ".join(line for line in lines if line[0].isdigit())
        found = re.findall(r"(\d): (.+?)(?:;? (?=\d: )|$)", marks)
        earns = tuple((int(number), what) for number, what in found)
        part = Part(asks[4:], " ".join(said["="]), answers, earns, tuple(said["-"]))
        choices[asks[:3]].append(part)
    drawn = tuple(parts[int(draw.integers(len(parts)))] for parts in choices.values())
    return Question(title, chapter, outcome, int(minutes), flow(given), drawn)


def flow(text: str) -> str:
    """Return a text of several lines in one."""
    return " ".join(text.split())


def plain(value: float) -> str:
    """Return a number that was drawn, with the minus of a printed page."""
    return f"{value:.10g}".replace("-", "−")


def matrix(rows: Iterable[Iterable[float]], form: str = "g") -> str:
    """Return a matrix in LaTeX, for a line of Markdown."""
    body = r" \\ ".join(" & ".join(format(float(x), form) for x in row) for row in rows)
    return rf"\begin{{pmatrix}} {body} \end{{pmatrix}}"
