"""What a reader has answered since the kernel started; no file keeps it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
import sympy as sp

from .exercise import Verdict


class Progress:
    """The last verdict, the first guess and the hints asked for, by the exercise's number."""

    def __init__(self) -> None:
        self._right: dict[str, bool] = {}
        self._guess: dict[str, str] = {}
        self._rungs: dict[str, int] = {}

    def note(self, number: str, answer: Any, verdict: Verdict) -> None:
        """Remember a verdict, and of the first answer that can be read what it was."""
        if verdict.right is not None:
            self._right[number] = verdict.right
        if verdict.word in ("right", "not yet"):
            self._guess.setdefault(number, as_text(answer))

    def guess_against(self, number: str, answer: Any) -> str:
        """A sentence about the first guess, now that a right answer is there."""
        guess, right = self._guess[number], as_text(answer)
        if guess == right:
            return "You had it at the first guess."
        return f"Your first guess was {guess}, the answer is {right}."

    def next_rung(self, number: str, last: int) -> int:
        """How many hints to show, one more than the last time."""
        self._rungs[number] = min(self._rungs.get(number, 0) + 1, last)
        return self._rungs[number]

    def of(self, numbers: Iterable[str]) -> tuple[int, int]:
        """How many of some exercises are right, and how many there are."""
        each = [self._right.get(number, False) for number in numbers]
        return sum(each), len(each)


def as_text(answer: Any) -> str:
    """An answer in a few words, as a reader would say it."""
    if isinstance(answer, str):
        return ", ".join(answer) if answer.isalpha() else answer
    if isinstance(answer, sp.MatrixBase):
        answer = answer.tolist()
    try:
        values = np.asarray(answer, dtype=float)
    except (TypeError, ValueError):
        return ", ".join(map(str, answer)) if isinstance(answer, (list, tuple)) else str(answer)
    return ", ".join(f"{value:.4g}" for value in values.flat)
