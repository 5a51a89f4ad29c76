"""What a panel has found: the one number that matters, and a table of the others."""

from __future__ import annotations

import html
import re
from collections.abc import Sequence
from typing import NamedTuple

ABSENT = "–"
"""What stands where a value does not exist."""


class Results(NamedTuple):
    """Results of a panel, as words with units."""

    headline: tuple[str, str]  # name and value of the number that matters most
    # name of a row, then its value in each column. There are as many rows, whatever the values
    rows: Sequence[tuple[str, ...]]
    columns: Sequence[str] = ()  # heads of the columns of values; none for a single column
    note: str = ""  # a sentence below the table: how its numbers are to be read

    def headline_html(self) -> str:
        """The number that matters, large, with its name."""
        name, value = self.headline
        return f"<span>{html.escape(name)}</span> <b>{_value(value)}</b>"

    def table_html(self) -> str:
        """All others as a table with header cells."""
        head = ""
        if self.columns:
            titles = "".join(f"<th scope='col'>{html.escape(title)}</th>" for title in self.columns)
            head = f"<thead><tr><th></th>{titles}</tr></thead>"
        body = "".join(
            f"<tr><th scope='row'>{html.escape(name)}</th>"
            + "".join(f"<td>{_value(value)}</td>" for value in values)
            + "</tr>"
            for name, *values in self.rows
        )
        note = f"<p>{html.escape(self.note)}</p>" if self.note else ""
        return f"<table>{head}<tbody>{body}</tbody></table>{note}"

    def blank(self) -> Results:
        """The same table without a value."""
        rows = [(name, *(ABSENT for _ in values)) for name, *values in self.rows]
        return Results((self.headline[0], ABSENT), rows, self.columns, self.note)


def _value(text: str) -> str:
    # What rounds to zero has no sign.
    return html.escape(re.sub(r"-(0(\.0*)?)(?![\d.])", r"\1", text))
