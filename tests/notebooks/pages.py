"""The book's notebooks and pages, and what is said in them."""

import re
from pathlib import Path
from typing import NamedTuple

import nbformat
from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_notebook

from driftlab.book import __all__ as BOOK

FOLDER = Path(__file__).parents[2] / "notebooks"
NOTEBOOKS = sorted(
    path for path in FOLDER.rglob("*.ipynb") if ".ipynb_checkpoints" not in path.parts
)
START = FOLDER / "00_start_here.ipynb"
LEDGER = FOLDER / "19_ledger_and_glossary.ipynb"
CHAPTERS = sorted(set(FOLDER.glob("[01][0-9]_*.ipynb")) - {START, LEDGER})
SOLUTIONS = [FOLDER / "solutions" / path.name for path in CHAPTERS]
PAGES = [*NOTEBOOKS, *sorted(FOLDER.rglob("*.md"))]


def name_of(path: Path) -> str:
    """Path of a page within the book."""
    return path.relative_to(FOLDER).as_posix()


def markdown(path: Path) -> str:
    """The text of a notebook or of a page."""
    if path.suffix == ".md":
        return path.read_text(encoding="utf-8")
    cells = nbformat.read(path, as_version=4).cells
    return "\n\n".join(cell.source for cell in cells if cell.cell_type == "markdown")


SLIDE_TYPES = {
    "slide": "Slide",
    "subslide": "Sub-Slide",
    "fragment": "Fragment",
    "-": "-",
    "skip": "Skip",
    "notes": "Notes",
}
"""What a cell may be on the slides, and what JupyterLab calls it."""


def slide_types(notebook: NotebookNode) -> dict[str, str]:
    """What each cell is on the slides; one that does not say it fails, and is told how to."""
    types = {
        cell.id: cell.metadata.get("slideshow", {}).get("slide_type", "") for cell in notebook.cells
    }
    missing = [name for name, shown in types.items() if shown not in SLIDE_TYPES]
    assert not missing, (
        f"no slide type in: {', '.join(missing)}. In JupyterLab choose the cell, open the property "
        "inspector (the two cogs on the right), and set Slide Type: Slide for a heading of level "
        "two, Sub-Slide for a lower one, as over an exercise; Skip for a cell with an answer or a "
        "panel; - for what stays on the slide before. In the file it is "
        '"metadata": {"slideshow": {"slide_type": "subslide"}}.'
    )
    return types


class Size(NamedTuple):
    """What of a chapter is in view, and the minutes that a student alone is expected to need."""

    words: int  # of the text, without the exercises
    lines: int  # of code, without the exercises and the checks of the book
    pictures: int  # figures, panels and scenes
    exercises: int
    asserts: int  # in the lines

    @property
    def minutes(self) -> int:
        """160 words or 20 lines of code a minute, 2 minutes a picture, 6 an exercise; by fives."""
        exact = self.words / 160 + self.lines / 20 + 2 * self.pictures + 6 * self.exercises
        return 5 * round(exact / 5)


PICTURE = re.compile(
    r"^(?:\w+ = )?(?:figure|" + "|".join(name for name in BOOK if name[0].isupper()) + r")\(|!\[",
    re.MULTILINE,
)
"""A figure, a panel or a scene as a cell shows it. (`Table(` is none; it is taken off.)"""


def size_of(path: Path) -> Size:
    """Measure a chapter."""
    words = lines = pictures = exercises = asserts = 0
    for cell in nbformat.read(path, as_version=4).cells:
        if re.match(r"\d\d-exercise", cell.id):
            exercises += cell.source.startswith("### ")
        elif cell.cell_type == "markdown":
            words += len(cell.source.split())
            pictures += len(re.findall(r"!\[", cell.source))
        elif not cell.metadata.get("jupyter", {}).get("source_hidden"):
            lines += len(cell.source.splitlines())
            asserts += len(re.findall(r"^\s*assert\b", cell.source, re.MULTILINE))
            pictures += bool(re.search(PICTURE, re.sub(r"\bTable\(", "", cell.source)))
    return Size(words, lines, pictures, exercises, asserts)


def notebook_of(*cells: str) -> NotebookNode:
    """A notebook of some cells of code, for the kernel of the book."""
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    return new_notebook(
        metadata={"kernelspec": kernel}, cells=[new_code_cell(source) for source in cells]
    )
