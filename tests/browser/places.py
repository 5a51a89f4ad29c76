"""Where the book shows its panels."""

import ast
from collections.abc import Iterator
from typing import NamedTuple

import nbformat
from pages import FOLDER


class Place(NamedTuple):
    """Where in the book a panel is shown."""

    chapter: str
    cell: int
    explorer: str
    arguments: tuple[str, ...]


def places() -> Iterator[Place]:
    """All cells of the book whose last line is a panel."""
    for path in sorted(FOLDER.glob("*.ipynb")):
        for index, cell in enumerate(nbformat.read(path, as_version=4).cells):
            if cell.cell_type == "code" and "Explorer(" in cell.source:
                call = ast.parse(cell.source).body[-1].value
                arguments = tuple(ast.literal_eval(argument) for argument in call.args)
                yield Place(path.name, index, call.func.id, arguments)


PLACES = list(places())
