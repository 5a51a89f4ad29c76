"""What a class handed in: one row a student, and the slips that many have made."""

from __future__ import annotations

from pathlib import Path

from driftlab.book.chapters import chapters_with
from driftlab.book.exercises import all_exercises
from driftlab.book.machinery.exercise.exercise import in_order as numbered

from .class_results import ClassResults, Slip
from .folders import files_in
from .handed_in import handed_in
from .own_numbers import compare_numbers
from .plain_text import clean
from .report_files import write_report
from .report_page import fragment
from .report_text import text_of
from .roster import once, read_roster
from .same_work import compare_work
from .students import Student, in_order, students_of

MOST_EXERCISES = 200
"""That are not the book's: more are no teacher's."""


class ClassReport(ClassResults):
    """What a class handed in; the last line of a notebook cell shows it, `print` as text."""

    def __str__(self) -> str:
        return text_of(self)

    __repr__ = __str__

    def _repr_html_(self) -> str:
        return fragment(self)

    def write(self, folder: str | Path) -> Path:
        """Write the report's files into a folder of their own, instead of an earlier report.

        They are gradebook.csv, statuses.csv, slips.csv, words.csv and report.html. A folder that
        holds anything else raises ValueError.
        """
        return write_report(self, Path(folder))


def class_report(folder: str | Path, roster: str | Path | None = None) -> ClassReport:
    """Return what the notebooks that a class handed in say of the exercises.

    Parameters
    ----------
    folder : path
        A folder with what a learning platform gives (Moodle, Canvas, nbgrader), with exports of
        the web pages, or with a folder a student; archives (zip) in it are read in memory. Or one
        archive.
    roster : path, optional
        A list of the class as a CSV file. Then who handed in nothing has a row as well, and who is
        not on the list is marked.

    Returns
    -------
    ClassReport
        Nothing in a submission is run. What cannot be read is told, and never stops the report.

    Raises
    ------
    ValueError
        If there is no such folder, or the roster cannot be read.
    """
    where = Path(folder)
    listed, repeated = once(read_roster(roster) if roster is not None else [])
    files, notes = handed_in(files_in(where), listed)
    students = in_order(students_of(files), listed)
    compare_numbers(students, listed)
    compare_work(students)
    exercises, strange = _exercises(students)
    if not students:
        notes.append("Nothing was handed in.")
    return ClassReport(
        clean(where.absolute().name, 100) or "class",
        students,
        exercises,
        _slips(students, exercises),
        notes + repeated + strange,
    )


def _exercises(students: list[Student]) -> tuple[list[str], list[str]]:
    """The columns of the report, and a sentence on numbers that become none."""
    touched: dict[str, int] = {}
    for student in students:
        for number in student.answers:
            touched[number] = touched.get(number, 0) + 1
    book: list[str] = []
    for chapter in chapters_with("exercises"):
        if any(number.split(".")[0].zfill(2) == chapter for number in touched):
            known = all_exercises(chapter)
            book += known if touched.keys() & known.keys() else ()
    active = sum(bool(student.answers) for student in students)
    # Anyone can write a number into a notebook; a teacher's exercise was given to several.
    own = {n for n, count in touched.items() if n not in book and (count > 1 or active == 1)}
    ranked = sorted(own, key=lambda number: (-touched[number], numbered(number)))
    notes = []
    for left_out, why in (
        (touched.keys() - set(book) - own, "in the notebooks of one student only"),
        (ranked[MOST_EXERCISES:], f"beyond the {MOST_EXERCISES} that most students have"),
    ):
        if left_out:
            strange = sorted(left_out, key=numbered)
            shown = ", ".join(strange[:5]) + (" ..." if len(strange) > 5 else "")
            notes.append(f"Not in the book, and {why}, so without a column: {shown}.")
    return book + sorted(ranked[:MOST_EXERCISES], key=numbered), notes


def _slips(students: list[Student], exercises: list[str]) -> list[Slip]:
    told: dict[tuple[str, str], list[str]] = {}
    for student in students:
        for number in exercises:
            answer = student.answers.get(number)
            for says in answer.slips if answer else ():
                told.setdefault((number, says), []).append(student.name)
    slips = [Slip(number, says, tuple(names)) for (number, says), names in told.items()]
    return sorted(slips, key=lambda slip: (-len(slip.students), numbered(slip.exercise), slip.says))
