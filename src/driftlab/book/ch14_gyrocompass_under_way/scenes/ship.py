"""A ship with its compass on board: what it does, and what its compass shows."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike
from scipy.constants import arcminute, hour, minute

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Values
from driftlab.book.machinery.panel.results import Results
from driftlab.book.machinery.scene.solids import arrow, compass_card, raised, sea, ship
from driftlab.book.machinery.scene.spans import reach
from driftlab.book.machinery.scene.stage import Curve, Part, Plot, Readout, Stage, View
from driftlab.book.machinery.scene.view import SceneExplorer, SceneView
from driftlab.book.scenarios import SARATOV_LATITUDE, SPEED, SPEED_UP, TURN
from driftlab.checks import FloatArray, finite_array
from driftlab.quaternion import from_rotation_vector, multiply

from ..experiments import GYRO_BIAS, ship_with_compass

TILT_FACTOR, HEADING_FACTOR, LEAN_FACTOR = 1000, 15, 20
"""How many times too large the horizon's tilt, the heading's error and the plumb line are drawn."""
CARD, SEA, HANDLES = 0.95, 1.42, 1.2
"""Radius of the compass card, of the water, and of the ring on which the courses are set."""
THEN, ASIDE = 1.62, np.radians(16.0)
"""Radius of the word at the second course, and its least angle from a letter of the water, rad."""
METRES = 3000.0
"""Of the wake in one unit of the view."""
WINDOWS = {
    "gathering way": (SPEED_UP[0] - 2 * minute, SPEED_UP[0] + 8 * minute, 1),
    "the turn": (TURN[0] - 4 * minute, TURN[0] + 12 * minute, 1),
    "two hours": (0.0, np.inf, 6),
}
"""First and last time that are shown, s, and every how many steps there is a moment."""


class ShipUnderWayView(SceneView):
    """The ship, the plumb line on board, and the horizon and the North that its compass shows."""

    def stage(self, run: DataTable) -> Stage:
        return Stage(
            times=run.shown("times"),
            time_unit="min",
            seconds=10.0,
            tracks={
                "ship": about_up(run.true_heading),
                "ghost": shown_axes(run.tilt, run.shown_error, (TILT_FACTOR, HEADING_FACTOR)),
            },
            views=(
                View(
                    f"its horizon × {TILT_FACTOR}, its N × {HEADING_FACTOR}, "
                    f"plumb line × {LEAN_FACTOR}",
                    (
                        *sea(SEA),
                        *compass_card(CARD, "edge"),
                        *turn_shown(run.course, run.turn),
                        *course_handles(run.course, run.turn),
                        Part("line", wake_points(run), "rate"),
                        *ship("ship"),
                        *shown_compass("ghost"),
                        *plumb_line(run.lean),
                    ),
                    azimuth=-48.0,
                    elevation=44.0,
                    reach=1.85,
                ),
            ),
            plots=(tilt_plot(run), heading_plot(run)),
            readouts=(
                Readout("heading shown is off by", run.shown("shown_error"), 3, "°"),
                Readout("the ship's own way makes", run.shown("speed_error"), 3, "°"),
                Readout("horizon is off by", size(run.tilt) / arcminute, 3, "′"),
                Readout("plumb line is off by", size(np.arctan(run.lean)) / arcminute, 1, "′"),
            ),
        )


def about_up(angle: FloatArray) -> FloatArray:
    """Attitude (..., 4) after a turn by an angle, rad, from North to West about Up."""
    return from_rotation_vector(np.multiply.outer(angle, [0.0, 0.0, 1.0]))


def shown_axes(
    tilt: FloatArray, shown_error: FloatArray, factors: tuple[float, float]
) -> FloatArray:
    """Attitude (n, 4) of the horizon and the North that the compass shows, magnified by factors.

    A heading is counted from North to West: what shows too much of it has its North in the East.
    """
    return multiply(leaning(factors[0] * tilt), about_up(-factors[1] * shown_error))


def leaning(tilt: FloatArray) -> FloatArray:
    """Attitude (n, 4) of what leans about North and about East by tilts (n, 2), rad."""
    north, east = tilt.T
    return from_rotation_vector(np.stack([east, north, np.zeros(len(tilt))], axis=-1))


def shown_compass(track: str) -> tuple[Part, ...]:
    """The compass card as the instrument has it: its horizon, and a needle to its North."""
    return (
        *compass_card(CARD, "ghost", track),
        Part("arrow", np.array([[0.0, 0.4, 0.0], [0.0, 0.95, 0.0]]), "ghost", track),
        Part("label", np.array([[0.0, 1.06, 0.0]]), "ghost", track, text="its N"),
    )


def plumb_line(lean: FloatArray) -> tuple[Part, ...]:
    """Up as a plumb line on board has it, at each moment, from the bridge upwards."""
    north, east = LEAN_FACTOR * lean.T
    up = np.stack([east, north, np.ones(len(lean))], axis=-1)
    tip = 0.7 * up / np.linalg.norm(up, axis=-1, keepdims=True)
    return raised(arrow(tip, "third", text="plumb line's Up"), 0.32)  # from the bridge


def course_handles(course: float, turn: float) -> tuple[Part, ...]:
    """The courses before and after the turn, on a ring around the ship."""
    parts: list[Part] = []
    courses = {"course": (course, HANDLES), "course after the turn": (course + turn, 1.1 * HANDLES)}
    for name, (angle, radius) in courses.items():
        place = radius * np.array([[-np.sin(angle), np.cos(angle), 0.0]])
        parts.append(Part("dot", place, "axis", handle=name))
    return tuple(parts)


def turn_shown(course: float, turn: float) -> tuple[Part, ...]:
    """The way from one handle of `course_handles` to the other, and a word at the second."""
    angles, radii = np.linspace(course, course + turn, 61), np.linspace(1.0, 1.1, 61) * HANDLES
    way = np.stack([-radii * np.sin(angles), radii * np.cos(angles), np.zeros(61)], axis=-1)
    letter = np.round((course + turn) / (np.pi / 2)) * np.pi / 2
    aside = course + turn - letter
    angle = letter + np.copysign(max(abs(aside), ASIDE), aside)
    place = THEN * np.array([[-np.sin(angle), np.cos(angle), 0.0]])
    return Part("line", way, "way"), Part("label", place, "axis", text="then")


def dragged_course(values: Values, handle: str, direction: FloatArray) -> Values:
    """Return the course, or the turn, with which a handle of `course_handles` lies in a direction.

    A turn goes on from where it is, so that a handle that is led around makes a whole turn.
    """
    bearing = float(np.degrees(np.arctan2(-direction[0], direction[1])))
    if handle == "course":
        return {"course": bearing}
    turn = values["turn"]
    return {"turn": turn + (bearing - values["course"] - turn + 180.0) % 360.0 - 180.0}


def wake_points(run: DataTable) -> FloatArray:
    """Corners (n, p, 3) of the wake: to the East, to the North, on the water."""
    flat = run.wake[..., ::-1] / METRES
    return np.concatenate([flat, np.zeros((*flat.shape[:-1], 1))], axis=-1)


def size(errors: FloatArray) -> FloatArray:
    """Size (n,) of level errors (n, 2)."""
    return np.hypot(*errors.T)


def tilt_plot(run: DataTable) -> Plot:
    """Tilt of the horizon; beside it, for a few minutes, how far off the plumb line is."""
    north, east = run.tilt.T / arcminute
    if np.ptp(run.times) > hour:
        curves = (Curve("about North", north, "second"), Curve("about East", east, "ghost"))
        return Plot("horizon's error, ′", curves, *reach(run.tilt / arcminute))
    plumb, horizon = size(np.arctan(run.lean)) / arcminute, size(run.tilt) / arcminute
    curves = (Curve("plumb line", plumb, "third"), Curve("horizon", horizon, "ghost"))
    return Plot("off the true Up, ′", curves, 0.0, reach(np.append(plumb, horizon))[1])


def heading_plot(run: DataTable) -> Plot:
    """Error of the heading shown, and what the ship's own way makes of it."""
    shown, own = run.shown("shown_error"), run.shown("speed_error")
    curves = (Curve("ship's own way", own, "soft"), Curve("shown", shown, "ghost"))
    low, high = reach(np.append(shown, own))
    return Plot("error of the heading shown, °", curves, low, high)


def ship_under_way(
    speed: float = SPEED,
    course: float = 0.0,
    turn: float = 2 * np.pi,
    gyro_bias: ArrayLike = (0.0, 0.0, 0.0),
    speed_log: bool = False,
    window: str = "the turn",
    latitude: float = SARATOV_LATITUDE,
) -> DataTable:
    """Sail a voyage and look at a part of it: what the ship does, and what its compass shows."""
    if window not in WINDOWS:
        raise ValueError(f"window: expected one of {', '.join(WINDOWS)}, got {window!r}.")
    bias = finite_array(gyro_bias, "gyro_bias", 3)
    return ship_with_compass(
        speed, course, turn, bias, speed_log=speed_log, latitude=latitude, seen=WINDOWS[window]
    )


def most_off(run: DataTable) -> int:
    """The moment at which the compass shows the most wrong heading."""
    return int(np.abs(run.shown_error).argmax())


class ShipUnderWay(SceneExplorer):
    """Sail, turn, and watch which Up and which North the compass believes in."""

    title = "A ship under way, and what its compass shows"
    picture_class = ShipUnderWayView
    controls = (
        Control("speed", "speed, m/s", SPEED, 0.0, 15.0, 0.5, group="ship"),
        Control("course", "course to West, °", 0.0, -180.0, 180.0, 5.0, group="ship"),
        Control("turn", "then turns by, °", 0.0, -360.0, 360.0, 5.0, group="ship"),
        Control("window", "show", "gathering way", choices=tuple(WINDOWS), group="time"),
        Control("drift", "the gyros drift", False),
        Control("log", "a log tells the velocity", False),
    )
    presets: ClassVar = {
        "To the North": {},
        "To the East": {"course": -90.0},
        "At rest": {"speed": 0.0, "drift": True, "window": "two hours"},
        "A whole turn": {"turn": 360.0, "window": "the turn"},
        "A voyage": {"turn": 90.0, "drift": True, "window": "two hours"},
    }
    look_for: ClassVar = {
        "To the North": "The ship gathers way. Who follows the plumb line: horizon, needle?",
        "To the East": "The same plumb line, to the East. Where is the needle's error now?",
        "At rest": "Nothing moves but the gyros' drift. Does the needle stay where it is?",
        "A whole turn": "The plumb line swings right round. What does the horizon make of it?",
        "A voyage": "Gyros that drift a little, and a turn to the West. What begins with the turn?",
    }

    def compute(self, values: Values) -> DataTable:
        course, turn = float(np.radians(values["course"])), float(np.radians(values["turn"]))
        bias = GYRO_BIAS * values["drift"]
        return ship_under_way(values["speed"], course, turn, bias, values["log"], values["window"])

    def dragged(self, handle: str, direction: FloatArray) -> Values:
        return dragged_course(self.values, handle, direction)

    def numbers(self, run: DataTable) -> Results:
        return Results(
            run.row("most_shown_error", ".4f"),
            [
                run.row("most_speed_error", ".4f"),
                run.row("most_tilt", ".3f"),
                run.row("most_lean", ".1f"),
            ],
        )

    def call(self, values: Values) -> str:
        bias = "GYRO_BIAS" if values["drift"] else "np.zeros(3)"
        return (
            "import numpy as np\n"
            "from driftlab.book.ch14_gyrocompass_under_way.experiments import (\n"
            "    GYRO_BIAS, ship_with_compass\n"
            ")\n"
            f"course, turn = np.radians([{values['course']}, {values['turn']}])\n"
            f"run = ship_with_compass({values['speed']}, course, turn, {bias}, "
            f"speed_log={values['log']})\n"
            "print(np.degrees(run.shown_error[-1]))"
        )
