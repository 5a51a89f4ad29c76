"""What an exercise is: it judges an answer, and says what may be wrong with it.

An exercise computes what is right, and what each likely mistake would give, with the package
itself; nothing is typed in. A wrong answer that equals one of the mistakes is told so. What is
right is never shown to anybody who has not found it.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .reading import SettingError, UnreadableError

KINDS = ("predict", "slide", "explain", "compute")
"""What an exercise asks for: a guess before looking, a try in a panel, a reason, a computation."""


Parts = tuple[tuple[bool, ...], ...]


class Verdict(NamedTuple):
    """What `check` thinks of an answer.

    Attributes
    ----------
    right : bool or None
        None if there is no answer yet.
    says : str
        One or two sentences for the reader. They begin with "right", "not yet", "not readable" or
        "not answered yet", and a full stop.
    parts : tuple of tuple of bool
        Which parts of a list or an array are right, row by row; empty if there is nothing to say
        of parts.
    """

    right: bool | None
    says: str
    parts: Parts = ()

    @property
    def word(self) -> str:
        """What the sentences begin with."""
        return self.says.partition(".")[0]


class Objection(NamedTuple):
    """What can be said of a wrong answer, and which of its parts are right."""

    reason: str
    parts: Parts = ()


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
            objection = self._objection(answer)
        except SettingError as error:
            return Verdict(False, f"not yet. {error}")
        except UnreadableError as error:
            return Verdict(False, f"not readable. {error}")
        if objection is None:
            return Verdict(True, f"right. {self.remark}".rstrip())
        return Verdict(False, f"not yet. {objection.reason}", objection.parts)

    @abstractmethod
    def expected(self) -> str:
        """What is right, in words, for a teacher's list."""

    def feedback(self) -> list[str]:
        """What the likely mistakes of this exercise are told."""
        return []

    @abstractmethod
    def _objection(self, answer: Any) -> Objection | None:
        """Return None if `answer` is right, else what can be said of it."""


def rows(parts: NDArray[np.bool_]) -> Parts:
    """Which parts are right, row by row; nothing for a single number."""
    return tuple(tuple(map(bool, row)) for row in np.atleast_2d(parts)) if parts.ndim else ()


def _is_missing(answer: Any) -> bool:
    if answer is None or answer is Ellipsis:
        return True
    if isinstance(answer, str):
        return not answer.strip(" ?.")
    return isinstance(answer, (list, tuple)) and any(map(_is_missing, answer))
