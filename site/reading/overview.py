"""The overview of the chapters, and parts of notebooks as pages of their own."""

from __future__ import annotations

import json
import re
from itertools import groupby
from pathlib import Path

from driftlab.book.ledger import LedgerEntry, ledger_entries
from reading.links import with_links
from reading.papers import entry_label, place_label, short, shown_label
from reading.parts import Chapter, chapters


def chapters_page(root: Path) -> str:
    """Return the overview of the chapters."""
    head = (
        "# The chapters\n\nWhat each is about, how long it takes, and which statements of the "
        "papers it derives, computes or refutes.\n"
    )
    return "\n".join([head, *(_chapter(root, chapter) for chapter in chapters(root))])


def _chapter(root: Path, chapter: Chapter) -> str:
    """A chapter of the table in the README; what the notebook says of itself tells more."""
    words = words_of(root / "notebooks" / f"{chapter.page}.ipynb")
    (subject,) = re.findall(r"^\*([^*].*)\*$", words[0], re.M)
    entries = [entry for entry in ledger_entries() if entry.chapter == chapter.number]
    there = {entry.section: place_label(entry) for entry in entries}
    sections = sorted(there.items(), key=lambda item: "\n".join(words).index(f"# {item[0]}\n"))
    lines = [f"## [{chapter.number} {chapter.name}]({chapter.page}.ipynb)\n", f"{subject}\n"]
    lines.append(f"{chapter.minutes} minutes with its exercises.\n")
    for section, label in sections:
        found = [entry for entry in entries if entry.section == section]
        lines += [f"- [{section}](#{label}): {_derived(found)}"]
    return "\n".join([*lines, ""])


def _derived(entries: list[LedgerEntry]) -> str:
    """The entries that a section treats, work by work."""
    works = []
    for paper, group in groupby(entries, key=lambda entry: entry.paper):
        links = (f"[{shown_label(entry)}](#{entry_label(entry)})" for entry in group)
        works.append(f"{short(paper)}, {', '.join(links)}")
    return "; ".join(works)


def words_of(notebook: Path) -> list[str]:
    """Return the text of each cell of a notebook that has text."""
    cells = json.loads(notebook.read_text("utf-8"))["cells"]
    return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown"]


def text_of(root: Path, notebook: str, begin: str, end: str) -> str:
    """Return the words of a notebook from one heading up to another, without its code."""
    text = "\n\n".join(words_of(root / "notebooks" / notebook))
    text = text[text.index(f"{begin}\n") :]
    return f"{with_links(text[: text.index(end)], notebook)}\n"
