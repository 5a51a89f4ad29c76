"""The words of a scene in the language that is spoken; they are the same at all its moments."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from ..language import tr

if TYPE_CHECKING:
    from .stage import Stage


def page_words() -> dict[str, str]:
    """Return what the script in the page says by itself."""
    return {
        "time": tr("time"),
        "play": tr("Play"),
        "pause": tr("Pause"),
        "again": tr("Again"),
        "look": tr("drag to look around, or use the arrow keys"),
        "keys": tr("Arrow keys look around."),
        "drag": tr("drag it, or move it with the arrow keys"),
    }


def words_of(stage: Stage) -> Iterator[str]:
    """Yield all that a stage says in words."""
    yield stage.time_unit
    for view in stage.views:
        yield view.title
        yield from (word for part in view.parts for word in (part.text, part.handle))
    for plot in stage.plots:
        yield plot.title
        yield from (curve.name for curve in plot.curves)
    for readout in stage.readouts:
        yield from (readout.name, readout.unit.strip(), *readout.words)


def translated(stage: Stage) -> Stage:
    """Return the stage with its words translated; the handles keep the names that code knows."""
    return replace(
        stage,
        time_unit=tr(stage.time_unit),
        views=tuple(
            replace(
                view,
                title=tr(view.title),
                parts=tuple(
                    replace(part, text=tr(part.text), says=tr(part.handle)) for part in view.parts
                ),
            )
            for view in stage.views
        ),
        plots=tuple(
            replace(
                plot,
                title=tr(plot.title),
                curves=tuple(replace(curve, name=tr(curve.name)) for curve in plot.curves),
            )
            for plot in stage.plots
        ),
        readouts=tuple(
            replace(
                readout,
                name=tr(readout.name),
                unit=_unit(readout.unit),
                words=tuple(map(tr, readout.words)),
            )
            for readout in stage.readouts
        ),
    )


def _unit(unit: str) -> str:
    """A unit with the space that keeps it from its number."""
    words = unit.strip()
    return unit.replace(words, tr(words)) if words else unit
