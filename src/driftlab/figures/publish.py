"""Publish figures: on a notebook page, or as SVG and CSV files whose content repeats."""

import base64
import csv
import html
import io
from pathlib import Path
from typing import Any

import matplotlib

from .catalogue import CATALOGUE
from .entry import Entry
from .picture import STYLE

GALLERY_NOTE = (
    "Rebuilt from seeds by `python3 lab.py figures`; do not edit. The numbers behind a figure are "
    "in the CSV of the same name."
)


class Plate:
    """A published figure on a page: the picture, and its caption below it and as its alt text.

    Attributes
    ----------
    data : object
        What the figure's module computed.
    caption : str
    """

    def __init__(self, entry: Entry) -> None:
        self.data = entry.compute()
        self.caption = entry.caption(self.data)
        self._figure = entry.picture.draw(self.data)

    def svg(self) -> bytes:
        """The picture as SVG whose bytes repeat: no date, identifiers from a fixed salt."""
        buffer = io.BytesIO()
        with matplotlib.rc_context(STYLE):
            self._figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None})
        return buffer.getvalue()

    def _repr_html_(self) -> str:
        picture = base64.b64encode(self.svg()).decode()
        caption = html.escape(self.caption)
        return (
            f'<figure style="margin: 0"><img alt="{caption}" style="max-width: 100%" '
            f'src="data:image/svg+xml;base64,{picture}">'
            f"<figcaption>{caption}</figcaption></figure>"
        )


def plate(name: str) -> Plate:
    """Return a published figure by name, to be the last line of a notebook cell."""
    entries = {entry.name: entry for entry in CATALOGUE}
    if name not in entries:
        raise ValueError(f"name: expected one of {', '.join(entries)}, got {name!r}.")
    return Plate(entries[name])


def write_entry(entry: Entry, folder: Path) -> list[str]:
    """Write one figure and its numbers; return its lines of the gallery."""
    shown = Plate(entry)
    (folder / f"{entry.name}.svg").write_bytes(shown.svg())
    if entry.columns:
        write_columns(folder / f"{entry.name}.csv", entry.columns(shown.data))
    return [f"![{shown.caption}]({entry.name}.svg)", "", f"**{entry.name}.** {shown.caption}", ""]


def write_columns(path: Path, columns: dict[str, Any]) -> None:
    """Write columns of equal length as CSV, numbers to twelve digits."""
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        for row in zip(*columns.values(), strict=True):
            writer.writerow([x if isinstance(x, str) else f"{x:.12g}" for x in row])
