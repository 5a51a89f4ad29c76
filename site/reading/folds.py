"""Sections that the page folds, as JupyterLab does, and places that links lead to.

Sphinx knows of them only here: a fold is a comment in Markdown, a figure is HTML.
"""

from __future__ import annotations

import re

from docutils import nodes
from sphinx.application import Sphinx

FOLDED = "folded"
"""The comment below a heading whose section is folded: ``% folded`` in Markdown."""
FIGURE = re.compile(r'<figure [^>]*\bid="([^"]+)"')


def fold_sections(app: Sphinx, doctree: nodes.document) -> None:
    """Put what follows a heading that is marked so between tags that fold it."""
    marks = [node for node in doctree.findall(nodes.comment) if node.astext() == FOLDED]
    for mark in marks:
        section = mark.parent
        opening = '<details class="folded"><summary>Unfold</summary>'
        section.replace(mark, nodes.raw("", opening, format="html"))
        section.append(nodes.raw("", "</details>", format="html"))


def note_figures(app: Sphinx, doctree: nodes.document) -> None:
    """Let links lead to figures that stand on the page as HTML."""
    labels = app.env.domains.standard_domain.anonlabels
    for node in doctree.findall(nodes.raw):
        if figure := FIGURE.search(node.astext()):
            labels[figure[1]] = app.env.docname, figure[1]


def keep_places_single(app: Sphinx, doctree: nodes.document, docname: str) -> None:
    """Leave the place of a formula to the box that the theme puts around it with the same name."""
    for formula in doctree.findall(nodes.math_block):
        if formula["ids"] == formula.parent.get("ids"):
            formula["ids"] = []
