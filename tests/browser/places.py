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
    """All cells of the book whose last line opens a panel.

    An exercise gives its panel a name first, so that an answer can be read from it; it is a panel
    of the same chapter once more, and not tried again.
    """
    for path in sorted(FOLDER.glob("*.ipynb")):
        for index, cell in enumerate(nbformat.read(path, as_version=4).cells):
            if cell.cell_type == "code" and "Explorer(" in cell.source:
                call = ast.parse(cell.source).body[-1].value
                if not isinstance(call, ast.Call):
                    continue
                arguments = tuple(ast.literal_eval(argument) for argument in call.args)
                yield Place(path.name, index, call.func.id, arguments)


PLACES = list(places())
