"""Schuler's pendulum: a platform on the Earth that is tilted and left alone, or on its way."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from scipy.constants import arcminute

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Values
from driftlab.book.machinery.panel.results import Results
from driftlab.book.machinery.scene.solids import arrow, box, circle
from driftlab.book.machinery.scene.spans import reach, span
from driftlab.book.machinery.scene.stage import GROUND, Curve, Part, Plot, Readout, Stage, View
from driftlab.book.machinery.scene.view import SceneExplorer, SceneView
from driftlab.book.scenarios import DURATION, SCHULER_PERIOD, SPEED
from driftlab.checks import FloatArray
from driftlab.earth import EARTH_RADIUS

from ..experiments import DAMPING, schuler_pendulum
from .ship import leaning

PLATFORM_FACTOR, WAY_FACTOR = 1000, 60
"""How many times too large the platform's tilt and the ship's way round the Earth are drawn."""
EARTH, UPRIGHT = 1.2, 0.95
"""Radius of the Earth, and length of what stands on the platform, in units of the view."""


class PendulumView(SceneView):
    """The Earth seen from the East, a platform on it, and the pendulum that swings as it does."""

    def stage(self, data: DataTable) -> Stage:
        tilt, miles = data.shown("tilt"), data.shown("place_error")
        whole = np.flatnonzero(np.diff(data.times // SCHULER_PERIOD)) + 1
        return Stage(
            times=data.shown("times"),
            time_unit="min",
            seconds=8.0 * DURATION / SCHULER_PERIOD,
            tracks={"platform": leaning(PLATFORM_FACTOR * data.tilt)},
            views=(
                View(
                    f"tilt × {PLATFORM_FACTOR}, way × {WAY_FACTOR}; North is to the right",
                    (*earth_parts(data), *platform_parts(data)),
                    azimuth=0.0,
                    elevation=6.0,
                    reach=1.35,
                ),
            ),
            plots=(
                Plot(
                    "platform out of level, ′",
                    (
                        Curve("about North", tilt[:, 0], "second"),
                        Curve("about East", tilt[:, 1], "ghost"),
                        Curve("", tilt[:, 1], "good", whole),
                    ),
                    *reach(np.append(tilt, 1.0)),
                ),
                Plot(
                    "way North that its turn tells, error, nautical miles",
                    (Curve("computed", miles, "ghost"), Curve("", miles, "good", whole)),
                    *span(miles, 1.0),
                ),
            ),
            readouts=(
                Readout("tilt about East", tilt[:, 1], 2, "′"),
                Readout("way told, off by", miles, 2, " nmi"),
                Readout("velocity told, off by", data.velocity_error, 2, " m/s"),
                Readout("heading, off by", data.shown("heading_error"), 2, "°"),
            ),
        )


def earth_parts(data: DataTable) -> tuple[Part, ...]:
    """The Earth below the platform: it rolls back as the ship goes on, and the harbour with it."""
    centre = np.array([0.0, 0.0, -EARTH])
    angle = WAY_FACTOR * data.way / EARTH_RADIUS
    outward = np.stack([np.zeros_like(angle), -np.sin(angle), np.cos(angle)], axis=-1)
    pier = centre + EARTH * np.array([1.0, 1.1])[:, np.newaxis] * outward[:, np.newaxis]
    return (
        Part("face", circle([1.0, 0.0, 0.0], EARTH)[:-1] + centre, "sea", lift=GROUND),
        Part("dot", centre[np.newaxis], "edge"),
        Part("label", centre[np.newaxis] + [0.0, 0.0, -0.1], "soft", text="centre of the Earth"),
        Part("line", pier, "axis"),
        Part("label", pier[:, 1:] + [0.0, 0.0, 0.07], "axis", text="harbour"),
        Part("line", np.array([[0.0, 0.0, -EARTH], [0.0, 0.0, UPRIGHT]]), "edge"),
    )


def platform_parts(data: DataTable) -> tuple[Part, ...]:
    """The platform, what it takes for Up, its pendulum, and a handle for the tilt at the start."""
    bob = np.array([0.0, 0.0, -EARTH * data.length / EARTH_RADIUS])
    angle = PLATFORM_FACTOR * data.start
    start = UPRIGHT * np.array([[0.0, -np.sin(angle), np.cos(angle)]])
    return (
        *box((0.2, 0.2, 0.03), "block", "platform"),
        *arrow([0.0, 0.0, UPRIGHT], "ghost", "platform", "its Up"),
        Part("line", np.stack([np.zeros(3), bob]), "ghost", "platform"),
        Part("dot", bob[np.newaxis], "ghost", "platform"),
        Part("dot", start, "good", handle="tilt at the start"),
    )


class SchulerPendulum(SceneExplorer):
    """Tilt a platform and leave it alone, or set it on its way."""

    title = "Schuler's pendulum: a platform that keeps level on its way round the Earth"
    picture_class = PendulumView
    controls = (
        Control("tilt", "tilt at the start, ′", 1.0, -2.0, 2.0, 0.1, group="platform"),
        Control("tuning", "tuning k₂R", 1.0, stops=(0.95, 1.0, 1.05, 1.25, 1.6, 2.0),
                group="platform"),
        Control("damping", "damping ratio", 0.0, 0.0, 1.0, 0.05, group="platform"),
        Control("speed", "speed to the North, m/s", 0.0, 0.0, 10.0, 0.5, group="ship"),
    )  # fmt: skip
    presets: ClassVar = {
        "Left alone": {},
        "Damped by the log": {"damping": DAMPING},
        "On its way": {"tilt": 0.0, "speed": SPEED},
        "On its way, too short": {"tilt": 0.0, "speed": SPEED, "tuning": 2.0},
    }
    look_for: ClassVar = {
        "Left alone": "One arc minute, and nobody touches it. How long is a swing? Does it stop?",
        "Damped by the log": "The same arc minute. How much of it is left after an hour?",
        "On its way": "The ship leaves the harbour. Where does the bob of the pendulum stay?",
        "On its way, too short": "A pendulum half as long. Who is left behind now?",
    }

    def compute(self, values: Values) -> DataTable:
        return schuler_pendulum(
            values["tilt"] * arcminute,
            speed=values["speed"],
            tuning_factor=values["tuning"],
            damping=values["damping"],
        )

    def dragged(self, handle: str, direction: FloatArray) -> Values:
        angle = float(np.arctan2(-direction[1], direction[2]))
        return {"tilt": angle / PLATFORM_FACTOR / arcminute}

    def numbers(self, table: DataTable) -> Results:
        return Results(
            table.row("most_tilt", ".3f"),
            [
                table.row("most_place_error", ".3f"),
                table.row("most_velocity_error", ".3f"),
                table.row("most_heading_error", ".4f"),
            ],
        )

    def call(self, values: Values) -> str:
        return (
            "from scipy.constants import arcminute\n"
            "from driftlab.book.ch14_gyrocompass_under_way.experiments import schuler_pendulum\n"
            f"swing = schuler_pendulum({values['tilt']} * arcminute, speed={values['speed']},\n"
            f"    tuning_factor={values['tuning']}, damping={values['damping']})\n"
            "print(swing.tilt[-1] / arcminute)"
        )
