"""The report of a class as HTML: everything that strangers wrote is escaped, and nothing runs."""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Iterator
from html import escape
from importlib.resources import files

from .class_results import ClassResults
from .students import Student

SIGNS = {"right": "✓", "wrong": "✗", "error": "!", "open": "○", "not run": "–", "absent": ""}
BAR = 160
"""Pixels of the longest bar."""


def page(report: ClassResults) -> str:
    """Return a page that stands alone; its policy lets no script run and asks for nothing."""
    style = _style("report_tables.css") + _style("report_page.css")
    digest = base64.b64encode(hashlib.sha256(style.encode()).digest()).decode()
    policy = f"default-src 'none'; style-src 'sha256-{digest}'; base-uri 'none'; form-action 'none'"
    title = f"Class report: {escape(report.folder)}"
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        '<meta name="color-scheme" content="light dark">\n'
        f"<title>{title}</title>\n<style>{style}</style>\n</head>\n<body>\n"
        f'<main class="class-report">\n<h1>{title}</h1>\n{_tables(report)}</main>\n'
        "</body>\n</html>\n"
    )


def fragment(report: ClassResults) -> str:
    """Return the tables for a notebook."""
    style = _style("report_tables.css")
    return f'<div class="class-report"><style>{style}</style>\n{_tables(report)}</div>'


def _style(name: str) -> str:
    return (files(__package__) / name).read_text("utf-8")


def _tables(report: ClassResults) -> str:
    return "\n".join([*_students(report), *_notes(report), *_slips(report), *_words(report)]) + "\n"


def _students(report: ClassResults) -> Iterator[str]:
    signs = " ".join(
        f'<span class="key"><span class="cell {_class(status)}">{sign}</span> {status}</span>'
        for status, sign in SIGNS.items()
    )
    yield "<h2>Students</h2>"
    yield f'<p class="legend">{signs}</p>'
    yield '<div class="wide" tabindex="0" role="region" aria-label="Students by exercises"><table>'
    heads = "".join(f'<th scope="col">{escape(number)}</th>' for number in report.exercises)
    yield (
        '<thead><tr><th scope="col">student</th><th scope="col">right</th>'
        f'<th scope="col">attempts</th>{heads}</tr></thead><tbody>'
    )
    for student in report.students:
        cells = "".join(_cell(student.status(number)) for number in report.exercises)
        yield (
            f'<tr><th scope="row">{_name(student)}</th>'
            f'<td class="sum">{student.right(report.exercises)} of {len(report.exercises)}</td>'
            f"<td>{student.attempts(report.exercises)}</td>{cells}</tr>"
        )
    totals = "".join(
        f"<td>{sum(student.status(number) == 'right' for student in report.students)}</td>"
        for number in report.exercises
    )
    yield f'</tbody><tfoot><tr><th scope="row">right</th><td></td><td></td>{totals}</tr></tfoot>'
    yield "</table></div>"


def _name(student: Student) -> str:
    mark = "" if student.is_listed else ' <span class="aside">not on the list</span>'
    return f"<bdi>{escape(student.name)}</bdi>{mark}"


def _cell(status: str) -> str:
    return (
        f'<td class="cell {_class(status)}"><span aria-hidden="true">{SIGNS[status]}</span>'
        f'<span class="spoken">{status}</span></td>'
    )


def _class(status: str) -> str:
    return status.replace(" ", "-")


def _slips(report: ClassResults) -> Iterator[str]:
    yield "<h2>Map of slips</h2>"
    if not report.slips:
        yield "<p>No notebook shows a wrong answer.</p>"
        return
    most = len(report.slips[0].students)
    yield '<table class="slips"><thead><tr><th scope="col">exercise</th>'
    yield '<th scope="col">students</th><th scope="col">what they were told</th></tr></thead>'
    yield "<tbody>"
    for slip in report.slips:
        count = len(slip.students)
        size = max(2, round(BAR * count / most))
        bar = (
            f'<svg class="bar" width="{BAR}" height="12" aria-hidden="true">'
            f'<rect width="{size}" height="12" rx="2"></rect></svg>'
        )
        says = escape(slip.says) or "<i>a wrong answer that shows no known slip</i>"
        who = ", ".join(f"<bdi>{escape(name)}</bdi>" for name in slip.students)
        yield (
            f'<tr><th scope="row">{escape(slip.exercise)}</th>'
            f'<td class="count">{bar} {count}</td>'
            f"<td><details><summary>{says}</summary>{who}</details></td></tr>"
        )
    yield "</tbody></table>"


def _words(report: ClassResults) -> Iterator[str]:
    said = [
        (number, student, answer)
        for number in report.exercises
        for student in report.students
        if (answer := student.answers.get(number)) and answer.because
    ]
    if said:
        yield "<h2>In their own words</h2>"
    last = ""
    for number, student, answer in said:
        if number != last:
            yield ("</dl>" if last else "") + f"<h3>Exercise {escape(number)}</h3><dl>"
            last = number
        yield (
            f'<dt>{_name(student)} <span class="aside">{answer.status}</span></dt>'
            f'<dd dir="auto">{escape(answer.because)}</dd>'
        )
    if said:
        yield "</dl>"


def _notes(report: ClassResults) -> Iterator[str]:
    notes = [escape(note) for note in report.notes]
    notes += [
        f"<bdi>{escape(student.name)}</bdi>: <bdi>{escape(note)}</bdi>"
        for student in report.students
        for note in student.notes
    ]
    if notes:
        yield "<h2>To know</h2><ul>"
        yield "\n".join(f"<li>{note}</li>" for note in notes)
        yield "</ul>"
