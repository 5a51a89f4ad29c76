"""Whose notebooks, or whose own words, are another's to the letter.

That is told, and no more: two may have worked together, or handed in a copy that both were given.
"""

from __future__ import annotations

from collections.abc import Hashable

from .newest import span
from .own_numbers import some
from .plain_text import spellings, squeezed
from .students import MOST_NOTES, Student

FEWEST_SIGNS = 40
"""Of one's own words; shorter ones can be the same by themselves."""


def compare_work(students: list[Student]) -> None:
    """Add to the rows who else handed in the same file, or the same words."""
    sharing: dict[Hashable, list[Student]] = {}
    for student in students:
        for key in {*_files(student), *_words(student), squeezed(student.name)}:
            sharing.setdefault(key, []).append(student)
    for student in students:
        notes = [
            f"{file} is byte for byte a notebook that {some(others)} handed in, too."
            for digest, file in _files(student).items()
            if (others := _others(sharing[digest], student))
        ]
        same: dict[str, list[str]] = {}
        for number, words in _words(student):
            if others := _others(sharing[number, words], student):
                same.setdefault(some(others), []).append(number)
        notes += [f"The words on {span(n)} are those of {who}." for who, n in same.items()]
        notes += [
            f"{one.file} is an export with the answers of {one.saved.whose}, as its title says."
            for one in student.read
            if squeezed(student.name) not in spellings(one.saved.whose)
            and any(name in sharing for name in spellings(one.saved.whose))
        ]
        student.notes += notes[:MOST_NOTES]


def _files(student: Student) -> dict[bytes, str]:
    """The notebooks with an answer, by what is the same for the same file."""
    return {one.saved.digest: one.file for one in student.read if one.is_judged}


def _words(student: Student) -> list[tuple[str, str]]:
    return [
        (number, squeezed(answer.because))
        for number, answer in student.answers.items()
        if len(answer.because) > FEWEST_SIGNS
    ]


def _others(sharing: list[Student], student: Student) -> list[Student]:
    return [other for other in sharing if other is not student] if len(sharing) > 1 else []
