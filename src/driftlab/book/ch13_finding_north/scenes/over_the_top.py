"""A box whose bow goes over the top: its angles jump, its attitude does not."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from scipy.constants import degree

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Values
from driftlab.book.machinery.panel.results import Results
from driftlab.book.machinery.panel.sensor_controls import slider_value
from driftlab.book.machinery.scene.solids import box, frame_of_box
from driftlab.book.machinery.scene.stage import Curve, Part, Plot, Readout, Stage, View
from driftlab.book.machinery.scene.view import SceneExplorer, SceneView
from driftlab.checks import FloatArray
from driftlab.quaternion import multiply, rotate

from ..experiments import BOXES, ERRORS_SHOWN, HEADING, over_the_top
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

CARD_BELOW = -0.75
"""Height of the card under the box."""


class OverTheTopView(SceneView):
    """The box as it stands and as it is found, the two headings, and the errors."""

    def stage(self, data: DataTable) -> Stage:
        angles = np.degrees(np.unwrap([data.true_heading, data.true_pitch, data.true_roll]))
        errors = np.log10(np.degrees([data.heading_error, data.attitude_error]))
        low, high = angles.min(), angles.max()
        return Stage(
            times=data.shown("angle"),
            time_unit="° turned",
            seconds=10.0,
            tracks={
                "box": multiply(TO_SPACE, data.attitude),
                "ghost": multiply(TO_SPACE, data.found),
            },
            views=(
                View(
                    f"the box and what it finds; sensor errors × {ERRORS_SHOWN}",
                    overturned_parts(data),
                    62.0,
                    24.0,
                    1.5,
                ),
            ),
            plots=(
                Plot(
                    "the same turn in angles, °",
                    tuple(
                        Curve(name, values, style)
                        for name, values, style in zip(
                            ("heading", "pitch", "roll"),
                            angles,
                            ("good", "gyro", "second"),
                            strict=True,
                        )
                    ),
                    low - 0.04 * (high - low),
                    high + 0.04 * (high - low),
                ),
                Plot(
                    f"found within (root mean square of {BOXES} boxes), °",
                    (
                        Curve("heading", errors[0], "good"),
                        Curve("attitude", errors[1], "ghost"),
                    ),
                    min(errors.min(), -1.0),
                    max(errors.max(), 1.5),
                    decades=True,
                ),
            ),
            readouts=(
                Readout("heading", data.shown("true_heading"), 1, "°"),
                Readout("heading found within", data.shown("heading_error"), 2, "°"),
                Readout("attitude found within", data.shown("attitude_error"), 2, "°"),
            ),
        )


def overturned_parts(data: DataTable) -> tuple[Part, ...]:
    """The box, its ghost, the way of its bow, and the two headings as needles on a card below."""
    forward = np.array([1.0, 0.0, 0.0])
    down = np.array([0.0, 0.0, CARD_BELOW])
    needle, ghost, start = (
        level_direction(heading)
        for heading in (data.true_heading, data.found_heading, data.true_heading[:1])
    )
    return (
        *lettered_card(CARD_BELOW),
        *box(HALF_SIZES, "block", "box"),
        Part("arrow", np.outer([HALF_SIZES[0], BOW], forward), "axis", "box"),
        Part("label", 1.15 * BOW * forward[np.newaxis], "axis", "box", text="bow"),
        *frame_of_box(HALF_SIZES, "ghost", "ghost"),
        Part("line", np.outer([HALF_SIZES[0], BOW], forward), "ghost", "ghost"),
        Part("line", BOW * in_space(rotate(data.attitude, forward)), "soft"),
        Part("arrow", 0.8 * CARD * from_origin(needle) + down, "good"),
        Part("arrow", 0.8 * CARD * from_origin(ghost) + down, "ghost"),
        Part("dot", CARD * start + down, "good", handle="heading before the turn"),
    )


class BowOverTheTop(SceneExplorer):
    """Turn a box about its right axis until its bow has gone over the top."""

    title = "The bow goes over the top"
    picture_class = OverTheTopView
    controls = (
        Control(
            "heading",
            "heading before, to West, °",
            slider_value(HEADING, degree),
            -180.0,
            180.0,
            1.0,
        ),
        Control("aside", "off the zenith, °", 0.0, 0.0, 45.0, 0.5),
    )
    presets: ClassVar = {
        "Through the zenith": {},
        "Past it by two degrees": {"aside": 2.0},
        "Past it by thirty": {"aside": 30.0},
    }
    look_for: ClassVar = {
        "Through the zenith": "The box turns smoothly. What do its heading and its roll do?",
        "Past it by two degrees": "No jump now. How fast must the needle still turn?",
        "Past it by thirty": "Far from the zenith. What is left of the peak?",
    }

    def compute(self, values: Values) -> DataTable:
        heading, aside = (float(np.radians(values[name])) for name in ("heading", "aside"))
        return over_the_top(heading, aside)

    def dragged(self, handle: str, direction: FloatArray) -> Values:
        return {"heading": np.degrees(np.arctan2(-direction[0], direction[1]))}

    def numbers(self, data: DataTable) -> Results:
        heading, attitude = data.shown("heading_error"), data.shown("attitude_error")
        return Results(
            ("largest heading error", f"{heading.max():.2f}°"),
            [
                ("heading, level", f"{heading[0]:.2f}°"),
                ("attitude, level", f"{attitude[0]:.2f}°"),
                ("attitude, at worst", f"{attitude.max():.2f}°"),
            ],
        )

    def call(self, values: Values) -> str:
        return (
            "import numpy as np\n"
            "from driftlab.book.ch13_finding_north.experiments import over_the_top\n"
            f"turn = over_the_top(*np.radians([{values['heading']}, {values['aside']}]))\n"
            "print(np.degrees(turn.heading_error.max()), np.degrees(turn.attitude_error.max()))"
        )
