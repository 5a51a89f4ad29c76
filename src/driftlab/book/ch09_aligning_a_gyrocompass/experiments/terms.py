"""Terms of the alignment's heading error over heading, pitch, latitude, and the stray factor."""

from typing import Any, NamedTuple

import numpy as np

from driftlab.book.scenarios import SARATOV_LATITUDE
from driftlab.checks import FloatArray
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass.alignment import align, alignment_errors
from driftlab.motion.vehicle import static_imu
from driftlab.quaternion import conjugate, rotate
from driftlab.vectors import wrap_angle

from .budget import ACCELEROMETER_BIAS, GYRO_BIAS, PITCH

FIXED = {
    "heading": float(np.radians(60.0)),
    "pitch": PITCH,
    "latitude": SARATOV_LATITUDE,
}
"""Values of the two quantities that do not vary, rad."""
GRIDS: dict[str, FloatArray] = {
    "heading": np.radians(np.linspace(-180, 180, 73)),
    "pitch": np.radians(np.linspace(-85, 85, 69)),
    "latitude": np.radians(np.linspace(-85, 85, 69)),
}
"""Values of the quantity that varies, rad."""


class AlignmentTerms(NamedTuple):
    """Heading errors over each of `GRIDS`, degrees.

    Attributes
    ----------
    terms : dict of ndarray, shape (n, 4)
        The four terms of first order.
    exact : dict of ndarray, shape (n,)
    in_copy : dict of ndarray, shape (n,)
        First order, with the stray factor of the copy.
    """

    terms: dict[str, FloatArray]
    exact: dict[str, FloatArray]
    in_copy: dict[str, FloatArray]


def alignment_terms() -> AlignmentTerms:
    """Return the terms of (alignment heading), their sum as the copy has it, and the exact error.

    Heading, pitch and latitude vary one at a time. The sensor errors are given in North, Up, East,
    so that the terms do not mix.
    """
    terms, exact, in_copy = {}, {}, {}
    for name, grid in GRIDS.items():
        at: dict[str, Any] = {**FIXED, name: grid}
        attitude = from_euler_angles(at["heading"], at["pitch"], 0.0)
        rate, force = static_imu(attitude, at["latitude"])
        to_body = conjugate(attitude)
        found = align(
            rate + rotate(to_body, GYRO_BIAS),
            force + rotate(to_body, ACCELEROMETER_BIAS),
            heading_tolerance=np.inf,
        )
        gap = found.heading - at["heading"]
        formula = alignment_errors(
            at["heading"], at["pitch"], at["latitude"], GYRO_BIAS, ACCELEROMETER_BIAS
        )
        terms[name] = np.degrees(formula.heading_terms)
        exact[name] = np.degrees(wrap_angle(gap))
        surplus = formula.heading_terms[:, 2] * (np.tan(at["latitude"]) - 1)
        in_copy[name] = np.degrees(formula.heading + surplus)
    return AlignmentTerms(terms, exact, in_copy)
