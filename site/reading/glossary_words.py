"""The glossary's words in three languages, as places that the search and the index lead to."""

from __future__ import annotations

import re
from collections.abc import Iterator

from docutils import nodes
from sphinx import addnodes
from sphinx.transforms import SphinxTransform

from addresses import slug

GLOSSARY_PAGE = "glossary"
LANGUAGES = ("English", "Russian", "Chinese")
"""The first columns of the table, by their heads."""


class GlossaryWords(SphinxTransform):
    """Give each row of the glossary a name, and enter its words, before Sphinx collects them."""

    default_priority = 840

    def apply(self, **options: object) -> None:
        """Put an entry of the index in front of the table for each row."""
        if self.env.docname != GLOSSARY_PAGE:
            return
        for table in list(self.document.findall(nodes.table)):  # the tree grows in the loop
            head, *rows = table.findall(nodes.row)
            if tuple(cells(head)[: len(LANGUAGES)]) != LANGUAGES:
                continue
            place = table.parent.index(table)
            for row in rows:
                texts = cells(row)
                name = f"term-{slug(texts[0])}"
                row["ids"].append(name)
                entries = [("single", word, name, "main", None) for word in words(texts)]
                table.parent.insert(place, addnodes.index(entries=entries, inline=False))


def cells(row: nodes.row) -> list[str]:
    """Return the texts of a row's cells."""
    return [cell.astext() for cell in row.findall(nodes.entry)]


def words(texts: list[str]) -> Iterator[str]:
    """Yield the words of a row: without what stands in brackets, and what is an abbreviation.

    Of a Russian term also the last word, which says what it is of, "угловая скорость дрейфа".
    """
    russian = re.sub(r"\s*\([^)]*\)", "", texts[1]).split()
    if len(russian) > 1:
        yield russian[-1]
    for text in texts[: len(LANGUAGES)]:
        yield re.sub(r"\s*\([^)]*\)", "", text)
        yield from re.findall(r"\(([^\W\d_]{2,5})\)", text)
