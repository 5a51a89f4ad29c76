"""Slides that are written, not cut from a chapter: five to eight, one idea each.

A Markdown file for each chapter that has them. Slides are divided by ``---``; ``{cell-id}`` shows
what that cell of the chapter shows; what follows ``Notes:`` is for the speaker view.
"""

from __future__ import annotations

import re
from copy import copy
from pathlib import Path

from nbformat import NotebookNode

from slides.cells import note, picture_of, text_slide

FOLDER = Path(__file__).with_name("written")
SHOWN = re.compile(r"^\{([\w-]+)\}$", re.M)


def written_slides(notebook: NotebookNode, number: str) -> NotebookNode | None:
    """Return the written slides of an executed chapter; None if it has none."""
    path = FOLDER / f"{number}.md"
    if not path.exists():
        return None
    by_id = {cell.id: cell for cell in notebook.cells}
    cells: list[NotebookNode] = []
    for slide in path.read_text("utf-8").split("\n---\n"):
        text, _, said = slide.partition("\nNotes:\n")
        first, *rest = SHOWN.split(text.strip())
        cells.append(text_slide(first, "slide"))
        for place, part in enumerate(rest):
            if place % 2 == 0:
                cells.append(picture_of(by_id[part]))
            elif part.strip():
                cells.append(text_slide(part, "-"))
        cells.append(note(said.strip()))
    made = copy(notebook)
    made.cells = cells
    return made
