"""The published figures of chapter 00, with their captions."""

from driftlab.book.machinery.publish import FigureDefinition

from ..experiments import paper_frames
from . import frames

FIGURES = (
    FigureDefinition(
        "00-frames",
        paper_frames,
        frames.draw,
        None,
        lambda _: (
            "The frames of the papers. Each curved arrow is a positive angle: a right-handed "
            "turn about its axis. Plotnikov's heading is positive from North to West."
        ),
    ),
)
