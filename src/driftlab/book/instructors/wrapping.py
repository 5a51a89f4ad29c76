"""Whether one folder around all others is the class's, or the only student's.

Nothing in the files can say it for sure: ``all/Ada`` and ``all/Bob`` are two students, ``Ada/ps1``
and ``Ada/ps2`` one. So the list of the class decides, else what the inner folders are called and
hold, and where neither a list nor a platform has decided, a sentence says what was taken for what.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from driftlab.book.chapters import CHAPTERS

from .found_files import Found
from .plain_text import clean
from .roster import Listed, known

MOODLE = re.compile(r"(?P<name>[^_]+)_(?P<id>[^_]+)_assignsubmission_[a-z]+_?(?P<file>.*)", re.S)
CANVAS = re.compile(
    r"(?:(?:late_)?anon_(?P<anon>[0-9a-z]+)|(?P<name>.+?)(?:_late)?_(?P<id>[0-9]+))"
    r"_(?P<upload>[0-9]{3,15})_(?P<file>.+)",
    re.S | re.I,
)
ENDING = re.compile(r"\.(?:ipynb|zip|json|txt)\Z", re.I)
WORK = re.compile(
    r"(?:(?:chapter|ch|week|homework|hw|assignment|problem ?set|ps|sheet|part|lab|exercises?)"
    r"[ ._-]*)?[0-9]{1,2}[a-z]?",
    re.I,
)
"""What a folder of work is called; students may be numbered as well."""


def without_wrapping(found: list[Found], listed: Sequence[Listed]) -> tuple[list[Found], list[str]]:
    """Return all without a folder, or an archive, around the folders of all students.

    What holds one folder only is a student's. The sentences say what is unclear.
    """

    def is_wrapped(one: Found) -> bool:
        return one.parts[0] == found[0].parts[0] and (
            len(one.parts) > 2 or (len(one.parts) == 2 and bool(CANVAS.fullmatch(one.parts[1])))
        )

    notes: list[str] = []
    is_listed = known(listed)
    while all(map(is_wrapped, found)) and len({one.parts[1] for one in found}) > 1:
        outer, inner = found[0].parts[0], sorted({one.parts[1] for one in found})
        if _is_a_platforms(outer) or is_listed(stem_of(outer)):
            break
        is_clear = (
            "submitted" in (outer, *inner)
            or any(map(_is_a_platforms, inner))
            or any(is_listed(stem_of(name)) for name in inner)
        )
        is_one = not is_clear and _is_one_students(found, inner)
        if not is_clear:
            taken = "one student's" if is_one else f"that of a class of {len(inner)}"
            notes = [
                f'All lies in the folder "{clean(outer, 100)}", which is taken for {taken}. '
                "With a list of the class there is no doubt."
            ]
        if is_one:
            break
        found = [one._replace(parts=one.parts[1:]) for one in found]
    return found, notes


def _is_a_platforms(name: str) -> bool:
    return bool(MOODLE.fullmatch(name) or CANVAS.fullmatch(name))


def _is_one_students(found: list[Found], inner: list[str]) -> bool:
    """Whether folders are called as work is, and no exercise is in two of them."""
    chapters = {name[2:] for name in CHAPTERS.values()}
    if not all(WORK.fullmatch(name) or name in chapters for name in map(stem_of, inner)):
        return False
    where: dict[str, set[str]] = {}
    for one in found:
        for number in one.saved.answers if one.saved else ():
            where.setdefault(number, set()).add(one.parts[1])
    return bool(where) and all(len(folders) == 1 for folders in where.values())


def stem_of(name: str) -> str:
    """A name without its endings: "ada.ipynb.zip" is Ada's."""
    end = len(name)
    while ending := ENDING.search(name, max(end - 6, 0), end):
        end = ending.start()
    return name[:end]
