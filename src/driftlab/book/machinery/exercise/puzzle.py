"""What a puzzle asks, within which bounds a guess may lie, and how far off it is in words."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

Answer: TypeAlias = float | str
"""A number in the question's unit, or the chosen words."""

PARTS = {
    1 / 10: "a tenth of it",
    1 / 7: "a seventh of it",
    1 / 5: "a fifth of it",
    1 / 4: "a quarter of it",
    1 / 3: "a third of it",
    1 / 2: "half of it",
    2 / 3: "two thirds of it",
    4 / 5: "a little less than it is",
    1: "it almost exactly",
    5 / 4: "a little more than it is",
    3 / 2: "half as much again",
    2: "twice as much",
    3: "three times as much",
    4: "four times as much",
    5: "five times as much",
    7: "seven times as much",
    10: "ten times as much",
}
"""What a guess is of the truth, in words; beyond these a number says it."""


@dataclass(frozen=True, kw_only=True)
class Number:
    """A question for a number, which is guessed on a slider."""

    asks: str  # the question in short
    unit: str  # as it stands behind the number; a sign such as ° follows it without a space
    low: float  # end of the scale, in the unit; above zero where decades count on it
    high: float  # the other end
    truth: Callable[[], float]  # computes the answer, in the unit
    # whether whole things are counted; then the scale has equal steps and may begin at zero
    whole: bool = False

    @property
    def start(self) -> float:
        """Where the slider stands before anybody moved it: in the middle."""
        if self.whole:
            return (self.low + self.high) // 2
        return rounded(math.sqrt(self.low * self.high))

    def place(self, value: float) -> float:
        """Return where a value lies on the scale, from 0 to 1; what is beyond lies at its end."""
        value = min(max(value, self.low), self.high)
        if self.whole:
            return (value - self.low) / (self.high - self.low)
        return math.log(value / self.low) / math.log(self.high / self.low)

    def ticks(self) -> list[float]:
        """Return the values that the scale names."""
        if self.whole:
            return [self.low + part * (self.high - self.low) / 3 for part in range(4)]
        decades = range(math.ceil(math.log10(self.low)), math.floor(math.log10(self.high)) + 1)
        return [10.0**decade for decade in decades]

    def written(self, value: Answer) -> str:
        """Return a value with its unit, in three digits."""
        assert not isinstance(value, str)
        number = f"{value:.0f}" if self.whole or abs(value) >= 100 else f"{value:.3g}"
        return number + ("" if self.unit[:1] in "°′″" else " ") + self.unit

    def allows(self, answer: object) -> bool:
        """Tell whether something that was read is a guess at this question."""
        number = isinstance(answer, int | float) and not isinstance(answer, bool)
        return number and self.low <= answer <= self.high  # type: ignore[operator]

    def how_far(self, guess: Answer, truth: Answer) -> str:
        """Return how far off a guess is, as a sentence."""
        assert not isinstance(guess, str)
        assert not isinstance(truth, str)
        if self.whole:
            more = round(guess - truth)
            if not more:
                return "You guessed it exactly."
            if more > 0:
                return f"You guessed {more} too many."
            return f"You guessed {-more} too few."
        ratio = guess / truth
        if ratio > 14:
            return f"You guessed about {written_round(ratio)} times as much."
        if ratio < 1 / 14:
            times = written_round(1 / ratio)
            return f"It is about {times} times what you guessed."
        nearest = min(PARTS, key=lambda part: abs(math.log(ratio / part)))
        return f"You guessed {PARTS[nearest]}."


@dataclass(frozen=True, kw_only=True)
class Choice:
    """A question with a few answers to choose from."""

    asks: str  # the question in short
    options: tuple[str, ...]  # the answers
    truth: Callable[[], str]  # computes which of them is right

    def written(self, value: Answer) -> str:
        """Return the words."""
        return str(value)

    def allows(self, answer: object) -> bool:
        """Tell whether something that was read is a guess at this question."""
        return answer in self.options

    def how_far(self, guess: Answer, truth: Answer) -> str:
        """Return whether a guess is right, as a sentence."""
        if guess == truth:
            return "That is what you guessed."
        return f"You guessed: {self.written(guess)}."


Question: TypeAlias = Number | Choice


@dataclass(frozen=True, kw_only=True)
class Puzzle:
    """The puzzle that opens a chapter."""

    chapter: str  # its number, "00" to "17"
    edition: int  # counts up when the puzzle asks something else: an older guess is no guess at it
    questions: tuple[Question, ...]  # what it asks
    # a sentence or two that stand under the answer. ``{0}`` is the first answer with its unit
    says: str

    @property
    def key(self) -> str:
        """Name under which a guess is kept."""
        return f"{self.chapter}, edition {self.edition}"

    def truths(self) -> list[Answer]:
        """Compute the answers."""
        return [question.truth() for question in self.questions]

    def allows(self, guess: object) -> bool:
        """Tell whether something that was read is a guess at this puzzle, or a look without one."""
        if guess is None:
            return True
        return (
            isinstance(guess, list)
            and len(guess) == len(self.questions)
            and all(q.allows(each) for q, each in zip(self.questions, guess, strict=True))
        )

    def remark(self, truths: Sequence[Answer]) -> str:
        """Return the sentences under the answer."""
        written = [q.written(truth) for q, truth in zip(self.questions, truths, strict=True)]
        return self.says.format(*written)


def rounded(value: float, digits: int = 2) -> float:
    """Round to some significant digits."""
    return float(f"{value:.{digits}g}")


def written_round(value: float) -> str:
    """Return a large number as one says it: one digit and zeros."""
    return f"{rounded(value, 1):,.0f}".replace(",", "\u202f")
