"""The Cayley vector as a lamp throws it: a point on a circle, its image, its shadow."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from driftlab.attitude.riccati import SWITCH
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.axis import AXIS_CONTROLS, axis_code, axis_of, axis_values
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Values
from driftlab.book.machinery.panel.results import Results
from driftlab.book.machinery.scene.solids import box, circle, pin
from driftlab.book.machinery.scene.stage import Curve, Part, Plot, Readout, Stage, View
from driftlab.book.machinery.scene.view import SceneExplorer, SceneView
from driftlab.checks import FloatArray

from .experiments import shadow_steps

HALF_SIZES = (0.42, 0.34, 0.2)
"""Of the body."""
AXIS_LENGTH = 1.15
"""Of the axis of rotation, to either side."""
SHOWN = 3.0
"""Length up to which the plot shows a vector."""
SWITCHES = (1.0, SWITCH, 2.0, 3.0, float("inf"))
"""Lengths at which the reader may step over to the shadow."""
LAMP = np.array([-1.0, 0.0, 0.0])
FAR = 6.0
"""Where an image is drawn that is farther away, far outside of the window."""


class LampView(SceneView):
    """The circle of quaternions with its lamp; beside it the body with its vector."""

    def stage(self, data: DataTable) -> Stage:
        lengths = np.abs(data.heights)
        near = np.where(lengths <= SHOWN, lengths, np.nan)
        curves = [Curve("its vector", near[0], "gyro")]
        readouts = [
            Readout("length of the vector", lengths[0], 3, ""),
            Readout("angle φ", data.shown("angle"), 0, "°"),
        ]
        if has_shadow(data):
            used = np.where(data.in_use <= SHOWN, data.in_use, np.nan)
            level = np.full(len(used), data.switch)
            curves += [
                Curve("its shadow", near[1], "ghost"),
                Curve("steps over", level, "soft"),
                Curve("in use", used, "good"),
            ]
            readouts.insert(1, Readout("of its shadow", lengths[1], 3, ""))
            readouts.insert(0, Readout("length in use", data.in_use, 3, ""))
        return Stage(
            times=data.angle / (2 * np.pi),
            time_unit="turns",
            seconds=12.0,
            tracks={"body": data.attitude},
            views=(lamp_view(data), body_view(data)),
            plots=(Plot("lengths of the vectors", tuple(curves), 0.0, SHOWN),),
            readouts=tuple(readouts),
        )


def has_shadow(data: DataTable) -> bool:
    """Whether the computer knows of the shadow; else nothing of it is drawn."""
    return bool(np.isfinite(data.switch))


def drawn_heights(data: DataTable) -> FloatArray:
    """Heights (2, m), with `FAR` for what is farther away."""
    return np.clip(np.nan_to_num(data.heights, nan=FAR), -FAR, FAR)


def lamp_view(data: DataTable) -> View:
    """The plane of scalar part (to the right) and length of the vector part (upwards)."""
    quaternion_angle = data.angle / 2
    zero = np.zeros_like(quaternion_angle)
    point = np.stack([np.cos(quaternion_angle), zero, np.sin(quaternion_angle)], axis=-1)
    parts = [
        Part("line", circle([0, 1, 0]), "grid"),
        Part("line", np.array([[-1, 0, 0], [1, 0, 0]]), "grid"),
        Part("line", np.array([[0, 0, -2], [0, 0, 2]]), "soft"),
        Part("label", np.array([[1.16, 0, -0.16]]), "soft", text="no turn"),
    ]
    images = [np.stack([zero, zero, height], axis=-1) for height in drawn_heights(data)]
    named = (("gyro", "λ", "image", 0.3), ("ghost", "−λ", "shadow", -0.38))
    for row, (style, name, image, aside) in enumerate(named[: 2 if has_shadow(data) else 1]):
        place, end = (-1) ** row * point, images[row]
        parts += [
            Part("line", ray(data.heights[row]), "third"),
            Part("line", np.stack([np.zeros_like(end), end], axis=1), style),
            Part("dot", place[:, np.newaxis], style),
            Part("label", 1.16 * place[:, np.newaxis], style, text=name),
            Part("dot", end[:, np.newaxis], style),
            Part("label", (end + np.array([aside, 0, 0.1]))[:, np.newaxis], style, text=image),
        ]
    if has_shadow(data):
        end = np.stack(images)[data.used, np.arange(len(zero))]
        parts.append(Part("line", np.stack([np.zeros_like(end), end], axis=1), "good"))
    parts += [
        Part("dot", LAMP[np.newaxis], "third"),
        Part("label", 1.22 * LAMP[np.newaxis], "third", text="lamp"),
    ]
    return View("image on the line at tan φ/4", tuple(parts), -90.0, 0.0, 1.8)


def ray(height: FloatArray) -> FloatArray:
    """From the lamp (m, 2, 3) as far as its image at a height, or the point behind it."""
    with np.errstate(invalid="ignore"):
        cosine = np.nan_to_num(1 / np.hypot(1, height))
        sine = np.where(np.isnan(height), 1.0, height * cosine)
    length = np.minimum(FAR, np.maximum(1 / np.maximum(cosine, 1e-9), 2 * cosine))
    end = LAMP + length[:, np.newaxis] * np.stack([cosine, np.zeros_like(sine), sine], axis=-1)
    return np.stack([np.broadcast_to(LAMP, end.shape), end], axis=1)


def body_view(data: DataTable) -> View:
    """The turning body, and its vectors, which lie along the axis of the rotation."""
    tips = -drawn_heights(data)[..., np.newaxis] * data.axis
    arrows = [("gyro", tips[0])]
    if has_shadow(data):
        arrows += [("ghost", tips[1]), ("good", tips[data.used, np.arange(len(data.used))])]
    axis = AXIS_LENGTH * data.axis
    return View(
        "the body, and its vectors in true length",
        (
            *box(HALF_SIZES, "block", "body"),
            *(
                Part("line", np.array([np.zeros(3), edge]), "edge", "body")
                for edge in np.diag(np.array(HALF_SIZES) + 0.25)
            ),
            Part("line", np.stack([-axis, axis]), "axis"),
            *pin(axis, "axis", text="axis", handle="axis of the rotation")[1:],
            *(
                Part("arrow", np.stack([np.zeros_like(tip), tip], axis=1), style)
                for style, tip in arrows
            ),
        ),
        reach=1.4,
    )


class LampAndShadow(SceneExplorer):
    """Turn a body twice round, and follow the image of its quaternion, and the shadow."""

    title = "A lamp, an image and a shadow: the Cayley vector through two turns"
    picture_class = LampView
    controls = (
        Control(
            "switch", "steps over at length", SWITCH, stops=SWITCHES, group="the computer"
        ),
        *AXIS_CONTROLS,
    )  # fmt: skip
    presets: ClassVar = {
        "One vector only": {"switch": float("inf")},
        "Step over at 1.2": {},
        "Step over late": {"switch": 3.0},
        "About the third edge": {"elevation": 90.0},
    }
    look_for: ClassVar = {
        "One vector only": "Where does the image go when the point comes to the lamp?",
        "Step over at 1.2": "Watch the vector in use. How long does it ever become?",
        "Step over late": "How short is the shadow when the computer takes it at last?",
        "About the third edge": "Another axis. Has anything changed in the plane of the lamp?",
    }

    def compute(self, values: Values) -> DataTable:
        return shadow_steps(axis_of(values), values["switch"])

    def dragged(self, handle: str, direction: FloatArray) -> Values:
        return axis_values(direction)

    def numbers(self, data: DataTable) -> Results:
        longest = data.in_use.max()
        product = np.nanmean(np.prod(np.abs(data.heights), axis=0))
        steps = " and ".join(f"{at:.1f}°" for at in data.shown("steps"))
        return Results(
            ("longest vector in use", "∞" if np.isnan(longest) else f"{longest:.3f}"),
            [
                ("steps over at", steps or "never"),
                ("length × length of the shadow", f"{product:.3f}"),
            ],
        )

    def call(self, values: Values) -> str:
        return (
            "import numpy as np\n"
            "from driftlab.book.ch06_attitude_in_three_numbers.experiments import shadow_steps\n"
            "from driftlab.vectors import direction_from_angles\n"
            f"axis = {axis_code(values)}\n"
            f"shadow_steps(axis, float('{values['switch']}')).heights"
        )


SCENES = (LampAndShadow,)
