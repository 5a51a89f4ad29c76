"""The values of a panel's controls, and the rows beside its picture."""

from collections.abc import Mapping

import numpy as np

from driftlab.vectors import direction_from_angles

Values = Mapping[str, float | int | bool | str]
Rows = list[tuple[str, str]]
"""Names and what stands after them, in the order of the panel."""


def listed(values: Values, names: str) -> np.ndarray:
    return np.array([values[name] for name in names.split()], dtype=float)


def axis_of(values: Values) -> np.ndarray:
    return direction_from_angles(*np.radians(listed(values, "azimuth elevation")))
