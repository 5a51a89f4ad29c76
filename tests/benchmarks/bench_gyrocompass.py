"""Benchmark of Part IV: two hours of a gyrocompass at ten samples a second."""

from time import perf_counter

import numpy as np
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation
from timing import best

from driftlab.earth import EARTH_RADIUS, EARTH_RATE
from driftlab.frames import from_euler_angles
from driftlab.gyrocompass.gains import schuler_gains
from driftlab.gyrocompass.levelling import LevelFrame, propagate_level_frame
from driftlab.increments import Increments
from driftlab.motion.vehicle import static_imu
from driftlab.quaternion import from_rotation_vector, multiply

LATITUDE = np.radians(51.5)
DURATION, INTERVAL, RUNS = 7200.0, 0.1, 26
AZIMUTH_RATE = float(EARTH_RATE * np.sin(LATITUDE))
ATTITUDE = from_euler_angles(0.5, 0.1, -0.2)
RATE, FORCE = static_imu(ATTITUDE, LATITUDE)
# A horizon that swings, so that there is something to get wrong.
START = LevelFrame(
    multiply(from_rotation_vector([2e-4, 0.0, -3e-4]), ATTITUDE),
    np.array([EARTH_RATE * np.cos(LATITUDE), 0.0]),
)


def gyrocompass() -> None:
    count = round(DURATION / INTERVAL)
    angle, velocity = (np.broadcast_to(INTERVAL * part, (count, 3)) for part in (RATE, FORCE))

    def run(*, runs: int | None = None) -> np.ndarray:
        many = angle if runs is None else np.broadcast_to(angle, (runs, count, 3))
        found = propagate_level_frame(
            START, Increments(INTERVAL, many, velocity), schuler_gains(), AZIMUTH_RATE, every=count
        )
        return found.heading[..., -1]

    ours, many = best(run, repeats=3), best(lambda: run(runs=RUNS), repeats=1)
    print(f"operate, {DURATION / 3600:.0f} h at {1 / INTERVAL:.0f} Hz:              {ours:8.2f} s")
    print(f"  {RUNS} runs at once, all of them      {many:8.2f} s  {many / ours:8.1f} x")
    loop = count / 2000 * by_rotations(2000)
    print(f"  scipy Rotation, from 2000 steps    {loop:8.2f} s  {loop / ours:8.1f} x")
    begin = perf_counter()
    reference = by_solve_ivp()
    seconds = perf_counter() - begin
    print(f"  solve_ivp, rates constant and known{seconds:8.2f} s  {seconds / ours:8.1f} x")
    print(f"  heading, distance to solve_ivp     {abs(float(run()) - reference):8.1e} rad")


def by_rotations(steps: int) -> float:
    """Seconds for some steps of the same scheme in objects of SciPy."""
    attitude, (north, east) = Rotation.from_quat(START.attitude), START.rate
    body, gain = Rotation.from_rotvec(INTERVAL * RATE), INTERVAL / EARTH_RADIUS
    begin = perf_counter()
    for _ in range(steps):
        half = Rotation.from_rotvec(-0.5 * INTERVAL * np.array([north, AZIMUTH_RATE, east]))
        force = (half * attitude).apply(FORCE)
        turn = np.array([north + 0.5 * gain * force[2], AZIMUTH_RATE, east - 0.5 * gain * force[0]])
        north, east = north + gain * force[2], east - gain * force[0]
        attitude = Rotation.from_rotvec(-INTERVAL * turn) * attitude * body
    return perf_counter() - begin


def by_solve_ivp() -> float:
    """Heading in rad at the end, by SciPy's integrator."""

    def slope(_: float, state: np.ndarray) -> np.ndarray:
        q, (north, east) = state[:4], state[4:]
        horizon = np.array([north, AZIMUTH_RATE, east, 0.0])
        change = 0.5 * (multiply(q, [*RATE, 0.0]) - multiply(horizon, q))
        force = Rotation.from_quat(q).apply(FORCE)
        return np.array([*change, force[2] / EARTH_RADIUS, -force[0] / EARTH_RADIUS])

    end = solve_ivp(
        slope, (0, DURATION), [*START.attitude, *START.rate],
        method="DOP853", rtol=1e-12, atol=1e-14,
    ).y[:, -1]  # fmt: skip
    bow = Rotation.from_quat(end[:4]).apply([1.0, 0.0, 0.0])
    return float(np.arctan2(-bow[2], bow[0]) + np.arctan2(end[5], end[4]))
