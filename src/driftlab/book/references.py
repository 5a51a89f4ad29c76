"""What the book cites: each book, paper and standard once.

The entries are in ``references.toml``. The notebooks quote them letter for letter; the
bibliography lists all.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from .machinery.table import Table


@dataclass(frozen=True, kw_only=True)
class Reference:
    """A book, a paper or a standard."""

    key: str  # name of the entry
    authors: str  # initials and surnames, as far as they could be checked
    title: str = ""  # empty if it could not be checked
    about: str = ""  # of what it treats, where the title is missing
    where: str = ""  # journal with its volume, or edition and publisher
    year: int = 0  # 0 if it could not be checked
    doi: str = ""  # empty if none was seen

    def __str__(self) -> str:
        """As it stands in the notebooks, in Markdown."""
        title = f"*{self.title}*" if self.title else self.about
        return ", ".join(filter(None, [self.authors, title, self.where, str(self.year or "")]))


@cache
def all_references() -> tuple[Reference, ...]:
    """Return all entries, by author and year."""
    text = Path(__file__).with_suffix(".toml").read_text(encoding="utf-8")
    return tuple(Reference(**entry) for entry in tomllib.loads(text)["reference"])


def references_table() -> Table:
    """Return all entries with their digital identifiers."""
    return Table([("", "DOI"), *((str(entry), _link(entry.doi)) for entry in all_references())])


def _link(doi: str) -> str:
    return f"[{doi}](https://doi.org/{doi})" if doi else ""
