"""Pictures as files of which the bytes repeat: PDF and PNG for a paper, SVG for a page as well."""

from __future__ import annotations

import html
import io
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from .sheet import Sheet, drawn_in

PICTURES = ("pdf", "svg", "png")
"""Endings of files that hold a picture."""


def ending_of(path: Path, known: Sequence[str]) -> str:
    """Return the ending of a file's name, without its dot, if it is one of those known."""
    ending = path.suffix[1:].lower()
    if ending not in known:
        endings = ", ".join(f".{each}" for each in known)
        raise ValueError(f"path: expected an ending of {endings}, got {str(path)!r}.")
    return ending


def picture_file(
    figure: Figure, ending: str, sheet: Sheet, title: str = "", subject: str = ""
) -> bytes:
    """Return a figure as a file: no date in it, identifiers from a fixed salt."""
    known: dict[str, dict[str, Any]] = {
        "svg": {"Date": None, "Creator": None},
        "pdf": {"CreationDate": None, "Title": title, "Subject": subject},
        "png": {"Title": title, "Description": subject},
    }
    buffer = io.BytesIO()
    with drawn_in(sheet.style):
        figure.savefig(buffer, format=ending, metadata=known[ending])
    return buffer.getvalue()


def how_to_save(panel: str, *, drawn: bool) -> str:
    """Return a line of HTML that says how a panel's picture is kept; `drawn` by Matplotlib."""
    arguments = '"picture.pdf", width=3.5' if drawn else '"picture.svg"'
    make, save = f"panel = {panel}()", f"panel.save({html.escape(arguments)})"
    return f"<p>To keep this picture: <code>{make}</code>, and then <code>{save}</code>.</p>"
