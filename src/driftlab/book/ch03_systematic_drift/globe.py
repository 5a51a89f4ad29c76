"""A globe of axes as a living scene: the drift about each of them, and the cone without."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

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
from driftlab.book.machinery.scene.solids import globe
from driftlab.book.machinery.scene.spans import span
from driftlab.book.machinery.scene.stage import Curve, Part, Plot, Readout, Stage, View
from driftlab.book.machinery.scene.view import SceneExplorer, SceneView
from driftlab.book.scenarios import SKEW
from driftlab.checks import FloatArray
from driftlab.quaternion import from_rotation_vector

from .axes import axis_tour
from .block import AXIS_LENGTH, block_parts, ghost_parts, gyro_dragged, magnification
from .controls import TRIAD_ERROR_CONTROLS, TRIADS, error_matrix_of, error_matrix_values

AZIMUTH = 15.0
"""From where the reader looks at first, so that the worst axis of the first block is in sight."""
LIFT = 0.2
"""How much nearer than they are the lines on the globe are drawn; half a face is as large."""
ROUNDING = 1e-6
"""A drift below, arc minutes a turn, is what a computer leaves of zero."""


class GlobeOfAxesView(SceneView):
    """A globe that has, at each axis, the colour of the drift about it; and the block."""

    def stage(self, data: DataTable) -> Stage:
        factor = magnification(np.linalg.norm(data.error, axis=-1).max())
        attitude = np.tile([0.0, 0.0, 0.0, 1.0], (len(data.way), 1))
        first_order, exact = data.shown("first_order"), data.shown("exact")
        ends = np.stack([-data.axes, data.axes], axis=1)
        crossings = np.flatnonzero(first_order[:-1] * first_order[1:] < 0)
        if np.abs(first_order).max() < ROUNDING:
            crossings = crossings[:0]  # a drift that is zero everywhere changes its sign nowhere
        return Stage(
            times=data.shown("way"),
            time_unit="°",
            seconds=12.0,
            tracks={"block": attitude, "ghost": from_rotation_vector(factor * data.error)},
            views=(
                View(
                    f"all axes: full colour, {arcmin(data.full_colour):.3g}′ a turn",
                    (*globe_parts(data), *way_parts(data.axes)),
                    azimuth=AZIMUTH,
                    reach=1.4,
                ),
                View(
                    f"after {data.turns} turns: bent × {data.exaggeration:g}, error × {factor}",
                    (
                        *block_parts(data.triad, "block"),
                        Part("line", AXIS_LENGTH * ends, "axis"),
                        *ghost_parts(data.triad),
                    ),
                    azimuth=AZIMUTH,
                ),
            ),
            plots=(
                Plot(
                    "left after one turn, ′, as the axis goes round",
                    (
                        Curve("first order", first_order, "soft"),
                        Curve("exact", exact, "ghost"),
                        Curve("no drift", 0 * first_order, "good", crossings),
                    ),
                    *span(exact),
                ),
            ),
            readouts=(
                Readout("left after one turn", exact, 3, "′"),
                Readout(f"after {data.turns} turns", data.turns * exact, 3, "′"),
            ),
        )


def arcmin(coefficient: float) -> float:
    """Drift in a turn, arc minutes, of a drift coefficient."""
    return 60 * float(np.degrees(2 * np.pi * coefficient))


def signed(angle: float) -> str:
    """Arc minutes with their sign, for a label."""
    return "0′" if abs(angle) < 0.05 else f"{angle:+.1f}′".replace("-", "−")


def colour(coefficient: float, full: float) -> str:
    """Colour of a face: grey without drift, vermilion if the computer runs ahead, else blue."""
    share = min(abs(coefficient) / full, 1.0)
    name = "vermilion" if coefficient > 0 else "blue"
    return f"color-mix(in srgb, var(--dl-{name}) {100 * share:.0f}%, var(--dl-rule))"


def globe_parts(data: DataTable) -> tuple[Part, ...]:
    """The painted globe, the axes without drift on it, and the principal axes with their drift."""
    cone = [part for half in data.no_drift for part in on_globe(half, "zero")]
    named = np.abs(data.principal).max() > 1e-9
    principal = [
        Part(kind, height * side * axis[np.newaxis], "zero", text=text, lift=LIFT)
        for coefficient, axis in zip(data.principal, data.principal_axes, strict=True)
        for side in (1, -1)
        for kind, height, text in (
            ("dot", 1.0, ""),
            ("label", 1.22, signed(arcmin(coefficient))),
        )
        if named
    ]
    colours = [[colour(face, data.full_colour) for face in row] for row in data.coefficient]
    return (*globe(colours), *cone, *principal)


def on_globe(points: FloatArray, style: str) -> list[Part]:
    """A line over the globe (p, 3) in short pieces, each of which has its own place in depth."""
    return [Part("line", points[i : i + 3], style, lift=LIFT) for i in range(0, len(points) - 1, 2)]


def way_parts(axes: FloatArray) -> tuple[Part, ...]:
    """The way of the axis over the globe, both its ends, and the handle where it starts."""
    pins = [
        Part("line", side * axes[:, np.newaxis] * [[1.0], [1.3]], "axis", lift=LIFT)
        for side in (1, -1)
    ]
    start = 1.3 * axes[0]
    return (
        *on_globe(axes[::5], "way"),
        *pins,
        Part("dot", 1.3 * axes[:, np.newaxis], "axis", lift=LIFT),
        Part("line", np.stack([axes[0], start]), "way", lift=LIFT),
        Part("dot", start[np.newaxis], "axis", handle="axis of the turns", lift=2 * LIFT),
    )


def tells_most(data: DataTable) -> int:
    """The moment at which the axis drifts most."""
    return int(np.abs(data.exact).argmax())


class GlobeOfAxes(SceneExplorer):
    """Paint the drift of a triad on all its axes, and go through them."""

    title = "A globe of axes: about which one does the block drift?"
    picture_class = GlobeOfAxesView
    controls = (*TRIAD_ERROR_CONTROLS, *AXIS_CONTROLS)
    presets: ClassVar = {
        "The first block": {
            **TRIADS["Symmetric triad"], "azimuth": 0.0, "elevation": 0.0
        },
        "The second block": {
            **error_matrix_values(1e-3 * SKEW), "azimuth": -45.0, "elevation": 0.0
        },
        "One gyro leans": {"m12": 2.0, "azimuth": 0.0, "elevation": 0.0},
        "Larin's triad": {
            **TRIADS["Larin's triad"], "azimuth": 0.0, "elevation": 0.0
        },
        "Scale factor": {
            **TRIADS["Scale factor"], "azimuth": 0.0, "elevation": 30.0
        },
    }  # fmt: skip
    look_for: ClassVar = {
        "The first block": "Play. Where is the ghost when the axis crosses the thick line?",
        "The second block": "Every gyro leans as much as before. Where has the drift gone?",
        "One gyro leans": "The cone has opened into two planes. Which edges lie in them?",
        "Larin's triad": "Drag the large dot to where the drift is largest, then play.",
        "Scale factor": "No cone anywhere. Lean gyros 1 and 2 to each other until one opens.",
    }

    def compute(self, values: Values) -> DataTable:
        return axis_tour(error_matrix_of(values), axis_of(values))

    def dragged(self, handle: str, direction: FloatArray) -> Values:
        if handle.startswith("gyro"):
            return gyro_dragged(handle, direction, self.values)
        return axis_values(direction)

    def numbers(self, data: DataTable) -> Results:
        return Results(
            ("left after one turn about the starting axis", angle_text(data.exact[0])),
            [
                ("to first order", angle_text(data.first_order[0])),
                ("most, to first order", f"{arcmin(data.principal[2]):.3f}′"),
                ("least, to first order", f"{arcmin(data.principal[0]):.3f}′".replace("-", "−")),
            ],
        )

    def call(self, values: Values) -> str:
        return (
            "import numpy as np\n"
            "from driftlab.drift import drift_per_revolution, principal_drifts\n"
            "from driftlab.vectors import direction_from_angles\n"
            f"error_matrix = {matrix_code(error_matrix_of(values))}\n"
            f"drift_per_revolution({axis_code(values)}, error_matrix)\n"
            "principal_drifts(error_matrix)"
        )
