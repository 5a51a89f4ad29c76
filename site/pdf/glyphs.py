"""Whether each sign of a PDF is in a font; Typst draws a box for others and says nothing."""

from __future__ import annotations

import pikepdf

MISSING = b"\0\0"
"""Number of the glyph that stands for all that a font has not."""


def pages_with_boxes(document: pikepdf.Pdf) -> list[int]:
    """Return the numbers of the pages, from 1 on, on which a sign is only a box."""
    return [
        number
        for number, page in enumerate(document.pages, 1)
        if any(MISSING in _glyphs(shown) for shown in _shown(page))
    ]


def _shown(page: pikepdf.Page) -> list[bytes]:
    """The strings that a page shows; Typst writes two bytes a glyph."""
    found: list[bytes] = []
    for said in pikepdf.parse_content_stream(page, "Tj TJ"):
        pieces = said.operands[0] if str(said.operator) == "TJ" else said.operands
        found += [bytes(piece) for piece in pieces if isinstance(piece, pikepdf.String)]
    return found


def _glyphs(shown: bytes) -> set[bytes]:
    return {shown[place : place + 2] for place in range(0, len(shown), 2)}
