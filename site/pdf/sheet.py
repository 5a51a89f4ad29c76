"""The exercises of a chapter as a notebook of their own, with room to write."""

from __future__ import annotations

import re

from nbformat import NotebookNode
from nbformat.v4 import new_markdown_cell, new_notebook

from driftlab.book.instructors.questions import outside_a_notebook
from driftlab.book.machinery.exercise.exercise import NUMBER
from pdf.cells import call, typst
from unfinished import Unfinished

EXERCISE = re.compile(rf"### {NUMBER.pattern} (\w+)")
ROOM = {"Compute": 200.0}
"""Points, by the kind of an exercise."""
LESS_ROOM = 120.0


def sheet(notebook: NotebookNode) -> NotebookNode:
    """Return the exercises of a chapter without their panels and hints.

    Of a cell for an answer only what is given in it is kept; it need not be run.
    """
    title, *cells = notebook.cells
    found = [_words(f"{title.source.splitlines()[0]}: exercises")]
    end: list[NotebookNode] = []
    is_among_them = False
    for cell in cells:
        if cell.cell_type == "markdown" and cell.source.startswith("## "):
            is_among_them = cell.source.startswith("## Exercises")
        elif is_among_them:
            if begun := EXERCISE.match(cell.source):
                found += [*end, _words(typst("#block(breakable: false)["))]
                words = "Your answer, and how you found it:"
                if "- (a) " in cell.source:
                    words = "Tick the letters, and say why:"
                room = call("room", words, ROOM.get(begun[1], LESS_ROOM))
                end = [_words(f"{room}\n\n{typst(']')}")]
            if cell.cell_type == "markdown":
                found.append(_words(outside_a_notebook(cell.source)))
            elif "answer = ..." in cell.source:
                found.append(cell)
    if not end:
        raise Unfinished(f"{title.source.splitlines()[0]} has no exercises.")
    made: NotebookNode = new_notebook(cells=[*found, *end])  # type: ignore[no-untyped-call]
    return made


def _words(text: str) -> NotebookNode:
    cell: NotebookNode = new_markdown_cell(text)  # type: ignore[no-untyped-call]
    return cell
