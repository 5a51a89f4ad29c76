"""What the exercises in a saved notebook say; nothing of it is run.

`check` leaves a record beside what it shows (`exercise.records`). Where there is none, as in
notebooks of earlier versions, the words that it shows are read. Nothing proves that nobody wrote
either by hand.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import islice
from typing import Any

from driftlab.book.machinery.exercise.answers import NOT_ALL, NOT_ONE, letters_in
from driftlab.book.machinery.exercise.records import MIME

from .plain_text import clean

LARGEST = 16 * 2**20
"""Bytes of a notebook; more is not read. The book's have less than one, with all figures."""
MOST_BRACKETS = 500_000
"""Of a notebook; each can become an object that takes a hundred bytes and more."""
NUMBER = re.compile(r"[0-9]{1,3}\.[0-9]{1,3}[a-z]?", re.ASCII)
MOST_NUMBERS = 1000
"""Exercises of one notebook; the book has fewer than a hundred."""
MOST_TOLD = 2000
"""Replies in one notebook; what comes behind is not read."""
MOST_CODE = 2 * 2**20
"""Signs of code that are searched for calls; the book's notebooks have a tenth of it."""
MOST_WORDS = 4000
MOST_SLIPS = 50
"""Of one exercise; the last ones."""
MOST_ATTEMPTS = 9999
MOST_CHOSEN = 60
"""Signs of an answer that chooses statements."""

STATUSES = ("right", "wrong", "error", "open", "not run", "absent")
"""What an exercise can be; of several in a notebook the first counts."""

_SAID = re.compile(
    r"^Exercise ([0-9]{1,3}\.[0-9]{1,3}[a-z]?): "
    r"(right|not yet|not readable|not answered yet)\.[ \t]*(.*)$",
    re.MULTILINE,
)
_CALLED = re.compile(
    r"\bcheck\(\s*(?:number\s*=\s*)?"
    r"(?:\"([0-9.]{3,7}[a-z]?)\"|'([0-9.]{3,7}[a-z]?)'|([0-9]{1,3}\.[0-9]{1,3}))"
)
_STATUS = {
    "right": "right",
    "not yet": "wrong",
    "not readable": "wrong",
    "not answered yet": "open",
}


@dataclass
class SavedAnswer:
    """What a notebook says of one exercise."""

    status: str = "absent"  # one of `STATUSES`
    # what wrong answers were told, each once, the latest last
    slips: list[str] = field(default_factory=list)
    attempts: int = 0  # how many different answers were judged, as far as the notebook shows it
    because: str = ""  # the student's own words
    student: str = ""  # the name that the exercise's numbers were asked with; empty for the book's
    is_recorded: bool = False  # whether a record was there; words alone say nothing of the numbers
    error: str = ""  # the name of the error that kept the answer from being judged

    def become(self, status: str) -> None:
        """Take a status, unless one that counts more is there."""
        self.status = min(self.status, status, key=STATUSES.index)


@dataclass
class SavedNotebook:
    """What a saved notebook says."""

    answers: dict[str, SavedAnswer]  # by the exercise's number
    whose: str = ""  # the name in the title of an export from the web pages
    digest: bytes = b""  # the same for the same file


def saved_answers(content: bytes) -> SavedNotebook:
    """Return what `check` had said, exercise by exercise, when a notebook was saved.

    If this is not a notebook in Jupyter's format 3 or 4, a ValueError says so in one sentence,
    without the name of the file.
    """
    notebook: dict[str, list[_Told]] = {}
    whose, replies, code = "", 0, 0
    errors: dict[str, str] = {}
    for cell in _cells(content):
        source = _text(cell.get("source", cell.get("input")))
        if cell.get("cell_type") == "markdown" and not whose:
            whose = _whose(source)
        if cell.get("cell_type") != "code":
            continue
        told: list[_Told] = []
        error = ""
        for output in _dicts(cell.get("outputs")):
            told += islice(_told(output), MOST_TOLD - replies - len(told))
            error = clean(output.get("ename"), 60) or error
        replies += len(told)
        for one in told:
            if one.number in notebook or len(notebook) < MOST_NUMBERS:
                notebook.setdefault(one.number, []).append(one)
        shown = {one.number for one in told}
        code += len(source)
        called = _called(source) if code <= MOST_CODE else ()
        for number in sorted(called)[: MOST_NUMBERS - len(notebook)]:
            notebook.setdefault(number, [])
            if error and number not in shown:
                errors[number] = error
    answers = {number: _summed(told, errors.get(number)) for number, told in notebook.items()}
    return SavedNotebook(answers, whose, hashlib.sha256(content).digest())


@dataclass
class _Told:
    """What was said once: the word that follows the number, and the rest."""

    number: str
    word: str
    says: str
    attempt: int = 0
    because: str = ""
    student: str = ""
    is_recorded: bool = False


def _summed(told: list[_Told], error: str | None) -> SavedAnswer:
    answer = SavedAnswer("not run")
    if error:
        answer.become("error")
        answer.error = error
    judged = [one for one in told if _STATUS[one.word] != "open"]
    for one in told:
        answer.become(_STATUS[one.word])
        answer.because = one.because or answer.because
        answer.student = one.student or answer.student
        answer.is_recorded |= one.is_recorded
    slips = [one.says for one in judged if _STATUS[one.word] == "wrong"]
    answer.slips = list(dict.fromkeys(reversed(slips)))[:MOST_SLIPS][::-1]
    counted = {one.attempt for one in judged if one.attempt}
    # Who shows one answer in two cells has tried once; where nothing is counted, each is a try.
    shown = len(counted) + sum(not one.attempt for one in judged)
    answer.attempts = min(max(shown, *counted, 0), MOST_ATTEMPTS)
    return answer


def _cells(content: bytes) -> Iterator[dict[str, Any]]:
    if len(content) > LARGEST:
        raise ValueError(f"It is larger than {LARGEST // 2**20} MB.")
    if not content.strip(b"\0 \t\r\n"):
        raise ValueError("It is empty.")
    if content.count(b"{") + content.count(b"[") > MOST_BRACKETS:
        raise ValueError("It holds more than a notebook does.")
    try:
        # With what an editor has put first, or in two bytes a sign, too; of a letter in another
        # encoding nothing that counts depends.
        book = json.loads(content.decode(json.detect_encoding(content), errors="replace"))
    except RecursionError:
        raise ValueError("It is nested too deeply for a notebook.") from None
    except (ValueError, MemoryError):
        raise ValueError("It is not a notebook, whatever its name says.") from None
    sheets = _dicts(book.get("worksheets")) if isinstance(book, dict) else []
    if not isinstance(book, dict) or not (isinstance(book.get("cells"), list) or sheets):
        raise ValueError("It is not a notebook, whatever its name says.")
    for holder in (book, *sheets):
        yield from _dicts(holder.get("cells"))


def _told(output: dict[str, Any]) -> Iterator[_Told]:
    data = output.get("data")
    data = data if isinstance(data, dict) else {}
    record = data.get(MIME)
    if isinstance(record, dict) and (told := _recorded(record)):
        yield told
        return
    text = _text(output.get("text")) or _text(data.get("text/plain"))
    for said in _SAID.finditer(text):
        number, word, says = said.groups()
        yield _Told(number, word, _slip(clean(says)))


def _recorded(record: dict[str, Any]) -> _Told | None:
    number, word, attempt = (record.get(name) for name in ("exercise", "word", "attempt"))
    if not isinstance(number, str) or not NUMBER.fullmatch(number) or word not in tuple(_STATUS):
        return None
    counted = type(attempt) is int and 0 < attempt <= MOST_ATTEMPTS
    return _Told(
        number,
        str(word),
        _slip(clean(record.get("says")), record.get("answer")),
        attempt if counted and isinstance(attempt, int) else 0,
        clean(record.get("because"), MOST_WORDS),
        clean(record.get("student"), 100),
        is_recorded=True,
    )


def _slip(says: str, answer: object = None) -> str:
    """What shows a slip: of statements that are told alike whatever was chosen, the choice."""
    if not says.startswith((NOT_ALL, NOT_ONE)):
        return says
    text = answer[:MOST_CHOSEN] if isinstance(answer, str) else ""
    chosen = [letter for letter in letters_in(text) if letter.isascii() and letter.isalpha()]
    return f"Chose {', '.join(chosen)}." if chosen else ""


def _called(source: str) -> set[str]:
    """Numbers of the exercises that a cell hands an answer to."""
    code = re.sub(r"#.*", "", source)
    found = set()
    for called in _CALLED.finditer(code):
        double, single, bare = called.groups()
        number = double or single or str(float(bare))
        if NUMBER.fullmatch(number):
            found.add(number)
    return found


def _whose(source: str) -> str:
    """The name in a title as the web pages export it, where a backslash guards punctuation."""
    title = re.match(r"# Answers of (.{1,400})", source)
    return clean(re.sub(r"\\([!-/:-@\[-`{-~])", r"\1", title[1]), 100) if title else ""


def _text(value: object) -> str:
    """Text of a notebook, which may be kept as a list of lines."""
    if isinstance(value, list):
        return "".join(line for line in value if isinstance(line, str))
    return value if isinstance(value, str) else ""


def _dicts(value: object) -> list[dict[str, Any]]:
    return [one for one in value if isinstance(one, dict)] if isinstance(value, list) else []
