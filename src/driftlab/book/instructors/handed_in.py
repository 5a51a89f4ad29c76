"""Who handed in a file: read from its name and its folders, as learning platforms give them.

- Moodle: ``[group-]Full Name_1234567_assignsubmission_file[_]/name``, a folder a student, or the
  same in front of the name. A name keeps its blanks and has no underscore.
- Canvas: ``lovelaceada[_LATE]_12345_67890_name``: family name first, without blanks, the numbers
  of the student and of the file. What is handed in again has ``-1`` and so on behind its name.
- nbgrader: ``submitted/student/assignment/name``, with ``timestamp.txt`` beside it.
- The book's web pages: ``drift-lab-answers-ada-lovelace.ipynb``, with the name as it is written in
  the title inside.
- Else the first folder is the student's, or the archive, or the file is; two of them are one
  student's only if they are called the same, to the letter.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from datetime import datetime
from typing import NamedTuple

from driftlab.book.chapters import CHAPTERS

from .downloads import at_the_top, without_report
from .found_files import Found, is_archive
from .plain_text import clean, is_no_name, squeezed
from .roster import Listed
from .wrapping import CANVAS, MOODLE, stem_of, without_wrapping

CANVAS_AGAIN = re.compile(r"-([0-9]{1,2})(?=\.|$)")
COPY = re.compile(r" ?\(([0-9]{1,2})\)(?=\.|$)")
"""What browsers put behind the name of a second download."""
EXPORT = re.compile(r"drift-lab-answers(?:-(?P<name>.+))?", re.S)
ANONYMOUS = (*(name[2:] for name in CHAPTERS.values()), "drift-lab-answers", "answers")
"""Names of files that are nobody's."""


class Person(NamedTuple):
    """A student as a platform, a folder or a file names one."""

    name: str  # as it shows
    id: str = ""  # the platform's number, if it gives one
    key: str = ""  # the same for the same student, as far as the names of folders and files say it


class HandedIn(NamedTuple):
    """A file with its student."""

    person: Person
    file: str  # its name, without what the platform has put in front
    # of two files with the same exercises the one with the larger counts
    newness: tuple[float, float]
    found: Found
    # whether only a name in the file, or in its own, says whose it is: anybody can write it
    is_claimed: bool = False
    trouble: str = ""  # what is odd about the name, in one sentence


def handed_in(
    found: Iterable[Found], listed: Sequence[Listed] = ()
) -> tuple[list[HandedIn], list[str]]:
    """Return the files with their students, and sentences on what was left out or is unclear."""
    inside, reports = without_report(list(found))
    inside, unclear = without_wrapping(inside, listed)
    everything, downloads, notes = at_the_top(inside)
    times = {
        one.parts[:-1]: moment
        for one in everything
        if one.parts[-1] == "timestamp.txt" and (moment := _timestamp(one.moment)) is not None
    }
    # Whose folder holds nothing but the moment has handed in nothing, and has a row all the same.
    filled = {one.parts[:-1] for one in everything if one.parts[-1] != "timestamp.txt"}
    files = []
    for one in everything:
        is_moment = one.parts[-1] == "timestamp.txt" and not one.trouble
        if is_moment and one.parts[:-1] in filled:
            continue
        if is_moment and len(one.parts) > 1:
            one = Found((*one.parts[:-1], ""), one.time)
        files.append(_whose(one, times.get(one.parts[:-1], one.time), downloads))
    return _without_groups(files), reports + notes + unclear


def _whose(found: Found, moment: float, downloads: set[str]) -> HandedIn:
    parts = found.parts
    file = clean(parts[-1] or parts[-2], 200) or "?"
    copies = COPY.search(file)
    newness = (moment, float(copies[1]) if copies else 0.0)
    part = parts[1] if parts[0] in downloads else parts[0]
    if said := MOODLE.fullmatch(part):
        person = Person(
            clean(said["name"], 100) or "?", clean(said["id"], 40), f"Moodle {said['id']}"
        )
        shown = clean(said["file"], 200) if part == parts[-1] and said["file"] else file
        return HandedIn(person, shown, newness, found)
    if said := CANVAS.fullmatch(part):
        again = CANVAS_AGAIN.search(said["file"])
        newness = (float(again[1]) if again else newness[1], float(said["upload"]))
        shown = clean(said["file"], 200) if part == parts[-1] else file
        id_ = said["id"] or said["anon"]
        person = Person(clean(said["name"] or "Anonymous", 100) or "?", id_, f"Canvas {id_}")
        return HandedIn(person, shown, newness, found)
    first = parts[0]
    if len(parts) > 1:
        name = stem_of(first) if is_archive(first) else first
        return HandedIn(Person(clean(name, 100) or "?", key=f"folder {name}"), file, newness, found)
    return _of_a_file(stem_of(first), file, newness, found)


def _of_a_file(full: str, file: str, newness: tuple[float, float], found: Found) -> HandedIn:
    """Whose a file is that lies in no folder; students choose its name."""
    stem = COPY.sub("", full)
    title = found.saved.whose if found.saved and not is_no_name(found.saved.whose) else ""
    # Two files of the book's own name are two students', not two downloads of one.
    name, key, trouble, is_claimed = file, f"file {full}", "", False
    if said := EXPORT.fullmatch(stem):
        in_file = clean((said["name"] or "").replace("-", " "), 100)
        is_claimed = True
        if title and (is_no_name(in_file) or _is_same(in_file, title)):
            name = title
        elif not is_no_name(in_file):
            name = in_file
            trouble = f"The title inside says {title}." if title else ""
    elif stem in ANONYMOUS or stem.isdigit():
        name, is_claimed = title or file, bool(title)
    else:
        name, key = clean(stem, 100) or file, f"folder {stem}"
    key = f"claim {name.casefold()}" if is_claimed and name != file else key
    return HandedIn(Person(name, key=key), file, newness, found, is_claimed, trouble)


def _is_same(in_file: str, title: str) -> bool:
    """Whether a file is called as the web pages call that of a name; they cut it short."""
    one, other = squeezed(re.sub(r"(?<=\D) [0-9]{1,2}$", "", in_file)), squeezed(title)
    return squeezed(in_file) == other or one == other or (len(one) > 25 and other.startswith(one))


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
