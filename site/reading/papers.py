"""What became of the papers' equations: the pages of the ledger, and a function's part in it.

A page of the ledger is Markdown for MyST, a function's section reStructuredText, as docstrings are.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache

from addresses import section_label, slug
from driftlab.book.ledger import (
    SEVERITIES,
    STATUSES,
    WORKS,
    LedgerEntry,
    ledger_entries,
    place_of,
)
from reading.doors import documented, home


def entry_label(entry: LedgerEntry) -> str:
    """Return the target of links to an entry."""
    return f"ledger-{entry.paper}-{slug(entry.label)}"


def shown_label(entry: LedgerEntry) -> str:
    """Return the number or name of an entry as Markdown, in which a star would mean something."""
    return entry.label.replace("*", r"\*")


def place_label(entry: LedgerEntry) -> str:
    """Return the target of links to the place where the book treats an entry."""
    return section_label(entry.notebook.split("_")[0], entry.section)


@cache
def entries_by_home() -> dict[str, list[LedgerEntry]]:
    """Return the entries that each function computes, by the name of its home."""
    found: dict[str, list[LedgerEntry]] = {}
    for entry in ledger_entries():
        for place in dict.fromkeys(home(name) for name in entry.functions):
            found.setdefault(place, []).append(entry)
    return found


def in_the_papers(place: str) -> list[str]:
    """Return lines on what a function computes of the papers; none if the ledger has nothing."""
    entries = entries_by_home().get(place, [])
    lines = [
        f"- :ref:`{short(entry.paper)}, {entry.label} <{entry_label(entry)}>`, *{entry.status}*: "
        f"{as_rst(entry.says)} "
        f"See :ref:`{place_of(entry)} <{place_label(entry)}>`."
        for entry in entries
    ]
    return ["", ".. rubric:: In the papers", "", *lines, ""] if lines else []


def short(paper: str) -> str:
    """Return the family names of the authors of a work."""
    names = [name.split(" ")[-1] for name in WORKS[paper].authors.split(", ")]
    if paper == "wu":  # Chinese names have the family first
        names = [name.split(" ")[0] for name in WORKS[paper].authors.split(", ")]
    return " and ".join(names) if len(names) < 3 else f"{names[0]} et al."


def as_rst(text: str) -> str:
    """Return Markdown of the ledger as reStructuredText, which marks formulas and code its way."""
    text = re.sub(r"(?<!`)`([^`]+)`(?!`)", r"``\1``", text)
    return re.sub(r"\$([^$]+)\$", r"\\ :math:`\1`\\ ", text)  # letters may stand close to it


def ledger_pages() -> dict[str, str]:
    """Return the text of each page of the ledger by its name without ending."""
    return {"ledger/index": _index()} | {f"ledger/{paper}": _paper(paper) for paper in WORKS}


def _index() -> str:
    counts = []
    for paper, work in WORKS.items():
        statuses = [entry.status for entry in ledger_entries() if entry.paper == paper]
        cells = [f"[{work.authors}]({paper}.md), {work.work}", *map(statuses.count, STATUSES)]
        counts.append(_row([*cells, len(statuses)]))
    return "\n".join(
        [
            "# The equation ledger\n",
            "What became of every equation, table, figure and claim of the four papers, and of "
            "the numbers that others have published with the recordings of chapter 17. Each entry "
            "links to the functions that compute it, and their reference links back.\n",
            _row(["", *STATUSES, "in all"]),
            _row(["---"] * (len(STATUSES) + 2)),
            *counts,
            "",
            *(f"- *{word}*: {meaning}." for word, meaning in (STATUSES | SEVERITIES).items()),
            "",
            "```{toctree}\n:hidden:\n",
            *WORKS,
            "```\n",
        ]
    )


def _row(cells: Sequence[object]) -> str:
    return f"| {' | '.join(map(str, cells))} |"


def _paper(paper: str) -> str:
    work = WORKS[paper]
    entries = [entry for entry in ledger_entries() if entry.paper == paper]
    head = [f"# {short(paper)}: the ledger\n", f"{work}.\n", f"{work.copy}\n"]
    return "\n".join([*head, *(line for entry in entries for line in _entry(entry))])


def _line(line: str) -> str:
    """A line of the copy as it is set, and its letters, by which one finds it in the copy."""
    if "$" in line:
        return f"{line} (`{line}`)"
    if "\\" in line:
        formula = ["$$", rf"\begin{{aligned}} {line} \end{{aligned}}", "$$"]
        return "\n".join(["\n", *(f"  {part}" for part in formula), "", f"  `{line}`"])
    return f"`{line}`" if line else ""


def _entry(entry: LedgerEntry) -> list[str]:
    weight = f", {entry.severity}" if entry.severity else ""
    shown = documented()
    functions = ", ".join(
        f"{{py:obj}}`{shown[home(name)].removeprefix('driftlab.')} <{shown[home(name)]}>`"
        for name in entry.functions
    )
    tests = ", ".join(f"`{test}`" for test in entry.tests)
    facts = {
        "The line, as the copy has it": _line(entry.line),
        "The copy, in the letters of this book": entry.copy,
        "Right": entry.right,
        "Proof": entry.proof,
        "For the authors": entry.in_favour,
        "In the book": f"[{place_of(entry)}, {entry.section}](#{place_label(entry)})",
        "Computed by": functions,
        "Tested by": tests,
    }
    return [
        f"({entry_label(entry)})=",
        f"## {shown_label(entry)}\n",
        f"{entry.says}\n",
        f"*{entry.status.capitalize()}{weight}.* {entry.remark}\n",
        *(f"- **{name}:** {text}" for name, text in facts.items() if text),
        "",
    ]
