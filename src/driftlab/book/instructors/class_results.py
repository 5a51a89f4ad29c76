"""What is known of a class: the record that a report is made of."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from .students import Student


class Slip(NamedTuple):
    """What several students were told of the same wrong answer.

    Attributes
    ----------
    exercise : str
    says : str
        As `check` said it; empty if it did not know the slip.
    students : tuple of str
        Their names.
    """

    exercise: str
    says: str
    students: tuple[str, ...]


@dataclass(frozen=True, repr=False)
class ClassResults:
    """The fields of `ClassReport`."""

    folder: str
    students: list[Student]
    exercises: list[str]
    slips: list[Slip]
    notes: list[str]
