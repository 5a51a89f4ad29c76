"""The executed notebooks as pages: what MyST-NB reads of them.

Each keeps its name, so links between notebooks hold. Headings of chapters become places to link to,
and what JupyterLab folds is folded. `outputs` says what becomes of outputs.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from copy import deepcopy
from typing import Any, NamedTuple

import nbformat
from nbformat import NotebookNode
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from addresses import PDF, live_address, section_label, slug
from reading.folds import FOLDED
from reading.links import with_links
from reading.outputs import Outputs, has_room
from reading.parts import Chapter
from reading.pictures import Pictures
from reading.solutions import link_back

COLLAPSED = "jp-MarkdownHeadingCollapsed"
"""JupyterLab's mark at a cell whose section is folded."""
HEADING = re.compile(r"^(#+) (.+)$", re.M)
IN_A_NOTEBOOK = '<details class="in-a-notebook"><summary>In a notebook, this is the cell</summary>'


class NotebookPages(NamedTuple):
    """The pages of all notebooks."""

    texts: dict[str, str]  # what MyST-NB reads, by the name of the file
    pictures: Pictures


def notebook_pages(
    notebooks: Mapping[str, NotebookNode], chapters: Sequence[Chapter]
) -> NotebookPages:
    """Return the pages of all notebooks."""
    pictures, texts = Pictures(), {}
    known = {f"{chapter.page}.ipynb": chapter for chapter in chapters}
    for name, notebook in notebooks.items():
        folder, _, file = name.rpartition("/")
        chapter = known.get(file)
        number = chapter.number if chapter else ""
        outputs = Outputs(pictures, name.removesuffix(".ipynb"), number)
        cells = deepcopy(notebook.cells)
        if folder == "solutions":
            link_back(cells, number)
        elif chapter or folder:
            _add_places(cells, number or name.removesuffix(".ipynb").split("_")[0])
        cells = [*_shown(cells, name, outputs)]
        if folder != "solutions":
            _add_ways(cells[0], name, chapter)
        # Without the state of its widgets, which live in a kernel only.
        metadata = {"kernelspec": notebook.metadata["kernelspec"]}
        page = new_notebook(cells=cells, metadata=metadata)  # type: ignore[no-untyped-call]
        texts[name] = nbformat.writes(page)  # type: ignore[no-untyped-call]
    return NotebookPages(texts, pictures)


def _add_places(cells: list[NotebookNode], number: str) -> None:
    """Make headings of a chapter places to link to."""
    for cell in cells:
        if cell.cell_type == "markdown":
            cell.source = HEADING.sub(
                lambda found: f"({_place(found, number)})=\n{found[0]}", cell.source
            )


def _place(heading: re.Match[str], number: str) -> str:
    return f"chapter-{slug(number)}" if heading[1] == "#" else section_label(number, heading[2])


def _shown(cells: list[NotebookNode], name: str, outputs: Outputs) -> Iterator[NotebookNode]:
    """What a page has of the cells: links and outputs as the site has them, folds marked."""
    for cell in cells:
        if cell.cell_type == "code":
            cell.outputs = outputs.shown(cell)
        else:
            cell.source = with_links(cell.source, name)
            if cell.metadata.get(COLLAPSED):
                cell.source = HEADING.sub(rf"\g<0>\n\n% {FOLDED}\n", cell.source, count=1)
        cell.metadata.clear()
        if cell.cell_type == "code" and has_room(cell.outputs):
            yield from _asking(cell)
        else:
            yield cell


def _asking(cell: NotebookNode) -> Iterator[NotebookNode]:
    """The room for an answer, and below it, folded, the cell that takes it in a notebook."""
    yield _cell("code", cell.source, outputs=cell.outputs, metadata={"tags": ["remove-input"]})
    yield _cell("markdown", IN_A_NOTEBOOK)
    yield _cell("code", cell.source)
    yield _cell("markdown", "</details>")


def _cell(kind: str, source: str, **more: Any) -> NotebookNode:
    make = new_code_cell if kind == "code" else new_markdown_cell
    return make(source, **more)  # type: ignore[no-untyped-call]


def _add_ways(first: NotebookNode, name: str, chapter: Chapter | None) -> None:
    """Say below the title how long a chapter takes, and how else one can have the notebook."""
    ways = [f"{chapter.minutes} minutes"] if chapter else []
    up = "../" * name.count("/")
    ways += [
        f'<a href="{up}{live_address(name)}">Run the whole notebook live</a>',
        f'<a href="{up}{PDF}">The book as PDF</a>',
    ]
    line = f'<p class="ways">{" · ".join(ways)}</p>'
    first.source = HEADING.sub(rf"\g<0>\n\n{line}\n", first.source, count=1)
