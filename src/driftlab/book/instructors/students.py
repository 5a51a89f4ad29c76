"""The students of a class, each with what the newest of their notebooks say."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field

from .found_files import is_notebook
from .handed_in import HandedIn
from .newest import Read, joined
from .plain_text import spellings, squeezed
from .roster import Listed
from .saved_answers import SavedAnswer

MOST_NOTES = 8


@dataclass
class Student:
    """A row of the report."""

    name: str
    id: str = ""  # the number on the list, or else the platform's
    # by the exercise's number; where several notebooks have it, as the newest says
    answers: dict[str, SavedAnswer] = field(default_factory=dict)
    files: list[str] = field(default_factory=list)  # the notebooks that were read, the oldest first
    notes: list[str] = field(default_factory=list)  # what else there is to know, in sentences
    is_listed: bool = True  # whether the student is on the roster; True if there is none
    read: list[Read] = field(default_factory=list)  # the same notebooks with what they say

    def status(self, exercise: str) -> str:
        """One of `saved_answers.STATUSES`."""
        return self.answers[exercise].status if exercise in self.answers else "absent"

    def right(self, exercises: Iterable[str]) -> int:
        """How many of some exercises are right."""
        return sum(self.status(exercise) == "right" for exercise in exercises)

    def attempts(self, exercises: Iterable[str]) -> int:
        """How many different answers there were to some exercises."""
        return sum(self.answers[each].attempts for each in exercises if each in self.answers)


@dataclass
class _Row:
    """A student, and all that is theirs."""

    student: Student
    is_claimed: bool
    others: list[str] = field(default_factory=list)


def students_of(files: list[HandedIn]) -> list[Student]:
    """Read all files, and put those of one student together."""
    rows: dict[str, _Row] = {}
    for file in files:
        person, found = file.person, file.found
        row = rows.setdefault(
            person.key, _Row(Student(person.name, person.id), is_claimed=file.is_claimed)
        )
        notes = row.student.notes
        if file.trouble:
            notes.append(f"{file.file}: {file.trouble}")
        if found.trouble:
            notes.append(f"{file.file}: {found.trouble}")
        elif found.parts[-1] and not is_notebook(found.parts[-1]):
            row.others.append(file.file)
        elif found.saved is not None and not found.saved.answers:
            notes.append(f"{file.file}: It has no exercise of the book.")
        elif found.saved is not None:
            row.student.read.append(Read(file.file, file.newness, file.is_claimed, found.saved))
    for row in rows.values():
        if row.others:
            more = " and others" if len(row.others) > 3 else ""
            row.student.notes.append(
                f"Not read, since no notebook: {', '.join(row.others[:3])}{more}."
            )
    students = []
    for row in _with_claims(list(rows.values())):
        _join(row.student)
        students.append(row.student)
    return students


def _with_claims(rows: list[_Row]) -> list[_Row]:
    """Put what belongs to a name alone to whom a platform or a folder knows by that name."""
    known: dict[str, list[_Row]] = {}
    for row in rows:
        if not row.is_claimed:
            for name in {row.student.name.casefold(), squeezed(row.student.name)} - {""}:
                known.setdefault(name, []).append(row)
    kept = []
    for row in rows:
        name = row.student.name
        owners = known.get(name.casefold(), known.get(squeezed(name), []))
        if row.is_claimed and len(owners) == 1:
            owners[0].student.notes += row.student.notes
            owners[0].student.read += row.student.read
        else:
            kept.append(row)
    return kept


def _join(student: Student) -> None:
    """Take the newest of what a student handed in, exercise by exercise."""
    student.read.sort(key=lambda each: each.newness)
    student.answers, notes = joined(student.read)
    student.notes += notes
    student.files = [one.file for one in student.read]
    if not student.files and not student.notes:
        student.notes.append("Nothing was handed in.")
    if len(student.notes) > MOST_NOTES:
        more = len(student.notes) - MOST_NOTES
        student.notes[MOST_NOTES:] = [f"And {more} notes more of this kind."]


def in_order(students: list[Student], listed: list[Listed]) -> list[Student]:
    """Return every student on the list, and then who is not on it; without a list, by name."""
    by_number: dict[str, list[Student]] = {}
    by_name: dict[str, list[Student]] = {}
    for student in students:
        for number in {student.id.casefold(), student.name.casefold()} - {""}:
            by_number.setdefault(number, []).append(student)
        by_name.setdefault(squeezed(student.name), []).append(student)
    names = Counter(spelling for one in listed for spelling in spellings(one.name))
    rows: dict[int, Student] = {}
    for one in listed:
        # Two of one name are told apart by numbers, or not at all.
        is_alone = names[squeezed(one.name)] == 1
        mine = _left(by_number, one.numbers, rows) or (
            _left(by_name, spellings(one.name), rows) if is_alone else []
        )
        if len(mine) == 1:
            student = mine[0]
            student.name, student.id = one.name, one.ids[0] if one.ids else student.id
        else:
            student = Student(one.name, one.ids[0] if one.ids else "")
            student.notes.append("Nothing was handed in under this name.")
        rows[id(student)] = student
    left = [student for student in students if id(student) not in rows]
    for student in left if listed else ():
        student.is_listed = False
        student.notes.append("This name is not on the list.")
    return [*rows.values(), *sorted(left, key=lambda each: (each.name.casefold(), each.id))]


def _left(
    known: dict[str, list[Student]], keys: Iterable[str], taken: dict[int, Student]
) -> list[Student]:
    """Who is known by one of several keys, each once, and has no row yet."""
    found = {id(student): student for key in keys for student in known.get(key, ())}
    return [student for key, student in found.items() if key not in taken]
