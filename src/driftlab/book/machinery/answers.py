"""Exercises that ask for numbers, or for a choice among statements."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from .exercise import Exercise, Objection, rows
from .reading import Numbers, UnreadableError, fit, numbers, panel_values, read
from .sizes import how_far_off
from .slips import UNITS, find_slip, matches


@dataclass(frozen=True, kw_only=True)
class Value(Exercise):
    """A number or an array of numbers.

    Attributes
    ----------
    right : callable
        Gives the value.
    unit : str
        The unit that the exercise asks for, one of `slips.UNITS`; "1" for pure numbers.
    accuracy : float
        Largest allowed deviation of any entry, as a part of the largest entry; 1e-3 if neither
        this nor `absolute` is given.
    absolute : float or sequence of float
        The same in the unit, for all entries or one by one. If both are given, the larger one
        counts.
    mistakes : mapping
        What to say of a likely mistake, and a callable that gives the value it leads to.
    quaternion : bool
        The value is a unit quaternion, scalar last; the opposite sign is as right.
    any_order : bool
        The entries may come in any order; `absolute` is then one number.
    from_panel : callable, optional
        Reads the answer from the values of a slider panel that stand for it; it raises
        `UnreadableError` if they cannot.
    """

    right: Callable[[], Any]
    unit: str = "1"
    accuracy: float | None = None
    absolute: float | Sequence[float] = 0.0
    mistakes: Mapping[str, Callable[[], Any]] = field(default_factory=dict)
    quaternion: bool = False
    any_order: bool = False
    from_panel: Callable[[Mapping[str, Any]], Any] | None = None

    def __post_init__(self) -> None:
        if not any(self.unit in kind for kind in UNITS.values()):
            raise ValueError(f"unit: expected one of slips.UNITS, got {self.unit!r}")

    @cached_property
    def _right(self) -> Numbers:
        return numbers(self.right())

    @cached_property
    def _slips(self) -> list[tuple[str, Numbers]]:
        return [(says, numbers(value())) for says, value in self.mistakes.items()]

    def expected(self) -> str:
        right = self._right
        right = np.where(np.abs(right) < 1e-9 * np.abs(right).max(), 0, right)
        text = ", ".join(f"{entry:.3g}" for entry in right.flat)
        return text if self.unit == "1" else f"{text} {self.unit}"

    def feedback(self) -> list[str]:
        return list(self.mistakes)

    def _objection(self, answer: Any) -> Objection | None:
        right = self._right
        if self.any_order and isinstance(answer, (set, frozenset)):
            answer = list(answer)
        values = panel_values(answer)
        if values is not None:
            answer = self._read_panel(values)
        given = fit(read(numbers, answer), right)
        absolute = np.asarray(self.absolute, dtype=float)
        part = self.accuracy or (0.0 if absolute.any() else 1e-3)
        tolerance = np.maximum(part * np.abs(right).max(), absolute)
        same = {"quaternion": self.quaternion, "any_order": self.any_order}
        reason = find_slip(given, right, self._slips, tolerance=tolerance, unit=self.unit, **same)
        if reason is None:
            return None
        parts = matches(given, right, tolerance, **same)
        reason = reason or how_far_off(given, right, parts, any_order=self.any_order)
        return Objection(reason, rows(parts))

    def _read_panel(self, values: Mapping[str, Any]) -> Any:
        if self.from_panel is None:
            raise UnreadableError("No one setting of a panel is the answer; expected numbers.")
        try:
            return self.from_panel(values)
        except KeyError:
            raise UnreadableError("Expected the panel of this exercise, got another one.") from None


@dataclass(frozen=True, kw_only=True)
class Choice(Exercise):
    """One or several of the statements a, b, c, ... of the exercise.

    Attributes
    ----------
    right : str
        The letters of all true statements.
    wrong : mapping
        The other letters, and what is wrong with each.
    """

    right: str
    wrong: Mapping[str, str]

    def expected(self) -> str:
        return ", ".join(self.right)

    def feedback(self) -> list[str]:
        return [f"({letter}) {reason}" for letter, reason in self.wrong.items()]

    def _objection(self, answer: Any) -> Objection | None:
        letters = sorted({*self.right, *self.wrong})
        expected = f"Expected letters from {letters[0]} to {letters[-1]}"
        if isinstance(answer, np.ndarray):
            answer = answer.ravel().tolist()
        if isinstance(answer, Mapping) or not isinstance(answer, Iterable):
            raise UnreadableError(f"{expected}, as text.")
        words = [answer] if isinstance(answer, str) else list(answer)
        if not all(isinstance(word, str) for word in words):
            raise UnreadableError(f"{expected}, as text.")
        text = " ".join(words).lower().replace("and", " ")
        chosen = sorted({letter for letter in text if letter.isalnum()})
        for letter in chosen:
            if letter not in letters:
                raise UnreadableError(f"{expected}, found {letter!a}.")
        if not chosen:
            raise UnreadableError(f"{expected}.")
        for letter in chosen:
            if letter in self.wrong:
                return Objection(f"({letter}) {self.wrong[letter]}")
        if set(chosen) < set(self.right):
            return Objection("What you chose is true, and something else is too.")
        return None
