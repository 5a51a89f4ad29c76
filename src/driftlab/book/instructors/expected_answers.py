"""What is right in each exercise, in words, and what its likely mistakes are told."""

from __future__ import annotations

from functools import singledispatch

import numpy as np

from driftlab.book.exercises import by_kind
from driftlab.book.machinery.exercise.answers import Choice, Value, computed
from driftlab.book.machinery.exercise.exercise import Exercise, key_of
from driftlab.book.machinery.exercise.formulas import Formula
from driftlab.book.machinery.table import Table


def expected_answers(kind: str, *, student: str = "") -> Table:
    """Return a table of all exercises of one kind with what is right.

    The numbers are those of a student, or the book's if no name is given.
    """
    rows = [
        (number, expected(exercise, student), "<br>".join(told(exercise)))
        for number, exercise in by_kind(kind).items()
    ]
    return Table([("exercise", "answer", "what a wrong one is told"), *rows])


@singledispatch
def expected(exercise: Exercise, student: str = "") -> str:
    """Return what is right in an exercise, in words."""
    return str(key_of(exercise).right)


@expected.register
def _(exercise: Value, student: str = "") -> str:
    right, _ = computed(exercise, student)
    right = np.where(np.abs(right) < 1e-9 * np.abs(right).max(), 0, right)
    text = ", ".join(f"{entry:.3g}" for entry in right.flat)
    return text if exercise.unit == "1" else f"{text} {exercise.unit}"


@expected.register
def _(exercise: Choice, student: str = "") -> str:
    return ", ".join(sorted(key_of(exercise).right))


@expected.register
def _(exercise: Formula, student: str = "") -> str:
    return f"a formula in {', '.join(exercise.arguments)}; see the solutions"


def told(exercise: Exercise) -> list[str]:
    """Return what the likely mistakes of an exercise are told."""
    mistakes = key_of(exercise).mistakes
    if isinstance(exercise, Choice):
        return [f"({letter}) {reason}" for letter, reason in mistakes.items()]
    return list(mistakes)
