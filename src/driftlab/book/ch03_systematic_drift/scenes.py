"""The block of the book's first puzzle as a living scene: three gyros, a turntable, and a ghost."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from driftlab.book.machinery.axis import AXIS_CONTROLS, axis_code, axis_of, matrix_code
from driftlab.book.machinery.panel import Values
from driftlab.book.machinery.results import Results
from driftlab.book.machinery.scene.solids import box, frame_of_box, pin
from driftlab.book.machinery.scene.stage import Curve, Part, Plot, Readout, Stage, View, reach
from driftlab.book.machinery.scene.view import SceneExplorer, SceneView
from driftlab.book.machinery.units import angle_text
from driftlab.checks import FloatArray
from driftlab.quaternion import from_rotation_vector, multiply

from .controls import TRIAD_ERROR_CONTROLS, TRIADS, triad_error_of
from .experiments import EXAGGERATION, TURNS, DriftHistory, drift_history

SAMPLES = 96
"""Moments in a turn; at ten seconds for five turns some fifty a second."""
HALF_SIZES = (0.62, 0.5, 0.4)
"""Of the block."""
LENGTH = 1.1
"""Of an arrow that shows a gyro's sensitive axis."""
AXIS_LENGTH = 1.4
"""Of the axis of rotation, to either side."""
MAGNIFICATIONS = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)
"""How many times too large the error may be drawn."""
LARGEST_SHOWN = np.radians(75)
"""Error that the ghost shows at most, rad."""


class TurningBlockView(SceneView):
    """The block as it turns, and as its computer believes it to be."""

    autoplay = True

    def stage(self, data: DriftHistory) -> Stage:
        attitude = from_rotation_vector(2 * np.pi * data.turns[:, np.newaxis] * data.direction)
        angle = np.linalg.norm(data.error, axis=-1)
        factor = magnification(angle.max())
        ghost = multiply(attitude, from_rotation_vector(factor * data.error))
        along, across = np.degrees(parts_of_error(data)) * 60
        whole = SAMPLES * np.arange(TURNS + 1)
        straight = np.degrees(data.first_order_per_turn * data.turns) * 60
        return Stage(
            times=data.turns,
            time_unit="turns",
            seconds=10.0,
            tracks={"block": attitude, "ghost": ghost},
            views=(
                View(
                    f"gyros bent × {EXAGGERATION}, error × {factor}",
                    (*block_parts(data.triad, data.direction), *ghost_parts(data.triad)),
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
                    *reach(along),
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


def magnification(largest: float) -> int:
    """Return how many times too large an error of up to `largest`, rad, can be drawn."""
    fitting = [m for m in MAGNIFICATIONS if m * largest <= LARGEST_SHOWN]
    return fitting[-1] if fitting else 1


def parts_of_error(data: DriftHistory) -> tuple[FloatArray, FloatArray]:
    """Error (m,) about the axis of the turns, and the size of the rest, rad."""
    along = data.error @ data.direction
    rest = data.error - along[:, np.newaxis] * data.direction
    return along, np.linalg.norm(rest, axis=-1)


def block_parts(triad: FloatArray, axis: FloatArray) -> tuple[Part, ...]:
    """The block with its edges' directions, its three gyros, and the axis that it turns about."""
    return (
        *triad_parts(triad),
        Part("line", AXIS_LENGTH * np.stack([-axis, axis]), "axis", "block"),
        *pin(AXIS_LENGTH * axis, "axis", "block", handle="axis of the turns")[1:],
    )


def triad_parts(triad: FloatArray) -> tuple[Part, ...]:
    """The block with its edges' directions and its three gyros."""
    tips = LENGTH * triad / np.linalg.norm(triad, axis=1, keepdims=True)
    gyros = [
        part
        for i in range(3)
        for part in pin(tips[i], "gyro", "block", text=str(i + 1), handle=f"gyro {i + 1}")
    ]
    edges = [Part("line", np.array([np.zeros(3), LENGTH * e]), "edge", "block") for e in np.eye(3)]
    return (*box(HALF_SIZES, "block", "block"), *edges, *gyros)


def ghost_parts(triad: FloatArray) -> tuple[Part, ...]:
    """The block where the computer believes it to be."""
    tips = LENGTH * triad / np.linalg.norm(triad, axis=1, keepdims=True)
    pins = [part for tip in tips for part in pin(tip, "ghost", "ghost")]
    return (*frame_of_box(HALF_SIZES, "ghost", "ghost"), *pins)


def leaning(handle: str, direction: FloatArray) -> Values:
    """Values of a gyro's two leans, mrad, that bring its arrow into a direction (3,)."""
    i = int(handle[-1]) - 1
    lean = 1e3 * direction / max(direction[i], 1e-3) / EXAGGERATION
    return {f"m{i + 1}{j + 1}": lean[j] for j in range(3) if j != i}


class TurningBlock(SceneExplorer):
    """Turn a block with three gyros, lean them, and watch what its computer believes."""

    title = "A block on a turntable, and where its computer believes it to be"
    picture_class = TurningBlockView
    controls = (*TRIAD_ERROR_CONTROLS, *AXIS_CONTROLS)
    folded = True
    presets: ClassVar = {
        "The puzzle": TRIADS["One gyro leans"],
        "About the third edge": {
            **TRIADS["One gyro leans"], "elevation": 90.0
        },
        "About the other diagonal": {
            **TRIADS["One gyro leans"], "azimuth": -45.0
        },
        "Symmetric triad": TRIADS["Symmetric triad"],
        "Skew triad": TRIADS["Skew triad"],
    }  # fmt: skip
    look_for: ClassVar = {
        "The puzzle": "The ghost is what the computer believes. What is left after a whole turn?",
        "About the third edge": "Does the ghost leave for good now?",
        "About the other diagonal": "The same block. Which way does the ghost go?",
        "Symmetric triad": "Drag the dashed axis: which way drifts most? Is there a way without?",
        "Skew triad": "All gyros lean as if the triad were turned. What stays after a turn?",
    }

    def compute(self, values: Values) -> DriftHistory:
        return drift_history(triad_error_of(values), axis_of(values), SAMPLES)

    def dragged(self, handle: str, direction: FloatArray) -> Values:
        if handle.startswith("gyro"):
            return leaning(handle, direction)
        x, y, z = direction / np.linalg.norm(direction)
        return {
            "azimuth": np.degrees(np.arctan2(y, x)),
            "elevation": np.degrees(np.arcsin(z)),
        }

    def numbers(self, data: DriftHistory) -> Results:
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
            "from driftlab.drift import drift_per_turn\n"
            "from driftlab.vectors import direction_from_angles\n"
            f"triad_error = {matrix_code(triad_error_of(values))}\n"
            f"drift_per_turn({axis_code(values)}, triad_error)"
        )


SCENES = (TurningBlock,)
