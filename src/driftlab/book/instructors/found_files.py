"""All that lies in a folder and in the archives in it, read in memory; nothing is unpacked.

What comes from strangers has bounds: how many files, how large, how deep an archive lies in
another. Whatever is not read is found all the same, with a sentence that says why, so that nobody
who handed in something is lost.
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
from .saved_answers import LARGEST

MOST_FILES = 20_000
MOST_BYTES = 2**29
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
    content : bytes or None
        Of a notebook and of `timestamp.txt`; other files are not read.
    trouble : str
        Why it could not be read, in one sentence.
    """

    parts: tuple[str, ...]
    time: float = 0.0
    content: bytes | None = None
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
    if place.is_dir():
        yield from _walked(place, ())
    elif zipfile.is_zipfile(place):
        yield from _read(place, ())
    else:
        raise ValueError(
            f"folder: expected a folder with what students handed in, or a zip, got {str(place)!r}."
        )


def _walked(folder: Path, parts: tuple[str, ...]) -> Iterator[Found]:
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
            yield from _walked(Path(entry.path), here)
        elif not entry.is_file():
            yield Found(here, trouble="It is no ordinary file.")
        else:
            yield from _read(Path(entry.path), here)


def _read(path: Path, parts: tuple[str, ...]) -> Iterator[Found]:
    """Give a file of the disk, or what is in it."""
    name = path.name
    try:
        with path.open("rb") as file:
            if file.read(4) == b"PK\3\4" or name.casefold().endswith(".zip"):
                yield from _unzipped(path, parts, Budget(MOST_FILES, MOST_BYTES))
                return
            file.seek(0)
            wanted = is_notebook(name) or name == "timestamp.txt"
            content = file.read(LARGEST + 1) if wanted else None
            written = os.fstat(file.fileno()).st_mtime
    except OSError as error:
        yield Found(parts, trouble=f"It cannot be read ({error.strerror}).")
        return
    yield Found(parts, written, content)


@dataclass
class Budget:
    """How much may still be unpacked; what is inside of another archive counts there as well."""

    files: int
    size: int
    outer: Budget | None = None

    def spend(self, files: int, size: int) -> bool:
        """Take it, or say that there is not enough."""
        budget: Budget | None = self
        while budget is not None:
            if budget.files < files or budget.size < size:
                return False
            budget = budget.outer
        budget = self
        while budget is not None:
            budget.files, budget.size = budget.files - files, budget.size - size
            budget = budget.outer
        return True


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
    elif not (is_archive or is_notebook(name) or name == "timestamp.txt"):
        yield Found(parts, when)
    elif not budget.spend(1, info.file_size):
        yield Found(parts, when, trouble="Its archive holds more than is unpacked of one.")
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
            inner = Budget(MOST_FILES_INSIDE, MOST_BYTES_INSIDE, budget)
            yield from _unzipped(io.BytesIO(content), parts, inner, depth + 1)
        else:
            yield Found(parts, when, content)


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
