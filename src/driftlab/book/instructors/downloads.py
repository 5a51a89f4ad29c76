"""What stands at the top of the folder: students' folders, or whole downloads of a platform.

Students choose the names of what is inside their own folders, so a name there that looks like
Moodle's or Canvas's is not believed; only at the top, and in what is a download of a class.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from .found_files import REPORT, Found, is_archive, is_notebook
from .plain_text import clean
from .wrapping import CANVAS, MOODLE

COURSE = ("source", "release", "autograded", "feedback", "gradebook.db", "nbgrader_config.py")
"""What nbgrader has beside the folder "submitted", and no student has handed in."""


class Top(NamedTuple):
    """What the top of a folder holds."""

    found: list[Found]
    downloads: set[str]  # folders and archives in which a platform has put several students
    notes: list[str]


def without_report(found: list[Found]) -> tuple[list[Found], list[str]]:
    """Return all but an earlier report that was written into the folder itself."""
    inside = _by_top(found)
    reports = sorted(
        top for top, files in inside.items() if sorted(one.parts[1:] for one in files) == _OF_REPORT
    )
    notes = [f'The folder "{clean(top, 100)}" is an earlier report.' for top in reports]
    return [one for one in found if one.parts[0] not in reports], notes


_OF_REPORT = sorted((name,) for name in REPORT)


def at_the_top(found: list[Found]) -> Top:
    """Tell downloads of platforms from the folders of students."""
    below, found, notes = _below_submitted(found)
    inside = _by_top(found)
    alike = {top for top, files in inside.items() if _is_a_class(files)}
    folders = {top for top, files in inside.items() if len(files[0].parts) > 1}
    plain = {top for top in folders - alike if not is_platforms(top)}
    # A student can pack files in others' names, too; so not where students' own things are alike.
    downloads = {
        top for top in alike if not (any(map(is_archive, plain)) if is_archive(top) else plain)
    }
    if plain:
        notes += [
            f'"{clean(top, 100)}" lies beside folders of students, and was taken for a '
            "platform's download of several."
            for top in sorted(downloads)
        ]
    return Top(below + found, downloads, notes)


def is_platforms(name: str) -> bool:
    """Whether a file or a folder is called as Moodle or Canvas call one."""
    return bool(MOODLE.fullmatch(name) or CANVAS.fullmatch(name))


def _by_top(found: Iterable[Found]) -> dict[str, list[Found]]:
    inside: dict[str, list[Found]] = {}
    for one in found:
        inside.setdefault(one.parts[0], []).append(one)
    return inside


def _is_a_class(files: list[Found]) -> bool:
    """Whether all in a folder or archive is called as a platform calls it, and is of several."""
    if is_platforms(files[0].parts[0]) or len(files[0].parts) == 1:
        return False  # what a student handed in
    ids = set()
    for name, is_read in {(one.parts[1], _is_read(one.parts[1:])) for one in files}:
        if said := MOODLE.fullmatch(name) or CANVAS.fullmatch(name):
            ids.add(said["id"])
        elif is_read:
            return False
    return len(ids) > 1


def _is_read(parts: tuple[str, ...]) -> bool:
    return len(parts) > 1 or is_notebook(parts[0])


def _below_submitted(found: list[Found]) -> tuple[list[Found], list[Found], list[str]]:
    """What students handed in of a whole course of nbgrader, and what else there is."""
    # At the top, or below one folder around it all: elsewhere it is some student's.
    tops = {one.parts[0] for one in found}
    place = int(len(tops) == 1 and not any(map(is_platforms, tops)))
    if any(_is_submitted(one, 0) for one in found):
        place = 0
    if not any(_is_submitted(one, place) for one in found):
        return [], found, []
    beside = [one for one in found if not _is_submitted(one, place)]
    is_course = place == 1 or any(one.parts[0] in COURSE for one in beside)
    # Of a course only this is the students'; else "submitted" is one folder among others.
    others = [one for one in beside if not is_course or any(map(is_platforms, one.parts[:2]))]
    below = [
        one._replace(parts=one.parts[place + 1 :]) for one in found if _is_submitted(one, place)
    ]
    notes = []
    if left_out := len(beside) - len(others):
        notes = [f'Only the folder "submitted" is read; {left_out} files lie elsewhere.']
    return below, others, notes


def _is_submitted(one: Found, place: int) -> bool:
    """Whether something lies in a student's folder in "submitted"."""
    return len(one.parts) > place + 2 and one.parts[place] == "submitted"
