"""The notebooks in a folder, and the values that `check` recorded in them.

Only values are taken from what a notebook shows: who hands it in can write anything into it.
"""

from __future__ import annotations

import json
import os
import stat
import unicodedata
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NamedTuple

from driftlab.book.machinery.exercise.records import MIME

from .typed_answers import UNREAD, Reader, within_bounds

LARGEST = 16 * 2**20
"""Bytes of a notebook; the book's have less than one million, with all figures."""
MOST_BRACKETS = 500_000
"""Of a notebook; each can become an object that takes a hundred bytes and more."""
MOST_BYTES = 4 * 2**30
MOST_FILES = 50_000
"""Of a class, with all that is no notebook."""
DEEPEST = 40
MOST_ANSWERS = 1000
"""Of a notebook; the book has fewer than a hundred exercises."""
MOST_NAMES = 20
NOISE = {
    "__MACOSX", "__pycache__", "Thumbs.db", "desktop.ini", ".DS_Store", ".ipynb_checkpoints",
    ".git", ".venv", ".vscode", ".idea", ".cache", ".Trash",
}  # fmt: skip
"""What systems and programs leave behind, besides a Mac's shadows of files, ``._03.ipynb``."""


class Answer(NamedTuple):
    """An answer in a notebook, to be judged."""

    number: str  # of the exercise
    value: Any  # `UNREAD` if it is neither typed as a literal nor recorded as a value
    student: Any  # the name that numbers were asked with
    recorded: bool = False


def notebooks_in(folder: Path) -> tuple[list[tuple[str, list[Answer]]], list[str]]:
    """Return the notebooks of a folder by their paths, and a sentence on each file left out."""
    found: list[tuple[str, list[Answer]]] = []
    notes: list[str] = []
    others: list[str] = []
    left = MOST_BYTES
    for path, trouble in _files(folder):
        name = clean(path.relative_to(folder).as_posix(), 300)
        if not trouble and path.suffix.casefold() != ".ipynb":
            others.append(name)
            continue
        try:
            if trouble:
                raise ValueError(trouble)
            content = _content(path)
            left -= len(content)
            if left < 0:
                raise ValueError(f"It was not read: the class has more than {MOST_BYTES:,} bytes.")
            found.append((name, answers_in(content)))
        except (ValueError, OSError) as error:
            notes.append(f"{name}: {getattr(error, 'strerror', None) or error}")
    if others:
        more = f" and {len(others) - MOST_NAMES} more" if len(others) > MOST_NAMES else ""
        names = ", ".join(others[:MOST_NAMES]) + more
        notes.append(f"Other files, not read (unpack archives first): {names}.")
    return sorted(found, key=lambda each: each[0]), notes


def _files(folder: Path) -> Iterator[tuple[Path, str]]:
    """All files in a folder, and what is wrong with one before it is opened."""
    waiting, count = [(folder, 0)], 0
    while waiting:
        place, depth = waiting.pop()
        try:
            inside = sorted(os.scandir(place), key=lambda entry: entry.name)
        except OSError as error:
            yield place, f"The folder cannot be read ({error.strerror})."
            continue
        for entry in inside:
            path = Path(entry.path)
            if entry.name.startswith("._") or entry.name in NOISE:
                continue
            count += 1
            if count > MOST_FILES:
                yield path, f"Here reading stopped: there are more than {MOST_FILES:,} files."
                return
            if entry.is_symlink():
                yield path, "It is a link, and links are not followed."
            elif entry.is_dir(follow_symlinks=False):
                if depth < DEEPEST:
                    waiting.append((path, depth + 1))
                else:
                    yield path, f"It is nested in more than {DEEPEST} folders."
            else:
                yield path, ""


def _content(path: Path) -> bytes:
    about = path.lstat()
    if not stat.S_ISREG(about.st_mode):
        raise ValueError("It is not a regular file.")
    if about.st_size > LARGEST:
        raise ValueError(f"It is larger than {LARGEST // 2**20} MB.")
    with path.open("rb") as file:
        return file.read(LARGEST)


def answers_in(content: bytes) -> list[Answer]:
    """Return the answers in a saved notebook; a ValueError says why it cannot be read."""
    reader = Reader()
    answers: list[Answer] = []
    for cell in _cells(content):
        if cell.get("cell_type") != "code":
            continue
        typed = reader.calls(_text(cell.get("source", cell.get("input"))))
        records = {each.number: each for each in _recorded(cell)}  # the last one of an exercise
        for number, value, student in typed:
            record = records.get(number)
            if value is UNREAD and record:
                continue
            if student is UNREAD and record:
                student = record.student
            answers.append(Answer(number, value, student))
        unread = {each.number for each in typed if each.answer is UNREAD}
        read = {each.number for each in typed} - unread
        answers += [each for number, each in records.items() if number not in read]
    return answers[:MOST_ANSWERS]


def _recorded(cell: dict[str, Any]) -> Iterator[Answer]:
    """The answers that `check` recorded when the cell was run; its verdicts are passed over."""
    for output in _dicts(cell.get("outputs")):
        data = output.get("data")
        record = data.get(MIME) if isinstance(data, dict) else None
        if isinstance(record, dict) and isinstance(number := record.get("exercise"), str):
            student = record.get("student", "")
            try:
                value = record.get("answer")
                if isinstance(value, dict):  # the sliders of a panel
                    within_bounds([*value.values()])
                    value = SimpleNamespace(values=value)
                else:
                    within_bounds(value)
            except (ValueError, ArithmeticError, RecursionError):
                value = UNREAD
            yield Answer(number, value, student if isinstance(student, str) else "", True)


def _cells(content: bytes) -> list[dict[str, Any]]:
    if not content.strip(b"\0 \t\r\n"):
        raise ValueError("It is empty.")
    if content.count(b"{") + content.count(b"[") > MOST_BRACKETS:
        raise ValueError("It holds more than a notebook does.")
    try:
        # An editor may have saved it with a mark in front, or in two bytes a character.
        book = json.loads(content.decode(json.detect_encoding(content), errors="replace"))
    except RecursionError:
        raise ValueError("It is nested too deeply for a notebook.") from None
    except (ValueError, MemoryError):
        raise ValueError("It is damaged, or no notebook.") from None
    sheets = _dicts(book.get("worksheets")) if isinstance(book, dict) else []  # format 3
    if not isinstance(book, dict) or not (isinstance(book.get("cells"), list) or sheets):
        raise ValueError("It is damaged, or no notebook.")
    return [cell for holder in (book, *sheets) for cell in _dicts(holder.get("cells"))]


def _text(value: object) -> str:
    """Text of a notebook, which may be kept as a list of lines."""
    if isinstance(value, list):
        return "".join(line for line in value if isinstance(line, str))
    return value if isinstance(value, str) else ""


def _dicts(value: object) -> list[dict[str, Any]]:
    return [one for one in value if isinstance(one, dict)] if isinstance(value, list) else []


def clean(text: str, longest: int) -> str:
    """Return text in one line, without characters that a terminal or a page would obey."""
    line = " ".join(text[: 4 * longest].split())
    kept = "".join(sign for sign in line if unicodedata.category(sign)[0] != "C")
    kept = unicodedata.normalize("NFC", kept)
    return kept if len(kept) <= longest else f"{kept[: longest - 1]}…"
