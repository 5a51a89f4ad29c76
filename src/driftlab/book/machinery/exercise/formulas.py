"""Exercises that ask for a formula: right is what gives the right values, whatever its form."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from copy import deepcopy
from dataclasses import InitVar, dataclass, field
from functools import cached_property
from itertools import combinations
from numbers import Number
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import UnusualWarning

from .exercise import Exercise, Objection, Said, rows
from .reading import (
    Numbers,
    UnreadableError,
    entries,
    fit,
    name,
    numbers,
    of_sympy,
    read,
    symbols,
)
from .sizes import common_factor, size
from .slips import find_slip, matches

EXCHANGED = "Two of the arguments have changed places."


@dataclass(frozen=True, kw_only=True, eq=False)
class Formula(Exercise):
    """A formula: a SymPy expression, a matrix of them, or a Python function.

    It is right if it gives the right values at `COUNT` random places, whatever its form.
    """

    # the arguments of a function, in this order, or the symbols of an expression
    arguments: tuple[str, ...]
    # gives values of the arguments, from a generator of random numbers
    draw: Callable[[np.random.Generator], tuple[Any, ...]]
    right: InitVar[Callable[..., Any]]  # the formula, as a function of the arguments
    accuracy: float = 1e-6  # largest allowed deviation, as a part of the largest value
    # what to say of a likely mistake, and the formula that it leads to
    mistakes: InitVar[Mapping[str, Callable[..., Any]]] = MappingProxyType({})
    # other names of symbols that are taken for one of the arguments
    aliases: Mapping[str, str] = field(default_factory=dict)

    COUNT: ClassVar[int] = 7

    def __post_init__(
        self, right: Callable[..., Any], mistakes: Mapping[str, Callable[..., Any]]
    ) -> None:
        self._seal(right, mistakes)

    def _objection(self, answer: Any, said: Said) -> Objection | None:
        places, right = self._places, self._values(self._key.right)
        function = read(self._function, answer, places[0])
        # An answer may change its arguments; the places are still needed.
        fitted = read(lambda: [fit(numbers(function(*deepcopy(p))), right[0]) for p in places])
        given = np.array(fitted)
        tolerance = self.accuracy * float(np.abs(right).max())
        if matches(given, right, tolerance).all():
            return None
        parts = np.asarray(matches(given, right, tolerance).all(axis=0))
        found = find_slip(given, right, self._slips, tolerance=tolerance)
        return Objection(found or self._off(given, right, parts), rows(parts))

    def _off(self, given: Numbers, right: Numbers, parts: NDArray[np.bool_]) -> str:
        """How far a formula is off that shows no slip, at one of the places where it was tried."""
        factor = common_factor(given, right)
        if factor:
            if factor < 0:
                return "The form is right, the sign and a constant factor are not."
            return "The form is right, a constant factor is not."
        if parts.ndim and parts.any():
            verb = "is" if parts.sum() == 1 else "are"
            return f"Right {verb} {parts.sum()} of {parts.size} parts."
        at = np.unravel_index(np.argmax(np.abs(given - right)), given.shape)
        where = "One of those tried: there"
        if all(np.ndim(value) == 0 for value in self._places[at[0]]):
            pairs = zip(self.arguments, self._places[at[0]], strict=True)
            where = f"At {', '.join(f'{n} = {value:.3g}' for n, value in pairs)}"
        how = size(given[at], right[at])
        if right.ndim == 1:
            return f"{where} it is {how}."
        return f"{where} one of its parts is {how}."

    @cached_property
    def _places(self) -> list[tuple[Any, ...]]:
        rng = np.random.default_rng(1)
        return [self.draw(rng) for _ in range(self.COUNT)]

    def _values(self, function: Callable[..., Any]) -> Numbers:
        return np.array([numbers(function(*place)) for place in self._places])

    @cached_property
    def _slips(self) -> list[tuple[str, Numbers]]:
        own = [(says, self._values(function)) for says, function in self._key.mistakes.items()]
        return [*own, *self._exchanged()]

    def _exchanged(self) -> Iterator[tuple[str, Numbers]]:
        """What the formula gives with two arguments of a kind exchanged, and what to say of it."""
        kinds = [np.shape(value) for value in self._places[0]]
        for i, j in combinations(range(len(kinds)), 2):
            if kinds[i] == kinds[j]:
                order = list(range(len(kinds)))
                order[i], order[j] = j, i
                # A latitude, say, that is no length; or a length that is much for a bias.
                with suppress(ValueError), warnings.catch_warnings():
                    warnings.simplefilter("ignore", UnusualWarning)
                    values = self._values(
                        lambda *place, order=order: self._key.right(*(place[k] for k in order))
                    )
                    yield EXCHANGED, values

    def _function(self, answer: Any, place: tuple[Any, ...]) -> Callable[..., Any]:
        """The answer, a function, an expression or a constant, as a function."""
        if callable(answer) and not of_sympy(answer, "Basic"):
            return answer
        import sympy as sp

        names = ", ".join(self.arguments)
        if isinstance(answer, sp.Lambda):
            return sp.lambdify(answer.variables, answer.expr)
        parts = entries(answer)
        if not all(isinstance(part, (sp.Basic, Number)) for part in parts):
            raise UnreadableError(
                f"Expected an expression or a function of ({names}), got {name(answer)}."
            )
        found = {symbol for part in parts for symbol in symbols(part)}
        own = {self.aliases.get(str(symbol), str(symbol)): symbol for symbol in found}
        unknown = sorted(own.keys() - set(self.arguments))
        if unknown:
            others = ", ".join(unknown)
            raise UnreadableError(f"Expected an expression in {names}, found also {others}.")
        if own and any(np.ndim(value) for value in place):
            raise UnreadableError(f"Expected a Python function of ({names}).")
        if isinstance(answer, np.ndarray):
            answer = answer.tolist()
        return sp.lambdify([own.get(n, sp.Symbol(n)) for n in self.arguments], answer)
