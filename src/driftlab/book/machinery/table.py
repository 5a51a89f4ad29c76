"""A table on a notebook page."""

from __future__ import annotations

import re
from collections.abc import Iterable


class Table:
    """Rows of Markdown, to be the last line of a notebook cell.

    Attributes
    ----------
    rows : list of tuple of str
        The first one is the header.
    """

    def __init__(self, rows: Iterable[tuple[str, ...]]) -> None:
        self.rows = list(rows)

    def _repr_markdown_(self) -> str:
        header, *rows = self.rows
        lines = [header, ("---",) * len(header), *rows]
        return "\n".join(f"| {' | '.join(map(_without_bars, line))} |" for line in lines)


def _without_bars(cell: str) -> str:
    r"""A bar would end the cell of a table, in a formula as well; there ``\|`` is a double bar."""
    words_and_formulas = re.split(r"(\$[^$]*\$)", cell)
    for i, part in enumerate(words_and_formulas):
        if i % 2:
            words_and_formulas[i] = part.replace(r"\|", r"\Vert ").replace("|", r"\vert ")
        else:
            words_and_formulas[i] = re.sub(r"(?<!\\)\|", r"\|", part)
    return "".join(words_and_formulas)
