"""The published figures of chapter 14, with their captions."""

import numpy as np
from scipy.constants import arcminute

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.figure.publish import FigureDefinition
from driftlab.book.machinery.scene.published import scene_figure
from driftlab.book.scenarios import TURN
from driftlab.checks import FloatArray

from .. import experiments
from ..scenes.ship import ShipUnderWayView, most_off, ship_under_way
from . import horizons, operating_formula, operation


def _largest(values: FloatArray) -> float:
    return float(np.degrees(np.abs(values).max()))


def _operation_caption(data: DataTable) -> str:
    gap = _largest(data.heading_error - data.formula)
    return (
        "A ship gathers way and turns (shaded), published for gyros that drift by a few hundredths "
        "of a degree per hour on a way first to the North, then to the West. The heading error "
        f"reaches {_largest(data.heading_error):.2f} degrees, the formula follows within "
        f"{gap:.1g}. At the end the yaw is off by {np.degrees(data.yaw_error[-1]):+.2f} degrees "
        f"and the compass angle by {np.degrees(data.compass_angle_error[-1]):+.2f}. The speed "
        f"error, up to {_largest(data.speed_error):.1f} degrees, is counted apart."
    )


def _ballistic_caption(data: DataTable) -> str:
    tilts = [np.abs(run.tilt).max() / arcminute for run in data.runs.values()]
    damped = _largest(list(data.runs.values())[-1].heading_error)
    return (
        "One voyage, perfect sensors, five horizons. Schuler's tuning does not feel that the ship "
        f"gathers way; what tilts it by up to {tilts[0]:.1f} arc minutes is the Coriolis force, "
        f"and with a log to take that out {tilts[1]:.1g} are left. Other tunings tilt by up to "
        f"{max(tilts[2:]):.0f}. The damped one leans while the ship gathers way, and what it does "
        f"about it afterwards is a heading error of {damped:.1f} degrees."
    )


def _formula_caption(data: DataTable) -> str:
    before = data.run.times < TURN[0]
    without = [_largest(gap[before]) for gap in data.gaps[1:]]
    return (
        "Everything wrong at once, published for a fast craft with its bow up that turns until it "
        "goes nearly West, where the term with the velocity North fades. Left: the error of the "
        f"compass angle, up to {_largest(data.run.compass_error):.1f} degrees, and the formula's "
        "terms, given the tilts and the yaw error of the simulation. Right: until the turn at most "
        f"{_largest(data.gaps[0][before]):.2g} degrees are missing with all terms, and "
        f"{min(without):.2g} or more without any one of them."
    )


FIGURES = (
    scene_figure(
        "14-ship-under-way",
        ship_under_way,
        ShipUnderWayView,
        "A ship turns; published for a whole circle. Its compass carries a horizon and a needle "
        "with it, in dashes, as far as they are wrong.",
        most_off,
    ),
    FigureDefinition(
        "14-ballistic-error",
        experiments.ballistic_errors,
        horizons.draw_ballistic,
        _ballistic_caption,
    ),
    FigureDefinition(
        "14-operation",
        experiments.errors_under_way,
        operation.OperationPicture.draw,
        _operation_caption,
    ),
    FigureDefinition(
        "14-operating-formula",
        experiments.operating_formula,
        operating_formula.draw,
        _formula_caption,
    ),
)
