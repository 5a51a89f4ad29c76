"""A false rate that turns with the body: where it leads the computer, and what it adds up to."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.axis import axis_code, axis_of, axis_values
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Values
from driftlab.book.machinery.panel.results import ABSENT, Results
from driftlab.book.machinery.panel.units import angle_text
from driftlab.book.machinery.scene.solids import box, circle, frame_of_box, pin
from driftlab.book.machinery.scene.spans import reach
from driftlab.book.machinery.scene.stage import Curve, Part, Plot, Readout, Stage, View
from driftlab.book.machinery.scene.view import SceneExplorer, SceneView
from driftlab.checks import FloatArray

from .experiments import DURATION, MOMENTS, SPIN, error_in_space

HALF_SIZES = (0.75, 0.6, 0.36)
"""Of the block."""
RATES = (0.0, 6.0, SPIN, 18.0)
"""True rates, degrees a second; whole turns of all of them end at a moment of the scene."""
RATE_LENGTH = 1.4 / np.radians(RATES[-1])
"""Length of an arrow for a rate of one rad/s."""
MAGNIFIED = 15
"""How many times too long the false rate is drawn."""
RINGS = (1, 2, 3, 5, 7, 10, 15, 20, 30, 50, 70, 100)
"""Sizes of an error that a ring can stand for, degrees."""
RING = 1.2
"""Radius of the ring in its view."""
EDGES: FloatArray = np.diag(np.array(HALF_SIZES) + 0.3)
"""Lines along the edges of the block, which tell a body that has turned from one that has not."""


class FalseRateView(SceneView):
    """The body and the computer's ghost; beside them the error as a vector that is added up."""

    def stage(self, data: DataTable) -> Stage:
        angle, turns = data.shown("angle"), data.whole_turns
        largest = reach(angle)[1]
        naive = np.degrees(np.linalg.norm(data.added, axis=-1) * data.time)
        curves = [
            Curve("false rate × time", np.where(naive <= largest, naive, np.nan), "soft"),
            Curve("error", angle, "ghost"),
        ]
        if len(turns) > 1:
            curves.append(Curve("whole turns", angle, "good", turns))
        return Stage(
            times=data.time,
            time_unit="s",
            seconds=9.0,
            tracks={"body": data.attitude, "ghost": data.apparent},
            views=(
                View(f"false rate × {MAGNIFIED}, ghost not magnified", bodies(data)),
                error_view(data),
            ),
            plots=(Plot("the computer is wrong by, °", tuple(curves), 0.0, largest),),
            readouts=(
                Readout("the computer is wrong by", angle, 2, "°"),
                Readout("the body has turned by", 360 * data.time / data.turn, 0, "°"),
            ),
        )


def bodies(data: DataTable) -> tuple[Part, ...]:
    """The block with its two rates, and where the computer believes the block to be."""
    false = MAGNIFIED * RATE_LENGTH * data.added[0]  # the first moment: body axes
    rate = 2 * np.pi / data.turn * RATE_LENGTH
    spin = (
        (
            Part("arrow", np.array([[0, 0, 0], [0, 0, rate]]), "good", "body"),
            Part("label", np.array([[0, 0, rate + 0.12]]), "good", "body", text="true rate"),
        )
        if rate
        else ()
    )
    return (
        *box(HALF_SIZES, "block", "body"),
        *(Part("line", np.array([np.zeros(3), edge]), "edge", "body") for edge in EDGES),
        *frame_of_box(HALF_SIZES, "ghost", "ghost"),
        *(Part("line", np.array([np.zeros(3), edge]), "ghost", "ghost") for edge in EDGES),
        *spin,
        *pin(false, "rate", "body", text="false rate", handle="false rate"),
    )


def error_view(data: DataTable) -> View:
    """The error as a vector in space, the way of its tip, and what is being added there."""
    degrees = data.shown("vector")
    largest = float(np.linalg.norm(degrees, axis=-1).max())
    ring = next((size for size in RINGS if size >= largest), RINGS[-1])
    tip = RING / ring * degrees
    growing = 0.45 * data.added / max(float(np.linalg.norm(data.added[0])), 1e-12)
    start = np.zeros_like(tip)
    return View(
        f"the error as a vector; ring: {ring}°",
        (
            Part("line", circle([0, 0, 1], RING), "rule"),
            Part("line", np.array([[0, 0, -0.5], [0, 0, RING]]), "axis"),
            Part("label", np.array([[0, -1.12 * RING, 0]]), "soft", text=f"{ring}°"),
            Part("trace", tip, "trace"),
            Part("arrow", np.stack([start, tip], axis=1), "trace"),
            Part("arrow", np.stack([tip, tip + growing], axis=1), "rate"),
            Part("label", (tip + 1.35 * growing)[:, np.newaxis], "rate", text="false rate"),
        ),
        elevation=32.0,
        reach=1.4,
    )


class FalseRate(SceneExplorer):
    """Give a turning body a false rate, and see which part of it its computer keeps."""

    title = "A body that turns, and a computer with a false rate"
    picture_class = FalseRateView
    controls = (
        Control("size", "size, °/s", 1.0, 0.1, 1.2, 0.1, group="false rate"),
        Control("azimuth", "azimuth, °", 0.0, -180.0, 180.0, 1.0, group="false rate"),
        Control("elevation", "elevation, °", 0.0, -90.0, 90.0, 1.0, group="false rate"),
        Control("rate", "about the third axis, °/s", SPIN, stops=RATES, group="true rate"),
    )
    presets: ClassVar = {
        "Across the true rate": {},
        "Along the true rate": {"elevation": 90.0},
        "In between": {"elevation": 30.0},
        "A true zero": {"rate": 0.0},
    }
    look_for: ClassVar = {
        "Across the true rate": "The false rate turns with the body. Where does that lead the "
        "error vector in a turn?",
        "Along the true rate": "Now the false rate keeps its direction. Does the error come back?",
        "In between": "Drag the false rate. Which part of the false rate is the one that stays?",
        "A true zero": "Nothing turns, so nothing takes the false rate round. What comes of it?",
    }

    def compute(self, values: Values) -> DataTable:
        false_rate = np.radians(values["size"]) * axis_of(values)
        return error_in_space(np.radians([0.0, 0.0, values["rate"]]), false_rate)

    def dragged(self, handle: str, direction: FloatArray) -> Values:
        return axis_values(direction)

    def numbers(self, data: DataTable) -> Results:
        one = data.whole_turns[1:2]
        first = data.angle[: one[0] + 1] if len(one) else data.angle
        naive = float(np.linalg.norm(data.added[0])) * data.turn
        return Results(
            ("error after one whole turn", angle_text(first[-1]) if len(one) else ABSENT),
            [
                ("largest on the way", angle_text(first.max())),
                ("false rate × time of the turn", angle_text(naive) if len(one) else ABSENT),
                (f"error after {data.time[-1]:.0f} s", angle_text(data.angle[-1])),
            ],
        )

    def call(self, values: Values) -> str:
        return (
            "import numpy as np\n"
            "from driftlab.drift import error_quaternion\n"
            "from driftlab.quaternion import rotation_angle\n"
            "from driftlab.vectors import direction_from_angles\n"
            f"rate = np.radians([0, 0, {values['rate']}])\n"
            f"false_rate = np.radians({values['size']}) * {axis_code(values)}\n"
            f"time = np.linspace(0, {DURATION:g}, {MOMENTS})\n"
            "np.degrees(rotation_angle(error_quaternion(rate, rate + false_rate, time)))"
        )


SCENES = (FalseRate,)
