"""Four small turns whose increments add up to nothing, as a living scene."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from scipy.constants import degree

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Values
from driftlab.book.machinery.panel.results import Results
from driftlab.book.machinery.scene.solids import ABOVE, box, frame_of_box, in_plane, pin
from driftlab.book.machinery.scene.spans import reach
from driftlab.book.machinery.scene.stage import Curve, Part, Plot, Readout, Stage, View
from driftlab.book.machinery.scene.view import SceneExplorer, SceneView
from driftlab.checks import FloatArray

from .experiments import square_of_turns

HALF_SIZES = (0.6, 0.45, 0.3)
"""Of the body."""
LENGTH = 1.2
"""Of its axes."""
WIDEST = 60.0
"""Largest of the small turns, degrees; a square of this size fills its window."""


class SquareView(SceneView):
    """A body that makes four turns, the square of its increments, and what is left."""

    def stage(self, table: DataTable) -> Stage:
        area, about_third, angle = map(table.shown, ("area", "about_third", "angle"))
        high = reach(np.concatenate([about_third, area]))[1]
        return Stage(
            times=table.turns,
            time_unit="turns",
            seconds=8.0,
            tracks={"body": table.attitude},
            views=(
                View(
                    "four turns, as large as they are", body_parts(table), azimuth=-35.0, reach=1.5
                ),
                View("its increments, summed", square_parts(table), **ABOVE),
            ),
            plots=(
                Plot(
                    "turned about the third axis, °",
                    (
                        Curve("area gone round", area, "good"),
                        Curve("the body", about_third, "ghost"),
                    ),
                    0.0,
                    high,
                ),
            ),
            readouts=(
                Readout("turned from where it began", angle, 2, "°"),
                Readout("of this about the third axis", about_third, 2, "°"),
                Readout("area gone round", area, 2, "°"),
            ),
        )


def body_parts(table: DataTable) -> tuple[Part, ...]:
    """The body and where it began, the ways of two of its axes, and handles for the turns."""
    first, second = table.summed.max(axis=0)
    down = np.array([0.0, -np.sin(first), np.cos(first)])
    aside = np.array([np.sin(second), 0.0, np.cos(second)])
    return (
        *box(HALF_SIZES, "block", "body"),
        *frame_of_box(HALF_SIZES, "soft"),
        *pin((LENGTH, 0.0, 0.0), "gyro", "body", text="1"),
        *pin((0.0, 0.0, LENGTH), "gyro", "body", text="3"),
        Part("trace", LENGTH * table.tips[:, 0], "trace"),
        Part("trace", LENGTH * table.tips[:, 2], "trace"),
        *pin(LENGTH * down, "axis", handle="turn about axis 1"),
        *pin(LENGTH * aside, "axis", handle="turn about axis 2"),
    )


def square_parts(table: DataTable) -> tuple[Part, ...]:
    """The way round the square in its plane, and the area that it has gone round."""
    scale = 2 / np.radians(WIDEST)
    way = in_plane(scale * table.summed) - [1.0, 1.0, 0.0]
    side = (len(way) - 1) // 4
    moments = np.arange(len(way))
    # From the start over the corners passed so far to where it is.
    passed = [way[np.minimum(moments, corner * side)] for corner in range(4)]
    corners = way[[0, side, 2 * side, 3 * side, 0]]
    return (
        Part("face", np.stack(passed, axis=1), "gone-round"),
        Part("line", corners, "soft", lift=0.1),
        Part("trace", way, "gyro", lift=0.2),
        Part("dot", way[:, np.newaxis], "gyro", lift=0.3),
    )


class SquareThatDoesNotClose(SceneExplorer):
    """Make four small turns whose sum is zero, and see what is left."""

    title = "Four small turns that add up to nothing"
    picture_class = SquareView
    controls = (
        Control("first", "about axis 1, °", 30.0, 2.0, WIDEST, 1.0),
        Control("second", "about axis 2, °", 30.0, 2.0, WIDEST, 1.0),
    )
    presets: ClassVar = {
        "Thirty degrees": {},
        "Ten degrees": {"first": 10.0, "second": 10.0},
        "Sixty degrees": {"first": 60.0, "second": 60.0},
        "A narrow strip": {"first": 60.0, "second": 5.0},
    }
    look_for: ClassVar = {
        "Thirty degrees": "The square closes. Does the body come back into its outline?",
        "Ten degrees": "A third of the size. What is left: a third, or a ninth?",
        "Sixty degrees": "Is what is left still the area? Where do the curves part?",
        "A narrow strip": "As long as the last one, and narrow. What counts: length or area?",
    }

    def compute(self, values: Values) -> DataTable:
        return square_of_turns(values["first"] * degree, values["second"] * degree)

    def dragged(self, handle: str, direction: FloatArray) -> Values:
        x, y, z = direction
        if handle.endswith("1"):
            return {"first": np.arctan2(-y, z) / degree}
        return {"second": np.arctan2(x, z) / degree}

    def numbers(self, table: DataTable) -> Results:
        area, about_third, angle = (
            f"{table.shown(title)[-1]:.2f}°" for title in ("area", "about_third", "angle")
        )
        return Results(
            ("left after the four turns", angle),
            [("about the third axis", about_third), ("area of the square", area)],
        )

    def call(self, values: Values) -> str:
        return (
            "import numpy as np\n"
            "from driftlab.quaternion import from_rotation_vector, multiply, to_rotation_vector\n"
            f"a, b = np.radians([{values['first']}, {values['second']}])\n"
            "attitude = np.array([0.0, 0, 0, 1])\n"
            "for turn in ([a, 0, 0], [0, b, 0], [-a, 0, 0], [0, -b, 0]):\n"
            "    attitude = multiply(attitude, from_rotation_vector(turn))\n"
            "print(np.degrees(to_rotation_vector(attitude)))"
        )
