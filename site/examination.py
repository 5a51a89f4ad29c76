"""An examination on paper: the sheet for the class and the scheme for who marks it, two files."""

from __future__ import annotations

import re
from pathlib import Path

from nbformat import NotebookNode
from nbformat.v4 import new_markdown_cell, new_notebook

from driftlab.book.instructors.examination import exam_paper
from pdf.cells import typst
from pdf.make import Look, make_handout

NAME = "instructors/examination.ipynb"
"""The notebook that shows both; printed as one file, it would give the class the answers."""
TITLE = re.compile(r"\A\*\*(.+?)\.\*\* ")
ROOM_FOR_NAME = re.compile(r"\n\nName: _[^\n]*")
"""The printed sheet has lines of its own for it."""
NUMBER = re.compile(r"(?<=^### )(\d+\.) ", re.M)
"""Of a question; with a space of the usual kind behind it the heading would be a list of one."""
QUESTION = re.compile(r"^### .*?(?=\n\n### |\Z)", re.M | re.S)
PART = re.compile(r"^\*\*\([a-z]\)\*\* .*?(?=\n\n(?:\*\*\(|### )|\Z)", re.M | re.S)


def print_examination(edition: str, build: Path, folder: Path, paper: str) -> list[Path]:
    """Print sheet and scheme of an edition; return the files, which bear the mark of the sheet."""
    exam = exam_paper(edition)
    targets = []
    for kind, name, text in (
        ("examination", "sheet", _together(QUESTION, "1.7em", exam.sheet().text)),
        ("scheme", "scheme", _together(PART, "auto", exam.scheme().text)),
    ):
        targets.append(folder / f"examination-{exam.mark}-{name}.pdf")
        make_handout(NAME, document(text), build, targets[-1], Look(paper, kind=kind))
    return targets


def document(text: str) -> NotebookNode:
    """Return a sheet or a scheme as a notebook with a title."""
    titled = ROOM_FOR_NAME.sub("", TITLE.sub(r"# \1\n\n", text), count=1)
    titled = NUMBER.sub("\\1\u00a0", titled)
    made: NotebookNode = new_notebook(cells=[new_markdown_cell(titled)])  # type: ignore[no-untyped-call]
    return made


def _together(what: re.Pattern[str], above: str, text: str) -> str:
    """Whole questions on a page, or of longer ones at least each part."""
    begin, end = typst(f"#block(breakable: false, above: {above})["), typst("]")
    return what.sub(lambda found: f"{begin}\n\n{found[0]}\n\n{end}", text)
