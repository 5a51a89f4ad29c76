"""The exercises of a chapter as a notebook of their own, with room to write."""

from __future__ import annotations

import re

from nbformat import NotebookNode
from nbformat.v4 import new_markdown_cell, new_notebook

from driftlab.book.instructors.questions import outside_a_notebook
from driftlab.book.machinery.exercise.exercise import NUMBER
from pdf.cells import call, typst

SECTION = re.compile(r"## ")
EXERCISES = "## Exercises"
EXERCISE = re.compile(rf"### {NUMBER.pattern} (\w+)")
ROOM = {"Compute": 200.0}
"""Points, by the kind of an exercise."""
LESS_ROOM = 120.0
LETTERS = "- (a) "


def sheet(notebook: NotebookNode) -> NotebookNode | None:
    """Return the exercises of a chapter; None if it has none.

    What introduces them speaks of a screen and is left out, and so are panels, which need one;
    hints stand in no cell. Of the cells for answers there is what they give to begin with.
    """
    title, *cells = notebook.cells
    found: list[NotebookNode] = []
    end: list[NotebookNode] = []
    is_among_them = False
    for cell in cells:
        if cell.cell_type == "markdown" and SECTION.match(cell.source):
            is_among_them = cell.source.startswith(EXERCISES)
        elif is_among_them:
            if begun := EXERCISE.match(cell.source):
                found += [*end, _words(typst("#block(breakable: false)["))]
                end = [_words(f"{_room(begun[1], cell.source)}\n\n{typst(']')}")]
            if cell.cell_type == "markdown":
                found.append(_words(outside_a_notebook(cell.source)))
            elif "answer = ..." in cell.source:
                found.append(cell)
    if not end:
        return None
    heading = title.source.splitlines()[0]
    made: NotebookNode = new_notebook(cells=[_words(f"{heading}: exercises"), *found, *end])  # type: ignore[no-untyped-call]
    return made


def _room(kind: str, text: str) -> str:
    words = "Your answer, and how you found it:"
    if kind == "Slide":
        words = "Your answer, found with the panel in the notebook or on the web page:"
    elif LETTERS in text:
        words = "Tick them, and say why:"
    return call("room", words, ROOM.get(kind, LESS_ROOM))


def _words(text: str) -> NotebookNode:
    cell: NotebookNode = new_markdown_cell(text)  # type: ignore[no-untyped-call]
    return cell
