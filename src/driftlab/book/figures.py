"""The published figures of the book: ``figure("03-drift-map")`` shows one on a page."""

from __future__ import annotations

from pathlib import Path

from .chapters import chapters_with, part_of
from .machinery.publish import FigureDefinition, PublishedFigure, read_columns

_PUBLISHED = Path(__file__).parents[3] / "figures"


def figure_definitions(chapter: str | None = None) -> dict[str, FigureDefinition]:
    """Return what the figures of the book, or of one chapter, are made of, by name."""
    chapters = chapters_with("figures") if chapter is None else [chapter]
    return {each.name: each for c in chapters for each in part_of(c, "figures").FIGURES}


def figure(name: str, data: object = None) -> PublishedFigure:
    """Return a published figure by name, to be the last line of a notebook cell.

    It is computed, but for a study of some minutes: that is read from its published CSV, if the
    book's folder is there.

    Parameters
    ----------
    name : str
        Name of its file in the folder ``figures``: "03-drift-map".
    data : object, optional
        Numbers of the chapter's experiment, to draw these instead of computing them again.

    Raises
    ------
    ValueError
        If there is none of that name.
    """
    chapter = str(name)[:2]
    known = figure_definitions(chapter if chapter in chapters_with("figures") else None)
    if name not in known:
        raise ValueError(f"name: expected one of {', '.join(known)}, got {name!r}.")
    definition, table = known[name], _PUBLISHED / f"{name}.csv"
    if data is not None:
        return PublishedFigure(definition, data)
    if definition.restore is not None and table.exists():
        return PublishedFigure(definition, definition.restore(read_columns(table)))
    return PublishedFigure(definition, definition.compute())
