"""The chapters of the book, one folder each, found by what the folders are called."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from types import ModuleType

CHAPTERS = {
    folder.name[2:4]: folder.name for folder in sorted(Path(__file__).parent.glob("ch[0-9][0-9]_*"))
}
"""Folders by the number of the chapter, "00" to "19"; each is called like its notebook."""


def chapters_with(part: str) -> list[str]:
    """Numbers of the chapters that have a part: say "figures", "scenes" or "hints"."""
    here = Path(__file__).parent
    return [
        number
        for number, folder in CHAPTERS.items()
        if any((here / folder / f"{part}{ending}").exists() for ending in ("", ".py", ".toml"))
    ]


def part_of(chapter: str, part: str) -> ModuleType:
    """Import a part of a chapter, and nothing of the others."""
    return import_module(f"driftlab.book.{CHAPTERS[chapter]}.{part}")
