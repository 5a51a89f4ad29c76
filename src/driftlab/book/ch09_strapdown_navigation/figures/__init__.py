"""The published figures of chapter 09, with their captions."""

from driftlab.book.machinery.figure.publish import FigureDefinition

from .. import experiments
from . import carried_level, position_error, stops

FIGURES = tuple(
    FigureDefinition(name, compute, module.draw, module.caption)
    for name, compute, module in (
        ("09-carried-level", experiments.carried_level, carried_level),
        ("09-position-error", experiments.position_error, position_error),
        ("09-stops", experiments.stops, stops),
    )
)
