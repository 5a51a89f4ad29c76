"""The chapters and their parts, as the table in README.md has them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from pdf.contents import PARTS

ROW = re.compile(
    r"^\| (\d\d) \| \[([^\]]+)\]\(notebooks/([^)]*)\.ipynb\) \| [^|]+ \| (\d+) \|$", re.M
)
"""A chapter in the table of README.md: number, name, page, minutes."""


class Chapter(NamedTuple):
    """A row of the table; the page is the notebook's name without its ending."""

    number: str
    name: str
    page: str
    minutes: str


def chapters(root: Path) -> tuple[Chapter, ...]:
    """Return the chapters in their order."""
    return tuple(Chapter(*row) for row in ROW.findall((root / "README.md").read_text("utf-8")))


def parts(root: Path) -> dict[str, list[Chapter]]:
    """Return the chapters of each part of the book by its title."""
    found = {
        part.title: [each for each in chapters(root) if each.page.startswith(part.beginnings)]
        for part in PARTS
    }
    return {title: each for title, each in found.items() if each}


def contents(names: Sequence[str], *options: str) -> str:
    """Return a table of contents; options are lines like ":hidden:"."""
    return "\n".join(["", "```{toctree}", *options, "", *names, "```", ""])
