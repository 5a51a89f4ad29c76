"""The slider panel of chapter 05."""

from typing import ClassVar

import numpy as np

from driftlab.book.machinery.axis import AXIS_CONTROLS, axis_code, axis_of
from driftlab.book.machinery.control import Control
from driftlab.book.machinery.panel import Explorer, Values

from .experiments import EXAMPLE, CayleyMap, cayley_map
from .figures.cayley_map import CayleyMapPicture


class CayleyMapExplorer(Explorer):
    """Both Cayley vectors of a rotation, and the way to their singularities."""

    title = "The two Cayley vectors of a rotation"
    picture_class = CayleyMapPicture
    controls = (
        Control("angle", "angle φ, degrees", EXAMPLE, -360.0, 360.0, 1.0, group="rotation"),
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

    def compute(self, values: Values) -> CayleyMap:
        return cayley_map(np.radians(values["angle"]), axis_of(values))

    def numbers(self, data: CayleyMap) -> list[tuple[str, str]]:
        def length(along: float | None) -> str:
            return "infinite" if along is None else f"{abs(along):.4f}"

        def vector(along: float | None) -> str:
            if along is None:
                return "infinite"
            return "(" + ", ".join(f"{x:.3f}" for x in np.round(along * data.axis, 3)) + ")"

        return [
            ("dimension 3", vector(data.along_3)),
            ("length", length(data.along_3)),
            ("from its singularity", f"{np.degrees(data.distance_3):.0f}°"),
            ("dimension 4", vector(data.along_4)),
            ("length", length(data.along_4)),
            ("from its singularity", f"{np.degrees(data.distance_4):.0f}°"),
            ("shadow", vector(data.shadow)),
            ("length", length(data.shadow)),
        ]

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
