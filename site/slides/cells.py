"""What of a chapter stands on its slides.

Pictures stand in for panels and scenes. What the book folds stays out, except for the answer to the
puzzle; so do the cells that only check the book, links into its folder, and the solutions. What a
lecturer says comes as notes.
"""

from __future__ import annotations

import re
import tomllib
from base64 import b64encode
from copy import copy
from html import escape
from pathlib import Path

from nbformat import NotebookNode
from nbformat.v4 import new_markdown_cell, new_output

from driftlab.book.instructors.questions import outside_a_notebook
from executed import FOLDER

NOTES: dict[str, str] = tomllib.loads(Path(__file__).with_name("notes.toml").read_text("utf-8"))
"""What a lecturer may ask and say, by the id of the cell at which to say it."""
FOLDED = "jp-MarkdownHeadingCollapsed"
"""JupyterLab's mark at a cell whose section is folded."""
ANSWER = "### Guessed?"
"""How the folded answer to the puzzle begins."""
HEADING = re.compile(r"(#+) ")
LINK = re.compile(r"(?<!!)\[([^]]*)\]\((?!https?:)[^)\s]*\)")
PICTURE = re.compile(r"!\[([^]]*)\]\(([^)\s]*\.svg)\)")
IN_A_NOTEBOOK = re.compile(r"Put your answer in place of the three dots .*?\[Worked .*?\)\.", re.S)
"""How to answer an exercise, which a reader needs and a class does not."""
FOLDING = re.compile(
    r"(?:^|(?<=[.?] ))(?=[A-Z])[^.?]*\b(?:[Uu]nfold|[Ff]olded)\b[^.?]*\.(?: |$)", re.M
)
"""A sentence on what is folded in the book."""
WIDGET = "application/vnd.jupyter.widget-view+json"
LIVE = '<figcaption class="live">Live in the book.</figcaption>'
STILL = re.compile(r'<style>.*?</style><figure class="driftlab-still".*?(<img.*?>).*', re.S)


def on_slides(notebook: NotebookNode) -> NotebookNode:
    """Return a chapter, with its outputs, as its slides have it; the notebook stays as it is."""
    shown: list[NotebookNode] = []
    folded = 0  # the level of the heading that is folded
    for cell in notebook.cells:
        heading = HEADING.match(cell.source) if cell.cell_type == "markdown" else None
        level = len(heading[1]) if heading else 0
        if level and (not folded or level <= folded):
            hidden = cell.metadata.get(FOLDED) and not cell.source.startswith(ANSWER)
            folded = level if hidden else 0
        kind = cell.metadata.get("slideshow", {}).get("slide_type", "-")
        if kind == "subslide" and not heading:
            kind = "-"  # which slide it comes to is a matter of room
        panel = kind == "skip" and "-exercise-" not in cell.id and has_still(cell)
        if folded or (kind == "skip" and not panel):
            continue
        made = _code(cell) if cell.cell_type == "code" else _text(cell)
        made.metadata["slideshow"] = {"slide_type": "-" if panel else kind}
        shown.append(made)
        if cell.id in NOTES:
            shown.append(_cell(NOTES[cell.id], "notes"))
    made = copy(notebook)
    made.cells = shown
    return made


def has_still(cell: NotebookNode) -> bool:
    """Return whether a cell shows a panel or a scene, which left a picture of itself."""
    outputs = cell.get("outputs", [])
    return any(STILL.fullmatch(each.get("data", {}).get("text/html", "")) for each in outputs)


def _text(cell: NotebookNode) -> NotebookNode:
    source = outside_a_notebook(cell.source)
    for left_out in (IN_A_NOTEBOOK, FOLDING):
        source = left_out.sub("", source)
    source = PICTURE.sub(_inlined, LINK.sub(r"\1", source))
    made = copy(cell)
    made.source, made.metadata = source, copy(cell.metadata)
    return made


def _inlined(picture: re.Match[str]) -> str:
    """A picture of the book's figures, in the page itself."""
    raw = b64encode((FOLDER / picture[2]).read_bytes()).decode()
    return f'<img alt="{escape(picture[1])}" src="data:image/svg+xml;base64,{raw}">'


def _code(cell: NotebookNode) -> NotebookNode:
    outputs: list[NotebookNode] = []
    for output in cell.outputs:
        data = output.get("data", {})
        if still := STILL.fullmatch(data.get("text/html", "")):
            html = f"<figure>{still[1]}{LIVE}</figure>"
            outputs.append(new_output("display_data", {"text/html": html}))  # type: ignore[no-untyped-call]
        elif WIDGET in data and "text/html" not in data:
            continue  # the panel itself, whose still follows
        elif output.output_type == "stream" and not output.text.strip():
            continue  # the line that a progress bar leaves
        elif formula := data.get("text/latex"):
            # As two formulas, of which the second may go to a line of its own.
            apart = formula.replace(r"\quad\checkmark", r"$ $\displaystyle\quad\checkmark")
            outputs.append(new_output("display_data", {"text/latex": apart}))  # type: ignore[no-untyped-call]
        elif outputs and output.output_type == outputs[-1].output_type == "stream":
            both = copy(output)
            both.text = outputs[-1].text + output.text
            outputs[-1] = both
        else:
            outputs.append(output)
    # A call that only shows a panel tells a class nothing.
    made = copy(cell)
    made.outputs, made.metadata = outputs, copy(cell.metadata)
    made.metadata["aside"] = has_still(cell)
    return made


def text_slide(source: str, kind: str) -> NotebookNode:
    """Return a text of a written slide, its pictures within it."""
    return _cell(PICTURE.sub(_inlined, source.strip()), kind)


def picture_of(cell: NotebookNode) -> NotebookNode:
    """Return what a cell of the chapter shows, without its code."""
    made = _code(cell)
    made.metadata["slideshow"], made.metadata["aside"] = {"slide_type": "-"}, True
    return made


def note(said: str) -> NotebookNode:
    """Return what a lecturer may say at a slide."""
    return _cell(said, "notes")


def _cell(source: str, kind: str) -> NotebookNode:
    metadata = {"slideshow": {"slide_type": kind}}
    cell: NotebookNode = new_markdown_cell(source, metadata=metadata)  # type: ignore[no-untyped-call]
    return cell
