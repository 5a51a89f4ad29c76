"""The static alignment of navtk beside `align`, on any attitude and in both hemispheres."""

from types import ModuleType

import numpy as np
from scipy.spatial.transform import Rotation

from driftlab.frames import from_euler_angles
from driftlab.gyrocompass import align
from driftlab.motion import static_imu

DOWN = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])
"""Forward, up, right to forward, right, down; and North, Up, East to North, East, Down."""


def test_the_same_alignment_of_units_with_errors(navtk: ModuleType) -> None:
    rng = np.random.default_rng(9)
    for _ in range(50):
        heading, roll = rng.uniform(-np.pi, np.pi, 2)
        attitude = from_euler_angles(heading, rng.uniform(-1.4, 1.4), roll)
        rate, force = static_imu(attitude, rng.uniform(-1.3, 1.3))
        rate = rate + 1e-6 * rng.standard_normal(3)
        force = force + 1e-2 * rng.standard_normal(3)
        theirs = navtk.inertial.quaternion_static_alignment(DOWN @ force, DOWN @ rate)
        ours = (
            DOWN
            @ Rotation.from_quat(align(rate, force, heading_tolerance=np.inf).attitude).as_matrix()
            @ DOWN.T
        )
        np.testing.assert_allclose(ours, theirs, atol=1e-12)
