"""The published figures of the book: ``figure("03-drift-map")`` shows one on a page.

Some are computed from recordings that others have published, and the project holds none of those.
Nothing here fetches one: if it is at hand, from `driftlab.recordings.publishers.published` or in a
folder of the reader's, the figure is computed, else it comes from the numbers in the book's folder.
"""

from __future__ import annotations

import warnings
from functools import cache
from pathlib import Path
from typing import Any

from driftlab.recordings.publishers import PUBLISHED, RecordingUnavailable, published_file

from .chapters import chapters_with, part_of
from .machinery.figure.csv_table import read_table
from .machinery.figure.data_table import DataTable
from .machinery.figure.publish import FigureDefinition, PublishedFigure

_FOLDER = Path(__file__).parents[3] / "figures"


def figure_definitions(chapter: str | None = None) -> dict[str, FigureDefinition]:
    """Return what the figures of the book, or of one chapter, are made of, by name."""
    chapters = chapters_with("figures") if chapter is None else [chapter]
    return {each.name: each for c in chapters for each in part_of(c, "figures").FIGURES}


def figure(name: str, data: object = None, **parameters: Any) -> PublishedFigure:
    """Return a published figure by name, to be the last line of a notebook cell.

    It is computed, but for a study of some minutes and for one whose recording is not at hand:
    those are read from their published CSV, if the book's folder is there. Nothing is downloaded.
    With parameters of your own it is always computed.

    Parameters
    ----------
    name : str
        Name of its file in the folder ``figures``: "03-drift-map".
    data : object, optional
        Numbers of the chapter's experiment, to draw these instead of computing them again.
    **parameters
        What to compute it with, in SI units and radians; what is not named is as published.
        `figure_parameters` lists them.

    Returns
    -------
    PublishedFigure
        A page shows it; ``save("map.pdf", width=3.5)`` puts it into a paper's column, ``table()``
        has its numbers, ``call`` the line that makes it again.

    Raises
    ------
    ValueError
        If there is none of that name, or it has no such parameter.
    RecordingUnavailable
        If a recording is not at hand, and the book's folder is not there either.

    See Also
    --------
    figure_parameters : What can be changed of a figure.

    Examples
    --------
    >>> import driftlab
    >>> mine = driftlab.figure("03-drift-map", error_matrix=[[0, 2e-3, 0], [0, 0, 0], [0, 0, 0]])
    >>> mine.call
    "driftlab.figure('03-drift-map', error_matrix=[[0, 0.002, 0], [0, 0, 0], [0, 0, 0]])"
    """
    definition = _definition(name)
    known = definition.parameters
    if unknown := [each for each in parameters if each not in known]:
        takes = f"expected {', '.join(known)}" if known else "it takes no parameters"
        raise ValueError(f"{name}: {takes}, got {unknown[0]!r}.")
    if data is not None:
        if parameters:
            raise ValueError(f"{name}: expected data or parameters, got both.")
        return PublishedFigure(definition, data)
    if parameters:
        parameters = {**known, **parameters}
        return PublishedFigure(definition, definition.compute(**parameters), parameters)
    return PublishedFigure(definition, measured(name), known, not_at_hand(definition))


def figure_parameters(name: str) -> dict[str, Any]:
    """Return the parameters of a published figure with their published values.

    Parameters
    ----------
    name : str
        As in `figure`.

    Raises
    ------
    ValueError
        If there is none of that name.

    Examples
    --------
    >>> from driftlab.book import figure_parameters
    >>> list(figure_parameters("03-drift-map"))
    ['error_matrix']
    """
    return _definition(name).parameters


def measured(name: str) -> Any:
    """Return the numbers behind a published figure, which `figure` draws, by its name.

    Parameters
    ----------
    name : str
        As in `figure`.

    Returns
    -------
    object
        What the chapter's experiment returns, computed or read from the published CSV.

    Raises
    ------
    ValueError, RecordingUnavailable
        As in `figure`.
    """
    definition, path = _definition(name), _FOLDER / f"{name}.csv"
    if definition.kept or not_at_hand(definition):
        if path.exists():
            return DataTable.of_csv(*read_table(path))
        if definition.kept:
            warnings.warn(
                f"{name} is computed anew, which takes minutes: its published numbers are in the "
                "folder figures of the project, which an installed package does not have.",
                stacklevel=3,
            )
    return _from_recordings(name) if definition.recordings else definition.compute()


@cache
def _from_recordings(name: str) -> Any:
    """What is computed from recordings, once: they do not change."""
    return _definition(name).compute()


def not_at_hand(definition: FigureDefinition) -> str:
    """Return a sentence on the recordings of a figure that are missing; empty if none is."""
    for recording in definition.recordings:
        one = PUBLISHED[recording]
        try:
            for path in one.files:
                published_file(Path(path).name, download=False)
        except RecordingUnavailable:
            return (
                f"The recording {recording} from github.com/{one.repository} was not at hand: "
                "this is from the numbers that were computed when it was."
            )
    return ""


def published_paths(name: str) -> list[Path]:
    """Return the files of a figure in the book's folder, picture and numbers."""
    return sorted(_FOLDER.glob(f"{name}.*"))


def _definition(name: str) -> FigureDefinition:
    chapter = str(name)[:2]
    known = figure_definitions(chapter if chapter in chapters_with("figures") else None)
    if name not in known:
        raise ValueError(f"name: expected one of {', '.join(known)}, got {name!r}.")
    return known[name]
