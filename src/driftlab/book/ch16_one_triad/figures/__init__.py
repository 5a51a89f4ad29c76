"""The published figures of chapter 16, with their captions."""

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.publish import FigureDefinition

from .. import experiments
from . import damped_turn
from .capstone import CapstonePicture


def _caption(data: DataTable) -> str:
    turns = np.abs(data.shown("drift")).max(axis=1)
    headings = np.abs(data.shown("heading_error")).max(axis=1)
    return (
        "One misaligned triad as built, after turns and after the filter; f, u, r are its forward, "
        "upper and right axis. Panel 1: turns find the non-orthogonality, of which half the angle "
        "is drawn; the filter also finds the rotation of the whole triad. Panels 2 to 4: the "
        "remaining error in a turn, at rest and under way. The drift in a turn is up to "
        f"{turns[0]:.0f}, {turns[1]:.1f} and {turns[2]:.0f} arc seconds at the three stages, the "
        f"heading error of a ship that turns by {data.shown('turn'):.3g} degrees up to "
        f"{headings[0]:.2f}, {headings[1]:.2f} and {headings[2]:.3f} degrees."
    )


FIGURES = (
    FigureDefinition("16-capstone", experiments.calibration_stages, CapstonePicture.draw, _caption),
    FigureDefinition(
        "16-damped-turn", experiments.damped_turn, damped_turn.draw, damped_turn.caption
    ),
)
