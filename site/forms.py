"""What the page's forms must know without Python: files of data, made when the site is built.

Nothing of the right answers is in them.
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import driftlab
from driftlab.book.chapters import CHAPTERS, chapters_with
from driftlab.book.exercises import all_exercises
from driftlab.book.machinery.exercise.answers import Choice, Value
from driftlab.book.machinery.exercise.exercise import Exercise
from driftlab.book.machinery.exercise.guess import UNITS
from driftlab.book.machinery.exercise.puzzle import Number, Question
from driftlab.book.puzzles import puzzle_of

NOTEBOOKS = Path(__file__).resolve().parents[1] / "notebooks"


def write_forms(target: Path) -> None:
    """Write ``exercises.json`` and ``puzzles.json`` into a folder."""
    for name, found in (("exercises", exercise_forms()), ("puzzles", puzzles())):
        data = {"version": driftlab.__version__, name: found}
        (target / f"{name}.json").write_text(json.dumps(data, ensure_ascii=False), "utf-8")


def exercise_forms() -> dict[str, dict[str, Any]]:
    """Return how each exercise is answered, by its number.

    "way" is "letters", "line" or "code", "letters" are those of the statements, "panel" tells
    whether a panel's state is an answer, and "lines" are what a Python answer begins with, where
    one makes sense.
    """
    found = {}
    for chapter in chapters_with("exercises"):
        lines = _lines(chapter)
        for number, exercise in all_exercises(chapter).items():
            found[number] = _form(exercise, lines[number])
    return found


def _form(exercise: Exercise, lines: str) -> dict[str, Any]:
    form: dict[str, Any] = {"way": "code"}
    if isinstance(exercise, Choice):
        form = {"way": "letters", "letters": exercise.letters}
    elif isinstance(exercise, Value):
        form = {"way": "line"}
        if exercise.from_panel:
            form["panel"] = True
    # A cell that brings more than the check is one to compute in.
    if form["way"] == "code" or exercise.kind == "compute" or "import" in lines:
        form["lines"] = lines
    return form


def _lines(chapter: str) -> dict[str, str]:
    """The code of each exercise's cell without its check, by the exercise's number."""
    notebook = json.loads((NOTEBOOKS / f"{CHAPTERS[chapter][2:]}.ipynb").read_text("utf-8"))
    found = {}
    for cell in notebook["cells"]:
        *code, last = "".join(cell["source"]).splitlines() or [""]
        if cell["cell_type"] == "code" and last.startswith('check("'):
            kept = [line for line in code if line != "from driftlab.book import check"]
            found[last.split('"')[1]] = re.sub(r"\n{3,}", "\n\n", "\n".join(kept).strip())
    return found


def puzzles() -> dict[str, dict[str, Any]]:
    """Return what each puzzle asks, and the scales of its guesses, by the chapter's number."""
    found = {}
    for chapter in chapters_with("puzzle"):
        puzzle = puzzle_of(chapter)
        found[chapter] = {"key": puzzle.key, "questions": list(map(_question, puzzle.questions))}
    return found


def _question(question: Question) -> dict[str, Any]:
    if not isinstance(question, Number):
        return {"asks": question.asks, "options": question.options}
    return {
        "asks": question.asks,
        "unit": UNITS.get(question.unit, question.unit),
        "low": question.low,
        "high": question.high,
        "start": question.start,
        "whole": question.whole,
    }
