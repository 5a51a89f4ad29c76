"""Publish figures: on a notebook page, or as SVG and CSV files whose content repeats."""

from __future__ import annotations

import base64
import csv
import html
import io
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib.figure import Figure

from .picture import STYLE

GALLERY_NOTE = (
    "Rebuilt from seeds by `python3 lab.py figures`; do not edit. The numbers behind a figure are "
    "in the CSV of the same name."
)


@dataclass(frozen=True)
class FigureDefinition:
    """What a published figure is made of.

    Attributes
    ----------
    name : str
        File name without ending; begins with the chapter's number.
    compute : callable
        Takes nothing, returns the picture's data.
    draw : callable
        Data to a Matplotlib figure, or to the text of an SVG, as a scene draws itself.
    columns : callable or None
        Data to CSV columns of equal length; None for a drawing that shows no numbers.
    caption : callable
        Data to the sentence under the figure, so that its numbers are computed.
    restore : callable, optional
        Columns of the published CSV to the data, for what takes minutes to compute or needs a
        recording that may not be at hand.
    recordings : tuple of str, optional
        Names in `driftlab.recordings.publishers.PUBLISHED` that it is computed from.
    """

    name: str
    compute: Callable[[], Any]
    draw: Callable[[Any], Figure | str]
    columns: Callable[[Any], dict[str, Any]] | None
    caption: Callable[[Any], str]
    restore: Callable[[Mapping[str, list[str]]], Any] | None = None
    recordings: tuple[str, ...] = ()


class PublishedFigure:
    """A figure on a page: the picture, and its caption below it and as its alt text.

    Attributes
    ----------
    definition : FigureDefinition
    data : object
        What ``definition.compute`` returned.
    caption : str
        What ``definition.caption`` says of the data, and the note if there is one.
    """

    def __init__(self, definition: FigureDefinition, data: Any, note: str = "") -> None:
        self.definition = definition
        self.data = data
        self.caption = " ".join(filter(None, [definition.caption(data), note]))
        self._figure = definition.draw(data)

    def svg(self) -> bytes:
        """The picture as SVG whose bytes repeat: no date, identifiers from a fixed salt."""
        if isinstance(self._figure, str):
            return self._figure.encode()
        buffer = io.BytesIO()
        with matplotlib.rc_context(STYLE):
            self._figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None})
        return buffer.getvalue()

    def write(self, folder: Path) -> None:
        """Write the picture as SVG and, if it shows any, its numbers as CSV."""
        (folder / f"{self.definition.name}.svg").write_bytes(self.svg())
        if self.definition.columns:
            columns = self.definition.columns(self.data)
            write_columns(folder / f"{self.definition.name}.csv", columns)

    def _repr_html_(self) -> str:
        picture = base64.b64encode(self.svg()).decode()
        caption = html.escape(self.caption)
        return (
            f'<figure style="margin: 0"><img alt="{caption}" style="max-width: 100%" '
            f'src="data:image/svg+xml;base64,{picture}">'
            f"<figcaption>{caption}</figcaption></figure>"
        )


def gallery(captions: Mapping[str, str]) -> str:
    """Return the Markdown page that shows all figures, from their captions by name."""
    lines = ["# The figures of the book", "", GALLERY_NOTE, ""]
    for name, caption in captions.items():
        lines += [f"![{caption}]({name}.svg)", "", f"**{name}.** {caption}", ""]
    return "\n".join(lines)


def read_columns(path: Path) -> dict[str, list[str]]:
    """Return the columns of a CSV that `write_columns` wrote, as words."""
    with path.open(encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    return {
        title: list(column) for title, column in zip(header, zip(*rows, strict=True), strict=True)
    }


def write_columns(path: Path, columns: dict[str, Any]) -> None:
    """Write columns of equal length as CSV, numbers to twelve digits."""
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        for row in zip(*columns.values(), strict=True):
            writer.writerow([x if isinstance(x, str) else f"{x:.12g}" for x in row])
