"""A round of nbgrader: what a class hands in gets the marks that it should.

nbgrader stands in an environment of its own; the kernel that runs the notebooks is the book's.
"""

import json
import os
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import nbformat
import numpy as np
import pytest
from nbformat.v4 import new_code_cell, new_notebook

import driftlab
from driftlab.book import given
from driftlab.drift import earth_rate_offset

UV = [sys.executable, "-m", "uv", "tool", "run", "--quiet", "--from", "nbgrader==0.9.5"]
NOTEBOOKS = Path(__file__).parents[2] / "notebooks"
GRADEBOOK = """\
import json
from nbgrader.api import Gradebook
with Gradebook("sqlite:///gradebook.db") as book:
    handed_in = book.assignment_submissions("sheet")
    print(json.dumps({
        one.student.id: {grade.cell.name: grade.score for grade in one.notebooks[0].grades}
        for one in handed_in
    }))
"""
ASKED = ("largest_drift = ...", "map_values = ...", "earth = ...")
MARKED = {  # with the points for it
    "strict": (
        "from driftlab.book import check\n\n"
        'check("3.2", largest_drift, because="a reason", strict=True)',
        5,
    ),
    "in-parts": (
        "from driftlab.book import verdict\n\n"
        'found = verdict("3.1", map_values)\n'
        "parts = [part for row in found.parts for part in row]\n"
        "6 if found.right else 6 * sum(parts) / max(len(parts), 1)",
        6,
    ),
    "own-numbers": (
        "from driftlab.book import verdict\n\n"
        "### BEGIN HIDDEN TESTS\n"
        'assert verdict("5.1", earth, student=student).right\n'
        "### END HIDDEN TESTS",
        4,
    ),
}


def earth_of(student: str) -> float:
    """What is right in 4.6 with the numbers of a student."""
    numbers = given("5.1", student=student)
    offset = earth_rate_offset(*np.radians([numbers["latitude"], numbers["table_rate"]]))
    return float(np.degrees(offset)) * 3600


CLASS = {  # what each student types where nbgrader has put its three lines
    "ada": [
        "largest_drift = 129.6",
        "map_values = [1, 1, -1, 0, 0, 0.5]",
        f"earth = {earth_of('Ada')}",
    ],
    "bob": [  # two thirds of the drift; four of six values; the numbers of the book
        "largest_drift = 86.4",
        "map_values = [1, -1, -1, 0, 0, 0]",
        f"earth = {earth_of('')}",
    ],
    "cyd": [  # does not answer, but knows Python
        "def check(*_, **__): ...\n\n\nlargest_drift = 1",
        "map_values = ...",
        "earth = ...",
    ],
}
MARKS = {"ada": [5, 6, 4], "bob": [0, 4, 0], "cyd": [0, 0, 0]}


def test_marks_of_right_wrong_and_missing_answers(tmp_path: Path) -> None:
    if ask(tmp_path, "nbgrader", "--version").returncode:
        pytest.skip("nbgrader cannot be fetched.")
    prepare(tmp_path)
    done(tmp_path, "nbgrader", "generate_assignment", "sheet", "--create")
    sheet = (tmp_path / "release/sheet/problem.ipynb").read_text("utf-8")
    assert 'check(\\"3.2\\"' in sheet
    assert "5.1" not in sheet, "the number of a hidden test"
    for who, typed in CLASS.items():
        notebook = nbformat.reads(sheet, 4)
        notebook.cells[0].source = f"student = {who.title()!r}"
        for cell, source in zip(notebook.cells[1::2], typed, strict=True):
            cell.source = source
        folder = tmp_path / "submitted" / who / "sheet"
        folder.mkdir(parents=True)
        nbformat.write(notebook, folder / "problem.ipynb")
    done(tmp_path, "nbgrader", "autograde", "sheet", "--create")
    marks = json.loads(done(tmp_path, "python", "-c", GRADEBOOK))
    assert {who: [scores[name] for name in MARKED] for who, scores in marks.items()} == MARKS


def test_an_archive_of_moodle_is_collected_and_two_of_one_name_stay_apart(tmp_path: Path) -> None:
    """With the lines that ``for_instructors.ipynb`` gives for the configuration."""
    if ask(tmp_path, "nbgrader", "--version").returncode:
        pytest.skip("nbgrader cannot be fetched.")
    page = nbformat.read(NOTEBOOKS / "for_instructors.ipynb", as_version=4)
    (lines,) = (
        found[0]
        for cell in page.cells
        if (found := re.search(r"^c\.FileNameCollectorPlugin.*?^\)$", cell.source, re.M | re.S))
    )
    (tmp_path / "nbgrader_config.py").write_text(f"c = get_config()\n{lines}\n")
    (tmp_path / "release/sheet").mkdir(parents=True)
    nbformat.write(new_notebook(), tmp_path / "release/sheet/problem.ipynb")
    students = ["Ada Lovelace_51001", "Ada Lovelace_51002", "Zoë van 't Hoff_51003"]
    archive = tmp_path / "downloaded/sheet/archive/all.zip"
    archive.parent.mkdir(parents=True)
    with zipfile.ZipFile(archive, "w") as packed:
        for who in students:
            name = f"{who}_assignsubmission_file_/problem.ipynb"
            packed.write(tmp_path / "release/sheet/problem.ipynb", name)
    done(tmp_path, "nbgrader", "zip_collect", "sheet")
    collected = (tmp_path / "submitted").glob("*/sheet/problem.ipynb")
    assert sorted(path.parts[-3] for path in collected) == students


def prepare(course: Path) -> None:
    """Write the assignment, and a kernel that has the book."""
    kernel = course / "jupyter/kernels/book/kernel.json"
    kernel.parent.mkdir(parents=True)
    command = [sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"]
    kernel.write_text(json.dumps({"argv": command, "display_name": "book", "language": "python"}))
    (course / "nbgrader_config.py").write_text("c = get_config()\n")
    cells = [new_code_cell('student = "your name"')]
    every = {"schema_version": 3, "task": False, "grade": False, "solution": False, "locked": False}
    for (name, (code, points)), line in zip(MARKED.items(), ASKED, strict=True):
        answer = every | {"grade_id": f"answer-{name}", "solution": True}
        test = every | {"grade_id": name, "grade": True, "locked": True, "points": points}
        cells.append(new_code_cell(line, metadata={"nbgrader": answer}))
        cells.append(new_code_cell(code, metadata={"nbgrader": test}))
    notebook = new_notebook(cells=cells)
    notebook.metadata.kernelspec = {"name": "book", "display_name": "book", "language": "python"}
    (course / "source/sheet").mkdir(parents=True)
    nbformat.write(notebook, course / "source/sheet/problem.ipynb")


def ask(course: Path, *command: str) -> subprocess.CompletedProcess[str]:
    """Run a program of nbgrader's environment in the folder of the course."""
    package = str(Path(driftlab.__file__).parents[1])
    around = {**os.environ, "JUPYTER_PATH": str(course / "jupyter"), "PYTHONPATH": package}
    return subprocess.run(
        [*UV, *command], capture_output=True, encoding="utf-8", cwd=course, env=around, timeout=900
    )


def done(course: Path, *command: str) -> str:
    """What a command prints that has to go well."""
    finished = ask(course, *command)
    assert finished.returncode == 0, finished.stdout + finished.stderr
    return finished.stdout
