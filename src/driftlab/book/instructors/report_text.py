"""The report of a class in a terminal."""

from __future__ import annotations

from .class_results import ClassResults
from .plain_text import padded, width

SIGNS = {"right": "+", "wrong": "x", "error": "!", "open": "o", "not run": "?", "absent": "."}
LEGEND = "+ right  x wrong  ! error  o open  ? not run  . absent"
WIDEST = 28
MOST_SLIPS = 12


def text_of(report: ClassResults) -> str:
    """Return one row a student, what could not be read, and the slips."""
    columns = min(WIDEST, max([width(each.name) for each in report.students], default=0) + 2)
    chapters: dict[str, list[str]] = {}
    for number in report.exercises:
        chapters.setdefault(number.split(".")[0].zfill(2), []).append(number)
    widths = [max(len(numbers), 2) for numbers in chapters.values()]
    heads = [chapter.ljust(size) for chapter, size in zip(chapters, widths, strict=True)]
    lines = [
        f"{report.folder}: {len(report.students)} students, {len(report.exercises)} exercises",
        "",
        "  ".join(["student".ljust(columns), "right", "attempts", *heads]).rstrip(),
    ]
    for student in report.students:
        signs = [
            "".join(SIGNS[student.status(number)] for number in numbers).ljust(size)
            for numbers, size in zip(chapters.values(), widths, strict=True)
        ]
        right, attempts = student.right(report.exercises), student.attempts(report.exercises)
        name = padded(student.name if student.is_listed else f"* {student.name}", columns)
        lines.append("  ".join([name, f"{right:5}", f"{attempts:8}", *signs]).rstrip())
    lines += ["", LEGEND + ("" if all(s.is_listed for s in report.students) else "  * not listed")]
    notes = [f"{student.name}: {note}" for student in report.students for note in student.notes]
    if notes or report.notes:
        lines += ["", "To know:", *(f"  {note}" for note in [*report.notes, *notes])]
    if report.slips:
        lines += ["", "Slips, the most frequent first:"]
        for slip in report.slips[:MOST_SLIPS]:
            says = slip.says or "(a wrong answer that shows no known slip)"
            lines.append(f"  {len(slip.students):3}  {slip.exercise:5} {says}")
        if more := len(report.slips) - MOST_SLIPS:
            lines += [f"  and {more} more in slips.csv"] if more > 0 else []
    return "\n".join(lines)
