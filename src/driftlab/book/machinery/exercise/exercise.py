"""What an exercise is: it judges an answer, and says what may be wrong with it.

An exercise computes what is right, and what each likely mistake would give, with the package
itself; nothing is typed in. A wrong answer that equals one of the mistakes is told so. What is
right is never shown to anybody who has not found it; it is the exercise's `Key`, which no public
attribute leads to.
"""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .reading import SettingError, UnreadableError

KINDS = ("predict", "slide", "explain", "compute")
"""What an exercise asks for: a guess before looking, a try in a panel, a reason, a computation."""

NUMBER = re.compile(r"\d+\.\d+[a-z]?")
"""How an exercise is numbered; 3.3a stands between 3.3 and 3.4."""


def in_order(number: str) -> tuple[int, int, str]:
    """Return what exercises are sorted by: 3.3a after 3.3, 3.10 after 3.9."""
    chapter, _, rest = number.partition(".")
    digits = rest.rstrip("abcdefghijklmnopqrstuvwxyz")
    return int(chapter), int(digits), rest[len(digits) :]


Parts = tuple[tuple[bool, ...], ...]


class Verdict(NamedTuple):
    """What `check` thinks of an answer."""

    right: bool | None  # None if there is no answer yet
    # one or two sentences for the reader. They begin with "right", "not yet", "not readable" or
    # "not answered yet", for programs, and a full stop
    says: str
    # which parts of a list or an array are right, row by row; empty if there is nothing to say of
    # parts
    parts: Parts = ()

    @property
    def word(self) -> str:
        """What the sentences begin with."""
        return self.says.partition(".")[0]

    @property
    def reason(self) -> str:
        """What follows the word."""
        return self.says.partition(".")[2].strip()


class NotRightError(AssertionError):
    """An answer that had to be right is not."""


class Said(NamedTuple):
    """What a student says beside the answer."""

    because: str = ""  # why, in the student's own words
    # the name that numbers of one's own were asked with; empty for the book's numbers
    student: str = ""


NOTHING_SAID = Said()


class Key:
    """What is right, and what likely mistakes lead to: for judging, and for teachers' lists."""

    def __init__(self, right: Any, mistakes: Mapping[str, Any]) -> None:
        self.right, self.mistakes = right, mistakes


def key_of(exercise: Exercise) -> Key:
    """Return what is right in an exercise."""
    return exercise._key


class Objection(NamedTuple):
    """What can be said of a wrong answer, and which of its parts are right."""

    reason: str
    parts: Parts = ()


@dataclass(frozen=True, kw_only=True, eq=False)
class Exercise(ABC):
    """An exercise that checks an answer."""

    kind: str  # one of `KINDS`
    # what is worth seeing in the answer, told to who has found it
    remark: str = field(default="", repr=False)
    _key: Key = field(init=False, repr=False, compare=False)

    def _seal(self, right: Any, mistakes: Mapping[str, Any]) -> None:
        if self.kind not in KINDS:
            raise ValueError(f"kind: expected one of {', '.join(KINDS)}, got {self.kind!r}.")
        object.__setattr__(self, "_key", Key(right, mistakes))

    def verdict(self, answer: Any, said: Said = NOTHING_SAID) -> Verdict:
        """Judge `answer`; ``...`` and None mean that there is none yet."""
        try:
            if is_missing(answer):
                return Verdict(None, "not answered yet.")
            objection = self._objection(answer, said)
        except SettingError as error:
            return Verdict(False, f"not yet. {error}")
        except UnreadableError as error:
            return Verdict(False, f"not readable. {error}")
        except RecursionError:
            return Verdict(False, "not readable. There are too many lists in each other.")
        if objection is None:
            return Verdict(True, f"right. {self.remark}".rstrip())
        return Verdict(False, f"not yet. {objection.reason}", objection.parts)

    @abstractmethod
    def _objection(self, answer: Any, said: Said) -> Objection | None:
        """Return None if `answer` is right, else what can be said of it."""


def rows(parts: NDArray[np.bool_]) -> Parts:
    """Which parts are right, row by row; nothing for a single number."""
    return tuple(tuple(map(bool, row)) for row in np.atleast_2d(parts)) if parts.ndim else ()


def is_missing(answer: Any) -> bool:
    """Whether an answer is one that is still to be given, or a list with such a part."""
    if answer is None or answer is Ellipsis:
        return True
    if isinstance(answer, str):
        return not answer.strip(" ?.")
    return isinstance(answer, (list, tuple)) and any(map(is_missing, answer))
