"""Questions in the language of text2qti, a program that makes QTI 1.2 of them for Canvas.

It writes numbers with four decimals, because Canvas keeps no more, so a question that asks for a
finer number is left out. A wrong number cannot have a reply of its own.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import groupby
from textwrap import indent

from .questions import Number, Question

TITLE = "Drift Lab"
FINEST = 1e-3
"""Of a finer tolerance four decimals are a part that counts."""
SMALLEST = 1e-4
"""Size of the smallest limit of a right answer."""


def fits(question: Question) -> bool:
    """Whether four decimals are enough for a question."""
    return all(
        each.tolerance >= FINEST
        and min(abs(each.right - each.tolerance), abs(each.right + each.tolerance)) >= SMALLEST
        for each in question.numbers
    )


def quiz_text(questions: Iterable[Question]) -> str:
    """Return a quiz; of the variants of an exercise each student gets one.

    An exercise that asks for several numbers becomes as many questions.
    """
    parts = [f"Quiz title: {TITLE}\n"]
    for _, same in groupby(questions, lambda question: question.exercise):
        members = list(same)
        written = "\n".join(part for each in members for part in _questions(each))
        if members[0].variant:
            written = f"GROUP\npick: 1\npoints per question: 1\n\n{written}\nEND_GROUP\n"
        parts.append(written)
    return "\n".join(parts)


def _questions(question: Question) -> list[str]:
    if question.statements:
        return [_choice(question)]
    return [
        _number(question, which, number) for which, number in enumerate(question.numbers, start=1)
    ]


def _number(question: Question, which: int, number: Number) -> str:
    count = len(question.numbers)
    title, text = question.title, question.text
    if count > 1:
        title += f", number {which} of {count}"
        text += f"\n\n**Of the {count} numbers give number {which} here.**"
    return (
        f"Title: {title}\n{_hanging('1.', text)}{_remark(question)}"
        f"= {number.right:.10g} +- {number.tolerance:.10g}\n"
    )


def _choice(question: Question) -> str:
    lines = [f"Title: {question.title}\n{_hanging('1.', question.text)}{_remark(question)}"]
    for each in question.statements:
        lines.append(_hanging("[*]" if each.true else "[ ]", each.text))
        if each.says:
            lines.append(_hanging("...", each.says))
    return "".join(lines)


def _remark(question: Question) -> str:
    return _hanging("+", question.remark) if question.remark else ""


def _hanging(mark: str, text: str) -> str:
    """Text behind a mark, its other lines under the first one."""
    return f"{mark:<4}{indent(text, '    ')[4:]}\n"
