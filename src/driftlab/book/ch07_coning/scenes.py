"""The shaking bracket of the puzzle as a living scene."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from scipy.constants import degree

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Values
from driftlab.book.machinery.panel.results import Results
from driftlab.book.machinery.scene.solids import ABOVE, box, in_plane, pin
from driftlab.book.machinery.scene.spans import reach
from driftlab.book.machinery.scene.stage import Curve, Part, Plot, Readout, Stage, View
from driftlab.book.machinery.scene.view import SceneExplorer, SceneView
from driftlab.checks import FloatArray
from driftlab.motion import Coning
from driftlab.quaternion import rotate

from .experiments import bracket_run
from .experiments.bracket import FINE
from .square import SquareThatDoesNotClose

TILT = 15
"""How many times too large the cone is drawn."""
HALF_SIZES = (0.6, 0.45, 0.3)
"""Of the body."""
LENGTH = 1.2
"""Of its third axis."""


class ShakingBracketView(SceneView):
    """The bracket on its cone, what its increments go round, and the error that grows."""

    def stage(self, table: DataTable) -> Stage:
        drawn = Coning(TILT * table.motion.half_angle, table.motion.frequency)
        attitude = drawn.attitude(table.time)
        slivers, one_by_one, with_pairs = map(table.shown, ("slivers", "one_by_one", "with_pairs"))
        return Stage(
            times=table.time,
            time_unit="s",
            seconds=12.0,
            tracks={"body": attitude},
            views=(
                View(f"the bracket, tilt × {TILT}", cone_parts(attitude), reach=1.5),
                View(
                    "its rate, summed: circle, samples, slivers",
                    circle_parts(table),
                    **ABOVE,
                    reach=1.15,
                ),
            ),
            plots=(
                Plot(
                    "missed about the axis of the cone, ″",
                    (
                        Curve("slivers, added up", slivers, "soft"),
                        Curve("one by one", one_by_one, "ghost"),
                        Curve("with pairs", with_pairs, "good"),
                    ),
                    0.0,
                    reach(np.concatenate([one_by_one, slivers]))[1],
                ),
            ),
            readouts=(
                Readout("missed, one by one", one_by_one, 2, "″"),
                Readout("missed, with pairs", with_pairs, 2, "″"),
                Readout("rounds", table.motion.frequency * table.time, 2, ""),
            ),
        )


def cone_parts(attitude: FloatArray) -> tuple[Part, ...]:
    """The body, its third axis with the way of its tip, and a handle on the cone."""
    tips = LENGTH * rotate(attitude, np.array([0.0, 0, 1]))
    return (
        *box(HALF_SIZES, "block", "body"),
        *pin((0.0, 0.0, LENGTH), "gyro", "body"),
        Part("line", np.array([[0.0, 0, -0.8], [0, 0, LENGTH]]), "edge"),
        Part("trace", tips, "trace"),
        *pin(tips[0], "axis", handle="half angle of the cone"),
    )


def circle_parts(table: DataTable) -> tuple[Part, ...]:
    """The way of the summed rate, its samples with their chords, and the slivers between."""
    middle = np.array([1.0, 0.0])  # the sum begins on the circle
    circle, corners = in_plane(table.circle + middle), in_plane(table.corners + middle)
    parts = [Part("line", circle, "soft"), Part("dot", circle[table.places, np.newaxis], "gyro")]
    for i in range(table.samples):
        ready = (i + 1) * table.in_a_sample
        arc = circle[i * FINE : (i + 1) * FINE + 1 : 4]
        parts += [
            Part("face", arc, "missed", lift=0.15, since=ready),
            Part("line", corners[i : i + 2], "plain", lift=0.1, since=ready),
            Part("dot", corners[i + 1 : i + 2], "plain", lift=0.2, since=ready),
        ]
    return tuple(parts)


class ShakingBracket(SceneExplorer):
    """Let the bracket of the puzzle run, and see what its samples miss."""

    title = "The shaking bracket, and the slivers between its samples"
    picture_class = ShakingBracketView
    controls = (
        Control("half_angle", "half angle, °", 1.0, 0.5, 3.0, 0.05),
        Control("rate", "sampled at, Hz", 100.0, stops=(20.0, 40.0, 60.0, 100.0, 200.0)),
    )
    presets: ClassVar = {
        "The puzzle": {},
        "Sampled at 40 Hz": {"rate": 40.0},
        "Sampled at 200 Hz": {"rate": 200.0},
        "A cone twice as wide": {"half_angle": 2.0},
    }
    look_for: ClassVar = {
        "The puzzle": "The slivers between chords and circle can hardly be seen. See them count.",
        "Sampled at 40 Hz": "Now you see them. By which factor has the error grown?",
        "Sampled at 200 Hz": "Half as long a sample: what is left of the error?",
        "A cone twice as wide": "The same slivers, of a circle twice as wide. Guess the error.",
    }

    def compute(self, values: Values) -> DataTable:
        return bracket_run(values["half_angle"] * degree, values["rate"])

    def dragged(self, handle: str, direction: FloatArray) -> Values:
        x, y, z = direction
        return {"half_angle": np.arctan2(np.hypot(x, y), z) / degree / TILT}

    def numbers(self, table: DataTable) -> Results:
        return Results(
            table.row("drift_one_by_one", ".3f"),
            [
                table.row("drift_with_pairs", ".3f"),
                table.row("samples", "g"),
                table.row("missed_part", ".3f"),
            ],
        )

    def call(self, values: Values) -> str:
        return (
            "import numpy as np\n"
            "from scipy.constants import arcsecond\n"
            "from driftlab.attitude import integrate\n"
            "from driftlab.motion import Coning\n"
            "from driftlab.quaternion import conjugate, multiply, to_rotation_vector\n"
            f"motion, rate = Coning(np.radians({values['half_angle']}), 5.0), {values['rate']}\n"
            "increments = motion.increments(1 / rate, round(rate))\n"
            "computed = integrate(increments, 'picard-1', start=motion.attitude(0.0))[-1]\n"
            "error = multiply(computed, conjugate(motion.attitude(1.0)))\n"
            "print(to_rotation_vector(error)[2] / arcsecond)"
        )


SCENES = (ShakingBracket, SquareThatDoesNotClose)
