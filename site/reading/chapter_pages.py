"""What the reading version has of the notebooks: an overview of the chapters, and the appendices.

The chapters themselves are notebooks. Whatever links to a chapter, or to a section of it, finds its
place on the overview, by the labels ``chapter-03`` and ``chapter-03-the-worst-axis``.
"""

from __future__ import annotations

import json
import re
from itertools import groupby
from pathlib import Path
from urllib.parse import unquote

from driftlab.book.ledger import LedgerEntry, ledger_entries
from reading.doors import aliases, documented
from reading.papers import entry_label, section_label, short, shown_label

ROW = re.compile(r"^\| (\d\d) \| \[([^\]]+)\]\([^)]*\)(.*?) \| (\d+) \|(.*?)\|$", re.M)
"""A chapter in the table of README.md: number, name, more, minutes, source."""
PUBLISHED = {"ERRATA.md": "/errata.md", "conventions.ipynb": "/conventions.md"}
"""Where a file that the notebooks link to stands on the site; of chapters, on their overview."""


def chapters_page(root: Path) -> str:
    """Return the overview of the chapters."""
    rows = ROW.findall((root / "README.md").read_text("utf-8"))
    head = (
        "# The chapters\n\nNotebooks, which run on your own computer: `python3 lab.py` in the "
        "project's folder opens them. Here stands what each is about, how long it takes, and "
        "which statements of the papers it derives, computes or refutes.\n"
    )
    return "\n".join([head, *(_chapter(root, *row) for row in rows)])


def _chapter(root: Path, number: str, name: str, more: str, minutes: str, source: str) -> str:
    """A chapter of the table in the README; what the notebook says of itself tells more."""
    (path,) = (root / "notebooks").glob(f"{number}_*.ipynb")
    words = words_of(path)
    summary = re.search(r"^\*([^*].*)\*$", words[0], re.M)
    subject = summary[1] if summary else f"{more.lstrip(': ').capitalize()}."
    origin = f" From {source.strip()}." if source.strip() else ""
    entries = [entry for entry in ledger_entries() if entry.chapter == number]
    there = {entry.section: section_label(entry) for entry in entries}
    sections = sorted(there.items(), key=lambda item: "\n".join(words).index(f"# {item[0]}\n"))
    lines = [f"(chapter-{number})=\n## {number} {name}\n", f"{subject}\n"]
    lines.append(f"{minutes} minutes with its exercises.{origin}\n")
    for section, label in sections:
        found = [entry for entry in entries if entry.section == section]
        lines += [f"({label})=\n### {section}\n", *_derived(found), ""]
    return "\n".join(lines)


def _derived(entries: list[LedgerEntry]) -> list[str]:
    """A line for each work that a section treats, with its entries."""
    lines = []
    for paper, group in groupby(entries, key=lambda entry: entry.paper):
        links = (f"[{shown_label(entry)}](#{entry_label(entry)})" for entry in group)
        lines.append(f"- {short(paper)}: {', '.join(links)}")
    return lines


def words_of(notebook: Path) -> list[str]:
    """Return the text of each cell of a notebook that has text."""
    cells = json.loads(notebook.read_text("utf-8"))["cells"]
    return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown"]


def text_of(root: Path, notebook: str, begin: str = "", end: str = "") -> str:
    """Return the words of a notebook without its code, as a page.

    Parameters
    ----------
    root : Path
        The project's folder.
    notebook : str
        Its name.
    begin, end : str
        Headings to begin with, and to stop before; of the whole if they are empty.
    """
    text = "\n\n".join(words_of(root / "notebooks" / notebook))
    text = text[text.index(f"{begin}\n") if begin else 0 :]
    return f"{with_links(text[: text.index(end) if end else None])}\n"


def with_links(text: str) -> str:
    """Return Markdown of a notebook, its links and names led to where things stand on the site."""

    def led(match: re.Match[str]) -> str:
        target = match[1]
        path, _, fragment = target.partition("#")
        name = Path(path).name
        chapter = re.match(r"(\d\d)_.*\.ipynb$", name)
        if chapter:
            return f"](#chapter-{chapter[1]})"
        if not name:
            # Jupyter's address of a heading has its commas and capitals, MyST's has not.
            heading = unquote(fragment).lower().replace(" ", "-")
            return f"](#{re.sub('[^a-z0-9_-]', '', heading)})"
        if Path(name).suffix in (".ipynb", ".md"):
            return f"]({PUBLISHED.get(name, '/chapters.md')})"
        return match[0]

    def named(match: re.Match[str]) -> str:
        return f"{{py:obj}}`{match[1]}`" if match[1] in public else match[0]

    public = {*documented().values(), *aliases()}
    text = re.sub(r"(?<!`)`(driftlab\.[\w.]+)`(?!`)", named, text)
    return re.sub(r"\]\((?!https?:)([^)\s]+)\)", led, text)
