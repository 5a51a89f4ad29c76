"""The overview of the chapters, and parts of notebooks as pages of their own."""

from __future__ import annotations

import json
import re
from pathlib import Path

from reading.links import with_links
from reading.parts import chapters


def chapters_page(root: Path) -> str:
    """Return the overview of the chapters: rows of the README's table, and what each is about."""
    lines = ["# The chapters\n", "What each is about, and how long it takes with its exercises.\n"]
    for chapter in chapters(root):
        first, *_ = words_of(root / "notebooks" / f"{chapter.page}.ipynb")
        (subject,) = re.findall(r"^\*([^*].*)\*$", first, re.M)
        lines += [f"## [{chapter.number} {chapter.name}]({chapter.page}.ipynb)\n", f"{subject}\n"]
        lines += [f"{chapter.minutes} minutes.\n"]
    return "\n".join(lines)


def words_of(notebook: Path) -> list[str]:
    """Return the text of each cell of a notebook that has text."""
    cells = json.loads(notebook.read_text("utf-8"))["cells"]
    return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown"]


def text_of(root: Path, notebook: str, begin: str, end: str) -> str:
    """Return the words of a notebook from one heading up to another, without its code."""
    text = "\n\n".join(words_of(root / "notebooks" / notebook))
    text = text[text.index(f"{begin}\n") :]
    return f"{with_links(text[: text.index(end)], notebook)}\n"
