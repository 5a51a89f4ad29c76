"""Two laboratories and one bent triad, as a living scene."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from scipy.constants import arcsecond

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Values
from driftlab.book.machinery.panel.results import Results
from driftlab.book.machinery.scene.solids import box, circle, pin
from driftlab.book.machinery.scene.stage import Curve, Part, Plot, Readout, Stage, View
from driftlab.book.machinery.scene.view import SceneExplorer, SceneView
from driftlab.checks import FloatArray
from driftlab.quaternion import from_rotation_vector, multiply, rotate, to_rotation_vector

from .laboratories import two_laboratories
from .panels import SplitExplorer

MAGNIFICATION = 1200
"""How many times too large all leans and turns are drawn."""
AZIMUTH = -42.0
"""From where the reader looks at first, so that no arrow hides another."""
HALF_SIZES = (0.5, 0.42, 0.3)
"""Of the unit."""
LENGTH = 1.15
"""Of an arrow that shows a gyro's sensitive axis."""
EDGE = 1.35
"""Of an axis of the data."""
ENTRIES = tuple(c for c in SplitExplorer.controls if c.name[1] != c.name[2])
"""Sliders of the six leans."""
BRACKET = tuple(
    Control(f"turn_{axis}", f"about {axis}, ″", 0.0, -60.0, 60.0, 1.0, group="bracket")
    for axis in "xyz"
)
"""Sliders of what lies between the two mountings."""


class LaboratoriesView(SceneView):
    """The unit on both tables, and what the second one reports."""

    def stage(self, data: DataTable) -> Stage:
        turns = -MAGNIFICATION * data.share[:, np.newaxis] * data.bracket
        attitude = from_rotation_vector(turns)
        misalignment, pairs, lack = (
            data.shown(name).T for name in ("misalignment", "non_orthogonality", "lack_of_square")
        )
        curves = [
            *(
                Curve(f"misalignment {axis}", values, "ghost")
                for axis, values in zip("xyz", misalignment, strict=True)
            ),
            *(
                Curve(f"non-orth. {pair}", values, "good")
                for pair, values in zip(("xy", "xz", "yz"), pairs, strict=True)
            ),
        ]
        every = np.concatenate([*misalignment, *pairs])
        low, high = 20 * np.floor(every.min() / 20 - 0.2), 20 * np.ceil(every.max() / 20 + 0.2)
        # Names find their places from the outermost inwards.
        curves.sort(key=lambda curve: -abs(curve.values[-1] - (low + high) / 2))
        return Stage(
            times=data.share,
            time_unit="of the bracket",
            seconds=7.0,
            tracks={"unit": attitude},
            views=(
                View(
                    f"laboratory A, leans × {MAGNIFICATION}",
                    (*table_parts(), *unit_parts(data.gyro_error_matrix, "", handles=True)),
                    azimuth=AZIMUTH,
                ),
                View(
                    f"laboratory B, leans × {MAGNIFICATION}",
                    (
                        *table_parts(),
                        *unit_parts(data.gyro_error_matrix, "unit"),
                        *mounting_parts(attitude[-1]),
                    ),
                    azimuth=AZIMUTH,
                ),
            ),
            plots=(
                Plot(
                    "what laboratory B reports, ″",
                    tuple(curves),
                    float(low),
                    float(high),
                ),
            ),
            readouts=tuple(
                Readout(f"{pair} lack of a right angle", values, 2, "″")
                for pair, values in zip(("x, y", "x, z", "y, z"), lack, strict=True)
            ),
        )


def table_parts() -> tuple[Part, ...]:
    """A turntable with its three axes."""
    edges = [
        part
        for axis, name in zip(np.eye(3), "xyz", strict=True)
        for part in (
            Part("line", np.array([np.zeros(3), EDGE * axis]), "edge"),
            Part("label", 1.1 * EDGE * axis[np.newaxis], "soft", text=name),
        )
    ]
    return (Part("face", circle((0.0, 0.0, 1.0), 1.1, -0.75), "ground"), *edges)


def unit_parts(
    gyro_error_matrix: FloatArray, track: str, *, handles: bool = False
) -> tuple[Part, ...]:
    """The unit with its sensitive axes, bent too much."""
    triad = np.eye(3) + MAGNIFICATION * gyro_error_matrix
    tips = LENGTH * triad / np.linalg.norm(triad, axis=1, keepdims=True)
    gyros = [
        part
        for tip, name in zip(tips, "xyz", strict=True)
        for part in pin(
            tip, "gyro", track, text=f"gyro {name}", handle=f"gyro {name}" if handles else ""
        )
    ]
    return (*box(HALF_SIZES, "block", track), *gyros)


def mounting_parts(attitude: FloatArray) -> tuple[Part, ...]:
    """Where the edges of the unit will be in the end, as handles."""
    return tuple(
        part
        for axis, name in zip(np.eye(3)[[0, 2]], "xz", strict=True)
        for part in pin(EDGE * rotate(attitude, axis), "axis", handle=f"edge {name} of the unit")
    )


class TwoTables(SceneExplorer):
    """Measure one bent triad on two tables."""

    title = "One unit, two laboratories"
    picture_class = LaboratoriesView
    controls = (*ENTRIES, *BRACKET)
    presets: ClassVar = {
        "The puzzle": {
            **{c.name: SplitExplorer.presets["Typical unit"][c.name] for c in ENTRIES},
            "turn_x": 30.0, "turn_y": -15.0, "turn_z": 25.0,
        },
        "The bracket that suits": {
            **{c.name: SplitExplorer.presets["Typical unit"][c.name] for c in ENTRIES},
            "turn_x": -10.0, "turn_y": 15.0, "turn_z": -10.0,
        },
        "A square triad": {"kxy": -40.0, "kyx": 40.0, "turn_z": -40.0},
        "Two gyros close up": {"kxy": 60.0, "kyx": 60.0, "turn_z": 50.0},
    }  # fmt: skip
    look_for: ClassVar = {
        "The puzzle": "Which curves run off while the unit is turned, and which stay level?",
        "The bracket that suits": "A bracket chosen with care. Which three numbers end at zero?",
        "A square triad": "Is anything wrong with this unit, or only with its mounting?",
        "Two gyros close up": "Drag the edges of the unit in B. Can any mounting make it square?",
    }

    def compute(self, values: Values) -> DataTable:
        matrix = np.zeros((3, 3))
        for c in ENTRIES:
            matrix["xyz".index(c.name[1]), "xyz".index(c.name[2])] = values[c.name]
        return two_laboratories(matrix * arcsecond, bracket_of(values))

    def dragged(self, handle: str, direction: FloatArray) -> Values:
        i = "xyz".index(handle.split()[1])
        if handle.startswith("gyro"):
            lean = direction / max(direction[i], 1e-3) / MAGNIFICATION / arcsecond
            return {f"k{'xyz'[i]}{'xyz'[j]}": lean[j] for j in range(3) if j != i}
        # The smallest rotation that takes the edge from where it is to where it shall be.
        now = from_rotation_vector(-MAGNIFICATION * bracket_of(self.values))
        edge, goal = rotate(now, np.eye(3)[i]), direction / np.linalg.norm(direction)
        across = np.cross(edge, goal)
        angle = np.arctan2(np.linalg.norm(across), edge @ goal)
        way = angle * across / max(float(np.linalg.norm(across)), 1e-12)
        turned = to_rotation_vector(multiply(from_rotation_vector(way), now))
        turn = -turned / MAGNIFICATION / arcsecond
        return {c.name: value for c, value in zip(BRACKET, turn, strict=True)}

    def numbers(self, data: DataTable) -> Results:
        changed = np.abs(data.reported[-1] - data.reported[0]) / arcsecond
        bent = np.abs(data.lack_of_square[-1] - data.lack_of_square[0]).max() / arcsecond
        rows = [
            (f"gyro {axis} to x, y, z: A and B, ″", *(f"{a:.1f} → {b:.1f}" for a, b in pairs))
            for axis, pairs in zip(
                "xyz", np.stack([data.reported[0], data.reported[-1]], -1) / arcsecond, strict=True
            )
        ]
        return Results(
            ("the angles between the arrows change by", f"{bent:.2f}″"),
            [("an entry changes by up to", f"{changed.max():.1f}″"), *rows],
        )

    def call(self, values: Values) -> str:
        rows = np.round(self.compute(values).gyro_error_matrix / arcsecond, 6).tolist()
        turn = [values[c.name] for c in BRACKET]
        return (
            "import numpy as np\n"
            "from scipy.constants import arcsecond\n"
            "from driftlab.body_frames import change_body_frame\n"
            "from driftlab.quaternion import from_rotation_vector, rotate\n"
            f"in_a = arcsecond * np.array({rows})\n"
            f"bracket = rotate(from_rotation_vector(arcsecond * np.array({turn})), np.eye(3))\n"
            "print((change_body_frame(in_a, bracket) / arcsecond).round(2))"
        )


def bracket_of(values: Values) -> FloatArray:
    """Rotation vector (3,) of `BRACKET`, rad."""
    return np.array([values[c.name] for c in BRACKET]) * arcsecond


SCENES = (TwoTables,)
