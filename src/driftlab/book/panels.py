"""All slider panels of the book, in the order of the chapters.

Show one as the last line of a notebook cell: ``DriftExplorer()``.
"""

from __future__ import annotations

from .chapters import chapters_with, part_of
from .machinery.panel import Explorer

EXPLORERS: tuple[type[Explorer], ...] = tuple(
    panel for chapter in chapters_with("panels") for panel in part_of(chapter, "panels").PANELS
)
