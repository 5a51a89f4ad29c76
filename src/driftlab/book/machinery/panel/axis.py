"""An axis that the reader chooses: the same two sliders wherever there is one."""

import numpy as np

from driftlab.checks import FloatArray
from driftlab.vectors import direction_from_angles

from .control import Control
from .panel import Values

AXIS_CONTROLS = (
    Control("azimuth", "azimuth, °", 45.0, -180.0, 180.0, 1.0, group="axis of rotation"),
    Control("elevation", "elevation, °", 15.0, -90.0, 90.0, 1.0, group="axis of rotation"),
)


def axis_of(values: Values) -> FloatArray:
    """Unit vector of `AXIS_CONTROLS`."""
    return direction_from_angles(np.radians(values["azimuth"]), np.radians(values["elevation"]))


def axis_values(direction: FloatArray) -> dict[str, float]:
    """Values of `AXIS_CONTROLS` for a direction (3,) of any length."""
    x, y, z = direction / np.linalg.norm(direction)
    azimuth, elevation = np.degrees([np.arctan2(y, x), np.arcsin(np.clip(z, -1.0, 1.0))])
    return {"azimuth": float(azimuth), "elevation": float(elevation)}


def axis_code(values: Values) -> str:
    """Code for the same."""
    return f"direction_from_angles(*np.radians([{values['azimuth']}, {values['elevation']}]))"


def matrix_code(error_matrix: FloatArray) -> str:
    """Code for an error matrix."""
    return f"1e-3 * np.array({np.round(1e3 * error_matrix, 6).tolist()})"
