"""The book's notebooks and pages, and what is said in them."""

from pathlib import Path

import nbformat
from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_notebook

FOLDER = Path(__file__).parents[2] / "notebooks"
NOTEBOOKS = sorted(
    path for path in FOLDER.rglob("*.ipynb") if ".ipynb_checkpoints" not in path.parts
)
CHAPTERS = sorted(FOLDER.glob("0[1-9]_*.ipynb")) + sorted(FOLDER.glob("1[013]_*.ipynb"))
START = FOLDER / "00_start_here.ipynb"
LEDGER = FOLDER / "12_ledger_and_glossary.ipynb"
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


def notebook_of(*cells: str) -> NotebookNode:
    """A notebook of some cells of code, for the kernel of the book."""
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    return new_notebook(
        metadata={"kernelspec": kernel}, cells=[new_code_cell(source) for source in cells]
    )
