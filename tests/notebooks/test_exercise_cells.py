"""Whoever comes back to one exercise can do it at once: each of its cells runs alone."""

import ast
import contextlib
import io
import re
from itertools import pairwise
from pathlib import Path

import nbformat
import pytest
from nbformat import NotebookNode
from pages import CHAPTERS, name_of


def exercise_cells(path: Path) -> list[NotebookNode]:
    """The cells of a chapter's exercises, with the introduction."""
    cells = nbformat.read(path, as_version=4).cells
    return [cell for cell in cells if re.match(r"\d\d-exercise", cell.id)]


@pytest.mark.parametrize("path", CHAPTERS, ids=name_of)
def test_cell_of_an_exercise_runs_alone(path: Path) -> None:
    for cell in exercise_cells(path):
        if cell.cell_type == "markdown":
            continue
        if cell.id.endswith("-panel"):  # opening it takes a while; it needs what it imports
            *_, opening = ast.parse(cell.source).body
            assert isinstance(opening, ast.Expr)
            assert re.match(r"from driftlab.book import (\w+)\n\npanel = \1\(", cell.source)
            continue
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            exec(cell.source, {})
        assert said.getvalue().endswith(": not answered yet.\n"), cell.id


def test_exercises_are_introduced_in_the_same_words_everywhere() -> None:
    introductions = {
        re.sub(r"solutions/[\w.]+", "", exercise_cells(path)[0].source) for path in CHAPTERS
    }
    assert len(introductions) == 1


def test_every_slide_exercise_has_its_panel_below_it_but_one_that_shares() -> None:
    without = []
    for path in CHAPTERS:
        cells = exercise_cells(path)
        for cell, after in pairwise(cells):
            if re.match(r"### [\d.]+ Slide", cell.source) and not after.id.endswith("-panel"):
                without.append(cell.source.split()[1])
    assert without == ["7.3"]
