"""ERRATA.md and docs/papers.md, written from the equation ledger.

The first has what the copies of the four papers have wrong; the second leads from each figure,
equation, table and number of the papers to where it is here.
"""

from __future__ import annotations

from pathlib import Path
from pkgutil import resolve_name

from .figures import figure_definitions
from .ledger import PAPERS, SEVERITIES, LedgerEntry, ledger_entries
from .machinery.table import Table


def errata() -> str:
    """Return the text of ERRATA.md: what the copies have wrong, what is right, and the proof."""
    corrected = [entry for entry in ledger_entries() if entry.status == "corrected"]
    slips = [entry for entry in corrected if entry.severity == "typographical"]
    return "\n".join(
        [
            "# Errata of the four papers",
            "",
            "What Drift Lab found to be wrong in the copies of four papers, with the right form "
            "and its proof. Written by `python -m driftlab.book errata` from the equation ledger; "
            "do not edit. The whole ledger, with what was reproduced, reconstructed and not "
            "recoverable, is chapter 19 of the book.",
            "",
            "## What was read",
            "",
            "No print of any of the four papers was at hand. A proof below shows that *the text at "
            "hand* is wrong; it does not show that the journal or the author was. Whoever has a "
            "print is asked to compare.",
            "",
            *(f"- **{paper.authors}.** {paper.copy}" for paper in PAPERS.values()),
            "",
            "## How much each weighs",
            "",
            *_errata_counts(corrected),
            "",
            *(line for paper in PAPERS for line in _errata_of(paper, corrected)),
            "## Typographical, set apart",
            "",
            *(_slip(entry) for entry in slips),
            "",
        ]
    )


def _errata_counts(corrected: list[LedgerEntry]) -> list[str]:
    """A table: how many corrections of each severity, and what the word means."""
    labels = {
        severity: [entry for entry in corrected if entry.severity == severity]
        for severity in SEVERITIES
    }
    rows = [
        ("severity", "how many", "meaning"),
        *((severity, str(len(labels[severity])), SEVERITIES[severity]) for severity in SEVERITIES),
    ]
    return Table(rows)._repr_markdown_().splitlines()


def _errata_of(paper: str, corrected: list[LedgerEntry]) -> list[str]:
    """The section of one paper, without what is set apart as typographical."""
    lines = [f"## {PAPERS[paper]}", ""]
    for entry in corrected:
        if entry.paper == paper and entry.severity != "typographical":
            lines += [
                f"### {entry.label}",
                "",
                entry.says,
                "",
                f"- Severity: {entry.severity}.",
                f"- The copy's line: `{entry.line}`",
                f"- It says: {entry.copy}",
                f"- Right: {entry.right}",
                f"- Proof: {entry.proof}",
                *([f"- In the authors' favour: {entry.in_favour}"] if entry.in_favour else []),
                f"- Where: {_where(entry)}",
                "",
            ]
    return lines


def _slip(entry: LedgerEntry) -> str:
    return (
        f"- **{PAPERS[entry.paper].authors}, {entry.label}.** `{entry.line}` "
        f"In the copy: {entry.copy}. Right: {entry.right}. {entry.proof}"
    )


def _where(entry: LedgerEntry) -> str:
    tests = ", ".join(f"`{test}`" for test in entry.tests)
    place = f"`{entry.notebook}.ipynb`, *{entry.section}*"
    return f"{place}; checked by {tests}." if tests else f"{place}."


def papers_page() -> str:
    """Return the text of docs/papers.md: what makes each figure, equation and number here."""
    lines = [
        "# From the papers to this book",
        "",
        "Where each figure, equation, table and number of the four papers is in this book, and "
        "the command that makes or checks it. Written by `python -m driftlab.book papers` from "
        "the ledger; do not edit. Claims in words are in the notebooks on the papers.",
        "",
    ]
    for name, paper in PAPERS.items():
        rows = [("in the paper", "status", "in this book", "command")]
        for entry in ledger_entries():
            if entry.paper == name and entry.kind != "claim":
                page = f"[{Path(entry.notebook).name}](../notebooks/{entry.notebook}.ipynb)"
                place = f"{page}, *{entry.section}*"
                rows.append((entry.label, entry.status, place, _command(entry)))
        lines += [f"## {paper}", "", *Table(rows)._repr_markdown_().splitlines(), ""]
    return "\n".join(lines)


def _command(entry: LedgerEntry) -> str:
    """What draws a figure, or checks anything else: a test, or else the whole notebook."""
    if entry.kind in ("figure", "table"):
        for name, definition in figure_definitions().items():
            if any(resolve_name(each) is definition.compute for each in entry.functions):
                return f"`python3 lab.py figures {name}`"
    test = next((test for test in entry.tests if test.startswith("tests/")), "")
    return f"`python3 lab.py test {test}`" if test else "run the notebook"
