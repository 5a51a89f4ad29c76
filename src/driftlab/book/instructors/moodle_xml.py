"""Questions in Moodle XML, which Moodle imports without a plugin.

A wrong number that a likely slip leads to is one of the answers, worth nothing, and its feedback
names the slip; Moodle takes the first answer that is met, so the right one comes first.
"""

from __future__ import annotations

import html
import re
from collections.abc import Iterable
from itertools import groupby
from xml.etree import ElementTree as ET

from .questions import Number, Question

_AS_IT_STANDS = re.compile(r"\$\$(.+?)\$\$|\$([^$]+)\$|`([^`]*)`", re.DOTALL)
_CATEGORY = "$course$/top/Drift Lab"


def moodle_xml(questions: Iterable[Question]) -> str:
    """Return a question bank with a category for each chapter, and one for each set of variants."""
    quiz = ET.Element("quiz")
    for category, members in groupby(questions, _category):
        heading = ET.SubElement(quiz, "question", type="category")
        _text(heading, "category", category)
        for question in members:
            _add(quiz, question)
    ET.indent(quiz)
    return ET.tostring(quiz, encoding="unicode", xml_declaration=True) + "\n"


def _category(question: Question) -> str:
    chapter = f"{_CATEGORY}/Chapter {question.exercise.split('.')[0].zfill(2)}"
    return f"{chapter}/Variants of {question.exercise}" if question.variant else chapter


def _add(quiz: ET.Element, question: Question) -> None:
    kind = "multichoice" if question.statements else "numerical"
    cloze = len(question.numbers) > 1
    one = ET.SubElement(quiz, "question", type="cloze" if cloze else kind)
    _text(one, "name", question.title)
    asks = in_html(question.text)
    if cloze:
        gaps = "".join(f"<li>{_gap(each)}</li>" for each in question.numbers)
        asks += f"<p>Your numbers, in this order:</p><ol>{gaps}</ol>"
    _text(one, "questiontext", asks, format="html")
    remark = in_html(question.remark)
    if cloze:
        _text(one, "generalfeedback", remark, format="html")
    elif question.numbers:
        _answers(one, question.numbers[0], remark)
    else:
        _statements(one, question, remark)


def _answers(one: ET.Element, number: Number, remark: str) -> None:
    for fraction, value, tolerance, says in [
        ("100", number.right, number.tolerance, remark),
        *(("0", slip.value, slip.tolerance, in_html(slip.says)) for slip in number.slips),
    ]:
        answer = _text(one, "answer", _written(value), fraction=fraction)
        _text(answer, "feedback", says, format="html")
        ET.SubElement(answer, "tolerance").text = _written(tolerance)


def _statements(one: ET.Element, question: Question, remark: str) -> None:
    """All true ones make the mark; a wrong one takes away as much as all are many."""
    for name, value in (
        ("single", "false"),
        ("shuffleanswers", "false"),
        ("answernumbering", "none"),
    ):
        ET.SubElement(one, name).text = value
    _text(one, "correctfeedback", remark, format="html")
    true = sum(each.true for each in question.statements)
    for each in question.statements:
        worth = 100 / true if each.true else -100 / (len(question.statements) - true)
        answer = _text(one, "answer", in_html(each.text), fraction=f"{worth:.7g}", format="html")
        _text(answer, "feedback", in_html(each.says), format="html")


def _gap(number: Number) -> str:
    """A number in Moodle's language for gaps in a text, HTML about it."""
    answers = [f"={_written(number.right)}:{_written(number.tolerance)}"]
    for slip in number.slips:
        says = re.sub(r"([}~#])", r"\\\1", in_html(slip.says, block=False))
        answers.append(f"%0%{_written(slip.value)}:{_written(slip.tolerance)}#{says}")
    return f"{{1:NUMERICAL:{'~'.join(answers)}}}"


def _written(value: float) -> str:
    return f"{value:.10g}"


def _text(parent: ET.Element, name: str, text: str, **attributes: str) -> ET.Element:
    element = ET.SubElement(parent, name, attributes)
    ET.SubElement(element, "text").text = text
    return element


def in_html(markdown: str, *, block: bool = True) -> str:
    r"""Return Markdown of an exercise in HTML, with formulas between \( and \) for MathJax.

    Exercises are written in paragraphs, lists, emphasis, code and formulas, and in nothing else.
    """
    kept: list[str] = []

    def keep(found: re.Match[str]) -> str:
        shown, inline, code = (part and html.escape(part, quote=False) for part in found.groups())
        kept.append(
            rf"\[{shown}\]" if shown else rf"\({inline}\)" if inline else f"<code>{code}</code>"
        )
        return f"\0{len(kept) - 1}\0"

    text = html.escape(_AS_IT_STANDS.sub(keep, markdown), quote=False)
    text = re.sub(r"\*\*(.+?)\*\*", r"<strong>\1</strong>", text)
    text = re.sub(r"\*(.+?)\*", r"<em>\1</em>", text)
    if block:
        text = "".join(map(_block, re.split(r"\n\s*\n", text.strip()))) if text.strip() else ""
    return re.sub("\0(\\d+)\0", lambda found: kept[int(found[1])], text)


def _block(text: str) -> str:
    if text.startswith("- "):
        return "<ul>" + "".join(f"<li>{item[2:]}</li>" for item in text.split("\n")) + "</ul>"
    return f"<p>{text}</p>"
