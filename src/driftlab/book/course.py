"""What a module description needs, read from the chapters, so that it cannot drift from them.

Every chapter says under *What you will be able to do* what its reader can do afterwards, what it
needs, and how long it takes. Here these lines become learning outcomes, with verbs that can be
examined and their rung on Bloom's ladder, and hours that become credits.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import NamedTuple

from .chapters import CHAPTERS
from .machinery.table import Table

LADDER = ("remember", "understand", "apply", "analyse", "evaluate", "create")
"""After Bloom, as Anderson and Krathwohl revised it; the highest rung last."""
VERBS = {
    "remember": "recognise",
    "understand": "explain say read follow",
    "apply": "write find expand solve make measure turn integrate start compute remove calibrate "
    "simulate navigate carry predict count",
    "analyse": "derive split take tell compare show test distinguish determine",
    "evaluate": "choose weigh judge decide ask",
    "create": "design",
}
"""What the chapters' outcomes begin with, by rung."""
NOT_EXAMINED = ("see",)
"""Verbs of what happens to a reader, which nobody can mark."""
HEADING = "## What you will be able to do"
LINES = re.compile(r"^- (.*?)[;.]$", re.M)
NEEDS = re.compile(r"^You need: (.*?)\. About (\d+) minutes", re.M)


class Outcome(NamedTuple):
    """What a student can do after a chapter, and how high on Bloom's ladder that stands."""

    text: str
    rung: str


class Chapter(NamedTuple):
    """What a chapter promises."""

    outcomes: tuple[Outcome, ...]  # in the chapter's order
    needs: str  # what a student should bring
    minutes: int  # for a student alone, with the exercises


def promises(folder: str | Path = ".") -> dict[str, Chapter]:
    """Return what the chapters promise, by number."""
    found = {}
    for number, name in CHAPTERS.items():
        path = Path(folder) / f"{name.removeprefix('ch')}.ipynb"
        cells = json.loads(path.read_text("utf-8"))["cells"] if path.is_file() else []
        texts = ("".join(cell["source"]) for cell in cells)
        for text in texts:
            if text.startswith(HEADING) and (needs := NEEDS.search(text)):
                outcomes = tuple(_outcomes(LINES.findall(text)))
                found[number] = Chapter(outcomes, needs[1], int(needs[2]))
    if not found:
        raise ValueError(f"folder: expected the book's notebooks, found none in {str(folder)!r}.")
    return found


def outcomes_table(chapters: Mapping[str, Chapter], most: int = 4) -> Table:
    """Return each chapter's first outcome, and those of the others that stand highest."""
    rows = [("chapter", "after it a student can", "on Bloom's ladder")]
    for number, chapter in chapters.items():
        first, *others = chapter.outcomes
        others.sort(key=lambda each: -LADDER.index(each.rung))
        kept = (first, *others[: most - 1])
        rows += [(number, *each) for each in chapter.outcomes if each in kept]
    return Table(rows)


def hours_table(
    routes: Mapping[str, Iterable[str]], more: float = 0.0, folder: str | Path = "."
) -> Table:
    """Return the hours of some choices of chapters, and the credit points (ECTS) they make.

    `more` are hours for revision and the examination, for each choice.
    """
    header = ("course", "chapters", "alone", "slides", "lab", "hours in all", "credit points")
    rows: list[tuple[str, ...]] = [header]
    minutes = times(folder)
    for name, numbers in routes.items():
        chosen = sorted(numbers)
        hours = [sum(each) / 60 for each in zip(*(minutes[n] for n in chosen), strict=True)]
        total = sum(hours) + more
        credits = f"{total / 30:.1f} to {total / 25:.1f}"
        rows.append((name, ", ".join(chosen), *(f"{h:.0f}" for h in (*hours, total)), credits))
    return Table(rows)


def times(folder: str | Path = ".") -> dict[str, tuple[int, int, int]]:
    """Return the minutes of each chapter: alone, of its slides, of its lab.

    They are taken from the table in ``for_instructors.ipynb``.
    """
    cells = json.loads((Path(folder) / "for_instructors.ipynb").read_text("utf-8"))["cells"]
    (table,) = (text for cell in cells if "| alone |" in (text := "".join(cell["source"])))
    rows = re.findall(r"^\| (\d\d) [^|]*\| (\d+) \| (\d+|–) \| (\d+|–) \|", table, re.M)
    return {
        number: (int(alone), _minutes(slides), _minutes(lab)) for number, alone, slides, lab in rows
    }


def _minutes(cell: str) -> int:
    return 0 if cell == "–" else int(cell)


def _outcomes(lines: Iterable[str]) -> Iterable[Outcome]:
    for line in lines:
        text = _in_the_third_person(_examined(line))
        verb = re.split(r"\W", text)[0]
        if verb not in NOT_EXAMINED:
            yield Outcome(text, rung_of(verb))


def rung_of(verb: str) -> str:
    """Return the rung on which a verb stands."""
    for rung, verbs in VERBS.items():
        if verb in verbs.split():
            return rung
    raise ValueError(f"verb: {verb!r} is not on the ladder; enter it in VERBS of book/course.py.")


def _examined(line: str) -> str:
    """With a verb that a module description may have: nobody marks what a student "says"."""
    line = re.sub(r"^say\b", "explain", line)
    line = re.sub(r"^tell apart\b", "distinguish", line)
    return re.sub(r"^tell\b", "distinguish" if " from " in line else "determine", line)


def _in_the_third_person(line: str) -> str:
    return re.sub(r"\b[Yy]our\b", "their", re.sub(r"\byou\b", "they", line))
