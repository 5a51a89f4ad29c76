"""The published figures of chapter 13, with their captions."""

import numpy as np

from driftlab.book.machinery.arrays_table import from_columns, to_columns
from driftlab.book.machinery.publish import FigureDefinition
from driftlab.recordings.publishers import PUBLISHED

from .. import experiments
from . import hand_turns


def _credit(name: str) -> str:
    """Who made a recording, where it is from and under which licence, for the end of a caption."""
    one = PUBLISHED[name]
    return f"Recording: {one.source} ({one.licence})."


FIGURES = (
    FigureDefinition(
        "13-hand-turns",
        experiments.hand_turns,
        hand_turns.draw,
        to_columns,
        lambda data: (
            "A unit on a table, turned once about each axis by hand. Added up, the angles of the "
            f"two gyros across the axis reach {np.degrees(np.abs(data.added[:, -1])).max():.1f} "
            "degrees (open marks). As a rotation they go round a circle and come back to "
            f"{np.degrees(np.abs(data.path[:, -1])).max():.1f} degrees of where they began "
            "(filled): what stands across the axis adds up to nothing. What is left along the "
            f"axis is Larin's estimate, {', '.join(f'{x:.5f}' for x in data.estimate)}; "
            "Ferraris's diagonal from the same turns differs by at most "
            f"{np.abs(data.estimate - data.ferraris).max():.0e}. On the right, by how much each source "
            "may move an estimate; the heading at the end no sensor saw, and it is taken to be as "
            f"good as the tilt. {_credit('ferraris-session')}"
        ),
        from_columns(experiments.HandTurns),
        ("ferraris-session",),
    ),
)
