"""The students of a class, each with what the newest of their notebooks say."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from .found_files import is_notebook
from .handed_in import HandedIn, Person
from .plain_text import is_no_name, squeezed
from .roster import Listed
from .saved_answers import SavedAnswer

MOST_NOTES = 8


@dataclass
class Student:
    """A row of the report.

    Attributes
    ----------
    name : str
    id : str
        The number on the list, or else the platform's.
    answers : dict of str to SavedAnswer
        By the exercise's number; where several notebooks have it, as the newest says.
    files : list of str
        The notebooks that were read, the oldest first.
    notes : list of str
        What else there is to know, in sentences.
    is_listed : bool
        Whether the student is on the roster; True if there is none.
    """

    name: str
    id: str = ""
    answers: dict[str, SavedAnswer] = field(default_factory=dict)
    files: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    is_listed: bool = True

    def status(self, exercise: str) -> str:
        """One of `saved_answers.STATUSES`."""
        return self.answers[exercise].status if exercise in self.answers else "absent"

    def right(self, exercises: Iterable[str]) -> int:
        """How many of some exercises are right."""
        return sum(self.status(exercise) == "right" for exercise in exercises)

    def attempts(self, exercises: Iterable[str]) -> int:
        """How many different answers there were to some exercises."""
        return sum(self.answers[each].attempts for each in exercises if each in self.answers)


def students_of(files: list[HandedIn]) -> list[Student]:
    """Read all files, and put those of one student together."""
    found: dict[str, tuple[Person, Student, list[tuple[HandedIn, dict[str, SavedAnswer]]]]] = {}
    others: dict[str, list[str]] = {}
    for file in files:
        answers: dict[str, SavedAnswer] = {}
        person, note = file.person, file.found.trouble
        if not note and file.found.parts[-1] and not is_notebook(file.found.parts[-1]):
            others.setdefault(person.key, []).append(file.file)
        elif not note and file.found.saved is not None:
            answers, whose = file.found.saved.answers, file.found.saved.whose
            if file.is_named_inside and not is_no_name(whose):
                person = Person(whose)
            if not answers:
                note = "It has no exercise of the book."
        _, student, read = found.setdefault(
            person.key, (person, Student(person.name, person.id), [])
        )
        if note:
            student.notes.append(f"{file.file}: {note}")
        if answers:
            read.append((file, answers))
    for key, names in others.items():
        more = f" and {len(names) - 3} more" if len(names) > 3 else ""
        found[key][1].notes.append(f"Not read, since no notebook: {', '.join(names[:3])}{more}.")
    for key, (person, student, read) in list(found.items()):
        same = [
            each
            for each in found.values()
            if each[0].id and squeezed(each[0].name) == squeezed(person.name)
        ]
        # An export or a folder with a name alone belongs to whom the platform knows by that name.
        if not person.id and len(same) == 1:
            same[0][1].notes += student.notes
            same[0][2].extend(read)
            del found[key]
    for _, student, read in found.values():
        _join(student, read)
    return [student for _, student, _ in found.values()]


def _join(student: Student, read: list[tuple[HandedIn, dict[str, SavedAnswer]]]) -> None:
    """Take the newest of what a student handed in, exercise by exercise."""
    whence: dict[str, str] = {}
    for file, answers in sorted(read, key=lambda each: each[0].newness):
        replaced = {whence[number] for number in answers if number in whence}
        for older in sorted(replaced):
            student.notes.append(f"{file.file} came after {older}, and counts.")
        whence |= dict.fromkeys(answers, file.file)
        student.answers |= answers
        student.files.append(file.file)
    if not student.files and not student.notes:
        student.notes.append("Nothing was handed in.")
    if len(student.notes) > MOST_NOTES:
        more = len(student.notes) - MOST_NOTES
        student.notes[MOST_NOTES:] = [f"And {more} notes more of this kind."]


def in_order(students: list[Student], listed: list[Listed]) -> list[Student]:
    """Return every student on the list, and then who is not on it; without a list, by name."""
    left = sorted(students, key=lambda each: (each.name.casefold(), each.id))
    rows = []
    for one in listed:
        # Two of one name are told apart by numbers, or not at all.
        alone = sum(other.is_named(one.name) for other in listed) == 1
        mine = [s for s in left if one.has(s.id) or one.has(s.name)] or [
            s for s in left if alone and one.is_named(s.name)
        ]
        if len(mine) == 1:
            student = mine[0]
            left.remove(student)
            student.name, student.id = one.name, one.ids[0] if one.ids else student.id
        else:
            student = Student(one.name, one.ids[0] if one.ids else "")
            student.notes.append("Nothing was handed in under this name.")
        rows.append(student)
    for student in left:
        if listed:
            student.is_listed = False
            student.notes.append("This name is not on the list.")
    return rows + left
