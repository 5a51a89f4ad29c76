"""The equation ledger: what became of every equation, table, figure and claim of the four papers.

And of the numbers that others have published with the recordings of chapter 17. The entries are
in the folder ``ledgers``, a file for each paper. The notebook on a paper shows its entries, chapter
19 counts them, and `errata` writes the corrected ones to ERRATA.md.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import NamedTuple

from .machinery.table import Table


class Paper(NamedTuple):
    """One of the four papers, or a work with a recording, and what of it lay before this book."""

    authors: str  # Markdown
    work: str  # Markdown, with its year
    copy: str  # what was read, and in which state it was

    def __str__(self) -> str:
        return f"{self.authors}, {self.work}"


PAPERS = {
    "larin": Paper(
        "V. B. Larin",
        "*On the calibration of a spatial angular-rate meter*, received 1987",
        "A text of the Russian paper that was read by a machine, with damage of its own: a bracket "
        "that is never closed, one prime for the transpose and for the time derivative. It names "
        "neither the journal nor the year; 21 January 1987 is the day on which the editors "
        "received the paper.",
    ),
    "perelyaev-chelnokov": Paper(
        "S. E. Perelyaev, Yu. N. Chelnokov",
        "*New algorithms for determining the inertial orientation of an object*, 2014",
        "A text of the Russian paper that was read by a machine. Greek letters, signs and minus "
        "signs are damaged in it, and it ends at the first word of section 2, so that none of the "
        "algorithms is in it.",
    ),
    "wu": Paper(
        "Wu Huali, Xiao Zhicai, Zhou Dawang, Wang Lingling",
        "on decoupling the installation-error matrices of an inertial navigation system, 2018",
        "A text of the Chinese paper on a web page. The words are there; nearly all equations, the "
        "contents of both tables and all figures are lost, and the list of conclusions breaks off.",
    ),
    "plotnikov": Paper(
        "P. K. Plotnikov, A. V. Mikheev, S. G. Naumov",
        "*Errors of a strapdown gyrocompass for objects with unlimited rotation angles*, after "
        "2012",
        "A text of the Russian paper that was read by a machine, with its formulas; the two "
        "figures are lost. It has no year; its latest reference is of 2012.",
    ),
}
"""The four papers by the name that an entry gives, in the order of the book."""

PUBLISHERS = {
    "imucal": Paper(
        "A. Küderle, N. Roth, R. Richer, B. M. Eskofier",
        "*imucal*, a program, 2022",
        "The program, version 2.6.0, run on its own example session, and its repository.",
    ),
    "imu-tk": Paper(
        "D. Tedaldi, A. Pretto, E. Menegatti",
        "IMU-TK, a program, and its paper, 2014",
        "The program's source, its record of an Xsens MTi, and two outputs on that record, with "
        "two choices of body axes, which others who ran it have made public.",
    ),
    "imu-calib": Paper(
        "A. Mikov, S. Reginya, A. Moschevikin",
        "imu-calib, a program, and its paper, 2020",
        "The repository: source with its history, five records, and a table of five units as a "
        "picture. The paper itself was not read.",
    ),
}
"""Who published recordings with results of their own, in the order of chapter 17."""

WORKS = PAPERS | PUBLISHERS
"""Everything that an entry may be about."""

STATUSES = {
    "reproduced": "derived or computed anew, and equal to the copy",
    "corrected": "what the copy has is wrong, and the right form is proved",
    "reconstructed": (
        "not in the paper, or lost in the copy at hand; built anew from what is said of it"
    ),
    "not recoverable": "cannot be had from the copy at hand, nor built anew from what it says",
}
"""The four words, and what they mean."""

SEVERITIES = {
    "mathematical": (
        "a statement that does not hold as it stands, or not so far as it goes; no character "
        "misread explains it"
    ),
    "possibly the copy's": (
        "a formula or a number that does not hold as the copy has it; a few characters lost, "
        "misread or put in would explain it, so the print may well be right"
    ),
    "reference or sign": (
        "a number of a formula or of a reference, a modulus, the side of a diagonal: it points to "
        "the wrong place, and the copy has it right elsewhere or leaves no doubt of what is meant"
    ),
    "typographical": "a slip of the pen or of the typesetter, which misleads nobody",
}
"""How much a correction weighs, and who may have made the slip."""

KINDS = ("equation", "number", "table", "figure", "claim")


@dataclass(frozen=True, kw_only=True)
class LedgerEntry:
    """What became of one equation, table, figure or claim."""

    paper: str  # one of `WORKS`
    label: str  # the number in the paper, or a short name of a claim
    kind: str  # one of `KINDS`
    says: str  # what it states
    status: str  # one of `STATUSES`
    notebook: str  # the one that treats it, "07_coning" or "papers/larin"
    section: str  # heading in it
    remark: str = ""  # what there is to know of it, if anything
    severity: str = ""  # of a corrected one: one of `SEVERITIES`
    line: str = ""  # of a corrected one: the line as the copy has it, letter for letter
    copy: str = ""  # of a corrected one: what the copy has, in the letters of this book
    right: str = ""  # of a corrected one: what is right
    proof: str = ""  # of a corrected one: how that is proved
    in_favour: str = ""  # of a corrected one: what speaks for the authors, if anything does
    functions: tuple[str, ...] = ()  # what computes it, dotted
    # what would fail if it were wrong: a test, or a cell of a notebook that asserts it
    tests: tuple[str, ...] = ()


@cache
def ledger_entries() -> tuple[LedgerEntry, ...]:
    """Return all entries: paper by paper, and for each in the order of the notebooks."""
    folder = Path(__file__).parent / "ledgers"
    found = [
        LedgerEntry(**entry | {key: tuple(entry.get(key, ())) for key in ("functions", "tests")})
        for path in folder.glob("*.toml")
        for entry in tomllib.loads(path.read_text(encoding="utf-8"))["entry"]
    ]
    return tuple(sorted(found, key=lambda entry: list(WORKS).index(entry.paper)))


def paper_table(paper: str) -> Table:
    """Return all entries of one paper, with where to find each in the book.

    Parameters
    ----------
    paper : str
        One of `WORKS`.

    Raises
    ------
    ValueError
        If it is another.
    """
    return Table(
        [
            ("", "what it states", "status", "in the book", "computed and tested by"),
            *(
                (
                    _bold(entry.label),
                    entry.says,
                    _status(entry),
                    f"{place_of(entry)}, *{entry.section}*",
                    _names(entry),
                )
                for entry in _entries_of(paper)
            ),
        ]
    )


def place_of(entry: LedgerEntry) -> str:
    """Return the notebook of an entry in words: "chapter 07", or "the paper, read closely"."""
    number = entry.notebook[:2]
    return f"chapter {number}" if number.isdigit() else "the paper, read closely"


def summary_table() -> Table:
    """Return how many entries of each paper have which status."""
    rows = []
    for name, paper in WORKS.items():
        statuses = [entry.status for entry in _entries_of(name)]
        counts = [statuses.count(status) for status in STATUSES]
        rows.append((str(paper), *map(str, counts), str(sum(counts))))
    return Table([("", *STATUSES, "in all"), *rows])


def _entries_of(paper: str) -> list[LedgerEntry]:
    if paper not in WORKS:
        raise ValueError(f"paper: expected one of {', '.join(WORKS)}, got {paper!r}.")
    return [entry for entry in ledger_entries() if entry.paper == paper]


def _bold(label: str) -> str:
    """A label in bold letters; a star in it is none of Markdown's."""
    return "**" + label.replace("*", r"\*") + "**"


def _status(entry: LedgerEntry) -> str:
    """The status, with what is right or to be known of it."""
    correction = f"in the copy {entry.copy}; right is {entry.right}." if entry.copy else ""
    more = " ".join(filter(None, [correction, entry.in_favour, entry.remark]))
    status = f"*{entry.status}*" + (f" ({entry.severity})" if entry.severity else "")
    return f"{status}: {more}" if more else status


def _names(entry: LedgerEntry) -> str:
    """Functions and tests, folded away: their names are long."""
    names = [*entry.functions, *entry.tests]
    if not names:
        return ""
    count = f"{len(entry.tests)} test{'s' * (len(entry.tests) != 1)}"
    return f"<details><summary>{count}</summary>{'<br>'.join(names)}</details>"
