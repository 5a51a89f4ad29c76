"""The rotation schemes of chapter 11 as they turn a unit, and what each turn makes known."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from driftlab.book.machinery.figure.data_table import UNITS, DataTable
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Values
from driftlab.book.machinery.panel.results import Results
from driftlab.book.machinery.panel.units import number_text
from driftlab.book.machinery.scene.solids import box, circle
from driftlab.book.machinery.scene.stage import Curve, Part, Plot, Readout, Stage, View
from driftlab.book.machinery.scene.view import SceneExplorer, SceneView
from driftlab.book.scenarios import TABLE_LATITUDE
from driftlab.checks import FloatArray
from driftlab.earth import earth_rate
from driftlab.motion.scheme import EIGHTEEN_ROTATIONS, NINETEEN_POSITIONS, Scheme

from .experiments import scheme_run, state_unit

PLAYED = {
    "19 positions": NINETEEN_POSITIONS,
    "18 rotations": EIGHTEEN_ROTATIONS,
    "18 rotations, bad start": Scheme(EIGHTEEN_ROTATIONS.rotations, ("North", "Up", "East")),
    "z up, there and back": Scheme("+90Z -90Z", dwell=800.0),
}
GYROS = ("gyro bias", "gyro scale", "gyro non-orthogonality")
ACCELEROMETERS = ("accelerometer bias", "accelerometer scale", "accelerometer installation")
COLOURS = ("good", "second", "third", "ghost", "gyro", "soft")
"""Styles of x, y and z; and of the others, if there are six."""
HALF_SIZE = 0.5
"""Of the cube."""
OUTSIDE, REACH = 0.95, 1.45
"""Where arrows begin and end that stand still while the cube turns inside them."""
Known = tuple[DataTable, str, str]
"""A scheme as it is played, and the kinds of errors of both triads that are looked at."""


def states_of(kind: str, names: tuple[str, ...]) -> list[int]:
    """Places of the states of one kind."""
    return [i for i, name in enumerate(names) if name.startswith(kind)]


class TurningTableView(SceneView):
    """The cube as the table turns it, and how well its errors are known by then."""

    def stage(self, data: Known) -> Stage:
        run, *kinds = data
        positions = (len(run.doings) + 1) // 2
        earth = earth_rate(TABLE_LATITUDE)
        return Stage(
            times=run.place,
            time_unit=f"of {positions} positions",
            seconds=float(np.clip(0.7 * positions, 6.0, 13.0)),
            tracks={"cube": run.attitude},
            views=(
                View(
                    "the unit on its table; pauses shortened",
                    (
                        *cube_parts(),
                        *horizon_parts(),
                        *outer_arrow(np.array([0.0, 0.0, -1.0]), "soft", "gravity"),
                        *outer_arrow(earth / np.linalg.norm(earth), "rate", "Earth's rate"),
                    ),
                    azimuth=-50.0,
                    elevation=22.0,
                    reach=1.7,
                ),
            ),
            plots=tuple(known_plot(run, kind) for kind in kinds),
            readouts=(
                Readout("the table", run.doing.astype(float), words=tuple(run.doings)),
                Readout("since the start", run.shown("time"), 1, " min"),
            ),
        )


def known_plot(run: DataTable, kind: str) -> Plot:
    """Deviations of the errors of one kind, over as many decades for each scheme."""
    states = states_of(kind, run.names)
    size, sign = UNITS[state_unit(kind)]
    values = np.log10(run.standard_deviations[:, states] / size)
    usual = np.log10(scheme_run().standard_deviations[:, states] / size)
    low, high = min(values.min(), usual.min()), max(values.max(), usual.max())
    margin = 0.05 * (high - low)
    curves = (
        Curve(run.names[state].removeprefix(kind).strip(), column, style)
        for state, column, style in zip(states, values.T, COLOURS, strict=False)
    )
    title = f"{kind}: known within (one deviation), {sign.strip()}"
    return Plot(title, tuple(curves), low - margin, high + margin, decades=True)


def cube_parts() -> tuple[Part, ...]:
    """A cube with an arrow out of the faces +x, +y and +z, and the names of the other three."""
    parts = [*box((HALF_SIZE,) * 3, "block", "cube")]
    for name, axis, style in zip("xyz", np.eye(3), COLOURS, strict=False):
        parts += [
            Part("arrow", np.outer([HALF_SIZE, 2 * HALF_SIZE], axis), style, "cube"),
            Part("label", 2.3 * HALF_SIZE * axis[np.newaxis], style, "cube", text=name),
            Part("label", -1.02 * HALF_SIZE * axis[np.newaxis], style, "cube", text=f"−{name}"),
        ]
    return tuple(parts)


def horizon_parts() -> tuple[Part, ...]:
    """The horizon round the cube, in short pieces, so that near ones hide what is behind."""
    ring = circle((0, 0, 1), REACH)
    pieces = [Part("line", ring[i : i + 4], "soft") for i in range(0, len(ring) - 1, 3)]
    names = {"East": (1, 0, 0), "North": (0, 1, 0), "West": (-1, 0, 0), "South": (0, -1, 0)}
    return (
        *pieces,
        *(
            Part("label", 1.1 * REACH * np.array([place], float), "soft", text=name[0])
            for name, place in names.items()
        ),
    )


def outer_arrow(direction: FloatArray, style: str, name: str) -> tuple[Part, ...]:
    """An arrow outside the cube, with its name."""
    return (
        Part("arrow", np.outer([OUTSIDE, REACH], direction), style),
        Part("label", 1.1 * REACH * direction[np.newaxis], style, text=name),
    )


class TurningTable(SceneExplorer):
    """Let the table play a scheme, and watch which turn makes which error known."""

    title = "What each turn of the table makes known"
    picture_class = TurningTableView
    controls = (
        Control("scheme", "scheme", "19 positions", choices=tuple(PLAYED), group="shown"),
        Control("gyro", "gyros", "gyro scale", choices=GYROS, group="shown"),
        Control(
            "accelerometer", "accelerometers", "accelerometer bias", choices=ACCELEROMETERS,
            group="shown",
        ),
    )  # fmt: skip
    presets: ClassVar = {
        "Nineteen positions": {},
        "Eighteen rotations": {"scheme": "18 rotations"},
        "Only about z": {"scheme": "z up, there and back"},
        "A bad start": {
            "scheme": "18 rotations, bad start", "accelerometer": "accelerometer scale"
        },
        "The angles": {
            "gyro": "gyro non-orthogonality", "accelerometer": "accelerometer installation"
        },
    }  # fmt: skip
    look_for: ClassVar = {
        "Nineteen positions": "Turns about y, x and z. Which of them make which curve fall?",
        "Eighteen rotations": "The same three axes in another order. Do the curves follow?",
        "Only about z": "Forty minutes, and z is always up. Which errors does nobody learn?",
        "A bad start": "One axis never leaves the horizon. Which curves stay up?",
        "The angles": "An angle lies between two axes. Which turns does each pair wait for?",
    }

    def compute(self, values: Values) -> Known:
        run = scheme_run(PLAYED[values["scheme"]])
        return run, values["gyro"], values["accelerometer"]

    def numbers(self, data: Known) -> Results:
        run, *kinds = data
        before, after = run.standard_deviations[0, 6:], run.standard_deviations[-1, 6:]
        known = int(np.sum(after < 0.1 * before))
        rows = []
        for kind in kinds:
            size, sign = UNITS[state_unit(kind)]
            worst = max(states_of(kind, run.names), key=lambda i: after[i - 6])
            rows.append((
                f"{run.names[worst]}, {sign.strip()}",
                *(number_text(row[worst - 6] / size) for row in (before, after)),
            ))  # fmt: skip
        return Results(
            ("known ten times better than before", f"{known} of {len(after)} errors"),
            rows,
            ("before", "after"),
        )

    def call(self, values: Values) -> str:
        scheme = PLAYED[values["scheme"]]
        return (
            "import numpy as np\n"
            "from driftlab.calibration import (\n"
            "    ERROR_MODELS, linearize_along, standard_deviation_history\n"
            ")\n"
            "from driftlab.imu import ImuNoise, PriorStandardDeviations\n"
            "from driftlab.motion import Scheme\n"
            f"scheme = Scheme({scheme.rotations!r}, {scheme.start}, dwell={scheme.dwell})\n"
            f"way = linearize_along(scheme, {TABLE_LATITUDE:.9f}, ERROR_MODELS['averaged'])\n"
            "deviations = standard_deviation_history(way, ImuNoise(), PriorStandardDeviations())\n"
            f"i = [name.startswith({values['gyro']!r}) for name in way.model.names]\n"
            "print(deviations[0, i], deviations[-1, i])  # in SI units"
        )


SCENES = (TurningTable,)
