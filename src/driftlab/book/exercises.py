"""The exercises of the book, which answer back: ``check("3.2", answer)``.

Each chapter's exercises are data in a module of their own: what is right, and what likely mistakes
lead to, both as computed by the package. `reading` takes an answer in any form, `answers` judges
it, `slips` finds the mistake that explains it.
"""

from __future__ import annotations

from typing import Any

from .chapters import chapters_with, part_of
from .machinery.answers import KINDS, Exercise, Verdict


def all_exercises(chapter: str | None = None) -> dict[str, Exercise]:
    """Return the exercises of the book, or of one chapter, by number.

    Parameters
    ----------
    chapter : str, optional
        Its number, "01" to "11". Only that chapter's module is imported then.
    """
    chapters = chapters_with("exercises") if chapter is None else [chapter]
    return {n: each for c in chapters for n, each in part_of(c, "exercises").EXERCISES.items()}


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
    chapter = str(number).split(".")[0].zfill(2)
    known = all_exercises(chapter if chapter in chapters_with("exercises") else None)
    if not isinstance(number, str) or number not in known:
        first, *_, last = known
        raise ValueError(f'number: expected "{first}" to "{last}", got {number!r}.')
    return known[number].verdict(answer)


def by_kind(kind: str) -> dict[str, Exercise]:
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
    return {n: exercise for n, exercise in all_exercises().items() if exercise.kind == kind}
