"""Compares packages with the records that pip leaves of their files."""

import csv
import os
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

REWRITTEN = ("driftlab.pth",)
"""What lab.py itself writes anew after pip, besides scripts."""


def unlike_records(packages: Path, scripts: Path) -> list[str]:
    """Return the files that are lost or of another size, as seen from the packages' folder.

    Of twenty thousand files none is opened: each folder is listed once, which takes a tenth of a
    second for all. What Python has compiled is recorded without a size, and may be missing.
    """
    folders: defaultdict[str, list[tuple[str, str]]] = defaultdict(list)
    unlike = []
    for record in packages.glob("*.dist-info/RECORD"):
        try:
            for path, size in recorded(record):
                folder, _, name = path.rpartition("/")
                folders[folder].append((name, size))
        except (OSError, ValueError, csv.Error):
            unlike.append(record.relative_to(packages).as_posix())
    for folder, files in folders.items():
        place = os.path.normpath(packages / folder)
        found = sizes(place)
        of_scripts = os.path.normcase(place) == os.path.normcase(scripts)
        for name, size in files:
            there = name in found if of_scripts or name in REWRITTEN else found.get(name) == size
            if not there:
                unlike.append(f"{folder}/{name}" if folder else name)
    return unlike


def recorded(record: Path) -> Iterator[tuple[str, str]]:
    """Give each file of a package that has a size, and the size."""
    with record.open(encoding="utf-8", newline="") as lines:
        for line in csv.reader(lines):
            if len(line) == 3 and line[2]:
                yield line[0], line[2]


def sizes(folder: str) -> dict[str, str]:
    """Return the sizes of the files of a folder, by their names, as records have them."""
    try:
        with os.scandir(folder) as entries:
            return {entry.name: str(entry.stat().st_size) for entry in entries}
    except OSError:
        return {}
