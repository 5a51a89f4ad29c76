"""All that lies in a folder and in the archives in it, read in memory; nothing is unpacked.

Each notebook is read for what `check` said in it and let go, so that a class does not have to fit
into memory. What comes from strangers has bounds: how many files, how large, how deep an archive
lies in another. Whatever is not read is found all the same, with a sentence that says why, so that
nobody who handed in something is lost.
"""

from __future__ import annotations

import io
import os
import stat
import time
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from .plain_text import clean
from .saved_answers import LARGEST, SavedNotebook, saved_answers

MOST_FILES = 20_000
MOST_BYTES = 4 * 2**30
"""Of all that is read in a run, from the disk and from archives."""
MOST_FILES_OF_ONE = 5_000
MOST_BYTES_OF_ONE = 2**30
"""Of an archive, so that one leaves something for the others."""
MOST_FILES_INSIDE = 2_000
MOST_BYTES_INSIDE = 256 * 2**20
"""Of an archive in an archive."""
DEEPEST = 3
"""Archives in each other."""
DEEPEST_FOLDER = 40
NOISE = ("__MACOSX", "Thumbs.db", "desktop.ini", "__pycache__")


class Found(NamedTuple):
    """A file, or an empty folder.

    Attributes
    ----------
    parts : tuple of str
        Folders, archives among them, and the name; "" as the name of an empty folder.
    time : float
        When it was written, in seconds since 1970.
    saved : SavedNotebook or None
        What a notebook says.
    moment : bytes
        How `timestamp.txt` begins; other files are not read.
    trouble : str
        Why it could not be read, in one sentence.
    """

    parts: tuple[str, ...]
    time: float = 0.0
    saved: SavedNotebook | None = None
    moment: bytes = b""
    trouble: str = ""


def is_notebook(name: str) -> bool:
    """Whether a file may be a notebook; browsers add an ending of their own to some."""
    return ".ipynb" in name.casefold() or name.casefold().endswith(".json")


def files_in(place: Path) -> Iterator[Found]:
    """Give all that is in a folder, or in an archive, in the order of the names.

    Raises
    ------
    ValueError
        If there is neither.
    """
    budget = Budget(MOST_FILES, MOST_BYTES, "are read in one run")
    if place.is_dir():
        yield from _walked(place, (), budget)
    elif zipfile.is_zipfile(place):
        yield from _unzipped(place, (), budget)
    else:
        raise ValueError(
            f"folder: expected a folder with what students handed in, or a zip, got {str(place)!r}."
        )


def _walked(folder: Path, parts: tuple[str, ...], budget: Budget) -> Iterator[Found]:
    if len(parts) > DEEPEST_FOLDER:
        yield Found((*parts, ""), trouble="Too many folders lie in each other.")
        return
    try:
        entries = sorted(os.scandir(folder), key=lambda entry: entry.name)
    except OSError as error:
        yield Found((*parts, ""), trouble=f"The folder cannot be read ({error.strerror}).")
        return
    entries = [entry for entry in entries if not _is_noise(entry.name)]
    if not entries and parts:
        yield Found((*parts, ""))
    for entry in entries:
        here = (*parts, entry.name)
        if entry.is_symlink():
            yield Found(here, trouble="It is a link to another place, which is not followed.")
        elif entry.is_dir():
            yield from _walked(Path(entry.path), here, budget)
        elif not entry.is_file():
            yield Found(here, trouble="It is no ordinary file.")
        else:
            yield from _read(Path(entry.path), here, budget)


def _read(path: Path, parts: tuple[str, ...], budget: Budget) -> Iterator[Found]:
    """Give a file of the disk, or what is in it."""
    name = path.name
    try:
        with path.open("rb") as file:
            if file.read(4) == b"PK\3\4" or name.casefold().endswith(".zip"):
                one = Budget(
                    MOST_FILES_OF_ONE, MOST_BYTES_OF_ONE, "are unpacked of an archive", budget
                )
                yield from _unzipped(path, parts, one)
                return
            file.seek(0)
            state = os.fstat(file.fileno())
            if not _is_wanted(name):
                yield Found(parts, state.st_mtime)
            elif trouble := budget.spend(min(state.st_size, LARGEST)):
                yield Found(parts, state.st_mtime, trouble=trouble)
            else:
                yield _understood(parts, state.st_mtime, file.read(min(state.st_size, LARGEST) + 1))
    except OSError as error:
        yield Found(parts, trouble=f"It cannot be read ({error.strerror}).")


def _is_wanted(name: str) -> bool:
    return is_notebook(name) or name == "timestamp.txt"


def _understood(parts: tuple[str, ...], written: float, content: bytes) -> Found:
    """What a file says, without its content."""
    if parts[-1] == "timestamp.txt":
        return Found(parts, written, moment=content[:100])
    try:
        return Found(parts, written, saved_answers(content))
    except ValueError as error:
        return Found(parts, written, trouble=str(error))


@dataclass
class Budget:
    """How much may still be read; what is inside of another archive counts there as well."""

    files: int
    size: int
    what: str
    outer: Budget | None = None

    def __post_init__(self) -> None:
        self.says = (
            f"It was not read, since no more than {self.size / 2**20:.0f} MB "
            f"in {self.files} files {self.what}."
        )

    def spend(self, size: int) -> str:
        """Take a file's size, or say why there is not enough."""
        if self.files < 1 or self.size < size:
            return self.says
        if self.outer and (trouble := self.outer.spend(size)):
            return trouble
        self.files, self.size = self.files - 1, self.size - size
        return ""


def _unzipped(
    archive: Path | io.BytesIO, parts: tuple[str, ...], budget: Budget, depth: int = 1
) -> Iterator[Found]:
    try:
        with zipfile.ZipFile(archive) as opened:
            infos = sorted(opened.infolist(), key=lambda info: info.filename)
            inside = [(info, _parts(info)) for info in infos]
            inside = [(info, below) for info, below in inside if not any(map(_is_noise, below))]
            filled = {below[:n] for _, below in inside if below[-1] for n in range(len(below))}
            if not inside:
                yield Found((*parts, ""), trouble="The archive is empty.")
            for info, below in inside:
                if below[-1] or below[:-1] not in filled:
                    yield from _member(opened, info, (*parts, *below), budget, depth)
    except Exception as error:  # a damaged archive can raise nearly anything
        yield Found((*parts, ""), trouble=f"The archive is damaged ({_words(error)}).")


def _member(
    opened: zipfile.ZipFile,
    info: zipfile.ZipInfo,
    parts: tuple[str, ...],
    budget: Budget,
    depth: int,
) -> Iterator[Found]:
    """Give a file of an archive, or what is in it."""
    name = parts[-1]
    is_archive = name.casefold().endswith(".zip")
    when = _time(info)
    if not name:
        yield Found(parts, when)
    elif trouble := _refused(info, is_archive, depth):
        yield Found(parts, when, trouble=trouble)
    elif not (is_archive or _is_wanted(name)):
        yield Found(parts, when)
    elif trouble := budget.spend(info.file_size):
        yield Found(parts, when, trouble=trouble)
    else:
        try:
            with opened.open(info) as file:
                content = file.read(info.file_size + 1)
        except Exception as error:  # as above
            yield Found(parts, when, trouble=f"It is damaged in its archive ({_words(error)}).")
            return
        if is_archive or content.startswith(b"PK\3\4"):
            if depth == DEEPEST:
                yield Found(parts, when, trouble="Too many archives lie in each other.")
                return
            inner = Budget(
                MOST_FILES_INSIDE,
                MOST_BYTES_INSIDE,
                "are unpacked of an archive in another",
                budget,
            )
            yield from _unzipped(io.BytesIO(content), parts, inner, depth + 1)
        else:
            yield _understood(parts, when, content)


def _refused(info: zipfile.ZipInfo, is_archive: bool, depth: int) -> str:
    """Why a file of an archive is not even opened."""
    name = info.filename.replace("\\", "/")
    if name.startswith("/") or ".." in name.split("/") or name[1:2] == ":":
        return "Its name in the archive leads out of it."
    if stat.S_ISLNK(info.external_attr >> 16):
        return "It is a link to another place, which is not followed."
    if info.flag_bits & 1:
        return "The archive asks for a password."
    largest = MOST_BYTES_INSIDE if is_archive else LARGEST
    if info.file_size > largest and (is_archive or is_notebook(name)):
        return f"It unpacks to more than {largest // 2**20} MB."
    return ""


def _parts(info: zipfile.ZipInfo) -> tuple[str, ...]:
    """Folders and name in an archive, without what would lead out of it; "" ends a folder."""
    name = info.filename
    if not info.flag_bits & 0x800:  # then the name is read as if it came from DOS
        try:
            name = name.encode("cp437").decode("utf-8")
        except UnicodeError:
            name = info.filename
    *folders, last = name.replace("\\", "/").split("/")
    inner = tuple(part for part in folders if part not in ("", ".", "..") and part[1:] != ":")
    return (*inner[:DEEPEST_FOLDER], last if last not in (".", "..") else "")


def _time(info: zipfile.ZipInfo) -> float:
    try:
        return time.mktime((*info.date_time, 0, 0, -1))
    except (ValueError, OverflowError):
        return 0.0


def _is_noise(name: str) -> bool:
    return name in NOISE or name.startswith(".")


def _words(error: Exception) -> str:
    return clean(str(error), 80).rstrip(".") or type(error).__name__
