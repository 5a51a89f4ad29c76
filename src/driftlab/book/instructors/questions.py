"""Exercises as questions for a learning platform: the text, what is right, and the likely slips."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from driftlab.book.exercises import all_exercises
from driftlab.book.machinery.exercise.answers import Choice, Value, computed
from driftlab.book.machinery.exercise.exercise import NUMBER, Exercise, key_of
from driftlab.book.machinery.exercise.slips import exactness, slips

MOST_NUMBERS = 6
"""What a student may be asked to type in a row."""

_HEADING = re.compile(rf"### ({NUMBER.pattern}) .*\n+")
_STATEMENT = re.compile(r"^- \(([a-z])\) (.*)$", re.MULTILINE)
_BY_LETTER = re.compile(r"\b([Gg])ive (?:all|the) (?:their )?letters\b[^.;]*(?=[.;]\s|[.;]$)")
_IN_A_NOTEBOOK = re.compile(
    r"\n\nIn a course, in a notebook, you can have numbers[^\n]*|; the card says it [^.;]*(?=\.)"
)
"""How to have numbers of one's own, and what the card of a check does."""


class Slip(NamedTuple):
    """A wrong number, how exactly it is met, and what to say of it."""

    value: float
    tolerance: float
    says: str


@dataclass(frozen=True)
class Number:
    """A number that is asked."""

    right: float  # in the unit that the question asks for
    tolerance: float  # in the same unit
    slips: tuple[Slip, ...]  # likely wrong ones; the first that is met counts, and none is right


class Statement(NamedTuple):
    """A statement, in Markdown, whether it is true, and what is wrong with it if it is not.

    Both begin with the letter, because one statement may speak of the one before it.
    """

    text: str
    true: bool
    says: str


@dataclass(frozen=True)
class Question:
    """An exercise as a question, with the numbers of the book or of one variant."""

    exercise: str  # its number
    variant: int  # 0 if all students have the same numbers
    text: str  # Markdown, with formulas in LaTeX between dollar signs
    numbers: tuple[Number, ...]
    statements: tuple[Statement, ...]  # one of these two is empty
    remark: str  # what is told to who has found it

    @property
    def title(self) -> str:
        """What a teacher sees in a list."""
        return f"Exercise {self.exercise}" + (f", variant {self.variant}" if self.variant else "")


def questions(notebooks: Path, students: int) -> tuple[list[Question], dict[str, str]]:
    """Return the exercises that a learning platform can ask, and why each other one is left out.

    Of two variants that are the same one is kept.
    """
    texts = exercise_texts(notebooks)
    asked: list[Question] = []
    left_out = {}
    for number, exercise in all_exercises().items():
        why = _why_not(exercise)
        if why:
            left_out[number] = why
        elif isinstance(exercise, Choice):
            asked.append(_choice(number, exercise, texts[number]))
        elif isinstance(exercise, Value):
            variants = range(1, students + 1) if exercise.given else (0,)
            made = [_value(number, exercise, texts[number], each) for each in variants]
            # Round numbers are few, so two variants may have drawn the same.
            asked += reversed({each.text: each for each in reversed(made)}.values())
    return asked, left_out


def exercise_texts(notebooks: Path) -> dict[str, str]:
    """Return the texts of all exercises in a folder of notebooks, by number, without headings."""
    texts = {}
    for path in sorted(notebooks.glob("*.ipynb")):
        for cell in json.loads(path.read_text("utf-8"))["cells"]:
            source = "".join(cell["source"])
            heading = _HEADING.match(source)
            if cell["cell_type"] == "markdown" and heading:
                texts[heading[1]] = source[heading.end() :].strip()
    return texts


def outside_a_notebook(text: str) -> str:
    """Return the text of an exercise without what is done or said only in a notebook.

    A platform has drawn numbers already, paper draws none, and neither shows a card.
    """
    return _IN_A_NOTEBOOK.sub("", text)


def _why_not(exercise: Exercise) -> str:
    if exercise.kind == "slide":
        return "it needs its panel"
    if isinstance(exercise, Choice):
        return ""
    if not isinstance(exercise, Value):
        return "it asks neither for numbers nor for a choice"
    if exercise.quaternion:
        return "a quaternion has two right signs"
    if exercise.any_order:
        return "its numbers may come in any order"
    right, _ = computed(exercise)
    return "it asks for many numbers" if right.ndim > 1 or right.size > MOST_NUMBERS else ""


def _choice(number: str, exercise: Choice, text: str) -> Question:
    key = key_of(exercise)
    statements = tuple(
        Statement(
            f"({letter}) {says}",
            letter in key.right,
            f"({letter}) {key.mistakes[letter]}" if letter in key.mistakes else "",
        )
        for letter, says in _STATEMENT.findall(text)
    )
    asks = _BY_LETTER.sub(_tick, _STATEMENT.sub("", outside_a_notebook(text)).strip())
    return Question(number, 0, _signed(number, asks), (), statements, exercise.remark)


def _tick(asked: re.Match[str]) -> str:
    return ("T" if asked[1] == "G" else "t") + "ick all that are true"


def _value(number: str, exercise: Value, text: str, variant: int) -> Question:
    name = f"variant {variant}" if variant else ""
    right: Any
    right, mistakes = computed(exercise, name)
    tolerance = np.broadcast_to(exercise.tolerance(right), right.shape)
    right = np.where(np.abs(right) < 1e-9 * np.abs(right).max(), 0, right)
    likely = [*mistakes, *slips(right, unit=exercise.unit)]
    numbers = tuple(
        Number(
            float(right[at]),
            float(tolerance[at]),
            tuple(_slips_at(at, right, float(tolerance[at]), likely)),
        )
        for at in np.ndindex(right.shape)
    )
    text = outside_a_notebook(text)
    if variant:
        text = f"{text}\n\n{_own_numbers(exercise, name)}"
    if exercise.unit != "1":
        text = f"{text}\n\nThe unit is {exercise.unit}."
    return Question(number, variant, _signed(number, text), numbers, (), exercise.remark)


def _slips_at(
    at: tuple[int, ...], right: Any, tolerance: float, likely: Sequence[tuple[str, Any]]
) -> list[Slip]:
    """What makes one of the numbers another one; of two that make the same, the first."""
    found: list[Slip] = []
    for says, value in likely:
        if value.shape == right.shape and np.isfinite(value[at]):
            wrong = float(value[at])
            known = [(float(right[at]), tolerance), *((s.value, s.tolerance) for s in found)]
            if all(abs(wrong - other) > near for other, near in known):
                found.append(Slip(wrong, tolerance * exactness(right, value), says))
    return found


def _own_numbers(exercise: Value, name: str) -> str:
    """The numbers of a variant beside those of the text, in Markdown."""
    given = exercise.given
    assert given is not None
    own, book = given.numbers(name), given.numbers()
    lines = [
        f"- `{each}`: {_written(own, each, given.units)}, "
        f"in place of {_written(book, each, given.units)}"
        for each in own
    ]
    return "\n".join(["In this question these numbers stand in place of the book's:", "", *lines])


def _written(numbers: Mapping[str, Any], name: str, units: Mapping[str, str]) -> str:
    value = numbers[name]
    unit = f" {units[name]}" if name in units else ""
    return f"`{np.asarray(value).tolist()}`{unit}"


def _signed(number: str, text: str) -> str:
    return (
        f"{text}\n\n*Drift Lab, exercise {number}, CC BY 4.0. Where the text says equations, "
        "functions or panels, they are those of its chapter.*"
    )
