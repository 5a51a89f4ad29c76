"""Exercises that ask for numbers, or for a choice among statements."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import InitVar, dataclass, field
from functools import lru_cache
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import shown

from .exercise import Exercise, Objection, Said, key_of, rows
from .given_numbers import GivenNumbers
from .reading import Numbers, UnreadableError, fit, numbers, panel_values, read
from .sizes import how_far_off
from .slips import UNITS, find_slip, matches

FEWEST_WORDS = 3
LOOK_ALIKES = str.maketrans("асе", "ace")
"""Cyrillic letters that look like Latin ones: who has that keyboard means what is seen."""
NOT_ALL = "At least one statement is judged otherwise than it should be."
NOT_ONE = "More than one statement is judged otherwise than it should be."
SAY_WHY = "Say why you judge so, in your own words, and the reply goes into it."


@dataclass(frozen=True, kw_only=True, eq=False)
class Value(Exercise):
    """A number or an array of numbers."""

    right: InitVar[Callable[..., Any]]  # gives the value; its arguments are the names of `given`
    # what to say of a likely mistake, and a callable, like `right`, of the value it leads to
    mistakes: InitVar[Mapping[str, Callable[..., Any]]] = MappingProxyType({})
    # the unit that the exercise asks for, one of `slips.UNITS`; "1" for pure numbers
    unit: str = "1"
    # largest allowed deviation of any entry, as a part of the largest entry; 1e-3 if neither this
    # nor `absolute` is given
    accuracy: float | None = None
    # the same in the unit, for all entries or one by one. If both are given, the larger one counts
    absolute: float | Sequence[float] = 0.0
    # the value is a unit quaternion, scalar last; the opposite sign is as right
    quaternion: bool = False
    any_order: bool = False  # the entries may come in any order; `absolute` is then one number
    # reads the answer from the values of a slider panel that stand for it; it raises
    # `UnreadableError` if they cannot
    from_panel: Callable[[Mapping[str, Any]], Any] | None = None
    # the numbers that the exercise gives, if a student can have others
    given: GivenNumbers | None = None

    def __post_init__(
        self, right: Callable[..., Any], mistakes: Mapping[str, Callable[..., Any]]
    ) -> None:
        if not callable(right):
            raise ValueError(
                f"right: expected a function that computes the answer, got {shown(right)}."
            )
        self._seal(right, mistakes)
        if not any(self.unit in kind for kind in UNITS.values()):
            raise ValueError(f"unit: expected one of slips.UNITS, got {self.unit!r}")

    def _objection(self, answer: Any, said: Said) -> Objection | None:
        right, slips = computed(self, said.student)
        if self.any_order and isinstance(answer, (set, frozenset)):
            answer = list(answer)
        values = panel_values(answer)
        if values is not None:
            answer = self._read_panel(values)
        given = fit(read(numbers, answer), right)
        tolerance = self.tolerance(right)
        same = {"quaternion": self.quaternion, "any_order": self.any_order}
        reason = find_slip(given, right, slips, tolerance=tolerance, unit=self.unit, **same)
        if reason is None:
            return None
        parts = matches(given, right, tolerance, **same)
        reason = reason or how_far_off(given, right, parts, any_order=self.any_order)
        return Objection(reason, rows(parts))

    def tolerance(self, right: Numbers) -> NDArray[np.float64]:
        """Return by how much each entry may be off: one number for all, or one for each."""
        absolute = np.asarray(self.absolute, dtype=float)
        part = self.accuracy or (0.0 if absolute.any() else 1e-3)
        return np.maximum(part * float(np.abs(right).max()), absolute)

    def _read_panel(self, values: Mapping[str, Any]) -> Any:
        if self.from_panel is None:
            raise UnreadableError("No one setting of a panel is the answer; expected numbers.")
        try:
            return self.from_panel(values)
        except KeyError:
            raise UnreadableError("Expected the panel of this exercise, got another one.") from None


@lru_cache(maxsize=256)
def computed(exercise: Value, student: str = "") -> tuple[Numbers, list[tuple[str, Numbers]]]:
    """Return what is right with the numbers of a student, and what each mistake leads to."""
    given = exercise.given.numbers(student) if exercise.given else {}
    key = key_of(exercise)
    slips = [(says, numbers(value(**given))) for says, value in key.mistakes.items()]
    return numbers(key.right(**given)), slips


@dataclass(frozen=True, kw_only=True, eq=False)
class Choice(Exercise):
    """One or several of the statements a, b, c, ... of the exercise.

    Which letter is wrong is said only to who says why, and only if it is the only one: without
    that, trying finds the true ones sooner than thinking.
    """

    right: InitVar[str]  # the letters of all true statements
    wrong: InitVar[Mapping[str, str]]  # the other letters, and what is wrong with each
    letters: str = field(init=False)  # those of all statements

    def __post_init__(self, right: str, wrong: Mapping[str, str]) -> None:
        self._seal(frozenset(right), wrong)
        object.__setattr__(self, "letters", "".join(sorted({*right, *wrong})))

    def _objection(self, answer: Any, said: Said) -> Objection | None:
        letters = self.letters
        expected = f"Expected letters from {letters[0]} to {letters[-1]}"
        if isinstance(answer, np.ndarray):
            answer = answer.ravel().tolist()
        if isinstance(answer, Mapping) or not isinstance(answer, Iterable):
            raise UnreadableError(f"{expected}, as text.")
        words = [answer] if isinstance(answer, str) else list(answer)
        if not all(isinstance(word, str) for word in words):
            raise UnreadableError(f"{expected}, as text.")
        chosen = letters_in(" ".join(words))
        for letter in chosen:
            if letter not in letters:
                raise UnreadableError(f"{expected}, found {letter!r}.")
        if not chosen:
            raise UnreadableError(f"{expected}.")
        misjudged = self._key.right.symmetric_difference(chosen)
        if not misjudged:
            return None
        if not in_words(said.because):
            return Objection(f"{NOT_ALL} {SAY_WHY}")
        if len(misjudged) > 1:
            return Objection(NOT_ONE)
        (letter,) = misjudged
        if letter in self._key.mistakes:
            return Objection(f"({letter}) {self._key.mistakes[letter]}")
        return Objection("What you chose is true, and something else is too.")


def letters_in(text: str) -> list[str]:
    """The letters of statements, as somebody may list them: "a, c and d"."""
    plain = text.lower().replace("and", " ").translate(LOOK_ALIKES)
    return sorted({letter for letter in plain if letter.isalnum()})


def in_words(because: str) -> bool:
    """Whether somebody has said why, if only in a few words."""
    return len(because.split()) >= FEWEST_WORDS
