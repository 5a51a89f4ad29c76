"""The chapters and their parts, as the table in README.md has them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

ROW = re.compile(
    r"^\| (\d\d) \| \[([^\]]+)\]\(notebooks/([^)]*)\.ipynb\) \| [^|]+ \| (\d+) \|$", re.M
)
"""A chapter in the table of README.md: number, name, page, minutes."""
PARTS = {
    "Start": ("00",),
    "Part I: Larin": ("01", "02", "03", "04"),
    "Part II: Perelyaev and Chelnokov": ("05", "06"),
    "Part III: Wu and others": ("07", "08"),
    "Part IV: Plotnikov and others": ("09", "10"),
    "All four papers": ("11", "12"),
    "Recordings": ("13",),
}
"""Numbers of the chapters of each part: one paper is one part."""


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
    """Return the chapters of each part by its name."""
    known = {chapter.number: chapter for chapter in chapters(root)}
    return {name: [known[number] for number in numbers] for name, numbers in PARTS.items()}


def contents(names: Sequence[str], *options: str) -> str:
    """Return a table of contents; options are lines like ":hidden:"."""
    return "\n".join(["", "```{toctree}", *options, "", *names, "```", ""])
