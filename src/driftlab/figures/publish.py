"""Write figures as SVG and their numbers as CSV, so that both repeat."""

import csv
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib.figure import Figure

from .catalogue import Entry
from .picture import STYLE

GALLERY_NOTE = (
    "Rebuilt from seeds by `python3 lab.py figures`; do not edit. The numbers behind a figure are "
    "in the CSV of the same name."
)


def write_entry(entry: Entry, folder: Path) -> list[str]:
    """Write one figure and its numbers; return its lines of the gallery."""
    data = entry.compute()
    save(entry.picture.draw(data), folder / f"{entry.name}.svg")
    if entry.columns:
        write_columns(folder / f"{entry.name}.csv", entry.columns(data))
    caption = entry.caption(data)
    return [f"![{caption}]({entry.name}.svg)", "", f"**{entry.name}.** {caption}", ""]


def save(figure: Figure, path: Path) -> None:
    """Write a figure as SVG whose bytes repeat: no date, identifiers from a fixed salt."""
    with matplotlib.rc_context(STYLE):
        figure.savefig(path, format="svg", metadata={"Date": None, "Creator": None})


def write_columns(path: Path, columns: dict[str, Any]) -> None:
    """Write columns of equal length as CSV, numbers to twelve digits."""
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        for row in zip(*columns.values(), strict=True):
            writer.writerow([x if isinstance(x, str) else f"{x:.12g}" for x in row])
