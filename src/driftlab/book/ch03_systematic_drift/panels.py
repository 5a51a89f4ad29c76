"""The slider panel of chapter 03."""

from typing import ClassVar

import numpy as np
from scipy.constants import arcminute

from driftlab.book.machinery.axis import AXIS_CONTROLS, axis_code, axis_of, matrix_code
from driftlab.book.machinery.control import Control
from driftlab.book.machinery.panel import Explorer, Values
from driftlab.book.machinery.results import Results
from driftlab.book.scenarios import LARIN_TRIAD, SKEW, SYMMETRIC
from driftlab.checks import FloatArray

from .experiments import LARGEST_ENTRY, DriftHistory, drift_history
from .figures.drift_history import DriftHistoryPicture

ENTRIES = [f"m{row}{column}" for row in (1, 2, 3) for column in (1, 2, 3)]

TRIAD_ERROR_CONTROLS = tuple(
    Control(
        entry,
        f"{gyro} {'scale, 10⁻³' if gyro == 'xyz'[column] else f'to axis {column + 1}, mrad'}",
        0.0,
        -1e3 * LARGEST_ENTRY,
        1e3 * LARGEST_ENTRY,
        0.05,
        group=f"gyro {gyro}",
    )
    for entry, (gyro, column) in zip(
        ENTRIES, ((gyro, column) for gyro in "xyz" for column in range(3)), strict=True
    )
)
"""The nine entries of the triad error, row by row: what each gyro picks up of each body axis."""


def triad_error_of(values: Values) -> FloatArray:
    """Triad error (3, 3) of `TRIAD_ERROR_CONTROLS`."""
    return 1e-3 * np.array([values[entry] for entry in ENTRIES]).reshape(3, 3)


def triad_error_values(triad_error: FloatArray) -> dict[str, float]:
    """Values of `TRIAD_ERROR_CONTROLS` that give a triad error (3, 3)."""
    rounded = np.round(1e3 * np.asarray(triad_error).ravel(), 6)
    return dict(zip(ENTRIES, rounded.tolist(), strict=True))


class DriftExplorer(Explorer):
    """The error of a bent triad over the turns."""

    title = "Drift of a bent triad, turn after turn"
    picture_class = DriftHistoryPicture
    controls = (*TRIAD_ERROR_CONTROLS, *AXIS_CONTROLS)
    presets: ClassVar = {
        "Symmetric triad": triad_error_values(1e-3 * SYMMETRIC),
        "Skew triad": triad_error_values(LARGEST_ENTRY * SKEW),
        "Larin's triad": {
            **triad_error_values(LARIN_TRIAD), "azimuth": 0.0, "elevation": 45.0
        },
        "One gyro leans": {"m12": 2.0, "elevation": 0.0},
        "Scale factor": triad_error_values(1e-3 * np.eye(3)),
    }  # fmt: skip
    look_for: ClassVar = {
        "Symmetric triad": "Turn the axis. About which one does this triad drift most?",
        "Skew triad": "Try any axis you like. Then change one entry, and try again.",
        "Larin's triad": "The worst axis is none of the three. Can you find it before you look?",
        "One gyro leans": "One small lean. Guess the drift of a turn before you read it.",
        "Scale factor": "Nothing leans here. About which axis is the drift largest?",
    }

    def compute(self, values: Values) -> DriftHistory:
        return drift_history(triad_error_of(values), axis_of(values))

    def numbers(self, data: DriftHistory) -> Results:
        x, y, z = data.worst_axis
        azimuth, elevation = np.degrees([np.arctan2(y, x), np.arcsin(np.clip(z, -1.0, 1.0))])
        return Results(
            ("drift in one turn", _arcmin(data.exact_per_turn)),
            [
                ("to first order", _arcmin(data.first_order_per_turn)),
                ("about the worst axis", _arcmin(data.worst_per_turn)),
                ("worst axis, azimuth", f"{azimuth:.1f}°"),
                ("worst axis, elevation", f"{elevation:.1f}°"),
            ],
        )

    def call(self, values: Values) -> str:
        return (
            "import numpy as np\n"
            "from driftlab.drift import drift_per_turn, principal_drifts\n"
            "from driftlab.vectors import direction_from_angles\n"
            f"triad_error = {matrix_code(triad_error_of(values))}\n"
            f"drift_per_turn({axis_code(values)}, triad_error)\n"
            "principal_drifts(triad_error, exact=True)"
        )


def _arcmin(angle: float) -> str:
    return f"{angle / arcminute:.3f}′"


PANELS = (DriftExplorer,)
