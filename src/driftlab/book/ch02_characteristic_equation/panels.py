"""The slider panel of chapter 02."""

from __future__ import annotations

from typing import ClassVar

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.axis import AXIS_CONTROLS, axis_code, axis_of
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Explorer, Values
from driftlab.book.machinery.panel.results import Results
from driftlab.book.scenarios import SHAPES

from .experiments import FORMULAS, characteristic_roots
from .figures.roots import RootsPicture

SIZES = (1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5)


class RootsExplorer(Explorer):
    """Roots of (2.1): exact, asymptotic, and of the equation with one term missing."""

    title = "Roots of the characteristic equation against deformation and axis"
    picture_class = RootsPicture
    controls = (
        Control("shape", "shape T", "symmetric", choices=tuple(SHAPES), group="deformation"),
        Control("size", "size μ", 0.1, stops=SIZES, group="deformation"),
        *AXIS_CONTROLS,
    )
    presets: ClassVar = {
        "Symmetric triad": {},
        "Skew triad": {"shape": "skew"},
        "Larin's triad": {
            "shape": "third axis bent, as in Larin's experiment", "size": 2e-3, "azimuth": 0.0,
            "elevation": 45.0,
        },
        "Across the error": {
            "shape": "x leans to axis 2 only", "size": 0.3, "azimuth": 90.0, "elevation": 0.0
        },
    }  # fmt: skip
    look_for: ClassVar = {
        "Symmetric triad": "Push the size up. Which formula is the first to leave the exact root?",
        "Skew triad": "Turn the axis. Is there one for which the slow root all but vanishes?",
        "Larin's triad": "The bend is small here. How many digits do the formulas share?",
        "Across the error": "To first order the slow root is zero. Is it?",
    }

    def compute(self, values: Values) -> DataTable:
        return characteristic_roots(values["size"], SHAPES[values["shape"]], axis_of(values))

    def numbers(self, table: DataTable) -> Results:
        fast, slow = table.roots[:, 0].imag, table.roots[:, 2].imag
        return Results(
            ("slow root, exact", f"{slow[0]:.6f} i"),
            [
                (name, f"{a:.9f} i", f"{b:.9f} i")
                for name, a, b in zip(FORMULAS.values(), fast, slow, strict=True)
            ],
            ("fast root", "slow root"),
        )

    def call(self, values: Values) -> str:
        return (
            "import numpy as np\n"
            "from driftlab.drift import asymptotic_roots, exact_roots\n"
            "from driftlab.triad import measured_rate\n"
            "from driftlab.vectors import direction_from_angles\n"
            f"rate = {axis_code(values)}\n"
            f"error_matrix = {values['size']} * np.array({SHAPES[values['shape']]})\n"
            "exact_roots(rate, measured_rate(rate, error_matrix))\n"
            "asymptotic_roots(rate, error_matrix)"
        )


PANELS = (RootsExplorer,)
