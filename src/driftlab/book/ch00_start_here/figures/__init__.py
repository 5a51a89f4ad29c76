"""The published figures of chapter 00, with their captions."""

from driftlab.book.machinery.figure.publish import FigureDefinition

from . import frames, map_of_ideas

FIGURES = (
    FigureDefinition(
        "00-map-of-ideas",
        lambda: None,
        map_of_ideas.draw,
        lambda _: (
            "The book on one page: the arrows lead from a bend of the triad to a wrong heading; "
            "boxes on one side of this way are what helps, on the other what comes on top of it. "
            "The small numbers are chapters."
        ),
        columns=None,
    ),
    FigureDefinition(
        "00-frames",
        lambda: None,
        frames.draw,
        lambda _: (
            "The frames of the papers. Each curved arrow is a positive angle: a right-handed "
            "turn about its axis. Plotnikov's heading is positive from North to West."
        ),
        columns=None,
    ),
)
