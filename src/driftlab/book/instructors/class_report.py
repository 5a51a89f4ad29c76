"""What a class got wrong: each exercise's slips, counted over a folder of notebooks."""

from __future__ import annotations

import base64
import csv
import hashlib
import io
import re
import warnings
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field
from html import escape
from pathlib import Path

import numpy as np

from driftlab.book.chapters import chapters_with
from driftlab.book.exercises import all_exercises
from driftlab.book.machinery.exercise.answers import NOT_ALL, NOT_ONE, Choice, letters_in
from driftlab.book.machinery.exercise.exercise import Exercise, Said, in_order
from driftlab.book.machinery.exercise.formulas import Formula
from driftlab.book.machinery.exercise.progress import as_text

from .handed_in import Answer, clean, notebooks_in
from .typed_answers import UNREAD

RIGHT, OPEN, NOT_JUDGED = "right", "no answer", "not judged"
MOST_EXAMPLES = 3
MOST_TRIES = 20
"""Answers to one exercise in one notebook; later ones are not judged."""
LONGEST = 60
"""Characters of an example."""
LONGEST_SLIP = 400
HEADER = ("exercise", "notebooks", "of", "what the answers show", "recorded", "examples")
FILES = ("class.html", "class.csv")
FORMULA = re.compile(r"(^\s*|[;\t]\s*\"*)(?=[=+\-@＝＋－＠])")
"""Where a spreadsheet would compute: many countries' begin a cell behind a semicolon."""
REASONED = Said(because="for the class report")
"""With words the reply goes into what was chosen."""
STYLE = """
.class-report { line-height: 1.45; overflow-x: auto }
.class-report table { border-collapse: collapse }
.class-report th, .class-report td {
  padding: 0.2em 0.6em; border: 1px solid rgba(128, 128, 128, 0.4);
  text-align: left; vertical-align: top
}
.class-report td, .class-report li { overflow-wrap: anywhere }
.class-report .count { text-align: right; white-space: nowrap }
.class-report .slip { min-width: 11em }
.class-report .right { background: rgba(0, 158, 115, 0.2) }
.class-report .slip { background: rgba(213, 94, 0, 0.2) }
"""


@dataclass
class Row:
    """What several notebooks show of one exercise."""

    exercise: str
    shows: str  # `RIGHT`, what a wrong answer was told, `OPEN` or `NOT_JUDGED`
    notebooks: int = 0
    of: int = 0  # how many have this exercise
    recorded: int = 0  # of `notebooks`, how many by a value that was recorded and not typed
    examples: list[str] = field(default_factory=list)  # an answer, and the path of its notebook

    @property
    def is_slip(self) -> bool:
        """Whether it is something to speak about."""
        return self.shows not in (RIGHT, OPEN, NOT_JUDGED)


@dataclass(frozen=True, repr=False)
class ClassReport:
    """The slips of a class; the last line of a notebook cell shows it, `print` as text."""

    rows: list[Row]  # by exercise; within one what is right, slips by their number, and the rest
    notebooks: int  # how many were read
    notes: list[str]  # a sentence on each file that could not be read

    def __str__(self) -> str:
        lines = [f"Notebooks read: {self.notebooks}", *self.notes, ""]
        for row in self.rows:
            lines.append(f"{row.exercise:5} {row.notebooks:4} of {row.of:3}  {row.shows}")
        return "\n".join(lines)

    __repr__ = __str__

    def _repr_html_(self) -> str:
        return f'<div class="class-report"><style>{STYLE}</style>\n{_tables(self)}</div>'

    def write(self, folder: str | Path) -> Path:
        """Write class.html and class.csv into a folder, which is made if it is not there.

        Nothing else in the folder changes. An OSError says why a file cannot be written.
        """
        place = Path(folder)
        place.mkdir(parents=True, exist_ok=True)
        for name, content in zip(FILES, (_page(self), _table(self)), strict=True):
            new = place / f".{name}.new"
            new.unlink(missing_ok=True)  # a link that somebody left there
            new.write_bytes(content)
            new.replace(place / name)
        return place


def class_report(folder: str | Path, chapters: str | Iterable[str] | None = None) -> ClassReport:
    """Return how often each slip occurs in the notebooks that a class handed in.

    A literal answer in a cell is read from its text. Otherwise the value that `check` recorded is
    judged again, and counted as recorded. Printed text and recorded verdicts are not believed, and
    nothing in a notebook is run. One notebook counts once in a row.

    Parameters
    ----------
    folder : path
        The notebooks, in folders of any kind; each is named by its path.
    chapters : str or list of str, optional
        As "03,04": exercises of these chapters only, else of all with a call of `check`.

    Raises
    ------
    ValueError
        If there is no such folder, or no such chapter.
    """
    where = Path(folder)
    if not where.is_dir():
        raise ValueError(f"folder: expected a folder with notebooks, got {str(folder)!r}.")
    exercises = _exercises(chapters)
    found, notes = notebooks_in(where)
    rows: dict[tuple[str, str], Row] = {}
    having: Counter[str] = Counter()
    for path, answers in found:
        if not any(each.number in exercises for each in answers):
            notes.append(f"{path}: It has none of these exercises.")
        for number in dict.fromkeys(each.number for each in answers if each.number in exercises):
            having[number] += 1
            for shows, answer in _shown(
                exercises[number], [each for each in answers if each.number == number]
            ).items():
                row = rows.setdefault((number, shows), Row(number, shows))
                row.notebooks += 1
                row.recorded += answer.recorded and shows != NOT_JUDGED
                if len(row.examples) < MOST_EXAMPLES:
                    row.examples.append(_example(answer, path))
    for row in rows.values():
        row.of = having[row.exercise]
    order = {RIGHT: 0, OPEN: 2, NOT_JUDGED: 3}
    ranked = sorted(
        rows.values(),
        key=lambda r: (in_order(r.exercise), order.get(r.shows, 1), -r.notebooks, r.shows),
    )
    return ClassReport(ranked, len(found), notes)


def _exercises(chapters: str | Iterable[str] | None) -> dict[str, Exercise]:
    if chapters is None:
        return all_exercises()
    known = chapters_with("exercises")
    chapters = chapters.split(",") if isinstance(chapters, str) else chapters
    wanted = [str(chapter).strip().zfill(2) for chapter in chapters]
    if strange := [chapter for chapter in wanted if chapter not in known]:
        raise ValueError(
            f"chapters: expected some of {', '.join(known)}, got {', '.join(strange)}."
        )
    return {number: each for c in wanted for number, each in all_exercises(c).items()}


def _shown(exercise: Exercise, answers: list[Answer]) -> dict[str, Answer]:
    """What a notebook shows of an exercise, each with the first answer that shows it.

    Nothing is said of an answer that is missing, or cannot be judged, where there is another one.
    """
    shown: dict[str, Answer] = {}
    for answer in answers[:MOST_TRIES]:
        shown.setdefault(judged(exercise, answer), answer)
    for rest in (OPEN, NOT_JUDGED):
        if len(shown) > 1:
            shown.pop(rest, None)
    return shown


def judged(exercise: Exercise, answer: Answer) -> str:
    """Return `RIGHT`, what is told of a wrong answer, `OPEN` or `NOT_JUDGED`."""
    value, student = answer.value, answer.student
    if value is UNREAD or isinstance(exercise, Formula):
        return OPEN if value is ... or (answer.recorded and value is None) else NOT_JUDGED
    if getattr(exercise, "given", None) is None:
        student = ""
    if student is UNREAD:
        return NOT_JUDGED
    if answer.recorded and isinstance(value, str) and not isinstance(exercise, Choice):
        return NOT_JUDGED  # a function, say, in words
    said = REASONED._replace(student=student)
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            verdict = exercise.verdict(value, said)
    except Exception:  # a recorded value may be anything that JSON can hold
        return NOT_JUDGED
    if verdict.right:
        return RIGHT
    if verdict.right is None:
        return OPEN
    if verdict.word == "not readable":
        # What was typed differs in each notebook, and is among the examples.
        expected = re.sub(r", (?:got|found) '.*", ".", verdict.reason, flags=re.DOTALL)
        return clean(f"Not readable. {expected}", LONGEST_SLIP)
    if isinstance(exercise, Choice):
        letters = value if isinstance(value, str) else " ".join(value)
        reason = "" if verdict.reason.startswith((NOT_ALL, NOT_ONE)) else verdict.reason
        return f"Chose {', '.join(letters_in(letters))}. {reason}".rstrip()
    return clean(verdict.reason, LONGEST_SLIP)


def _example(answer: Answer, path: str) -> str:
    value = getattr(answer.value, "values", answer.value)
    if isinstance(value, str) and value.startswith("<"):
        value = UNREAD  # an object, as Python names it
    text = "" if value is UNREAD else clean(_in_words(value), LONGEST)
    mark = " (recorded)" if answer.recorded else ""
    return f"{text}{mark} — {path}" if text else path


def _in_words(value: object) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{name} = {each}" for name, each in [*value.items()][:8])
    if isinstance(value, str):
        return value
    return "" if value is ... or value is None else as_text(value)


def _cells(row: Row) -> tuple[str, ...]:
    counts = str(row.notebooks), str(row.of), row.shows, str(row.recorded)
    return row.exercise, *counts, " | ".join(row.examples)


def _table(report: ClassReport) -> bytes:
    """The rows as CSV; with the mark that spreadsheets need to see UTF-8."""
    text = io.StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow(HEADER)
    for row in report.rows:
        writer.writerow(FORMULA.sub(r"\1'", cell) for cell in _cells(row))
    return text.getvalue().encode("utf-8-sig")


def _page(report: ClassReport) -> bytes:
    """A page that stands alone; its policy lets no script run and asks for nothing."""
    digest = base64.b64encode(hashlib.sha256(STYLE.encode()).digest()).decode()
    policy = f"default-src 'none'; style-src 'sha256-{digest}'; base-uri 'none'; form-action 'none'"
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        '<meta name="color-scheme" content="light dark">\n'
        f"<title>What a class got wrong</title>\n<style>{STYLE}</style>\n</head>\n<body>\n"
        f'<main class="class-report">\n<h1>What a class got wrong</h1>\n{_tables(report)}</main>\n'
        "</body>\n</html>\n"
    ).encode()


def _tables(report: ClassReport) -> str:
    heads = "".join(f'<th scope="col">{head}</th>' for head in HEADER if head != "of")
    lines = [f"<p>Notebooks read: {report.notebooks}.</p>"]
    # Paths name students: they are folded, so that the page can be projected.
    if report.notes:
        notes = "".join(f"<li><bdi>{escape(note)}</bdi></li>" for note in report.notes)
        lines.append(f"<details><summary>files not counted</summary><ul>{notes}</ul></details>")
    lines.append(f"<table><thead><tr>{heads}</tr></thead><tbody>")
    for row in report.rows:
        kind = "right" if row.shows == RIGHT else "slip" if row.is_slip else "open"
        examples = "".join(f"<div><bdi>{escape(each)}</bdi></div>" for each in row.examples)
        lines.append(
            f'<tr><th scope="row">{escape(row.exercise)}</th>'
            f'<td class="count">{row.notebooks} of {row.of}</td>'
            f'<td class="{kind}"><bdi>{escape(row.shows)}</bdi></td>'
            f'<td class="count">{row.recorded}</td>'
            f"<td><details><summary>show</summary>{examples}</details></td></tr>"
        )
    return "\n".join([*lines, "</tbody></table>\n"])
