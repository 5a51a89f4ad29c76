"""The report of a class as files: CSV for spreadsheets and platforms, HTML to read and to print."""

from __future__ import annotations

import csv
import io
import re
import shutil
import tempfile
from collections.abc import Iterable
from pathlib import Path

from .class_results import ClassResults
from .found_files import REPORT
from .report_page import page
from .students import Student

FORMULA = ("=", "+", "-", "@", "\t", "\r", "＝", "＋", "－", "＠")
"""A cell that begins so a spreadsheet would compute."""
BEHIND = re.compile(r"([;\t])(?=[\s\"]*[=+\-@＝＋－＠])")
"""Where spreadsheets of many countries begin a cell, although the file has commas."""
MARKS = {"right": "1", "wrong": "0", "error": "0", "open": "0"}
"""In the gradebook; what was not run or not handed in stays blank, which is no grade."""


def write_report(report: ClassResults, folder: Path) -> Path:
    """Write all files, or none; see `ClassReport.write`."""
    try:
        _expect_a_place(folder)
        folder = folder.resolve()  # a link leads to where the report is
    except (OSError, RuntimeError) as error:
        raise _cannot(folder, error) from None
    contents = {name: _csv(rows(report)) for name, rows in TABLES.items()}
    contents["report.html"] = page(report).encode()
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        new = Path(tempfile.mkdtemp(prefix=f".{folder.name}-", dir=folder.parent))
        try:
            for name, content in contents.items():
                (new / name).write_bytes(content)
            new.chmod(0o755)
            earlier = new.with_name(f"{new.name}-earlier")
            if folder.exists():
                folder.rename(earlier)
            new.rename(folder)
            shutil.rmtree(earlier, ignore_errors=True)
        finally:
            shutil.rmtree(new, ignore_errors=True)
    except OSError as error:
        raise _cannot(folder, error) from None
    return folder


def _expect_a_place(folder: Path) -> None:
    """Refuse a folder that holds anything else than a report."""
    if not folder.exists():
        return
    if not folder.is_dir():
        raise ValueError(f"folder: {str(folder)!r} is not a folder.")
    if others := sorted({path.name for path in folder.iterdir()} - set(REPORT)):
        raise ValueError(
            f"folder: {str(folder)!r} holds other files than a report ({others[0]!r} is one); "
            "choose another folder."
        )


def _cannot(folder: Path, error: Exception) -> ValueError:
    why = getattr(error, "strerror", None) or error
    return ValueError(f"folder: {str(folder)!r} cannot be written ({why}).")


def defused(cell: object) -> str:
    """Return a cell that a spreadsheet shows and does not compute."""
    text = BEHIND.sub(r"\1'", str(cell))
    return f"'{text}" if text.lstrip(" ").startswith(FORMULA) else text


def _csv(rows: Iterable[Iterable[object]]) -> bytes:
    """The bytes of a table; with the mark that spreadsheets need to see UTF-8."""
    text = io.StringIO(newline="")
    csv.writer(text).writerows([defused(cell) for cell in row] for row in rows)
    return text.getvalue().encode("utf-8-sig")


def _gradebook(report: ClassResults) -> Iterable[Iterable[object]]:
    yield ("student", "id", "right", "of", "attempts", *report.exercises)
    for student in report.students:
        yield (
            student.name,
            student.id,
            _right(student, report),
            len(report.exercises),
            student.attempts(report.exercises),
            *(MARKS.get(student.status(number), "") for number in report.exercises),
        )


def _right(student: Student, report: ClassResults) -> int | str:
    """How many are right; blank, like the exercises themselves, where there is nothing to mark."""
    has_any = any(student.status(number) in MARKS for number in report.exercises)
    return student.right(report.exercises) if has_any else ""


def _statuses(report: ClassResults) -> Iterable[Iterable[object]]:
    yield ("student", "id", *report.exercises, "files", "notes")
    for student in report.students:
        yield (
            student.name,
            student.id,
            *(student.status(number) for number in report.exercises),
            "; ".join(student.files),
            " ".join(student.notes),
        )


def _slips(report: ClassResults) -> Iterable[Iterable[object]]:
    yield ("exercise", "slip", "students", "who")
    for slip in report.slips:
        yield slip.exercise, slip.says, len(slip.students), "; ".join(slip.students)


def _words(report: ClassResults) -> Iterable[Iterable[object]]:
    yield ("exercise", "student", "id", "status", "words")
    for number in report.exercises:
        for student in report.students:
            answer = student.answers.get(number)
            if answer and answer.because:
                yield number, student.name, student.id, answer.status, answer.because


TABLES = {
    "gradebook.csv": _gradebook,
    "statuses.csv": _statuses,
    "slips.csv": _slips,
    "words.csv": _words,
}
