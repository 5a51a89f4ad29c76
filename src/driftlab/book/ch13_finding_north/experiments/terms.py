"""Terms of the alignment's heading error over heading, pitch, latitude, and the stray factor."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from driftlab.book.machinery.figure.data_table import DataTable
from driftlab.book.scenarios import SARATOV_LATITUDE
from driftlab.checks import FloatArray, finite_array, finite_number
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass.alignment import align, alignment_errors
from driftlab.motion.vehicle import static_imu
from driftlab.quaternion import conjugate, rotate
from driftlab.vectors import wrap_angle

from .budget import ACCELEROMETER_BIAS, GYRO_BIAS, PITCH

FIXED = {"heading": float(np.radians(60.0)), "pitch": PITCH, "latitude": SARATOV_LATITUDE}
"""Values of the two quantities that do not vary, rad."""
GRIDS: dict[str, FloatArray] = {
    "heading": np.radians(np.linspace(-180, 180, 73)),
    "pitch": np.radians(np.linspace(-85, 85, 69)),
    "latitude": np.radians(np.linspace(-85, 85, 69)),
}
"""Values of the quantity that varies, rad."""
LABELS = (
    "east gyro",
    "east acc. by tan pitch",
    "north acc. by tan pitch",
    "east acc. by tan latitude",
)
"""The four terms of first order."""


def alignment_terms(
    heading: float = FIXED["heading"],
    pitch: float = FIXED["pitch"],
    latitude: float = FIXED["latitude"],
    gyro_bias_nue: ArrayLike = GYRO_BIAS,
    accelerometer_bias_nue: ArrayLike = ACCELEROMETER_BIAS,
) -> DataTable:
    """Return the terms of (alignment heading), their sum as the copy has it, and the exact error.

    Heading, pitch and latitude vary one at a time, over `GRIDS`. The sensor errors are given in
    North, Up, East, so that the terms do not mix.
    """
    fixed = {
        name: finite_number(value, name)
        for name, value in (("heading", heading), ("pitch", pitch), ("latitude", latitude))
    }
    for name in ("pitch", "latitude"):
        if abs(fixed[name]) >= np.pi / 2:
            raise ValueError(f"{name}: expected an angle within pi/2, got {fixed[name]:g}.")
    gyro = finite_array(gyro_bias_nue, "gyro_bias_nue", 3)
    accelerometer = finite_array(accelerometer_bias_nue, "accelerometer_bias_nue", 3)
    columns: dict[str, tuple[Any, ...]] = {}
    for name, grid in GRIDS.items():
        at: dict[str, Any] = {**fixed, name: grid}
        attitude = from_euler_angles(at["heading"], at["pitch"], 0.0)
        rate, force = static_imu(attitude, at["latitude"])
        to_body = conjugate(attitude)
        wrong = rate + rotate(to_body, gyro), force + rotate(to_body, accelerometer)
        found = align(*wrong, heading_tolerance=np.inf)
        formula = alignment_errors(at["heading"], at["pitch"], at["latitude"], gyro, accelerometer)
        surplus = formula.heading_terms[:, 2] * (np.tan(at["latitude"]) - 1)
        errors = {
            **dict(zip(LABELS, formula.heading_terms.T, strict=True)),
            "exact": wrap_angle(found.heading - at["heading"]),
            "as in the copy": formula.heading + surplus,
            "corrected": formula.heading,
        }
        columns[f"at_{name}"] = (grid, "deg", f"{name}, the only angle that varies")
        columns[f"error_over_{name}"] = (errors, "deg", f"heading error over the {name}")
    facts = {
        f"fixed_{name}": (value, "deg", f"{name} where it does not vary")
        for name, value in fixed.items()
    }
    return DataTable(columns, facts)
