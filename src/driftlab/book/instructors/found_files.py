"""A file that somebody handed in, and what it says.

A notebook is read for what `check` said in it and let go, so that a class does not have to fit
into memory. What is not read is found all the same, with a sentence that says why, so that nobody
who handed in something is lost.
"""

from __future__ import annotations

from typing import NamedTuple

from .saved_answers import SavedNotebook, saved_answers

NOISE = (
    "__MACOSX", "Thumbs.db", "desktop.ini", "__pycache__", ".DS_Store", ".ipynb_checkpoints",
    ".git", ".svn", ".hg", ".venv", ".idea", ".vscode", ".cache", ".Trash", ".Trashes",
    ".Spotlight-V100", ".TemporaryItems", ".fseventsd",
)  # fmt: skip
"""What systems and programs leave behind, and nobody hands in."""
REPORT = ("gradebook.csv", "statuses.csv", "slips.csv", "words.csv", "report.html")
"""The files of a report; one may have been written into the folder that is read."""


class Found(NamedTuple):
    """A file, or an empty folder."""

    # folders, archives among them, and the name; "" as the name of an empty folder
    parts: tuple[str, ...]
    time: float = 0.0  # when it was written, in seconds since 1970
    saved: SavedNotebook | None = None  # what a notebook says
    moment: bytes = b""  # how `timestamp.txt` begins; other files are not read
    trouble: str = ""  # why it could not be read, in one sentence


def is_notebook(name: str) -> bool:
    """Whether a file may be a notebook; browsers add an ending of their own to some."""
    return ".ipynb" in name.casefold() or name.casefold().endswith(".json")


def is_archive(name: str) -> bool:
    """Whether a file, or a folder of `Found`, is an archive by its name."""
    return name.casefold().endswith(".zip")


def is_wanted(name: str) -> bool:
    """Whether a file is read."""
    return is_notebook(name) or name == "timestamp.txt"


def is_noise(name: str, *, is_folder: bool) -> bool:
    """Whether something is no student's, such as a Mac's shadows of files, ``._03.ipynb``."""
    if name in NOISE or name.startswith("._"):
        return True
    return name.startswith(".") and not (is_folder or is_wanted(name) or is_archive(name))


def understood(parts: tuple[str, ...], written: float, content: bytes) -> Found:
    """What a file says, without its content."""
    if parts[-1] == "timestamp.txt":
        return Found(parts, written, moment=content[:100])
    try:
        return Found(parts, written, saved_answers(content))
    except ValueError as error:
        return Found(parts, written, trouble=str(error))
