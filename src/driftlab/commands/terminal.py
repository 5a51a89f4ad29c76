"""Findings as plain text."""

from __future__ import annotations

import codecs
import re
import textwrap
from collections.abc import Iterator

from .findings import Findings, Table

WIDTH = 88
SIGNS = {"±": "+-", "√": "sqrt ", "²": "^2", "·": "*", "°": "deg"}
"""What a terminal shows that lacks a sign; others become question marks."""
PLAIN = "driftlab-plain"
"""Name of that rule, as a handler of errors of encoding."""
NUMBER = re.compile(r"(< )?[-+]?\d")


def _plain(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    lacking = error.object[error.start : error.end]
    return "".join(SIGNS.get(sign, "?") for sign in lacking), error.end


codecs.register_error(PLAIN, _plain)


def text(findings: Findings) -> str:
    """All that is to be read of findings, in lines that fit a terminal."""
    parts = [findings.title + "\n" + "=" * len(findings.title)]
    parts += ["\n".join(table_lines(table)) for table in (*findings.tables, *findings.details)]
    parts += [filled(sentence) for sentence in findings.sentences]
    parts += [filled(f"Warning: {warning}") for warning in findings.warnings]
    return "\n\n".join(parts) + "\n"


def filled(sentence: str) -> str:
    """A sentence in lines of the terminal's width."""
    return textwrap.fill(sentence, WIDTH, break_long_words=False, break_on_hyphens=False)


def numeric_columns(table: Table) -> list[bool]:
    """Which columns hold numbers only, and so stand to the right."""
    return [
        all(NUMBER.match(cell) or cell in ("", "-") for cell in column) and any(column)
        for column in zip(*table.rows, strict=True)
    ]


def table_lines(table: Table) -> Iterator[str]:
    """Lines of a table: numbers to the right, words to the left."""
    if table.title:
        yield table.title
    rows = (table.head, *table.rows)
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    right = numeric_columns(table)
    for number, row in enumerate(rows):
        cells = [
            cell.rjust(width) if aligned else cell.ljust(width)
            for cell, width, aligned in zip(row, widths, right, strict=True)
        ]
        yield ("  " + "  ".join(cells)).rstrip()
        if number == 0:
            yield "  " + "  ".join("-" * width for width in widths)
    if table.note:
        yield filled(table.note)
