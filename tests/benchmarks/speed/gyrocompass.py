"""Two hours of a gyrocompass at ten samples a second."""

from collections.abc import Iterator

import numpy as np
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from driftlab.earth import EARTH_RADIUS, EARTH_RATE
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass import LevelFrame, propagate_level_frame, schuler_gains
from driftlab.increments import Increments
from driftlab.motion import static_imu
from driftlab.quaternion import from_rotation_vector, multiply

from .measuring import Contender, Row

LATITUDE = np.radians(51.5)
DURATION, INTERVAL, RUNS = 7200.0, 0.1, 26
_SOME = 2000
"""Steps for what makes them in a Python loop."""
AZIMUTH_RATE = float(EARTH_RATE * np.sin(LATITUDE))
ATTITUDE = from_euler_angles(0.5, 0.1, -0.2)
RATE, FORCE = static_imu(ATTITUDE, LATITUDE)
# A horizon that swings, so that there is something to get wrong.
START = LevelFrame(
    multiply(from_rotation_vector([2e-4, 0.0, -3e-4]), ATTITUDE),
    np.array([EARTH_RATE * np.cos(LATITUDE), 0.0]),
)


def rows() -> Iterator[Row]:
    count = round(DURATION / INTERVAL)
    angle, velocity = (np.broadcast_to(INTERVAL * part, (count, 3)) for part in (RATE, FORCE))
    gains = schuler_gains()

    def run(runs: int | None = None) -> np.ndarray:
        many = angle if runs is None else np.broadcast_to(angle, (runs, count, 3))
        found = propagate_level_frame(
            START, Increments(INTERVAL, many, velocity), gains, AZIMUTH_RATE, every=count
        )
        return found.heading[..., -1]

    exact = by_solve_ivp(1e-13)

    def error(heading: np.ndarray) -> float:
        return float(np.abs(heading - exact).max())

    title = f"{DURATION / 3600:.0f} h of a gyrocompass at {1 / INTERVAL:.0f} Hz"
    alone = f"{RUNS} alone, from one of them"
    yield Row(
        "gyrocompass",
        title,
        Contender("driftlab", run, error),
        [
            Contender("solve_ivp, rates constant and known", lambda: by_solve_ivp(1e-10), error),
            Contender(
                "SciPy Rotation, a Python loop", lambda: by_rotations(_SOME), None, _SOME / count
            ),
        ],
        error_in="rad of heading",
        rounding=1e-9,
    )
    yield Row(
        "gyrocompass",
        f"{RUNS} runs at once, {title}",
        Contender("driftlab", lambda: run(RUNS), error),
        [],
        [Contender(alone, run, None, 1 / RUNS)],
        error_in="rad of heading",
    )


def by_rotations(steps: int) -> Rotation:
    """Some steps of the same scheme in objects of SciPy."""
    attitude, (north, east) = Rotation.from_quat(START.attitude), START.rate
    body, gain = Rotation.from_rotvec(INTERVAL * RATE), INTERVAL / EARTH_RADIUS
    for _ in range(steps):
        half = Rotation.from_rotvec(-0.5 * INTERVAL * np.array([north, AZIMUTH_RATE, east]))
        force = (half * attitude).apply(FORCE)
        turn = np.array([north + 0.5 * gain * force[2], AZIMUTH_RATE, east - 0.5 * gain * force[0]])
        north, east = north + gain * force[2], east - gain * force[0]
        attitude = Rotation.from_rotvec(-INTERVAL * turn) * attitude * body
    return attitude


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
