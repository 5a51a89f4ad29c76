"""The published figures of chapter 13, with their captions."""

import numpy as np

from driftlab.book.machinery.arrays_table import from_columns, to_columns
from driftlab.book.machinery.publish import FigureDefinition
from driftlab.recordings.publishers import PUBLISHED

from .. import experiments
from ..experiments.parked_car import LONGER, RESTART
from . import parked_car


def _credit(name: str) -> str:
    """Who made a recording, where it is from and under which licence, for the end of a caption."""
    one = PUBLISHED[name]
    return f"Recording: {one.source} ({one.licence})."


def _parked_car_caption(data: experiments.ParkedCar) -> str:
    means, _, carried = (experiments.spread(row) for row in data.restarts)
    longer = experiments.spread(data.longer[2])
    return (
        "A ring-laser unit on a car that stands, with engine and people on board. "
        f"{data.restarts.shape[1]} times {RESTART:g} s of one record, not switched off "
        "between: headings from means of the gyros have a standard deviation of "
        f"{np.degrees(means.deviation):.1f} degrees; with gravity seen in inertial space "
        f"{np.degrees(carried.deviation):.3f}, a range of {np.degrees(carried.reach):.2f}, and "
        "no stretch is lost. "
        f"{data.longer.shape[1]} times {LONGER:g} s: {np.degrees(longer.deviation):.3f}. "
        "Two velocities in place of all give "
        f"{np.degrees(experiments.spread(data.restarts[1]).deviation):.2f} for {RESTART:g} s. "
        f"Bars on the right are intervals of 95 %. {_credit('laser-gyro')}"
    )


FIGURES: tuple[FigureDefinition, ...] = (
    FigureDefinition(
        "13-parked-car",
        experiments.parked_car,
        parked_car.draw,
        to_columns,
        _parked_car_caption,
        from_columns(experiments.ParkedCar),
        ("laser-gyro",),
    ),
)
