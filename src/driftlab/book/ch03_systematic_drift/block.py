"""A block with three gyros, and its ghost: what the scenes of a bent triad are made of."""

from __future__ import annotations

import numpy as np

from driftlab.book.machinery.panel.panel import Values
from driftlab.book.machinery.scene.solids import box, frame_of_box, pin
from driftlab.book.machinery.scene.stage import Part
from driftlab.checks import FloatArray

from .experiments import EXAGGERATION

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


def magnification(largest: float) -> int:
    """Return how many times too large an error of up to `largest`, rad, can be drawn."""
    fitting = [m for m in MAGNIFICATIONS if m * largest <= LARGEST_SHOWN]
    return fitting[-1] if fitting else 1


def block_parts(triad: FloatArray, track: str = "") -> tuple[Part, ...]:
    """The block with its edges' directions and its three gyros, which can be dragged."""
    tips = LENGTH * triad / np.linalg.norm(triad, axis=1, keepdims=True)
    gyros = [
        part
        for i in range(3)
        for part in pin(tips[i], "gyro", track, text=str(i + 1), handle=f"gyro {i + 1}")
    ]
    edges = [Part("line", np.array([np.zeros(3), LENGTH * e]), "edge", track) for e in np.eye(3)]
    return (*box(HALF_SIZES, "block", track), *edges, *gyros)


def axis_parts(axis: FloatArray) -> tuple[Part, ...]:
    """The axis (3,) of the turns, to either side, with a handle."""
    return (
        Part("line", AXIS_LENGTH * np.stack([-axis, axis]), "axis"),
        *pin(AXIS_LENGTH * axis, "axis", handle="axis of the turns")[1:],
    )


def ghost_parts(triad: FloatArray) -> tuple[Part, ...]:
    """The block where the computer believes it to be."""
    tips = LENGTH * triad / np.linalg.norm(triad, axis=1, keepdims=True)
    pins = [part for tip in tips for part in pin(tip, "ghost", "ghost")]
    return (*frame_of_box(HALF_SIZES, "ghost", "ghost"), *pins)


def gyro_dragged(handle: str, direction: FloatArray, values: Values) -> Values:
    """Values of `TRIAD_ERROR_CONTROLS` that lean the gyro of a handle into a direction (3,)."""
    i = int(handle[-1]) - 1
    length = 1e3 / EXAGGERATION + values[f"m{i + 1}{i + 1}"]  # along its own axis, as it is drawn
    lean = length * direction / max(direction[i], 1e-3)
    return {f"m{i + 1}{j + 1}": lean[j] for j in range(3) if j != i}
