"""The book's notebooks and pages, and what is said in them."""

from pathlib import Path

import nbformat
from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_notebook

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


def notebook_of(*cells: str) -> NotebookNode:
    """A notebook of some cells of code, for the kernel of the book."""
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    return new_notebook(
        metadata={"kernelspec": kernel}, cells=[new_code_cell(source) for source in cells]
    )
