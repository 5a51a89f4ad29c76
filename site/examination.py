"""An examination on paper: the sheet for the class and the scheme for who marks it, two files."""

from __future__ import annotations

import re
from pathlib import Path

from nbformat import NotebookNode
from nbformat.v4 import new_markdown_cell, new_notebook

from driftlab.book.instructors.examination import exam_paper
from pdf.make import Look, make_handout

NAME = "instructors/examination.ipynb"
"""The notebook that shows both; printed as one file, it would give the class the answers."""
TITLE = re.compile(r"\A\*\*(.+?)\.\*\* ")
ROOM_FOR_NAME = re.compile(r"\n\nName: _[^\n]*")
"""The printed sheet has lines of its own for it."""


def print_examination(edition: str, build: Path, folder: Path, paper: str) -> list[Path]:
    """Print both of an edition; the files, which bear the mark of the sheet.

    Parameters
    ----------
    edition : str
        The text from which the numbers are drawn.
    build, folder : Path
        Where to work, and where to put them.
    paper : str
        As in `Look`.

    Raises
    ------
    ValueError
        If the edition is empty.
    Unfinished
        As in `make_handout`.
    """
    exam = exam_paper(edition)
    targets = []
    for kind, page in (("examination", exam.sheet()), ("scheme", exam.scheme())):
        targets.append(
            folder / f"examination-{exam.mark}-{kind.replace('examination', 'sheet')}.pdf"
        )
        make_handout(NAME, document(page.text), build, targets[-1], Look(paper, kind=kind))
    return targets


def document(text: str) -> NotebookNode:
    """Return a sheet or a scheme as a notebook with a title."""
    titled = ROOM_FOR_NAME.sub("", TITLE.sub(r"# \1\n\n", text), count=1)
    made: NotebookNode = new_notebook(cells=[new_markdown_cell(titled)])  # type: ignore[no-untyped-call]
    return made
