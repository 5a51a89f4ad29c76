"""All that lies in an archive, and in archives in it, read in memory; nothing is unpacked."""

from __future__ import annotations

import io
import stat
import time
import zipfile
from collections.abc import Iterator
from typing import BinaryIO

from .budget import MOST_BYTES_INSIDE, Budget, of_an_inner_archive
from .found_files import Found, is_archive, is_noise, is_notebook, is_wanted, understood
from .plain_text import clean
from .saved_answers import LARGEST

DEEPEST = 3
"""Archives in each other."""
DEEPEST_FOLDER = 40
LONGEST_NAME = 255
"""As on a disk; an archive can hold longer ones."""
END = 2**17
"""Bytes, more than zipfile looks at for where the list begins."""


class TooMuchListedError(Exception):
    """An archive has more entries than are read."""


class _Guarded:
    """A file whose list of entries is paid for before zipfile reads it.

    What the end of an archive says of the number of entries need not be true, so what counts is
    how much zipfile asks for; and an entry takes 46 bytes at least.
    """

    def __init__(self, file: BinaryIO, budget: Budget) -> None:
        self._file = file
        self._budget: Budget | None = budget
        self.seek, self.tell = file.seek, file.tell
        self.seekable, self.close = file.seekable, file.close

    def read(self, size: int = -1) -> bytes:
        if self._budget and size >= 0 and not self._budget.spend_list(size):
            raise TooMuchListedError
        return self._file.read(END if self._budget and size < 0 else size)

    def opened(self) -> None:
        """What is read from now on is files, which are paid for where they are read."""
        self._budget = None


def unzipped(
    file: BinaryIO, parts: tuple[str, ...], budget: Budget, depth: int = 1
) -> Iterator[Found]:
    """Give all that is in an archive, in the order of the names."""
    guarded = _Guarded(file, budget)
    try:
        with zipfile.ZipFile(guarded) as opened:
            guarded.opened()
            entries = [(_parts(info), i) for i, info in enumerate(opened.infolist())]
            entries = sorted(entry for entry in entries if not _is_noise(entry[0]))
            if not entries:
                yield Found((*parts, ""), trouble="The archive is empty.")
            for place, (below, i) in enumerate(entries):
                following = entries[place + 1][0] if place + 1 < len(entries) else ()
                # A folder comes before what is in it.
                if below[-1] or following[: len(below) - 1] != below[:-1]:
                    info = opened.infolist()[i]
                    yield from _member(opened, info, (*parts, *below), budget, depth)
    except TooMuchListedError:
        yield Found((*parts, ""), trouble="The archive has too many entries to be read.")
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
    when = _time(info)
    if not name:
        yield Found(parts, when)
    elif trouble := _refused(info, name):
        yield Found(parts, when, trouble=trouble)
    elif not (is_archive(name) or is_wanted(name)):
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
        if is_archive(name) or content.startswith(b"PK\3\4"):
            if depth == DEEPEST:
                yield Found(parts, when, trouble="Too many archives lie in each other.")
                return
            inner = of_an_inner_archive(budget)
            yield from unzipped(io.BytesIO(content), parts, inner, depth + 1)
        else:
            yield understood(parts, when, content)


def _refused(info: zipfile.ZipInfo, last: str) -> str:
    """Why a file of an archive is not even opened."""
    name = info.filename.replace("\\", "/")
    if name.startswith("/") or ".." in name.split("/") or name[1:2] == ":":
        return "Its name in the archive leads out of it."
    if stat.S_ISLNK(info.external_attr >> 16):
        return "It is a link to another place, which is not followed."
    if info.flag_bits & 1:
        return "The archive asks for a password."
    largest = MOST_BYTES_INSIDE if is_archive(last) else LARGEST
    if info.file_size > largest and (is_archive(last) or is_notebook(last)):
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
    *folders, last = map(_cut, name.replace("\\", "/").split("/"))
    inner = tuple(part for part in folders if part not in ("", ".", "..") and part[1:] != ":")
    return (*inner[:DEEPEST_FOLDER], last if last not in (".", "..") else "")


def _is_noise(parts: tuple[str, ...]) -> bool:
    """Whether a file, or a folder that it lies in, is no student's."""
    inside = any(is_noise(folder, is_folder=True) for folder in parts[:-1])
    return inside or is_noise(parts[-1], is_folder=False)


def _cut(name: str) -> str:
    """A name as long as a disk could hold it; its ending stays."""
    return name if len(name) <= LONGEST_NAME else f"{name[:200]}…{name[-50:]}"


def _time(info: zipfile.ZipInfo) -> float:
    try:
        return time.mktime((*info.date_time, 0, 0, -1))
    except (ValueError, OverflowError):
        return 0.0


def _words(error: Exception) -> str:
    return clean(str(error), 80).rstrip(".") or type(error).__name__
