"""Who handed in a file: read from its name and its folders, as learning platforms give them.

- Moodle: ``[group-]Full Name_1234567_assignsubmission_file[_]/name``, a folder a student, or the
  same in front of the name. A name keeps its blanks and has no underscore.
- Canvas: ``lovelaceada[_LATE]_12345_67890_name``: family name first, without blanks, the numbers
  of the student and of the file. What is handed in again has ``-1`` and so on behind its name.
- nbgrader: ``submitted/student/assignment/name``, with ``timestamp.txt`` beside it.
- The book's web pages: ``drift-lab-answers-ada-lovelace.ipynb``, with the name as it is written in
  the title inside.
- Else the first folder is the student's, or the archive, or the file is.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from datetime import datetime
from typing import NamedTuple

from driftlab.book.chapters import CHAPTERS

from .found_files import Found
from .plain_text import clean, is_no_name
from .roster import Listed
from .wrapping import CANVAS, MOODLE, stem_of, without_wrapping

CANVAS_AGAIN = re.compile(r"-([0-9]{1,2})(?=\.|$)")
COPY = re.compile(r" ?\(([0-9]{1,2})\)(?=\.|$)")
"""What browsers put behind the name of a second download."""
EXPORT = re.compile(r"drift-lab-answers(?:-(?P<name>.+))?", re.S)
ANONYMOUS = (*(name[2:] for name in CHAPTERS.values()), "drift-lab-answers", "answers")
"""Names of files that are nobody's."""


class Person(NamedTuple):
    """A student as a platform names one.

    Attributes
    ----------
    name : str
        As it shows.
    id : str
        The platform's number, if it gives one.
    """

    name: str
    id: str = ""

    @property
    def key(self) -> str:
        """The same for the same student."""
        return f"id {self.id}" if self.id else f"name {self.name.casefold()}"


class HandedIn(NamedTuple):
    """A file with its student.

    Attributes
    ----------
    person : Person
    file : str
        Its name, without what the platform has put in front.
    newness : tuple
        Of two files with the same exercises the one with the larger counts.
    found : Found
    is_named_inside : bool
        Whether a name in the file says better whose it is.
    """

    person: Person
    file: str
    newness: tuple[float, float]
    found: Found
    is_named_inside: bool = False


def handed_in(
    found: Iterable[Found], listed: Sequence[Listed] = ()
) -> tuple[list[HandedIn], list[str]]:
    """Return the files with their students, and sentences on what was left out or is unclear."""
    inside, unclear = without_wrapping(list(found), listed)
    everything, notes = _below_submitted(inside)
    notes += unclear
    times = {
        one.parts[:-1]: moment
        for one in everything
        if one.parts[-1] == "timestamp.txt" and (moment := _timestamp(one.moment)) is not None
    }
    # Whose folder holds nothing but the moment has handed in nothing, and has a row all the same.
    filled = {one.parts[:-1] for one in everything if one.parts[-1] != "timestamp.txt"}
    archives = _archives_of_a_class(everything)
    files = []
    for one in everything:
        is_moment = one.parts[-1] == "timestamp.txt" and not one.trouble
        if is_moment and one.parts[:-1] in filled:
            continue
        if is_moment and len(one.parts) > 1:
            one = Found((*one.parts[:-1], ""), one.time)
        files.append(_whose(one, times.get(one.parts[:-1], one.time), archives))
    return _without_groups(files), notes


def _archives_of_a_class(found: list[Found]) -> set[str]:
    """Archives in which a platform has put several students; else one is its owner's."""
    inside: dict[str, set[str]] = {}
    for one in found:
        if len(one.parts) > 1 and one.parts[0].casefold().endswith(".zip"):
            for pattern in (MOODLE, CANVAS):
                if said := pattern.fullmatch(one.parts[1]):
                    inside.setdefault(one.parts[0], set()).add(f"{said['id']}")
    return {archive for archive, students in inside.items() if len(students) > 1}


def _whose(found: Found, moment: float, archives: set[str]) -> HandedIn:
    parts = found.parts
    file = clean(parts[-1] or parts[-2], 200) or "?"
    copies = COPY.search(file)
    newness = (moment, float(copies[1]) if copies else 0.0)
    # What a student has packed may be called like another's.
    outer = parts[:2] if parts[0] in archives or not _is_archive(parts[0]) else parts[:1]
    for place, part in enumerate(outer):
        if said := MOODLE.fullmatch(part):
            person = Person(clean(said["name"], 100), clean(said["id"], 40))
            shown = clean(said["file"], 200) if part == parts[-1] and said["file"] else file
            return HandedIn(person, shown, newness, found)
        # Canvas makes no folders, and a report_11_2026_final.ipynb in a student's is none of its.
        is_outermost = place == 0 or parts[0] in archives
        if is_outermost and (said := CANVAS.fullmatch(part)):
            again = CANVAS_AGAIN.search(said["file"])
            newness = (float(again[1]) if again else newness[1], float(said["upload"]))
            shown = clean(said["file"], 200) if part == parts[-1] else file
            person = Person(clean(said["name"] or "Anonymous", 100), said["id"] or said["anon"])
            return HandedIn(person, shown, newness, found)
    first = parts[0]
    if len(parts) > 1:
        name = stem_of(first) if first.casefold().endswith(".zip") else first
        return HandedIn(Person(clean(name, 100) or "?"), file, newness, found)
    stem = COPY.sub("", stem_of(first))
    if said := EXPORT.fullmatch(stem):
        name = clean((said["name"] or "").replace("-", " "), 100)
        person = Person(file if is_no_name(name) else name)
        return HandedIn(person, file, newness, found, is_named_inside=True)
    # Two files of the book's own name are two students', not two downloads of one.
    name = file if stem in ANONYMOUS or stem.isdigit() else clean(stem, 100) or file
    is_nobodys = stem in ANONYMOUS or stem.isdigit()
    return HandedIn(Person(name), file, newness, found, is_named_inside=is_nobodys)


def _is_archive(name: str) -> bool:
    return name.casefold().endswith(".zip")


def _below_submitted(found: list[Found]) -> tuple[list[Found], list[str]]:
    """What students handed in of a whole course of nbgrader."""
    if any(MOODLE.fullmatch(one.parts[0]) or CANVAS.fullmatch(one.parts[0]) for one in found):
        return found, []
    # At the top, or below one folder around it all: elsewhere it is some student's.
    is_wrapped = len({one.parts[0] for one in found}) == 1
    inside = [one for one in found if "submitted" in one.parts[:-2][: 1 + is_wrapped]]
    if not inside:
        return found, []
    left_out = len(found) - len(inside)
    notes = [f'Only the folder "submitted" is read; {left_out} files lie elsewhere.']
    below = [one._replace(parts=one.parts[one.parts.index("submitted") + 1 :]) for one in inside]
    return below, notes if left_out else []


def _without_groups(files: list[HandedIn]) -> list[HandedIn]:
    """Without the group that Moodle puts in front of a name: "Group A-Ada Lovelace".

    Names have hyphens too, so a group is what stands before several names, and has a digit, or a
    blank before a name that has one as well.
    """
    members: dict[str, set[str]] = {}
    for file in files:
        group, hyphen, name = file.person.name.partition("-")
        has_digit = any(map(str.isdigit, group))
        if hyphen and file.person.id and name and (has_digit or (" " in group and " " in name)):
            members.setdefault(group, set()).add(file.person.id)
    groups = {group for group, several in members.items() if len(several) > 1}

    def without(person: Person) -> Person:
        group, _, name = person.name.partition("-")
        return person._replace(name=name) if group in groups and person.id else person

    return [file._replace(person=without(file.person)) for file in files]


def _timestamp(content: bytes) -> float | None:
    """The moment in a file of nbgrader: "2026-01-30 15:30:10.123456 UTC"."""
    said = re.match(rb"\s*(\d{4}-\d\d-\d\d[ T]\d\d:\d\d:\d\d(?:\.\d{1,6})?)", content)
    try:
        return datetime.fromisoformat(said[1].decode()).timestamp() if said else None
    except (ValueError, OverflowError, OSError):
        return None
