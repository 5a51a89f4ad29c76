"""Prints small notebooks and one chapter, for the tests to look at.

``python print_small.py FOLDER`` with the Python of the site; writes JSON of what names mean.
"""

import json
import sys
from pathlib import Path

import nbformat
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output

sys.path.insert(0, str(Path(__file__).parents[2] / "site"))

import paper
from examination import print_examination
from executed import KEPT, notebooks
from pdf.make import Look, make_handout
from unfinished import Unfinished

CHAPTER = "03_systematic_drift.ipynb"
EDITION = "spring, tests"
LONG = "a_long_name = " + "another_name + " * 5 + "a_last_one"
WAITS = "Exercise 3.1: not answered yet."
TEXT = " ".join(["A sentence that is written to fill a page."] * 60)
ASKED = ("03", "notebooks/" + CHAPTER, "lab_sheet", "conventions", "solutions/03", "14", "0", "")


def small(sections: int) -> nbformat.NotebookNode:
    """A notebook with its outputs, of about so many pages."""
    waits = new_output("display_data", {"text/html": f"<div role='status'>{WAITS}</div>"})
    return new_notebook(
        cells=[
            new_markdown_cell(
                "# 03 A title\n\nSee [chapter 04](04_calibration_by_turns.ipynb#Derive)."
            ),
            new_code_cell(LONG, outputs=[new_output("stream", text="what it gave\n")]),
            new_code_cell('answer = ...\ncheck("3.1", answer)', outputs=[waits]),
            *(new_markdown_cell(f"## Section {n}\n\n{TEXT}\n\n{TEXT}") for n in range(sections)),
        ]
    )


def meant(asked: str) -> str:
    try:
        return paper.found(asked, notebooks())
    except Unfinished as trouble:
        return str(trouble)


def main(folder: Path) -> None:
    def make(file: str, notebook: nbformat.NotebookNode, look: Look) -> None:
        make_handout(CHAPTER, notebook, folder, folder / f"{file}.pdf", look)

    make("long", small(12), Look())
    make("short", small(2), Look())
    make("without-code", small(2), Look(with_code=False))
    make("us-letter", small(2), Look(paper="us-letter"))
    if (KEPT / CHAPTER).exists():
        make("chapter", nbformat.read(KEPT / CHAPTER, as_version=4), Look())
    print_examination(EDITION, folder, folder, "a4")
    print(json.dumps({asked: meant(asked) for asked in ASKED}))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
