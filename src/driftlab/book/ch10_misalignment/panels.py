"""The slider panel of chapter 10."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from scipy.constants import arcsecond, micro

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Explorer, Values
from driftlab.book.machinery.panel.results import Results
from driftlab.checks import FloatArray
from driftlab.imu import TYPICAL_ERRORS

from .experiments import error_matrix_parts
from .figures.split_triad import SplitTriadPicture

PLACES = [(row, column) for row in range(3) for column in range(3)]


def _entry(row: int, column: int) -> str:
    return f"k{'xyz'[row]}{'xyz'[column]}"


def _entry_unit(row: int, column: int) -> float:
    return micro if row == column else arcsecond


def _entries(matrix: FloatArray) -> dict[str, float]:
    """Values of the nine sliders that give a matrix (3, 3)."""
    return {
        _entry(*place): round(float(matrix[place] / _entry_unit(*place)), 6) for place in PLACES
    }


class SplitExplorer(Explorer):
    """An error matrix taken apart."""

    title = "Taking an installation-error matrix apart"
    picture_class = SplitTriadPicture
    controls = tuple(
        Control(
            _entry(row, column),
            f"K_{'xyz'[row]}{'xyz'[row]}, scale, ppm"
            if row == column
            else f"K_{'xyz'[row]}{'xyz'[column]}, to axis {'xyz'[column]}, ″",
            0.0,
            -500.0 if row == column else -100.0,
            500.0 if row == column else 100.0,
            10.0 if row == column else 5.0,
            group=f"gyro {'xyz'[row]}",
        )
        for row, column in PLACES
    )
    presets: ClassVar = {
        "Typical unit": _entries(TYPICAL_ERRORS.gyro_error_matrix),
        "One gyro leans": {"kxy": 80.0},
        "Turned as a whole": {"kxy": -80.0, "kyx": 80.0},
        "Two gyros close up": {"kxy": 80.0, "kyx": 80.0},
        "Scale only": {"kxx": 400.0, "kyy": -200.0},
        "No error": {},
    }
    look_for: ClassVar = {
        "Typical unit": "Nine numbers. Which of the three parts is the largest?",
        "One gyro leans": "One entry only. Into which parts does it go, and how much into each?",
        "Turned as a whole": "All axes are still square. Which parts must be empty then?",
        "Two gyros close up": "Two axes lean to each other. What is left for the misalignment?",
        "Scale only": "Could any other choice of body axes change this picture?",
        "No error": "A perfect triad. Move one slider: which pictures answer?",
    }

    @staticmethod
    def _matrix(values: Values) -> FloatArray:
        entries = [values[_entry(*place)] * _entry_unit(*place) for place in PLACES]
        return np.array(entries).reshape(3, 3)

    def compute(self, values: Values) -> DataTable:
        return error_matrix_parts(self._matrix(values))

    def numbers(self, table: DataTable) -> Results:
        _, scale, symmetric, _ = table.parts
        pairs = symmetric[[0, 0, 1], [1, 2, 2]] / arcsecond
        return Results(
            ("the most that two axes lack of square", f"{np.abs(2 * pairs).max():.1f}″"),
            [
                ("scale of x, y, z, ppm", *(f"{x:.1f}" for x in np.diag(scale) / micro)),
                ("non-orthogonality xy, xz, yz, ″", *(f"{x:.1f}" for x in pairs)),
                ("misalignment about x, y, z, ″", *(f"{x:.1f}" for x in table.shown("vector"))),
            ],
        )

    def call(self, values: Values) -> str:
        rows = [[values[_entry(row, column)] for column in range(3)] for row in range(3)]
        return (
            "import numpy as np\n"
            "from scipy.constants import arcsecond, micro\n"
            "from driftlab.body_frames import misalignment_vector\n"
            "from driftlab.triad import split_error_matrix\n"
            "unit = np.where(np.eye(3, dtype=bool), micro, arcsecond)\n"
            f"matrix = unit * np.array({rows})\n"
            "scale, non_orthogonality, misalignment = split_error_matrix(matrix)\n"
            "print(misalignment_vector(matrix) / arcsecond)"
        )


PANELS = (SplitExplorer,)
