"""The slider panel of chapter 03."""

from typing import ClassVar

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.axis import (
    AXIS_CONTROLS,
    axis_code,
    axis_of,
    axis_values,
    matrix_code,
)
from driftlab.book.machinery.panel.panel import Explorer, Values
from driftlab.book.machinery.panel.results import Results

from .controls import TRIAD_ERROR_CONTROLS, TRIADS, error_matrix_of
from .experiments import drift_history
from .figures.drift_history import DriftHistoryPicture


class DriftExplorer(Explorer):
    """The error of a bent triad over the turns."""

    title = "Drift of a bent triad, turn after turn"
    picture_class = DriftHistoryPicture
    controls = (*TRIAD_ERROR_CONTROLS, *AXIS_CONTROLS)
    presets: ClassVar = TRIADS
    look_for: ClassVar = {
        "Symmetric triad": "Turn the axis. About which one does this triad drift most?",
        "Skew triad": "Try any axis you like. Then change one entry, and try again.",
        "Larin's triad": "The worst axis is none of the three. Can you find it before you look?",
        "One gyro leans": "One small lean. Guess the drift of a turn before you read it.",
        "Scale factor": "Nothing leans here. About which axis is the drift largest?",
    }

    def compute(self, values: Values) -> DataTable:
        return drift_history(error_matrix_of(values), axis_of(values))

    def numbers(self, table: DataTable) -> Results:
        worst = axis_values(table.worst_axis)
        return Results(
            table.row("exact_per_turn", ".3f"),
            [
                table.row("first_order_per_turn", ".3f"),
                table.row("worst_per_turn", ".3f"),
                ("worst axis, azimuth", f"{worst['azimuth']:.1f}°"),
                ("worst axis, elevation", f"{worst['elevation']:.1f}°"),
            ],
        )

    def call(self, values: Values) -> str:
        return (
            "import numpy as np\n"
            "from driftlab.drift import drift_per_revolution, principal_drifts\n"
            "from driftlab.vectors import direction_from_angles\n"
            f"error_matrix = {matrix_code(error_matrix_of(values))}\n"
            f"drift_per_revolution({axis_code(values)}, error_matrix)\n"
            "principal_drifts(error_matrix, exact=True)"
        )


PANELS = (DriftExplorer,)
