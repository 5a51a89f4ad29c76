"""Prints two small notebooks and an examination, for the tests.

``python print_small.py FOLDER`` with the Python of the site; writes JSON of what it was told.
"""

import io
import json
import sys
from contextlib import redirect_stderr
from pathlib import Path

import nbformat
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output

sys.path.insert(0, str(Path(__file__).parents[2] / "site"))

import paper
from examination import print_examination
from executed import notebooks
from pdf.make import Look, make_handout

CHAPTER = "03_systematic_drift.ipynb"
EDITION = "spring, tests"
LONG = "a_long_name = " + "another_name + " * 5 + "a_last_one"
TEXT = " ".join(["A sentence that is written to fill a page."] * 60)
WAITS = "<div role='status'>Exercise 3.1: not answered yet.</div>"
ASKED = ("03", f"notebooks/{CHAPTER}", "lab_sheet", "solutions/03")
REFUSED = (
    ["20"],
    ["--exercises"],
    ["19", "--exercises"],
    ["0"],
    ["instructors/examination"],
    ["--edition", " "],
    ["03", "--edition", "autumn"],
)


def small(sections: int) -> nbformat.NotebookNode:
    """A notebook with its outputs, of about so many pages."""
    gave, waits = (
        new_output("stream", text="what it gave\n"),
        new_output("display_data", {"text/html": WAITS}),
    )
    title = "# 03 A title\n\nSee [chapter 04](04_calibration_by_turns.ipynb#Derive)."
    cells = [
        new_markdown_cell(title),
        new_code_cell(LONG, outputs=[gave]),
        new_code_cell('answer = ...\ncheck("3.1", answer)', outputs=[waits]),
    ]
    texts = (f"## Section {n}\n\n{TEXT}\n\n{TEXT}" for n in range(sections))
    return new_notebook(cells=[*cells, *map(new_markdown_cell, texts)])


def refusal(arguments: list[str]) -> str:
    """What is said of a command line that prints nothing."""
    with redirect_stderr(io.StringIO()) as said:
        assert paper.main(arguments) == 1
    return said.getvalue()


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    for name, notebook, look in (
        ("long", small(9), Look()),
        ("short", small(2), Look(paper="us-letter", with_code=False)),
    ):
        make_handout(CHAPTER, notebook, folder, folder / f"{name}.pdf", look)
    sheet = paper.sheet(nbformat.read(paper.FOLDER / CHAPTER, as_version=4))
    make_handout(CHAPTER, sheet, folder, folder / "exercises.pdf", Look(kind="exercises"))
    print_examination(EDITION, folder, folder, "a4")
    found = {asked: paper.found(asked, notebooks()) for asked in ASKED}
    print(json.dumps({"found": found, "refusals": [*map(refusal, REFUSED)]}))
