"""What counts as the answer to an exercise, and what a wrong answer says of the slip behind it.

An exercise computes what is right, and what each likely mistake would give, with the package
itself; nothing is typed in. A wrong answer that equals one of the mistakes is told so. What is
right is never printed.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, field
from numbers import Number
from typing import Any, ClassVar, NamedTuple

import numpy as np
import sympy as sp

from .reading import Numbers, UnreadableError, entries, fit, name, numbers, read, symbols
from .slips import find_slip

KINDS = ("predict", "slide", "explain", "compute")
"""What an exercise asks for: a guess before looking, a try in a panel, a reason, a computation."""


class Verdict(NamedTuple):
    """What `check` thinks of an answer.

    Attributes
    ----------
    right : bool or None
        None if there is no answer yet.
    says : str
        One or two sentences for the reader.
    """

    right: bool | None
    says: str


@dataclass(frozen=True, kw_only=True)
class Exercise(ABC):
    """An exercise that answers back.

    Attributes
    ----------
    kind : str
        One of `KINDS`.
    remark : str
        What is worth seeing in the answer, told to who has found it.
    """

    kind: str
    remark: str = ""

    def verdict(self, answer: Any) -> Verdict:
        """Judge `answer`; ``...`` and None mean that there is none yet."""
        if _is_missing(answer):
            return Verdict(None, "not answered yet.")
        try:
            reason = self._objection(answer)
        except UnreadableError as error:
            return Verdict(False, f"not readable. {error}")
        if reason is None:
            return Verdict(True, f"right. {self.remark}".rstrip())
        return Verdict(False, f"not yet. {reason}".rstrip())

    @abstractmethod
    def expected(self) -> str:
        """What is right, in words, for a teacher's list."""

    def feedback(self) -> list[str]:
        """What the likely mistakes of this exercise are told."""
        return []

    @abstractmethod
    def _objection(self, answer: Any) -> str | None:
        """Return None if `answer` is right, else what can be said of it, perhaps nothing."""


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
    """

    right: Callable[[], Any]
    unit: str = "1"
    accuracy: float | None = None
    absolute: float | Sequence[float] = 0.0
    mistakes: Mapping[str, Callable[[], Any]] = field(default_factory=dict)
    quaternion: bool = False
    any_order: bool = False

    def expected(self) -> str:
        right = numbers(self.right())
        right = np.where(np.abs(right) < 1e-9 * np.abs(right).max(), 0, right)
        text = ", ".join(f"{entry:.3g}" for entry in right.flat)
        return text if self.unit == "1" else f"{text} {self.unit}"

    def feedback(self) -> list[str]:
        return list(self.mistakes)

    def _objection(self, answer: Any) -> str | None:
        right = numbers(self.right())
        if self.any_order and isinstance(answer, (set, frozenset)):
            answer = list(answer)
        given = fit(read(numbers, answer), right)
        mistakes = ((says, numbers(value())) for says, value in self.mistakes.items())
        absolute = np.asarray(self.absolute, dtype=float)
        part = self.accuracy or (0.0 if absolute.any() else 1e-3)
        return find_slip(
            given,
            right,
            mistakes,
            tolerance=np.maximum(part * np.abs(right).max(), absolute),
            unit=self.unit,
            quaternion=self.quaternion,
            any_order=self.any_order,
        )


@dataclass(frozen=True, kw_only=True)
class Formula(Exercise):
    """A formula: a SymPy expression, a matrix of them, or a Python function.

    It is right if it gives the right values at `COUNT` random places, whatever its form.

    Attributes
    ----------
    arguments : tuple of str
        The arguments of a function, in this order, or the symbols of an expression.
    draw : callable
        Gives values of the arguments, from a generator of random numbers.
    right : callable
        The formula, as a function of the arguments.
    accuracy : float
        Largest allowed deviation, as a part of the largest value.
    mistakes : mapping
        What to say of a likely mistake, and the formula that it leads to.
    aliases : mapping
        Other names of symbols that are taken for one of the arguments.
    """

    arguments: tuple[str, ...]
    draw: Callable[[np.random.Generator], tuple[Any, ...]]
    right: Callable[..., Any]
    accuracy: float = 1e-6
    mistakes: Mapping[str, Callable[..., Any]] = field(default_factory=dict)
    aliases: Mapping[str, str] = field(default_factory=dict)

    COUNT: ClassVar[int] = 7

    def expected(self) -> str:
        return f"a formula in {', '.join(self.arguments)}; see the solutions"

    def feedback(self) -> list[str]:
        return list(self.mistakes)

    def _objection(self, answer: Any) -> str | None:
        rng = np.random.default_rng(1)
        places = [self.draw(rng) for _ in range(self.COUNT)]

        def values(function: Callable[..., Any]) -> Numbers:
            return np.array([numbers(function(*place)) for place in places])

        right = values(self.right)
        function = read(self._function, answer, places[0])
        # An answer may change its arguments; the places are still needed.
        given = read(lambda: [fit(numbers(function(*deepcopy(p))), right[0]) for p in places])
        mistakes = ((says, values(function)) for says, function in self.mistakes.items())
        tolerance = self.accuracy * float(np.abs(right).max())
        return find_slip(np.array(given), right, mistakes, tolerance=tolerance)

    def _function(self, answer: Any, place: tuple[Any, ...]) -> Callable[..., Any]:
        """The answer, a function, an expression or a constant, as a function."""
        names = ", ".join(self.arguments)
        if isinstance(answer, sp.Lambda):
            return sp.lambdify(answer.variables, answer.expr)
        if callable(answer) and not isinstance(answer, sp.Basic):
            return answer
        parts = entries(answer)
        if not all(isinstance(part, (sp.Basic, Number)) for part in parts):
            raise UnreadableError(
                f"Expected an expression or a function of ({names}), got {name(answer)}."
            )
        found = {symbol for part in parts for symbol in symbols(part)}
        own = {self.aliases.get(str(symbol), str(symbol)): symbol for symbol in found}
        unknown = sorted(own.keys() - set(self.arguments))
        if unknown:
            raise UnreadableError(
                f"Expected an expression in {names}, found also {', '.join(unknown)}."
            )
        if own and any(np.ndim(value) for value in place):
            raise UnreadableError(f"Expected a Python function of ({names}).")
        if isinstance(answer, np.ndarray):
            answer = answer.tolist()
        return sp.lambdify([own.get(n, sp.Symbol(n)) for n in self.arguments], answer)


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

    def _objection(self, answer: Any) -> str | None:
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
                return f"({letter}) {self.wrong[letter]}"
        if set(chosen) < set(self.right):
            return "What you chose is true, and something else is too."
        return None


def _is_missing(answer: Any) -> bool:
    if answer is None or answer is Ellipsis:
        return True
    if isinstance(answer, str):
        return not answer.strip(" ?.")
    return isinstance(answer, (list, tuple)) and any(map(_is_missing, answer))
