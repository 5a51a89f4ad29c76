"""A hundred thousand static alignments: heading, pitch and roll from mean rate and force."""

from collections.abc import Iterator

import numpy as np
from scipy.spatial.transform import Rotation

from driftlab.frames import from_euler_angles
from driftlab.gyrocompass import align
from driftlab.motion import static_imu

from .contenders import floors_here, largest_angle, one_by_one, those_here
from .measuring import Contender, Row

COUNT, LATITUDE = 10**5, np.radians(51.5)
_SOME = 2000
"""Alignments for what makes them one by one."""
DOWN = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])
"""Forward, up, right to forward, right, down; and North, Up, East to North, East, Down."""


def cases(count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """True attitudes (count, 4), and the rates and forces (count, 3) at rest."""
    rng = np.random.default_rng(5)
    heading, roll = rng.uniform(-np.pi, np.pi, (2, count))
    attitude = from_euler_angles(heading, rng.uniform(-1.2, 1.2, count), roll)
    return attitude, *static_imu(attitude, LATITUDE)


def rows() -> Iterator[Row]:
    true, rate, force = cases(COUNT)
    north, up = static_imu(np.array([0.0, 0.0, 0.0, 1.0]), LATITUDE)
    some_rate, some_force = rate[:_SOME], force[:_SOME]

    def error(found: np.ndarray) -> float:
        """Of attitudes as quaternions, of all cases or of the first."""
        return largest_angle(found, true[: len(found)])

    def scipy() -> Contender:
        references, weights = np.stack([up, north]), [np.inf, 1.0]

        def one(w: np.ndarray, f: np.ndarray) -> np.ndarray:
            return Rotation.align_vectors(references, np.stack([f, w]), weights)[0].as_quat()

        return _loop("SciPy Rotation.align_vectors", one, error)

    def ahrs() -> Contender:
        from ahrs.filters import TRIAD

        triad = TRIAD()
        triad.v1, triad.v2 = up / np.linalg.norm(up), north / np.linalg.norm(north)

        def in_body(found: np.ndarray) -> float:
            return error(_quaternions(found.swapaxes(-1, -2)))

        return _loop("ahrs TRIAD", triad.estimate, in_body, True)

    def navtk() -> Contender:
        from navtk.inertial import quaternion_static_alignment

        # Its axes are forward, right, down; they are turned to beforehand.
        rates, forces = some_rate @ DOWN.T, some_force @ DOWN.T
        return Contender(
            "navtk quaternion_static_alignment, one by one",
            lambda: one_by_one(quaternion_static_alignment, forces, rates),
            lambda found: error(_quaternions(DOWN.T @ found @ DOWN)),
            _SOME / COUNT,
        )

    def _loop(name: str, one: object, judge: object, force_first: bool = False) -> Contender:
        columns = (some_force, some_rate) if force_first else (some_rate, some_force)
        return Contender(
            f"{name}, one by one", lambda: one_by_one(one, *columns), judge, _SOME / COUNT
        )

    peers, left_out = those_here({"SciPy": scipy, "ahrs": ahrs, "navtk": navtk})
    copies, without = floors_here(np.hstack([rate, force]))
    yield Row(
        "alignment",
        f"{COUNT} static alignments",
        Contender("driftlab", lambda: align(rate, force), lambda found: error(found.attitude)),
        peers,
        copies,
        [],
        left_out + without,
        (COUNT, "an alignment"),
        "rad",
        1e-12,
    )


def _quaternions(matrices: np.ndarray) -> np.ndarray:
    return Rotation.from_matrix(matrices).as_quat()
