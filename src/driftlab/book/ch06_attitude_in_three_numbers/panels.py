"""The slider panel of chapter 06."""

from typing import ClassVar

import numpy as np

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.machinery.panel.axis import AXIS_CONTROLS, axis_code, axis_of
from driftlab.book.machinery.panel.control import Control
from driftlab.book.machinery.panel.panel import Explorer, Values
from driftlab.book.machinery.panel.results import Results

from .experiments import EXAMPLE, VECTORS, cayley_map
from .figures.cayley_map import CayleyMapPicture


class CayleyMapExplorer(Explorer):
    """Both Cayley vectors of a rotation, and the way to their singularities."""

    title = "The two Cayley vectors of a rotation"
    picture_class = CayleyMapPicture
    controls = (
        Control("angle", "angle φ, °", EXAMPLE, -360.0, 360.0, 1.0, group="rotation"),
        *AXIS_CONTROLS,
    )
    presets: ClassVar = {
        "Both finite": {},
        "Half a turn": {"angle": 180.0},
        "Three quarters": {"angle": 270.0},
        "Nearly a whole turn": {"angle": 350.0},
        "Whole turn": {"angle": 360.0},
        "No rotation": {"angle": 0.0},
    }
    look_for: ClassVar = {
        "Both finite": "Move the angle. Which of the three vectors is the first to run away?",
        "Half a turn": "One vector has no end here. How long are the other two?",
        "Three quarters": "Where are the vector of dimension 4 and its shadow equally long?",
        "Nearly a whole turn": "Ten degrees are missing. Which vector would you rather use?",
        "Whole turn": "The same attitude as at the start. What do the three vectors say?",
        "No rotation": "Nothing has turned. Which vector makes trouble nevertheless?",
    }

    def compute(self, values: Values) -> DataTable:
        return cayley_map(np.radians(values["angle"]), axis_of(values))

    def numbers(self, table: DataTable) -> Results:
        def text(size: float, form: str) -> str:
            return "∞" if np.isnan(size) else f"{size:{form}}"

        sizes = table.mark[:, 0]
        shorter = np.nanmin(np.abs(sizes[1:]))
        return Results(
            ("the shorter of dimension 4 and its shadow", f"{shorter:.4f}"),
            [
                *(
                    (f"component {i}", *(text(size * factor, ".3f") for size in sizes))
                    for i, factor in enumerate(table.axis, 1)
                ),
                ("length", *(text(abs(size), ".4f") for size in sizes)),
                ("to its singularity", *(f"{angle:.0f}°" for angle in table.shown("away"))),
            ],
            tuple(VECTORS),
        )

    def call(self, values: Values) -> str:
        return (
            "import numpy as np\n"
            "from driftlab.attitude import cayley_vector\n"
            "from driftlab.vectors import direction_from_angles\n"
            "from driftlab.quaternion import from_rotation_vector\n"
            f"axis = {axis_code(values)}\n"
            f"rotation = from_rotation_vector(np.radians({values['angle']}) * axis)\n"
            "# Where a vector is infinite, rounding leaves one of length 1e15 or more.\n"
            "print(cayley_vector(rotation, 3))\n"
            "print(cayley_vector(rotation, 4))"
        )


PANELS = (CayleyMapExplorer,)
