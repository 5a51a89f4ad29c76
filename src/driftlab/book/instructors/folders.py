"""All that lies in a folder and in the archives in it.

What comes from strangers has bounds: how many files, how large, how deep an archive lies in
another.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path

from .archives import DEEPEST_FOLDER, unzipped
from .budget import Budget, of_a_run, of_an_archive
from .found_files import Found, is_archive, is_noise, is_wanted, understood
from .saved_answers import LARGEST

MOST_OTHERS = 8
"""Files of a folder that are not read, and told all the same."""


def files_in(place: Path) -> Iterator[Found]:
    """Give all that is in a folder, or in an archive, in the order of the names."""
    try:
        is_folder, is_file = place.is_dir(), place.is_file()
        starts = place.open("rb") if is_file else None
    except OSError as error:
        raise ValueError(
            f"folder: {str(place)!r} cannot be read ({error.strerror or error})."
        ) from None
    if is_folder:
        yield from _without_crowds(_walked(place, (), of_a_run()))
        return
    if starts:
        with starts as file:
            if file.read(2) == b"PK":
                for one in _without_crowds(unzipped(file, (), of_an_archive(of_a_run()))):
                    if one.parts == ("",):
                        raise ValueError(f"folder: {str(place)!r} is not read. {one.trouble}")
                    yield one
                return
    raise ValueError(
        f"folder: expected a folder with what students handed in, or a zip, got {str(place)!r}."
    )


def _without_crowds(found: Iterable[Found]) -> Iterator[Found]:
    """Give all, but of the files of a folder that are not read only some."""
    others: Counter[tuple[str, ...]] = Counter()
    for one in found:
        if one.parts[-1] and not (one.trouble or is_wanted(one.parts[-1])):
            others[one.parts[:-1]] += 1
            if one.parts[:-1] and others[one.parts[:-1]] > MOST_OTHERS:
                continue
        yield one


def _walked(folder: Path, parts: tuple[str, ...], budget: Budget) -> Iterator[Found]:
    if len(parts) > DEEPEST_FOLDER:
        yield Found((*parts, ""), trouble="Too many folders lie in each other.")
        return
    try:
        entries = [
            (entry, is_folder)
            for entry in sorted(os.scandir(folder), key=lambda entry: entry.name)
            if not is_noise(
                entry.name, is_folder=(is_folder := entry.is_dir(follow_symlinks=False))
            )
        ]
    except OSError as error:
        yield Found((*parts, ""), trouble=f"The folder cannot be read ({error.strerror}).")
        return
    if not entries and parts:
        yield Found((*parts, ""))
    for entry, is_folder in entries:
        here = (*parts, entry.name)
        if entry.is_symlink():
            yield Found(here, trouble="It is a link to another place, which is not followed.")
        elif is_folder:
            yield from _walked(Path(entry.path), here, budget)
        elif not entry.is_file(follow_symlinks=False):
            yield Found(here, trouble="It is no ordinary file.")
        else:
            yield from _read(Path(entry.path), here, budget)


def _read(path: Path, parts: tuple[str, ...], budget: Budget) -> Iterator[Found]:
    """Give a file of the disk, or what is in it."""
    try:
        with path.open("rb") as file:
            state = os.fstat(file.fileno())
            if file.read(4) == b"PK\3\4" or is_archive(path.name):
                yield from unzipped(file, parts, of_an_archive(budget))
                return
            file.seek(0)
            if not is_wanted(path.name):
                yield Found(parts, state.st_mtime)
            elif trouble := budget.spend(min(state.st_size, LARGEST)):
                yield Found(parts, state.st_mtime, trouble=trouble)
            else:
                yield understood(parts, state.st_mtime, file.read(min(state.st_size, LARGEST) + 1))
    except OSError as error:
        yield Found(parts, trouble=f"It cannot be read ({error.strerror}).")
