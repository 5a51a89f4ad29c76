"""The published figures of chapter 16, with their captions."""

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.publish import FigureDefinition

from .. import experiments
from .capstone import CapstonePicture


def _caption(data: DataTable) -> str:
    turns = np.abs(data.shown("drift")).max(axis=1)
    headings = np.abs(data.shown("heading_error")).max(axis=1)
    return (
        "One bent triad through all four papers; f, u, r are its forward, upper and right axis. "
        "Panel 1: Larin's formula finds what pairs of axes miss of a right angle, half of it here; "
        "the filter also finds how the triad is turned. Panels 2 to 4: what is left of it, in a "
        "turn, at rest and under way. The drift in a turn is up to "
        f"{turns[0]:.0f}, {turns[1]:.1f} and {turns[2]:.0f} arc seconds at the three stages, the "
        f"heading error of a ship that turns by {data.shown('turn'):.3g} degrees up to "
        f"{headings[0]:.2f}, {headings[1]:.2f} and {headings[2]:.3f} degrees."
    )


FIGURES = (
    FigureDefinition("16-capstone", experiments.calibration_stages, CapstonePicture.draw, _caption),
)
