"""The exercises of the book, which answer back: ``check("3.2", answer)``.

Each chapter's exercises are data in a module of their own: what is right, and what likely mistakes
lead to, both as computed by the package. `reading` takes an answer in any form, `answers` judges
it, `slips` finds the mistake that explains it.
"""

from __future__ import annotations

from typing import Any

from . import (
    chapter01,
    chapter02,
    chapter03,
    chapter04,
    chapter05,
    chapter06,
    chapter07,
    chapter08,
    chapter09,
    chapter10,
    chapter11,
)
from .answers import KINDS, Exercise, Verdict

__all__ = ["EXERCISES", "KINDS", "Exercise", "Verdict", "check", "of_kind", "verdict"]

EXERCISES: dict[str, Exercise] = {
    **chapter01.EXERCISES,
    **chapter02.EXERCISES,
    **chapter03.EXERCISES,
    **chapter04.EXERCISES,
    **chapter05.EXERCISES,
    **chapter06.EXERCISES,
    **chapter07.EXERCISES,
    **chapter08.EXERCISES,
    **chapter09.EXERCISES,
    **chapter10.EXERCISES,
    **chapter11.EXERCISES,
}
"""All exercises of the book by number, chapter first."""


def check(number: str, answer: Any) -> None:
    """Say whether `answer` is right; if it is not, name the likely mistake where there is one.

    Parameters
    ----------
    number : str
        The exercise's number, as in the text: "3.2" is the second one of chapter 03.
    answer
        A number or an array in any form, a SymPy expression or a function, or the letters of the
        chosen statements, as the exercise asks. ``...`` stands for an answer that is still missing.

    Raises
    ------
    ValueError
        If there is no exercise of that number.
    """
    print(f"Exercise {number}: {verdict(number, answer).says}")


def verdict(number: str, answer: Any) -> Verdict:
    """Return what `check` prints, and whether the answer is right; arguments as there."""
    if not isinstance(number, str) or number not in EXERCISES:
        chapter = str(number).split(".")[0]
        known = [n for n in EXERCISES if n.split(".")[0] == chapter] or list(EXERCISES)
        raise ValueError(f'number: expected "{known[0]}" to "{known[-1]}", got {number!r}.')
    return EXERCISES[number].verdict(answer)


def of_kind(kind: str) -> dict[str, Exercise]:
    """Return all exercises of one kind by number, for a teacher's lists.

    Parameters
    ----------
    kind : str
        "predict", "slide", "explain" or "compute".

    Raises
    ------
    ValueError
        If there is no such kind.
    """
    if kind not in KINDS:
        raise ValueError(f"kind: expected one of {', '.join(KINDS)}, got {kind!r}.")
    return {n: exercise for n, exercise in EXERCISES.items() if exercise.kind == kind}
