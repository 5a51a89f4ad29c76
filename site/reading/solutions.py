"""Worked solutions: pages of their own, and the links between them and the exercises."""

from __future__ import annotations

import re
from collections.abc import Sequence

from nbformat import NotebookNode

from addresses import section_label
from driftlab.book.machinery.exercise.exercise import NUMBER

HEADING = re.compile(rf"^## (({NUMBER.pattern}) .+)$", re.M)


def solution_label(number: str) -> str:
    """Return the target of links to the solution of an exercise."""
    return f"solution-{number.replace('.', '-')}"


def link_to_solution(number: str, page: str) -> str:
    """Return what stands below an exercise."""
    address = f"{page}#{solution_label(number)}"
    return f'<p><a class="reference internal" href="{address}">Worked solution</a></p>'


def link_back(cells: Sequence[NotebookNode], chapter: str) -> None:
    """Make each solution a place to link to, and lead from it to its exercise."""

    def linked(heading: re.Match[str]) -> str:
        exercise = f"[To the exercise](#{section_label(chapter, heading[1])})"
        return f"({solution_label(heading[2])})=\n{heading[0]}\n\n{exercise}"

    for cell in cells:
        if cell.cell_type == "markdown":
            cell.source = HEADING.sub(linked, cell.source)
