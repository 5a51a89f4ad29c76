"""An examination of 90 minutes and 60 marks: the sheet for the class, the scheme for who marks it.

All numbers are drawn from the name of the edition, a text that the lecturer chooses and keeps, and
so is each part of a question, from three. Nobody who does not know the name can compute the sheet
in advance.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from typing import NamedTuple

from driftlab.book.machinery.table import Table

from .exam_questions import BY_CHOICE, COMPULSORY, Part, Question, drawn_from

CHOSEN = 2
"""How many of the last questions are to be answered."""
READING = 5
"""Minutes."""
RULES = (
    "On paper, with a pocket calculator and one page of notes in your own handwriting. Three "
    "significant digits are enough. Every number needs its unit and one line of working. A "
    "question may state more numbers than it needs."
)


class Page(NamedTuple):
    """A page of Markdown, to be the last line of a notebook cell."""

    text: str

    def _repr_markdown_(self) -> str:
        return self.text


class Examination(NamedTuple):
    """A sheet with its numbers."""

    # what stands on sheet and scheme, so that they are not mixed up. It does not give the name of
    # the edition away
    mark: str
    compulsory: tuple[Question, ...]
    by_choice: tuple[Question, ...]  # of these `CHOSEN` are to be answered

    @property
    def marks(self) -> int:
        """All that can be earned."""
        return sum(q.marks for q in (*self.compulsory, *self.by_choice[:CHOSEN]))

    @property
    def minutes(self) -> int:
        """With those for reading."""
        return READING + sum(q.minutes for q in (*self.compulsory, *self.by_choice[:CHOSEN]))

    def plan(self) -> Table:
        """Return which outcome each question examines, with its marks and minutes."""
        header = ("", "question", "chapter", "examines whether a student can", "marks", "minutes")
        rows = [
            (str(n), q.title, q.chapter, q.outcome, str(q.marks), str(q.minutes))
            for n, q in self._numbered()
        ]
        total = f"reading, and {CHOSEN} of the last {len(self.by_choice)}"
        last = ("", total, "", "", f"**{self.marks}**", f"**{self.minutes}**")
        return Table([header, *rows, last])

    def sheet(self) -> Page:
        """Return what the class gets."""
        parts = [
            f"**Inertial navigation: a bent triad and its errors.** Sheet {self.mark}. "
            f"{self.minutes} minutes, {self.marks} marks.",
            "Name: ______________________________  Number: ______________",
            f"{RULES} The first {READING} minutes are for reading. Answer questions 1 to "
            f"{len(self.compulsory)} and any {CHOSEN} of the last {len(self.by_choice)}. If you "
            f"answer more of these, the first {CHOSEN} count.",
        ]
        for number, question in self._numbered():
            parts += [_title(number, question), question.given]
            parts += [
                f"**({letter})** {part.asks} *[{part.marks}]*"
                for letter, part in _lettered(question)
            ]
        return Page("\n\n".join(parts))

    def scheme(self) -> Page:
        """Return model answers, what earns each mark, typical errors and what they still earn."""
        parts = [
            f"**Marking scheme of sheet {self.mark}.** {self.minutes} minutes, {self.marks} marks.",
            "A number that follows correctly from an earlier wrong one earns its marks. The third "
            "digit may differ by one; a missing unit costs one mark, once on the whole sheet.",
        ]
        for number, question in self._numbered():
            parts += [
                _title(number, question),
                f"*Chapter {question.chapter}: {question.outcome}.*",
            ]
            for letter, part in _lettered(question):
                parts.append(f"**({letter})** {part.works}")
                rows = [f"- **{answer}**" for answer in part.answers]
                rows += [f"- {marks}: {what}" for marks, what in part.earns]
                rows += [f"- *also seen:* {slip}" for slip in part.slips]
                parts.append("\n".join(rows))
        return Page("\n\n".join(parts))

    def _numbered(self) -> Iterable[tuple[int, Question]]:
        return enumerate((*self.compulsory, *self.by_choice), 1)


def exam_paper(edition: str) -> Examination:
    """Return the examination of an edition; the same text always gives the same numbers.

    Let the text say the term, and a word that nobody guesses: who knows it can compute sheet and
    answers.
    """
    if not isinstance(edition, str) or not edition.strip():
        raise ValueError(f"edition: expected a text such as 'autumn, rowan', got {edition!r}.")
    edition = edition.strip()
    sheets = (
        tuple(make(drawn_from(edition, make.__name__)) for make in makers)
        for makers in (COMPULSORY, BY_CHOICE)
    )
    return Examination(hashlib.sha256(f"sheet {edition}".encode()).hexdigest()[:4], *sheets)


def _title(number: int, question: Question) -> str:
    return (
        f"### {number}. {question.title}\n\n"
        f"*{question.marks} marks, about {question.minutes} minutes*"
    )


def _lettered(question: Question) -> Iterable[tuple[str, Part]]:
    return zip("ab", question.parts, strict=True)
