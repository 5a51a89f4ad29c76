"""The published figures of chapter 11, with their captions."""

import numpy as np
from scipy.constants import arcsecond

from driftlab.book.machinery.publish import FigureDefinition
from driftlab.checks import FloatArray

from .. import experiments
from . import capstone


def _largest(values: FloatArray) -> float:
    return float(np.degrees(np.abs(values).max()))


def _capstone_caption(data: experiments.Capstone) -> str:
    turns = np.abs(data.per_turn).max(axis=1) / arcsecond
    headings = [_largest(error) for error in data.under_way.heading_error]
    return (
        "One bent triad through all four papers; f, u, r are its forward, upper and right axis. "
        "Panel 1: turns find what pairs of axes miss of a right angle, half of it here; the filter "
        "also finds how the triad is turned. Panels 2 to 4: what is left of it, in a turn, at rest "
        "and under way. The drift in a turn is up to "
        f"{turns[0]:.0f}, {turns[1]:.1f} and {turns[2]:.0f} arc seconds at the three stages, the "
        f"heading error of a ship that turns by {np.degrees(data.turn):.3g} degrees up to "
        f"{headings[0]:.2f}, {headings[1]:.2f} and {headings[2]:.3f} degrees."
    )


FIGURES = (
    FigureDefinition(
        "11-capstone",
        experiments.calibration_stages,
        capstone.CapstonePicture.draw,
        capstone.columns,
        _capstone_caption,
    ),
)
