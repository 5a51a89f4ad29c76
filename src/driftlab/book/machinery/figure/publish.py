"""Publish figures: on a notebook page, in a paper, or as SVG and CSV whose content repeats."""

from __future__ import annotations

import base64
import html
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from inspect import signature
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

import driftlab

from .csv_table import as_words, write_table
from .data_table import KEPT, DataTable
from .drawing import Drawing
from .picture_file import PICTURES, ending_of, picture_file
from .sheet import SCREEN, Sheet
from .written import imports, written

GALLERY_NOTE = (
    "Rebuilt from seeds by `python3 lab.py figures`; do not edit. The numbers behind a figure, "
    "every curve of it in the units of its axes, are in the CSV of the same name, below lines that "
    "say which columns are which curve; panels without axes are drawings. `driftlab.figure(name)` "
    "makes it anew, with your parameters if you hand some in, and its `save` puts it on the column "
    "or the page of a paper."
)


@dataclass(frozen=True)
class FigureDefinition:
    """What a published figure is made of."""

    name: str  # file name without ending; begins with the chapter's number
    # takes the figure's parameters, all by name and with their published values as defaults, in SI
    # units and radians; returns the table that is drawn, or what a scene shows
    compute: Callable[..., Any]
    # draws a table on a sheet; what plays by itself, as a scene does, returns the text of an SVG
    # for a screen, and on paper a Matplotlib figure
    draw: Callable[..., Drawing | Figure | str]
    # data to the sentence under the figure, true for any parameters, its numbers computed
    caption: Callable[[Any], str]
    # names in `driftlab.recordings.publishers.PUBLISHED` that it is computed from
    recordings: tuple[str, ...] = ()
    # whether its table is read from its published CSV, because it takes minutes to compute
    kept: bool = False
    # data to CSV columns by name; None for a drawing that shows no numbers
    columns: Callable[[Any], dict[str, Any]] | None = DataTable.columns

    @property
    def is_kept(self) -> bool:
        """Whether its table can be read from its published CSV."""
        return self.kept or bool(self.recordings)

    @property
    def parameters(self) -> dict[str, Any]:
        """Its parameters with their published values, by name."""
        return {name: each.default for name, each in signature(self.compute).parameters.items()}


class PublishedFigure:
    """A figure on a page: the picture, and its caption below it and as its alt text.

    Its `data` are what `compute` of its definition returned, its `parameters` are None if the data
    were handed in.
    """

    def __init__(
        self,
        definition: FigureDefinition,
        data: Any,
        parameters: Mapping[str, Any] | None = None,
        note: str = "",
    ) -> None:
        self.definition = definition
        self.data = data
        self.parameters = None if parameters is None else dict(parameters)
        self.caption = " ".join(filter(None, [definition.caption(data), note]))

    @cached_property
    def _drawn(self) -> Drawing | Figure | str:
        return self.definition.draw(self.data)

    @property
    def on_screen(self) -> Figure | str:
        """The picture as pages show it: a Matplotlib figure, or an SVG that plays by itself."""
        return self._drawn.figure if isinstance(self._drawn, Drawing) else self._drawn

    @property
    def call(self) -> str:
        """The call that makes this figure again; what differs from the published one is in it."""
        if self.parameters is None:
            return f"driftlab.figure({self.definition.name!r}, data)"
        return call_of(self.definition, self.parameters)

    @property
    def imports(self) -> list[str]:
        """The lines that `call` needs above it, besides ``import driftlab``."""
        return imports(_own(self.definition, self.parameters or {}))

    def table(self) -> dict[str, Any]:
        """Return the numbers behind the picture: the columns of its CSV, by name."""
        if self.definition.columns is None:
            raise ValueError(f"{self.definition.name} is a drawing: it shows no numbers.")
        return self.definition.columns(self.data)

    def svg(self) -> bytes:
        """The picture as SVG whose bytes repeat: no date, identifiers from a fixed salt."""
        if isinstance(self.on_screen, str):
            return self.on_screen.encode()
        return picture_file(self.on_screen, "svg", SCREEN)

    def save(self, path: str | Path, width: float | None = None) -> Path:
        """Save the figure for a paper as .pdf, .svg or .png, or its numbers as .csv.

        The width is in inches, 3.5 for a column, 7.2 for a page; as on a screen if not given.
        """
        path = Path(path)
        ending = ending_of(path, (*PICTURES, "csv"))
        sheet = Sheet(width)
        if ending == "csv":
            self._write_table(path)
        elif ending == "svg" and not sheet.on_paper:
            path.write_bytes(self.svg())
        else:
            drawn = self.definition.draw(self.data, sheet)
            figure = drawn.figure if isinstance(drawn, Drawing) else drawn
            assert isinstance(figure, Figure)
            name = self.definition.name
            path.write_bytes(picture_file(figure, ending, sheet, name, self.caption))
        return path

    def write(self, folder: Path) -> None:
        """Write the picture as SVG and, if it shows any, its numbers as CSV.

        The CSV comes first, so that a curve that is not in the table leaves no file behind.
        """
        if self.definition.columns:
            self._write_table(folder / f"{self.definition.name}.csv")
        (folder / f"{self.definition.name}.svg").write_bytes(self.svg())

    def comments(self) -> list[str]:
        """Return the lines above the numbers: what they are, of what parameters, what is drawn."""
        lines = [
            f"{self.definition.name}: {self.caption}",
            *self.imports,
            f"made by: driftlab {driftlab.__version__}, {self.call}; text and numbers CC BY 4.0",
        ]
        if self.parameters:
            lines.append("parameters, in SI units and radians:")
            lines += [f"  {line}" for line in imports(self.parameters)]
            lines += [f"  {name} = {written(value)}" for name, value in self.parameters.items()]
        if isinstance(self._drawn, Drawing):
            lines += [*self.data.notes(), *self._drawn.header()]
            if self.definition.is_kept:
                lines.append(KEPT + self.data.as_json())
        return lines

    def _write_table(self, path: Path) -> None:
        write_table(path, as_words(self.table()), self.comments())

    def __repr__(self) -> str:
        return f"{self.call}\n{self.caption}\n.save(path) writes it, .table() has its numbers."

    def _repr_html_(self) -> str:
        picture = base64.b64encode(self.svg()).decode()
        caption = html.escape(self.caption)
        return (
            f'<figure style="margin: 0"><img alt="{caption}" style="max-width: 100%" '
            f'src="data:image/svg+xml;base64,{picture}">'
            f"<figcaption>{caption}</figcaption></figure>"
        )


def call_of(definition: FigureDefinition, parameters: Mapping[str, Any]) -> str:
    """Return the call that makes a figure with these parameters; published ones are left out."""
    own = _own(definition, parameters)
    return f"driftlab.figure({definition.name!r}{''.join(f', {n}={written(own[n])}' for n in own)})"


def _own(definition: FigureDefinition, parameters: Mapping[str, Any]) -> dict[str, Any]:
    published = definition.parameters
    return {n: v for n, v in parameters.items() if written(v) != written(published[n])}


def captions_in(page: str) -> dict[str, str]:
    """Return the captions of a `gallery` by the names of the figures."""
    return dict(re.findall(r"^\*\*(\S+)\.\*\* (.*)$", page, re.MULTILINE))


def gallery(captions: Mapping[str, str]) -> str:
    """Return the Markdown page that shows all figures, from their captions by name."""
    lines = ["# The figures of the book", "", GALLERY_NOTE, ""]
    for name, caption in captions.items():
        lines += [f"![{caption}]({name}.svg)", "", f"**{name}.** {caption}", ""]
    return "\n".join(lines)
