"""Whether the recordings of chapter 17 are on this computer, and one sentence if they are not.

The figures of the chapter and a few kept words stand in for what is missing, so nothing here is an
error.
"""

from __future__ import annotations

import tomllib
from importlib.resources import files

from driftlab.recordings.publishers import (
    PUBLISHED,
    RecordingUnavailable,
    published,
    published_file,
)
from driftlab.recordings.recording import Recording

from ..machinery.table import Table

_MISSING = "{} is not at hand; 'The recordings', at the beginning, says how to get it."
_KEPT = tomllib.loads(files(__package__).joinpath("kept_words.toml").read_text("utf-8"))


def at_hand(name: str) -> Recording | None:
    """Return a published recording if it is on this computer; else say that it is not."""
    try:
        return published(name, download=False)
    except RecordingUnavailable:
        print(_MISSING.format(name))
        return None


def fetch_recordings() -> Table:
    """Fetch all recordings that are not here yet, and list them with authors and licences.

    After the first that cannot be fetched no other is asked for: the network is away.
    """
    rows, why = [("recording", "what it is", "by", "licence", "length", "at hand")], ""
    for name, one in PUBLISHED.items():
        length = "–"
        try:
            length = f"{published(name, download=not why).duration:.0f} s"
        except RecordingUnavailable as reason:
            why = why or str(reason)
        here = "no" if length == "–" else "yes"
        rows.append((name, one.title, one.source, one.licence, length, here))
    missing = sum(row[-1] == "no" for row in rows)
    if missing:
        print(
            f"{missing} of {len(PUBLISHED)} recordings are not here; the book's own figures stand "
            f"in for them. {why}"
        )
    return Table(rows)


def kept_words(cell: str) -> str:
    """Return what a cell shows of `mpu9150-1`, kept for a reader without the recording.

    The cells are "lines", "doubts" and "rests".
    """
    return f"With the recording this cell says:\n\n{_KEPT[cell].strip()}"


def first_lines(file: str, count: int = 3) -> str | None:
    """Return the first lines of a published file, or None if it is not here."""
    try:
        with published_file(file, download=False).open(encoding="utf-8") as text:
            return "".join(line for line, _ in zip(text, range(count), strict=False)).rstrip()
    except RecordingUnavailable:
        return None
