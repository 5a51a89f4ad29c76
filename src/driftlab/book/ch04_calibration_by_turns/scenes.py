"""The calibration as a living scene: four mountings on a turntable, and what each turn leaves.

Chapter 05 shows it too, with the Earth turning under the table.
"""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from scipy.constants import arcsecond

from driftlab.book.ch03_systematic_drift.block import (
    LENGTH,
    block_parts,
    ghost_parts,
    gyro_dragged,
    magnification,
)
from driftlab.book.ch03_systematic_drift.controls import (
    TRIAD_ERROR_CONTROLS,
    error_matrix_of,
    error_matrix_values,
)
from driftlab.book.ch03_systematic_drift.experiments import EXAGGERATION
from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.axis import matrix_code
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Values
from driftlab.book.machinery.panel.results import Results
from driftlab.book.machinery.scene.solids import circle
from driftlab.book.machinery.scene.spans import span
from driftlab.book.machinery.scene.stage import Curve, Part, Plot, Readout, Stage, View
from driftlab.book.machinery.scene.view import SceneExplorer, SceneView
from driftlab.book.scenarios import LARIN_TRIAD, SKEW
from driftlab.checks import FloatArray
from driftlab.motion.turntable_rotation import TurntableRotation
from driftlab.quaternion import from_rotation_vector, multiply

from .experiments import AS_DERIVED, LATITUDE, TABLE_RATE, mountings

FEET: FloatArray = np.array([[x, 0.0, 0.0] for x in (-0.9, -0.3, 0.3, 0.9)])
"""Where the error vectors of the four turns stand."""
UP: FloatArray = np.array([0.0, 0.0, 1.0])
BAR: FloatArray = np.array([-1.25, 0.0, 0.0])
"""Where the bar stands that says how long they are."""
TALL = 1.0
"""Height of the tallest of them, at most."""
WIDE = 0.5
"""How far from their feet they may lead aside."""
SMALLEST = np.radians(0.5 / 60)
"""Errors below this, rad, are drawn small."""
LEAST = 0.1
"""What the plot shows at least, mrad."""
BARS = (1, 2, 5, 10, 20, 50, 100)
"""Lengths that the bar beside them can have, minutes of arc."""
PAIRS = ((0, 1), (0, 2), (1, 2))
"""Gyros whose angle is 90° - 2 sigma, for each sigma."""
SIGMAS = ("σ₁", "σ₂", "σ₃")
TABLE_HEIGHT = -1.05
TABLE_RADIUS = 1.2


class MountingsView(SceneView):
    """The block on its table, mounted four times; beside it the errors of the four turns."""

    def stage(self, data: DataTable) -> Stage:
        factor = magnification(np.linalg.norm(data.error, axis=-1).max())
        ghost = multiply(data.attitude, from_rotation_vector(factor * data.error))
        along = sum_over(data)[:, 2]
        now = np.where(data.turning, along / (2 * np.pi), np.nan)
        moments = np.arange(len(now))
        true = np.where(moments <= data.ends[data.mounting], data.expected[data.mounting], np.nan)
        found = np.full(len(now), np.nan)
        found[data.ends] = data.estimates
        curves = (
            Curve("true", 1e3 * true, "soft"),
            Curve("so far", 1e3 * now, "ghost"),
            Curve("found", 1e3 * found, "good", data.ends),
        )
        values = np.concatenate([curve.values for curve in curves])
        return Stage(
            times=data.time,
            time_unit="s",
            seconds=16.0,
            tracks={"block": data.attitude, "ghost": ghost},
            views=(
                View(
                    f"gyros bent × {EXAGGERATION}, error × {factor}",
                    (
                        *table_parts(),
                        *block_parts(gyros(data), "block"),
                        *angle_parts(gyros(data)),
                        *ghost_parts(gyros(data)),
                    ),
                ),
                errors_view(data),
            ),
            plots=(Plot("error about the axis / 2π, mrad", curves, *span(values, LEAST)),),
            readouts=(
                Readout("error about the axis", np.degrees(along) * 60, 2, "′"),
                *(
                    Readout(
                        f"{name} found, true {1e3 * sigma:.2f}".replace("-", "−"),
                        np.where(moments >= end, 1e3 * estimate, np.nan),
                        3,
                        " mrad",
                    )
                    for name, sigma, estimate, end in zip(
                        (*SIGMAS, "their sum"),
                        (*data.sigma, data.sigma.sum()),
                        data.estimates * [1, 1, 1, AS_DERIVED],
                        data.ends,
                        strict=True,
                    )
                ),
            ),
        )


def gyros(data: DataTable) -> FloatArray:
    """Sensitive axes (3, 3) as rows, bent `EXAGGERATION` times too much."""
    return np.eye(3) + EXAGGERATION * data.error_matrix


def sum_over(data: DataTable) -> FloatArray:
    """Error vector (m, 3) of the present mounting in laboratory axes, rad."""
    present = data.vectors[data.mounting, np.arange(len(data.time))]
    return np.where(data.turning[:, np.newaxis], present, 0.0)


def table_parts() -> tuple[Part, ...]:
    """The table and its axis, which stand still in the laboratory."""
    tip = np.array([0, 0, 1.45])
    return (
        Part("face", circle([0, 0, 1], TABLE_RADIUS, TABLE_HEIGHT)[:-1], "ground"),
        Part("line", np.array([[0, 0, TABLE_HEIGHT], tip]), "axis"),
        Part("label", 1.06 * tip[np.newaxis], "axis", text="axis of the table"),
    )


def angle_parts(triad: FloatArray) -> tuple[Part, ...]:
    """Arcs between each two gyros, whose angle a sigma makes smaller than a right one."""
    unit = triad / np.linalg.norm(triad, axis=1, keepdims=True)
    share = np.linspace(0, 1, 13)[:, np.newaxis]
    parts = []
    for name, (i, j) in zip(SIGMAS, PAIRS, strict=True):
        arc = (1 - share) * unit[i] + share * unit[j]
        arc *= 0.9 * LENGTH / np.linalg.norm(arc, axis=1, keepdims=True)
        parts += [
            Part("line", arc, "second", "block"),
            Part("label", 1.1 * arc[6:7], "second", "block", text=name),
        ]
    return tuple(parts)


def errors_view(data: DataTable) -> View:
    """The error vectors of the four turns, side by side, as they grow."""
    high, wide = np.abs(data.vectors[..., 2]).max(), np.abs(data.vectors[..., :2]).max()
    scale = 1 / max(high / TALL, wide / WIDE, SMALLEST)
    bar = max((bar for bar in BARS if scale * np.radians(bar / 60) <= TALL), default=BARS[0])
    length = scale * np.radians(bar / 60)
    down = -TALL if data.vectors[..., 2].min() < -0.1 / scale else 0.0
    parts = [
        Part("line", np.array([BAR, BAR + length * UP]), "soft"),
        Part("label", (BAR + (length + 0.12) * UP)[np.newaxis], "soft", text=f"{bar}′"),
    ]
    growing = data.added / max(np.linalg.norm(data.added, axis=-1).max(), 1e-12)
    tip = FEET[data.mounting] + scale * sum_over(data)
    parts.append(Part("arrow", np.stack([tip, tip + 0.3 * growing], axis=1), "rate"))
    names = [f"{name}: {i + 1}, {j + 1}" for name, (i, j) in zip(SIGMAS, PAIRS, strict=True)]
    for foot, vector, name in zip(FEET, data.vectors, (*names, "sum: 1, 2, 3"), strict=True):
        tip = foot + scale * vector
        base = np.broadcast_to(foot, tip.shape)
        parts += [
            Part("line", foot + np.array([[down], [TALL]]) * UP, "grid"),
            Part("line", foot + circle([0, 0, 1], 0.2), "grid"),
            Part("label", (foot + (down - 0.22) * UP)[np.newaxis], "soft", text=name),
            Part("trace", tip, "trace"),
            Part("arrow", np.stack([base, tip], axis=1), "trace"),
        ]
    return View("error of each turn as a vector", tuple(parts), -80.0, 18.0, 1.45)


class FourMountings(SceneExplorer):
    """Mount a bent triad four times on a turntable, and read its angles off the errors."""

    title = "Four turns of a bent triad, and what each of them leaves"
    picture_class = MountingsView
    controls = (
        *TRIAD_ERROR_CONTROLS,
        Control(
            "earth", "Earth under the table", "none", choices=("none", "turning"), group="table"
        ),
    )
    presets: ClassVar = {
        "A bent triad": {"m12": 1.5, "m31": 1.0, "m23": -1.0},
        "Larin's triad": error_matrix_values(LARIN_TRIAD),
        "Skew triad": error_matrix_values(1e-3 * SKEW),
        "Scale factor": error_matrix_values(5e-4 * np.eye(3)),
        "A perfect triad, on the Earth": {"earth": "turning"},
    }
    look_for: ClassVar = {
        "A bent triad": "The tip of each error goes round. Where does it stand after the turn?",
        "Larin's triad": "One gyro leans to one neighbour, away from the other. Which turns "
        "see nothing?",
        "Skew triad": "All gyros lean, and all loops close. Look at the angles between the gyros.",
        "Scale factor": "All angles are right. What do the four turns say?",
        "A perfect triad, on the Earth": "Nothing is bent here, and yet every "
        "arrow grows. Do they stand upright?",
    }

    @staticmethod
    def _table(values: Values) -> TurntableRotation:
        latitude = LATITUDE if values["earth"] == "turning" else None
        return TurntableRotation(TABLE_RATE, latitude=latitude)

    def compute(self, values: Values) -> DataTable:
        return mountings(error_matrix_of(values), self._table(values))

    def dragged(self, handle: str, direction: FloatArray) -> Values:
        return gyro_dragged(handle, direction, self.values)

    def numbers(self, data: DataTable) -> Results:
        errors = (data.estimates[:3] - data.sigma) / arcsecond
        return Results(
            ("largest error of a σ", f"{errors[np.abs(errors).argmax()]:.2f}″"),
            [
                (
                    f"gyros {i + 1}, {j + 1}: −2{name}",
                    f"{-2 * sigma / arcsecond:+.1f}″",
                    f"{-2 * estimate / arcsecond:+.1f}″",
                )
                for name, (i, j), sigma, estimate in zip(
                    SIGMAS, PAIRS, data.sigma, data.estimates, strict=False
                )
            ],
            ("true", "found"),
        )

    def call(self, values: Values) -> str:
        return (
            "import numpy as np\n"
            "from driftlab.book.ch04_calibration_by_turns.experiments import mountings\n"
            "from driftlab.motion import TurntableRotation\n"
            f"error_matrix = {matrix_code(error_matrix_of(values))}\n"
            f"mountings(error_matrix, {self._table(values)}).estimates"
        )


SCENES = (FourMountings,)
