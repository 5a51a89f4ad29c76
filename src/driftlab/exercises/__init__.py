"""The exercises of the book, which answer back: ``check("3.2", answer)``.

Each chapter's exercises are data in a module of their own: what is right, and what likely mistakes
lead to, both as computed by the package. `answers` judges, `slips` knows what goes wrong anywhere.
"""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import Any

from .answers import KINDS, Exercise, Verdict

__all__ = ["EXERCISES", "KINDS", "Exercise", "Verdict", "check", "expected_answers", "verdict"]

EXERCISES: dict[str, Exercise] = {
    number: exercise
    for path in sorted(Path(__file__).parent.glob("chapter*.py"))
    for number, exercise in import_module(f".{path.stem}", __name__).EXERCISES.items()
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
    if number not in EXERCISES:
        last = list(EXERCISES)[-1]
        raise ValueError(f'number: expected one of "1.1" to "{last}", got {number!r}.')
    return EXERCISES[number].verdict(answer)


def expected_answers(kind: str) -> dict[str, str]:
    """Return the right answers to all exercises of one kind, in words, for a teacher's list.

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
    return {n: exercise.expected() for n, exercise in EXERCISES.items() if exercise.kind == kind}
