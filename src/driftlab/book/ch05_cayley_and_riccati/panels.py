"""The slider panel of chapter 05."""

from typing import ClassVar

import numpy as np

from driftlab.book.machinery.axis import AXIS_CONTROLS, axis_code, axis_of
from driftlab.book.machinery.control import Control
from driftlab.book.machinery.panel import Explorer, Values
from driftlab.book.machinery.results import Results

from .experiments import EXAMPLE, CayleyMap, cayley_map
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

    def compute(self, values: Values) -> CayleyMap:
        return cayley_map(np.radians(values["angle"]), axis_of(values))

    def numbers(self, data: CayleyMap) -> Results:
        def along(size: float | None, factor: float) -> str:
            return "∞" if size is None else f"{size * factor:.3f}"

        sizes = (data.along_3, data.along_4, data.shadow)
        lengths = [np.inf if size is None else abs(size) for size in sizes]
        away = (data.distance_3, data.distance_4, abs(data.angle))
        return Results(
            ("the shorter of dimension 4 and its shadow", f"{min(lengths[1:]):.4f}"),
            [
                *(
                    (f"component {i}", *(along(size, float(factor)) for size in sizes))
                    for i, factor in enumerate(data.axis, 1)
                ),
                ("length", *("∞" if np.isinf(size) else f"{size:.4f}" for size in lengths)),
                ("to its singularity", *(f"{np.degrees(angle):.0f}°" for angle in away)),
            ],
            ("dimension 3", "dimension 4", "shadow"),
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
