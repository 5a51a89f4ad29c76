"""All slider panels and all living scenes of the book, in the order of the chapters.

Show one as the last line of a notebook cell: ``DriftExplorer()``, ``TurningBlock()``.
"""

from __future__ import annotations

from .chapters import chapters_with, part_of
from .machinery.panel.panel import Explorer
from .machinery.scene.view import SceneExplorer

EXPLORERS: tuple[type[Explorer], ...] = tuple(
    panel for chapter in chapters_with("panels") for panel in part_of(chapter, "panels").PANELS
)
SCENES: tuple[type[SceneExplorer], ...] = tuple(
    scene for chapter in chapters_with("scenes") for scene in part_of(chapter, "scenes").SCENES
)
