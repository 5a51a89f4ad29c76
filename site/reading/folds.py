"""Sections that the page folds, as JupyterLab does; in Markdown a fold is a comment."""

from __future__ import annotations

from docutils import nodes
from sphinx.application import Sphinx

FOLDED = "folded"
"""The comment below a heading whose section is folded: ``% folded`` in Markdown."""


def fold_sections(app: Sphinx, doctree: nodes.document) -> None:
    """Put what follows a heading that is marked so between tags that fold it."""
    marks = [node for node in doctree.findall(nodes.comment) if node.astext() == FOLDED]
    for mark in marks:
        section = mark.parent
        opening = '<details class="folded"><summary>Unfold</summary>'
        section.replace(mark, nodes.raw("", opening, format="html"))
        section.append(nodes.raw("", "</details>", format="html"))
