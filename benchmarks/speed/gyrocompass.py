"""Static alignments from mean rate and force, and two hours of a gyrocompass at 10 Hz."""

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from driftlab.earth import EARTH_RADIUS, EARTH_RATE
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass import LevelFrame, align, propagate_level_frame, schuler_gains
from driftlab.increments import Increments
from driftlab.motion import static_imu
from driftlab.quaternion import from_rotation_vector, multiply

from .measuring import Contender, Row, copy_of, largest_angle

COUNT, SOME, LATITUDE = 10**5, 2000, np.radians(51.5)
"""Alignments, and those for peers that make them one by one."""
DOWN = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])
"""Forward, up, right to forward, right, down; and North, Up, East to North, East, Down."""
DURATION, INTERVAL = 7200.0, 0.1
AZIMUTH_RATE = float(EARTH_RATE * np.sin(LATITUDE))
ATTITUDE = from_euler_angles(0.5, 0.1, -0.2)
RATE, FORCE = static_imu(ATTITUDE, LATITUDE)
# A horizon that swings, so that there is something to get wrong.
START = LevelFrame(
    multiply(from_rotation_vector([2e-4, 0.0, -3e-4]), ATTITUDE),
    np.array([EARTH_RATE * np.cos(LATITUDE), 0.0]),
)


def alignments() -> Iterator[Row]:
    rng = np.random.default_rng(5)
    heading, roll = rng.uniform(-np.pi, np.pi, (2, COUNT))
    true = from_euler_angles(heading, rng.uniform(-1.2, 1.2, COUNT), roll)
    rate, force = static_imu(true, LATITUDE)
    north, up = static_imu(np.array([0.0, 0.0, 0.0, 1.0]), LATITUDE)

    def one_by_one(
        name: str, one: Callable[..., np.ndarray], axes: np.ndarray, left: np.ndarray
    ) -> Contender:
        """A function of force and rate, in other axes; its matrices become ours by `left`."""
        given = list(zip(force[:SOME] @ axes.T, rate[:SOME] @ axes.T, strict=True))

        def error(found: np.ndarray) -> float:
            turned = Rotation.from_matrix(left @ found @ axes)
            return largest_angle(turned.as_quat(), true[:SOME])

        run = partial(lambda cases: np.array([one(*case) for case in cases]), given)
        return Contender(f"{name}, one by one", run, error, SOME / COUNT)

    def scipy() -> Contender:
        def one(f: np.ndarray, w: np.ndarray) -> np.ndarray:
            return Rotation.align_vectors([up, north], [f, w], [np.inf, 1.0])[0].as_matrix()

        return one_by_one("SciPy Rotation.align_vectors", one, np.eye(3), np.eye(3))

    def ahrs() -> Contender:
        from ahrs.filters import TRIAD

        triad = TRIAD()
        triad.v1, triad.v2 = up / np.linalg.norm(up), north / np.linalg.norm(north)

        def one(f: np.ndarray, w: np.ndarray) -> np.ndarray:
            return triad.estimate(f, w).T

        return one_by_one("ahrs TRIAD", one, np.eye(3), np.eye(3))

    def navtk() -> Contender:
        from navtk.inertial import quaternion_static_alignment as one

        return one_by_one("navtk quaternion_static_alignment", one, DOWN, DOWN.T)

    yield Row(
        f"{COUNT} static alignments",
        Contender(
            "driftlab",
            partial(align, rate, force),
            lambda found: largest_angle(found.attitude, true),
        ),
        [scipy, ahrs, navtk],
        [copy_of(np.hstack([rate, force]))],
        (COUNT, "an alignment"),
        "rad",
        1e-12,
    )


def rows() -> Iterator[Row]:
    count = round(DURATION / INTERVAL)
    steps = (np.broadcast_to(INTERVAL * part, (count, 3)) for part in (RATE, FORCE))
    increments, exact = Increments(INTERVAL, *steps), by_solve_ivp(1e-13)

    def run() -> float:
        gains = schuler_gains()
        found = propagate_level_frame(START, increments, gains, AZIMUTH_RATE, every=count)
        return float(found.heading[-1])

    def error(heading: float) -> float:
        return abs(heading - exact)

    def ivp() -> Contender:
        why = "It knows that the rates are constant, and takes long steps; a log has none."
        name = "solve_ivp, rates constant and known"
        return Contender(name, partial(by_solve_ivp, 1e-10), error, why=why)

    yield Row(
        f"{DURATION / 3600:.0f} h of a gyrocompass at {1 / INTERVAL:.0f} Hz",
        Contender("driftlab", run, error),
        [ivp],
        error_in="rad of heading",
        rounding=1e-9,
    )


def by_solve_ivp(tolerance: float) -> float:
    """Heading in rad at the end, by SciPy's integrator."""

    def slope(_: float, state: np.ndarray) -> np.ndarray:
        q, (north, east) = state[:4], state[4:]
        horizon = np.array([north, AZIMUTH_RATE, east, 0.0])
        change = 0.5 * (multiply(q, [*RATE, 0.0]) - multiply(horizon, q))
        force = Rotation.from_quat(q).apply(FORCE)
        return np.array([*change, force[2] / EARTH_RADIUS, -force[0] / EARTH_RADIUS])

    end = solve_ivp(
        slope, (0, DURATION), [*START.attitude, *START.rate],
        method="DOP853", rtol=tolerance, atol=0.01 * tolerance,
    ).y[:, -1]  # fmt: skip
    bow = Rotation.from_quat(end[:4]).apply([1.0, 0.0, 0.0])
    return float(np.arctan2(-bow[2], bow[0]) + np.arctan2(end[5], end[4]))
