"""The chapters and their parts, as the table in README.md has them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import groupby
from pathlib import Path
from typing import NamedTuple

ROW = re.compile(
    r"^\| (\d\d) \| \[([^\]]+)\]\(notebooks/([^)]*)\.ipynb\)(.*?) \| (\d+) \|(.*?)\|$", re.M
)
"""A chapter in the table of README.md: number, name, page, more, minutes, source."""
NAMES = {"": "Start", "all four": "All four papers", "published recordings": "Recordings"}
"""Names of parts that are of no one paper, by what the table has as their source."""


class Chapter(NamedTuple):
    """A row of the table; the page is the notebook's name without its ending."""

    number: str
    name: str
    page: str
    more: str
    minutes: str
    source: str


def chapters(root: Path) -> tuple[Chapter, ...]:
    """Return the chapters in their order."""
    rows = ROW.findall((root / "README.md").read_text("utf-8"))
    return tuple(Chapter(*(cell.strip() for cell in row)) for row in rows)


def parts(root: Path) -> dict[str, list[Chapter]]:
    """Return the chapters of each part by its name: what comes from one paper is one part."""
    found: dict[str, list[Chapter]] = {}
    numerals = iter(("I", "II", "III", "IV"))
    for source, group in groupby(chapters(root), lambda chapter: chapter.source.partition(",")[0]):
        name = NAMES[source] if source in NAMES else f"Part {next(numerals)}: {source}"
        found[name] = list(group)
    return found


def contents(names: Sequence[str], *options: str) -> str:
    """Return a table of contents; options are lines like ":hidden:"."""
    return "\n".join(["", "```{toctree}", *options, "", *names, "```", ""])
