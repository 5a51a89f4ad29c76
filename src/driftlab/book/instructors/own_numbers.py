"""Whose numbers the students of a class used, in exercises that have numbers of one's own.

A record says in which name the numbers were asked. That is told, and no more: two who share a
name may have worked together, or have met the same cell.
"""

from __future__ import annotations

import re

from driftlab.book.exercises import all_exercises
from driftlab.book.machinery.exercise.exercise import in_order
from driftlab.book.machinery.exercise.given_numbers import same_name

from .plain_text import is_no_name
from .roster import Listed
from .students import MOST_NOTES, Student

YEAR = re.compile(r"[\s/._-]*[0-9]{2,4}$")
"""What is put behind a name for other numbers in another year."""
MOST_NAMES = 3


def compare_numbers(students: list[Student], listed: list[Listed]) -> None:
    """Add to the rows in which name numbers were asked, where it is not the row's own."""
    # Everybody has the same numbers in these.
    alike = {n for n, each in all_exercises().items() if getattr(each, "given", None) is None}
    names: dict[str, list[str]] = {}
    sharing: dict[tuple[str, str], list[Student]] = {}
    for student in students:
        for number, name in _asked(student).items():
            names.setdefault(number, []).append(name)
            if not is_no_name(name):
                sharing.setdefault((number, same_name(name)), []).append(student)
    by_name: dict[str, list[Listed]] = {}
    for one in listed:
        by_name.setdefault(one.name, []).append(one)
    for student in students:
        asked = _asked(student)
        on_the_list = _on_the_list(student, by_name.get(student.name, []))
        notes = _in_another_name(student, on_the_list)
        shared: dict[str, list[str]] = {}
        for number, name in asked.items():
            others = [s for s in sharing.get((number, same_name(name)), ()) if s is not student]
            if others:
                shared.setdefault(some(others), []).append(number)
        notes += [
            f"{who} asked the numbers of {_all(n)} in the same name." for who, n in shared.items()
        ]
        # Where most have the book's numbers, nobody was told to ask for others.
        plain = [
            number
            for number, name in asked.items()
            if not name
            and number not in alike
            and 2 * names[number].count("") <= len(names[number])
        ]
        if plain:
            notes.append(f"{_all(plain)} with the book's numbers, where others have their own.")
        student.notes += notes[:MOST_NOTES]


def _asked(student: Student) -> dict[str, str]:
    """By the exercise the name that its numbers were asked in, as far as a record says it."""
    return {
        number: answer.student
        for number, answer in student.answers.items()
        if answer.is_recorded and answer.status in ("right", "wrong")
    }


def _on_the_list(student: Student, listed: list[Listed]) -> Listed:
    """Who a row is of those with its name; its first number is that of the list."""
    for one in listed:
        if not one.ids or one.ids[0] == student.id:
            return one
    return Listed(student.name, (student.id,))


def _in_another_name(student: Student, listed: Listed) -> list[str]:
    others: dict[str, list[str]] = {}
    for number, answer in student.answers.items():
        asked = YEAR.sub("", answer.student)
        if asked and not (listed.is_named(asked) or listed.has(asked)):
            others.setdefault(answer.student, []).append(number)
    return [f"The numbers of {_all(n)} were asked in the name {who}." for who, n in others.items()]


def _all(numbers: list[str]) -> str:
    return ", ".join(sorted(numbers, key=in_order))


def some(students: list[Student]) -> str:
    """Several students by their names, which may be many."""
    names = [student.name for student in students]
    more = [f"{len(names) - MOST_NAMES} more"] if len(names) > MOST_NAMES else []
    return " and ".join([*names[:MOST_NAMES], *more])
