"""The block of the book's first puzzle as a living scene: three gyros, a turntable, and a ghost."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.ch00_start_here.puzzle import LEANING
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.axis import (
    AXIS_CONTROLS,
    axis_code,
    axis_of,
    axis_values,
    matrix_code,
)
from driftlab.book.machinery.panel.panel import Values
from driftlab.book.machinery.panel.results import Results
from driftlab.book.machinery.panel.units import angle_text
from driftlab.book.machinery.scene.spans import reach, span
from driftlab.book.machinery.scene.stage import Curve, Plot, Readout, Stage, View
from driftlab.book.machinery.scene.view import SceneExplorer, SceneView
from driftlab.book.scenarios import SKEW, SYMMETRIC
from driftlab.checks import FloatArray
from driftlab.quaternion import from_rotation_vector, multiply

from .block import axis_parts, block_parts, ghost_parts, gyro_dragged, magnification
from .controls import TRIAD_ERROR_CONTROLS, TRIADS, error_matrix_of, error_matrix_values
from .experiments import EXAGGERATION, TURNS, drift_history
from .globe import GlobeOfAxes

SAMPLES = 96
"""Moments in a turn; at ten seconds for five turns some fifty a second."""


class TurningBlockView(SceneView):
    """The block as it turns, and as its computer believes it to be."""

    autoplay = True

    def stage(self, data: DataTable) -> Stage:
        attitude = from_rotation_vector(2 * np.pi * data.turns[:, np.newaxis] * data.direction)
        angle = np.linalg.norm(data.error, axis=-1)
        factor = magnification(angle.max())
        ghost = multiply(attitude, from_rotation_vector(factor * data.error))
        along, across = (60 * np.degrees(each) for each in (data.along, data.across))
        whole = SAMPLES * np.arange(len(data.whole_turns))
        straight = np.degrees(data.first_order_per_turn * data.turns) * 60
        return Stage(
            times=data.turns,
            time_unit="turns",
            seconds=10.0,
            tracks={"block": attitude, "ghost": ghost},
            views=(
                View(
                    f"gyros bent × {data.exaggeration:g}, error × {factor}",
                    (
                        *block_parts(data.triad, "block"),
                        *axis_parts(data.direction),  # a turn about it leaves it where it is
                        *ghost_parts(data.triad),
                    ),
                ),
            ),
            plots=(
                Plot(
                    "error about the axis of the turns, ′",
                    (
                        Curve("first order", straight, "soft"),
                        Curve("error", along, "ghost"),
                        Curve("", along, "good", whole),
                    ),
                    *span(along),
                ),
                Plot(
                    "error perpendicular to it, ′",
                    (
                        Curve("comes and goes", across, "ghost"),
                        Curve("", across, "good", whole),
                    ),
                    0.0,
                    reach(across)[1],
                ),
            ),
            readouts=(
                Readout("the computer is wrong by", 60 * np.degrees(angle), 2, "′"),
                Readout("of this about the axis", along, 2, "′"),
                Readout("perpendicular to it", across, 2, "′"),
            ),
        )


def turning_block(
    error_matrix: ArrayLike = LEANING,
    direction: ArrayLike = (1.0, 1.0, 0.0),
    exaggeration: float = EXAGGERATION,
) -> DataTable:
    """Error of a bent triad in as many moments as the block is shown in; see `drift_history`."""
    return drift_history(error_matrix, direction, SAMPLES, exaggeration=exaggeration)


class TurningBlock(SceneExplorer):
    """Turn a block with three gyros, lean them, and watch what its computer believes."""

    title = "A block on a turntable, and where its computer believes it to be"
    picture_class = TurningBlockView
    controls = (*TRIAD_ERROR_CONTROLS, *AXIS_CONTROLS)
    presets: ClassVar = {
        "The puzzle": TRIADS["One gyro leans"],
        "About the third edge": {
            **TRIADS["One gyro leans"], "elevation": 90.0
        },
        "About the other diagonal": {
            **TRIADS["One gyro leans"], "azimuth": -45.0
        },
        "Symmetric triad": {
            **error_matrix_values(1e-3 * SYMMETRIC), "azimuth": 45.0, "elevation": 35.0
        },
        "Skew triad": {**error_matrix_values(1e-3 * SKEW), "azimuth": -45.0, "elevation": 0.0},
    }  # fmt: skip
    look_for: ClassVar = {
        "The puzzle": "The ghost is what the computer believes. What is left after a whole turn?",
        "About the third edge": "Does the ghost leave for good now?",
        "About the other diagonal": "The same block. Which way does the ghost go?",
        "Symmetric triad": "The worst axis of this block. Drag it: is there one without drift?",
        "Skew triad": "Each gyro leans as much as in the symmetric one. What stays after a turn?",
    }

    def compute(self, values: Values) -> DataTable:
        return turning_block(error_matrix_of(values), axis_of(values))

    def dragged(self, handle: str, direction: FloatArray) -> Values:
        if handle.startswith("gyro"):
            return gyro_dragged(handle, direction, self.values)
        return axis_values(direction)

    def numbers(self, data: DataTable) -> Results:
        return Results(
            ("left after one turn", angle_text(data.exact_per_turn)),
            [
                ("to first order", angle_text(data.first_order_per_turn)),
                (f"after {TURNS} turns", angle_text(TURNS * data.exact_per_turn)),
                ("about the worst axis, a turn", angle_text(data.worst_per_turn)),
            ],
        )

    def call(self, values: Values) -> str:
        return (
            "import numpy as np\n"
            "from driftlab.drift import drift_per_revolution\n"
            "from driftlab.vectors import direction_from_angles\n"
            f"error_matrix = {matrix_code(error_matrix_of(values))}\n"
            f"drift_per_revolution({axis_code(values)}, error_matrix)"
        )


SCENES = (TurningBlock, GlobeOfAxes)
