"""The numbered equations of the papers as places in the chapters, and links to them.

An equation of the ledger stands where the chapter sets it with its number; else at the cell of its
section that proves it, which the ledger names; else at the section's heading.
"""

from __future__ import annotations

import re
from functools import cache
from itertools import takewhile

from nbformat import NotebookNode

from driftlab.book.ledger import LedgerEntry, ledger_entries
from reading.papers import equation_label

HEADING = re.compile(r"^#+ (.+)$", re.M)
NUMBERS = re.compile(r"[:,] ((?:\([\d.]+\)(?:, | to )?)+)$")
"""What a heading names at its end: "The bend and its names: (2.4), (2.5)"."""
PROTECTED = re.compile(
    r"\$\$.*?\$\$|\$[^$]*\$|`[^`]*`|!?\[[^\]]*\]\([^)]*\)|^#.*$|^\(.*\)=$", re.M | re.S
)
"""Formulas, code, links, headings and targets, in which no number becomes a link."""
MENTION = re.compile(r"(?<![\w)\]])\(\d+(?:\.\d+)?\)(?![\w(])")


@cache
def equations() -> dict[str, list[LedgerEntry]]:
    """Return the entries with the number of an equation, by the number of their chapter."""
    found: dict[str, list[LedgerEntry]] = {}
    for entry in ledger_entries():
        if equation_label(entry):
            found.setdefault(entry.chapter, []).append(entry)
    return found


def add_targets(cells: list[NotebookNode], chapter: str) -> None:
    """Write the targets of a chapter's equations into its cells; a cell of code has them in its
    metadata, for Markdown alone can hold them.
    """
    for entry in equations().get(chapter, ()):
        target = f"({equation_label(entry)})="
        tag = f"\\tag{{{entry.label.strip('()')}}}"
        proofs = {test.rpartition("::")[2] for test in entry.tests}
        begin, section = _section(cells, _heading(cells, entry))
        for cell in section:
            if cell.cell_type == "markdown" and tag in cell.source:
                start = cell.source.rindex("$$", 0, cell.source.index(tag))
                cell.source = f"{cell.source[:start]}{target}\n{cell.source[start:]}"
                break
            if cell.cell_type == "code" and cell.id in proofs:
                cell.metadata.setdefault("targets", []).append(target)
                break
        else:
            first = section[0]
            first.source = f"{first.source[:begin]}{target}\n{first.source[begin:]}"


def _heading(cells: list[NotebookNode], entry: LedgerEntry) -> str:
    """The heading that names an equation, or that of the section in which the ledger has it."""
    text = "\n".join(cell.source for cell in cells if cell.cell_type == "markdown")
    named = ((heading, NUMBERS.search(heading)) for heading in HEADING.findall(text))
    found = (heading for heading, numbers in named if numbers and entry.label in numbers[1])
    return next(found, entry.section)


def _section(cells: list[NotebookNode], heading: str) -> tuple[int, list[NotebookNode]]:
    """Where a heading stands in its cell, and the cells up to the next heading."""
    for index, cell in enumerate(cells):
        if cell.cell_type == "markdown":
            for found in HEADING.finditer(cell.source):
                if found[1] == heading:
                    rest = takewhile(_continues, cells[index + 1 :])
                    return found.start(), [cell, *rest]
    raise ValueError(f"The ledger names a section that no chapter has: {heading}.")


def _continues(cell: NotebookNode) -> bool:
    return cell.cell_type == "code" or not HEADING.search(cell.source)


def with_mentions(text: str, chapter: str) -> str:
    """Return Markdown of a chapter in which the numbers of its paper's equations are links.

    A chapter on one paper means that paper by a number alone; in the others numbers stay text.
    """
    papers = {entry.paper for entry in equations().get(chapter, ())}
    if len(papers) != 1:
        return text
    known = {
        entry.label: equation_label(entry)
        for entries in equations().values()
        for entry in entries
        if entry.paper in papers
    }

    def linked(match: re.Match[str]) -> str:
        return f"[{match[0]}](#{known[match[0]]})" if match[0] in known else match[0]

    parts, last = [], 0
    for found in PROTECTED.finditer(text):
        parts += [MENTION.sub(linked, text[last : found.start()]), found[0]]
        last = found.end()
    return "".join([*parts, MENTION.sub(linked, text[last:])])
