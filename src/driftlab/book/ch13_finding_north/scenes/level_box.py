"""A level box on its way North, and what is left there of the Earth's rate."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from scipy.constants import degree, hour

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Values
from driftlab.book.machinery.panel.results import Results
from driftlab.book.machinery.panel.sensor_controls import BODY_AXES
from driftlab.book.machinery.scene.solids import box, globe
from driftlab.book.machinery.scene.stage import Curve, Part, Plot, Readout, Stage, View
from driftlab.book.machinery.scene.view import SceneExplorer, SceneView
from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RATE
from driftlab.quaternion import multiply
from driftlab.vectors import direction_from_angles

from ..experiments import MAGNIFIED, level_box
from .card import (
    BOW,
    CARD,
    HALF_SIZES,
    TO_SPACE,
    from_origin,
    in_space,
    lettered_card,
    level_direction,
)

RATE = 1.2
"""Length of the whole of the Earth's rate."""
SITE = np.radians(68.0)
"""Longitude in the picture of the place on the globe, rad."""


class LevelBoxView(SceneView):
    """Where the box is on the Earth, and what it finds there."""

    def stage(self, data: DataTable) -> Stage:
        error = data.shown("heading_error")
        low, high = min(error.min(), 0.0), max(error.max(), 0.0)
        margin = max(0.04 * (high - low), 0.01)
        level = np.hypot(data.earth_rate[:, 0], data.earth_rate[:, 2]) / (degree / hour)
        return Stage(
            times=data.shown("latitude"),
            time_unit="° of latitude",
            seconds=10.0,
            tracks={"box": np.tile(multiply(TO_SPACE, data.attitude), (len(error), 1))},
            views=(
                View("on the Earth", globe_parts(data), 0.0, 12.0, 1.7),
                View(
                    f"in the box; gyro's error × {MAGNIFIED}", inside_parts(data), -80.0, 48.0, 1.9
                ),
            ),
            plots=(
                Plot(
                    "heading error, computed minus true, ′",
                    (Curve("heading error", error, "ghost"),),
                    low - margin,
                    high + margin,
                ),
            ),
            readouts=(
                Readout("heading error", error, 2, "′"),
                Readout("level part of the Earth's rate", level, 2, " °/h"),
            ),
        )


def globe_parts(data: DataTable) -> tuple[Part, ...]:
    """The Earth, the box on it, its plumb line, and the Earth's rate with its level part."""
    place = direction_from_angles(np.full_like(data.latitude, SITE), data.latitude)
    north = direction_from_angles(np.full_like(data.latitude, SITE), data.latitude + np.pi / 2)
    part = data.earth_rate[:, :1] / EARTH_RATE * north
    pole = np.array([0.0, 0.0, 1.0])
    site = np.stack([place, place], axis=1)
    return (
        *globe([[""] * 18] * 9, "sea"),
        Part("line", np.outer([-1.0, -1.3], pole), "axis"),
        Part("line", np.outer([1.0, 1.4], pole), "axis"),
        Part("trace", 1.02 * place, "soft"),
        Part("line", site * np.array([[1.0], [1.45]]), "soft"),
        Part("label", 1.55 * place[:, np.newaxis], "soft", text="Up"),
        Part("arrow", site + 0.5 * from_origin(np.tile(pole, (len(place), 1))), "rate"),
        Part("arrow", site + 0.5 * from_origin(part), "gyro"),
        Part("dot", place[:, np.newaxis], "good"),
    )


def inside_parts(data: DataTable) -> tuple[Part, ...]:
    """The box of glass on its card, what its gyros feel, and the North that it finds."""
    rate = RATE * in_space(data.earth_rate) / EARTH_RATE
    level = rate * [1.0, 1.0, 0.0]
    bias = in_space(data.gyro_bias) * MAGNIFIED * RATE / EARTH_RATE
    # It believes its bow to be further West by the error, and so North further East.
    found = level_direction(-data.magnified_error)
    forward = np.array([1.0, 0.0, 0.0])
    return (
        *lettered_card(-HALF_SIZES[1]),
        *box(HALF_SIZES, "glass", "box"),
        Part("line", np.outer([HALF_SIZES[0], BOW], forward), "axis", "box"),
        Part("dot", BOW * forward[np.newaxis], "axis", "box", handle="bow"),
        Part("label", np.array([[0.66, 0.0, -0.2]]), "axis", "box", text="bow"),
        Part("arrow", from_origin(rate), "rate"),
        Part("label", (0.9 * rate + [-0.75, 0.0, 0.0])[:, np.newaxis], "rate", text="Earth's rate"),
        Part("line", np.stack([rate, level], axis=1), "soft"),
        Part("arrow", from_origin(level), "gyro"),
        Part("label", (0.7 * level + [0.52, 0.0, 0.0])[:, np.newaxis], "gyro", text="level part"),
        Part("arrow", level[:, np.newaxis] + np.stack([0 * bias, bias]), "error"),
        Part("line", from_origin(CARD * found), "ghost"),
        Part("label", 1.16 * CARD * found[:, np.newaxis], "ghost", text="North, found"),
    )


class BoxOnTheWayNorth(SceneExplorer):
    """Carry a level box with one bad gyro from the equator to the North."""

    title = "A box that looks for North, from the equator to 88°"
    picture_class = LevelBoxView
    controls = (
        Control("heading", "heading to West, °", 0.0, -180.0, 180.0, 1.0, group="the box"),
        Control("gyro", "gyro that errs", "right", choices=BODY_AXES, group="its gyros"),
        Control("drift", "its drift, °/h", 0.01, -0.02, 0.02, 0.001, group="its gyros"),
    )
    presets: ClassVar = {
        "The puzzle": {},
        "Bow to the North-West": {"heading": 45.0},
        "Bow to the West": {"heading": 90.0},
        "Another gyro errs": {"gyro": "forward"},
        "Better by ten": {"drift": 0.001},
    }
    look_for: ClassVar = {
        "The puzzle": "The Earth turns as fast everywhere. What becomes of the level part?",
        "Bow to the North-West": "The same gyro in a turned box. Drag the bow: where is it worst?",
        "Bow to the West": "The gyro that errs points North now. What does its error change?",
        "Another gyro errs": "The forward gyro, bow to the North. Drag the bow.",
        "Better by ten": "A gyro ten times as good. How far North does it bring you?",
    }

    def compute(self, values: Values) -> DataTable:
        bias = values["drift"] * degree / hour * np.eye(3)[BODY_AXES.index(values["gyro"])]
        return level_box(float(np.radians(values["heading"])), bias)

    def dragged(self, handle: str, direction: FloatArray) -> Values:
        # The handle is given in the axes of the box, which stands at the present heading.
        turned = np.degrees(np.arctan2(-direction[2], direction[0]))
        return {"heading": (self.values["heading"] + turned + 180) % 360 - 180}

    def numbers(self, data: DataTable) -> Results:
        rows = [data.row(name, ".2f") for name in ("at_85", "at_equator", "at_51_5")]
        return Results(rows[0], rows[1:])

    def call(self, values: Values) -> str:
        return (
            "import numpy as np\n"
            "from scipy.constants import degree, hour\n"
            "from driftlab.frames import from_euler_angles\n"
            "from driftlab.gyrocompass import align\n"
            "from driftlab.motion import static_imu\n"
            f"attitude = from_euler_angles(np.radians({values['heading']}), 0.0, 0.0)\n"
            "rate, force = static_imu(attitude, np.radians(85.0))\n"
            f"rate[{BODY_AXES.index(values['gyro'])}] += {values['drift']} * degree / hour\n"
            "found = align(rate, force, heading_tolerance=np.inf)  # no warning: it is put in\n"
            f"print(np.degrees(found.heading) - {values['heading']})"
        )
