"""What is known of a class: the record that a report is made of."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from .students import Student


class Slip(NamedTuple):
    """What several students were told of the same wrong answer."""

    exercise: str
    says: str  # as `check` said it; empty if it did not know the slip
    students: tuple[str, ...]  # their names


@dataclass(frozen=True, repr=False)
class ClassResults:
    """The fields of `ClassReport`."""

    folder: str
    students: list[Student]  # in the order of the roster, or of their names
    # all of the chapters that somebody has touched, in the book's order; then a teacher's own
    exercises: list[str]
    slips: list[Slip]  # the most frequent first
    notes: list[str]  # what concerns nobody alone
