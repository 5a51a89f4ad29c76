"""What a reader has answered; a notebook keeps it as long as its kernel, a page as it can."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from dataclasses import dataclass, field
from types import CodeType, FunctionType
from typing import Any

import numpy as np

from .exercise import Said, Verdict
from .reading import of_sympy, panel_values


@dataclass
class Progress:
    """How far a reader has come, by the exercise's number."""

    right: dict[str, bool] = field(default_factory=dict)  # the last verdict
    guesses: dict[str, str] = field(default_factory=dict)  # the first answer that could be read
    rungs: dict[str, int] = field(default_factory=dict)  # how many hints were asked for
    # digests of the different answers that could be read
    tried: dict[str, list[str]] = field(default_factory=dict)
    # what was said of an answer in words, and the digest of the answer
    reasons: dict[str, dict[str, str]] = field(default_factory=dict)

    def note(self, number: str, answer: Any, verdict: Verdict) -> None:
        """Remember a verdict, and of the first answer that can be read what it was."""
        if verdict.right is not None:
            self.right[number] = verdict.right
        if verdict.word in ("right", "not yet"):
            self.guesses.setdefault(number, as_text(answer))
        self.count(number, answer, verdict)

    def count(self, number: str, answer: Any, verdict: Verdict) -> None:
        """Count an answer that can be read, if it is another than those before."""
        if verdict.word in ("right", "not yet"):
            tried = self.tried.setdefault(number, [])
            if (digest := _digest(answer)) not in tried:
                tried.append(digest)

    def without_used_words(self, said: Said, number: str, answer: Any) -> Said:
        """What was said of an answer, without words that were said of another one before."""
        if not said.because:
            return said
        known = self.reasons.setdefault(number, {})
        is_new = known.setdefault(said.because, _digest(answer)) == _digest(answer)
        return said if is_new else said._replace(because="")

    def attempts(self, number: str) -> int:
        """How many different answers there were."""
        return len(self.tried.get(number, ()))

    def guess_against(self, number: str, answer: Any) -> str:
        """A sentence about the first guess, now that a right answer is there."""
        guess, right = self.guesses[number], as_text(answer)
        if guess == right:
            return "You had it at the first guess."
        return f"Your first guess was {guess}, the answer is {right}."

    def next_rung(self, number: str, last: int) -> int:
        """How many hints to show, one more than the last time."""
        self.rungs[number] = min(self.rungs.get(number, 0) + 1, last)
        return self.rungs[number]

    def of(self, numbers: Iterable[str]) -> tuple[int, int]:
        """How many of some exercises are right, and how many there are."""
        each = [self.right.get(number, False) for number in numbers]
        return sum(each), len(each)


def as_text(answer: Any) -> str:
    """An answer in a few words, as a reader would say it."""
    if isinstance(answer, str):
        return ", ".join(answer) if answer.isalpha() else answer
    if of_sympy(answer, "MatrixBase"):
        answer = answer.tolist()
    try:
        values = np.asarray(answer, dtype=float)
    except Exception:  # whatever a student's own object raises
        return ", ".join(map(_word, answer)) if isinstance(answer, list | tuple) else _word(answer)
    return ", ".join(f"{value:.4g}" for value in values.flat)


def _word(answer: Any) -> str:
    try:
        return str(answer)
    except Exception:
        return f"a {type(answer).__name__}"


def _digest(answer: Any) -> str:
    """What tells answers apart; the same lines of code, run again, make the same answer."""
    values = panel_values(answer)
    if values is not None:
        text = repr(sorted(values.items()))
    elif isinstance(answer, FunctionType):
        text = repr(_lines_of(answer.__code__))
    else:
        text = as_text(answer)
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()[:16]


def _lines_of(code: CodeType) -> tuple[Any, ...]:
    """What code does, without the places in memory where it stands."""
    constants = [_lines_of(c) if isinstance(c, CodeType) else repr(c) for c in code.co_consts]
    return code.co_code, constants, code.co_names
