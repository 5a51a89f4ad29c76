"""The ship of the last puzzle as a living scene: it turns, and its bent triad remembers."""

from __future__ import annotations

from dataclasses import replace
from typing import ClassVar, NamedTuple

import numpy as np
from scipy.constants import arcminute, arcsecond, minute

from driftlab.book.ch14_gyrocompass_under_way.scenes.ship import (
    CARD,
    SEA,
    about_up,
    course_handles,
    dragged_course,
    shown_axes,
    shown_compass,
    size,
    wake_points,
)
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Values
from driftlab.book.machinery.panel.results import Results
from driftlab.book.machinery.panel.sensor_controls import BODY_AXES
from driftlab.book.machinery.panel.units import degrees_text
from driftlab.book.machinery.scene.solids import box, compass_card, pin, raised, sea, ship
from driftlab.book.machinery.scene.spans import reach
from driftlab.book.machinery.scene.stage import Curve, Part, Plot, Readout, Stage, View
from driftlab.book.machinery.scene.view import SceneExplorer, SceneView
from driftlab.book.scenarios import SPEED, TURN
from driftlab.checks import FloatArray

from .experiments import STAGES, bent_triad, left_over, pairs_and_turn
from .panels import CapstoneExplorer
from .turning_ship import swing_factor, turning_ship

TILT_FACTOR, HEADING_FACTOR, LEAN_FACTOR = 1000, 40, 1000
"""How many times too large the horizon's tilt, the heading's error and the gyros' leans are."""
LENGTH, WATER = 0.72, -0.62
"""Length of an arrow that shows a gyro's axis, and height of the water under the instrument."""
MOST = 50.0
"""Of a pair or a turn of the triad, arc seconds, that a slider sets."""
BEFORE, STEP = 8 * minute, 4
"""How long before the turn the scene begins, s, and every how many steps there is a moment."""
TO_SCENE = [2, 0, 1]
"""Body axes forward, up, right as the axes right, forward, up of the scene."""


class TurningShipData(NamedTuple):
    """The voyage, the gyros as they are, what the computer knows of them, and the ship's turn."""

    run: DataTable
    bent: FloatArray
    known: FloatArray
    turn: float
    factor: float


class TurningShipView(SceneView):
    """The triad above its ship, and the horizon and the North that come of it."""

    def stage(self, data: TurningShipData) -> Stage:
        run = data.run
        north, east = run.tilt.T / arcminute
        heading = np.degrees(run.shown_error) * 60
        factors = (TILT_FACTOR, HEADING_FACTOR)
        return Stage(
            times=run.times / minute,
            time_unit="min",
            seconds=10.0,
            tracks={
                "ship": about_up(run.true_heading),
                "ghost": shown_axes(run.tilt, run.shown_error, factors),
            },
            views=(
                View(
                    f"leans × {LEAN_FACTOR}, horizon × {TILT_FACTOR}, its N × {HEADING_FACTOR}",
                    (
                        *raised((*sea(SEA), *ship("ship")), WATER),
                        *raised(course_handles(0.0, data.turn)[1:], WATER),
                        *raised((Part("line", wake_points(run), "rate"),), WATER),
                        *compass_card(CARD, "edge"),
                        *shown_compass("ghost"),
                        *triad_parts(data.bent, data.known),
                    ),
                    azimuth=-48.0,
                    elevation=34.0,
                    reach=1.6,
                ),
            ),
            plots=(
                Plot(
                    "horizon out of level, ′",
                    (Curve("about North", north, "second"), Curve("about East", east, "rate")),
                    *reach(np.append(run.tilt / arcminute, 0.1)),
                ),
                Plot(
                    "heading, and again the tilt about East, ′",
                    (Curve("tilt", east, "rate"), Curve("heading", heading, "ghost")),
                    *reach(np.append(heading, 1.0)),
                ),
            ),
            readouts=(
                Readout("heading is off by", heading, 2, "′"),
                Readout("horizon about East", east, 3, "′"),
                Readout("horizon about North", north, 3, "′"),
            ),
        )


def triad_parts(bent: FloatArray, known: FloatArray) -> tuple[Part, ...]:
    """The instrument: its gyros as they lean, with handles, and as the computer has them."""
    tips, believed = tips_of(bent), tips_of(known)
    return (
        *box((0.13, 0.13, 0.13), "block", "ship"),
        *(part for tip in believed for part in pin(tip, "ghost", "ship")),
        *(
            part
            for i in range(3)
            for part in pin(tips[i], "gyro", "ship", text=str(i + 1), handle=f"gyro {i + 1}")
        ),
    )


def tips_of(gyro_error_matrix: FloatArray) -> FloatArray:
    """Tips (3, 3) of arrows along the gyros' axes, leans magnified, in the scene's axes."""
    axes = np.eye(3) + LEAN_FACTOR * gyro_error_matrix
    return LENGTH * (axes / np.linalg.norm(axes, axis=1, keepdims=True))[:, TO_SCENE]


def bent_of(values: Values) -> FloatArray:
    """Error matrix (3, 3) of the gyros from the controls."""
    pairs = np.array([values[f"pair_{i}"] for i in range(3)]) * arcsecond
    return bent_triad(pairs, np.array([values[f"turn_{a}"] for a in BODY_AXES]) * arcsecond)


def _controls() -> tuple[Control, ...]:
    triad_and_ship = [c for c in CapstoneExplorer.controls if c.name not in ("cone", "algorithm")]
    ends = {"latitude": 75.0, "turn": 360.0}
    return (
        *(
            replace(c, low=-ends.get(c.name, MOST), high=ends.get(c.name, MOST))
            for c in triad_and_ship
        ),
        Control("speed", "speed, m/s", 0.0, 0.0, 15.0, 0.5, group="ship"),
        Control("stage", "the triad is used", STAGES[0], choices=STAGES, group="ship"),
    )


class TurningShip(SceneExplorer):
    """Lean a gyro, turn the ship, and watch the heading for an hour."""

    title = "A ship that turns, with one bent triad on board"
    picture_class = TurningShipView
    controls = _controls()
    presets: ClassVar = {
        "The puzzle": CapstoneExplorer.presets["The puzzle"],
        "A whole turn": {**CapstoneExplorer.presets["The puzzle"], "turn": 360.0},
        "Bent and turned": {"speed": SPEED},
        "After Larin's turns": {"speed": SPEED, "stage": STAGES[1]},
        "After the filter": {"speed": SPEED, "stage": STAGES[2]},
    }
    look_for: ClassVar = {
        "The puzzle": "One gyro leans by 30″. What does the turn do to the horizon, and to North?",
        "A whole turn": "The same gyro, and the ship comes back to North. What is left behind?",
        "Bent and turned": "All three lean, and the computer takes them for straight.",
        "After Larin's turns": "The computer knows one half of the bend. Is it the half at work?",
        "After the filter": "The computer knows both halves. What is left of the swing?",
    }

    def compute(self, values: Values) -> TurningShipData:
        bent, latitude = bent_of(values), float(np.radians(values["latitude"]))
        left = left_over(bent, values["stage"])
        turn = float(np.radians(values["turn"]))
        seen = (TURN[0] - BEFORE, np.inf, STEP)
        run = turning_ship(left, speed=values["speed"], turn=turn, latitude=latitude, seen=seen)
        east_speed = -values["speed"] * np.sin(turn)
        return TurningShipData(
            run, bent, bent - left, turn,
            swing_factor(latitude, float(east_speed)),
        )  # fmt: skip

    def dragged(self, handle: str, direction: FloatArray) -> Values:
        if not handle.startswith("gyro"):
            return dragged_course({**self.values, "course": 0.0}, handle, direction)
        i, bent = int(handle[-1]) - 1, bent_of(self.values)
        axis = np.empty(3)
        axis[TO_SCENE] = direction
        lean = axis / max(axis[i], 1e-3) / LEAN_FACTOR
        # A slider is half of the sum or of the difference of two entries. Where no slider is at
        # its end, the other gyros stay where they are.
        most = 2 * MOST * arcsecond - np.abs(bent[:, i])
        bent[i] = np.where(np.arange(3) == i, 0.0, np.clip(lean, -most, most))
        names = [*(f"pair_{j}" for j in range(3)), *(f"turn_{a}" for a in BODY_AXES)]
        return dict(zip(names, pairs_and_turn(bent) / arcsecond, strict=True))

    def numbers(self, data: TurningShipData) -> Results:
        run = data.run
        return Results(
            ("heading is off by up to", degrees_text(np.abs(run.shown_error).max())),
            [
                ("horizon is off by up to", f"{size(run.tilt).max() / arcminute:.3f}′"),
                ("the heading swings as much × ", f"{data.factor:.1f}"),
            ],
        )

    def call(self, values: Values) -> str:
        pairs = [values[f"pair_{i}"] for i in range(3)]
        turns = [values[f"turn_{axis}"] for axis in BODY_AXES]
        return (
            "import numpy as np\n"
            "from scipy.constants import arcsecond\n"
            "from driftlab.book.ch16_one_triad.experiments import bent_triad, left_over\n"
            "from driftlab.book.ch16_one_triad.turning_ship import turning_ship\n"
            f"bent = bent_triad(np.array({pairs}) * arcsecond, np.array({turns}) * arcsecond)\n"
            f"run = turning_ship(left_over(bent, {values['stage']!r}), speed={values['speed']},\n"
            f"    turn=np.radians({values['turn']}), latitude=np.radians({values['latitude']}))\n"
            "print(np.degrees(abs(run.shown_error).max()))"
        )


SCENES = (TurningShip,)
