"""Print how fast the package is, as ratios against peers in the same run: python3 lab.py bench.

Absolute times depend on the machine; the ratios much less. Each time is the best of several
repeats, a redraw the median of its moves. Peers that are missing are left out.
"""

import platform
import sys
import tomllib
import warnings
from pathlib import Path
from time import perf_counter

import mpmath
import numpy as np
from bench_calibration import calibration, navigation
from bench_gyrocompass import gyrocompass
from scipy.linalg import expm
from scipy.spatial.transform import Rotation
from timing import best

from driftlab.attitude.coning_algorithms import ALGORITHMS
from driftlab.attitude.integration import integrate
from driftlab.book.ch06_picard_algorithms.experiments import (
    PRECESSION_SECONDS,
    precession,
    precession_error,
)
from driftlab.book.panels import EXPLORERS
from driftlab.drift.error_kinematics import (
    error_quaternion,
    error_rate_matrix,
    error_transition_matrix,
)
from driftlab.quaternion import (
    conjugate,
    cumulative_product,
    from_rotation_vector,
    multiply,
    rotation_angle,
)


def error_quaternions() -> None:
    count = 10**6
    rate, measured = np.array([0.1, 0.2, 0.3]), np.array([0.11, 0.19, 0.31])
    time = np.linspace(0.0, 1000.0, count)

    def by_scipy() -> object:
        rate_turns = Rotation.from_rotvec(rate * time[:, None])
        return rate_turns.inv() * Rotation.from_rotvec(measured * time[:, None])

    ours, scipys = best(lambda: error_quaternion(rate, measured, time)), best(by_scipy)
    print(f"error_quaternion, {count} times:   {1e3 * ours:8.1f} ms")
    print(f"  scipy Rotation, same:              {1e3 * scipys:8.1f} ms   {scipys / ours:6.1f} x")


def exponentials() -> None:
    count = 10**5
    rng = np.random.default_rng(0)
    rate = rng.normal(size=(count, 3))
    measured = rate + 0.1 * rng.normal(size=(count, 3))
    matrices = 0.5 * error_rate_matrix(rate, measured)
    ours = best(lambda: error_transition_matrix(rate, measured, 1.0))
    scipys = best(lambda: expm(matrices), repeats=3)
    print(f"error_transition_matrix, {count}:   {1e3 * ours:8.1f} ms")
    print(f"  scipy.linalg.expm, same:           {1e3 * scipys:8.1f} ms   {scipys / ours:6.1f} x")

    sample = slice(0, 20)
    with mpmath.workdps(40):
        exact = np.array([
            np.array(mpmath.expm(mpmath.matrix(matrix.tolist())).tolist(), dtype=float)
            for matrix in matrices[sample]
        ])  # fmt: skip
    for name, result in (
        ("ours", error_transition_matrix(rate[sample], measured[sample], 1.0)),
        ("scipy", expm(matrices[sample])),
    ):
        print(f"  largest error, {name:6}              {np.abs(result - exact).max():8.1e}")


def products() -> None:
    count = 10**6
    rng = np.random.default_rng(0)
    quaternions = from_rotation_vector(1e-3 * rng.normal(size=(count, 3)))
    ours = best(lambda: cumulative_product(quaternions), repeats=3)
    each = 1e9 * ours / count
    print(f"cumulative_product, {count}:       {1e3 * ours:8.1f} ms   {each:6.0f} ns each")
    error = np.abs(cumulative_product(quaternions) - extended_product(quaternions)).max()
    print(f"  largest error                      {float(error):8.1e}")


def extended_product(quaternions: np.ndarray) -> np.ndarray:
    """Cumulative product in NumPy's longest floating point numbers, one after the other."""
    products = np.empty(quaternions.shape, np.longdouble)
    product = np.array([0, 0, 0, 1], np.longdouble)
    rows = np.moveaxis(quaternions.astype(np.longdouble), -1, 0)
    x, y, z, w = rows
    matrices = np.stack([w, z, -y, x, -z, w, x, y, y, -x, w, z, -x, -y, -z, w], axis=-1)
    for i, matrix in enumerate(matrices.reshape(-1, 4, 4)):
        product = matrix @ product
        products[i] = product
    return products


def attitudes() -> None:
    """Attitude from increments: the algorithms, and the peers on their own terms."""
    count, rate = 10**6 - 10**6 % 12, 100.0
    time = np.arange(count)[:, None] / rate
    increments = np.sin(time * [2.0, 1.3, 0.7] + [0.0, 1.0, 2.0]) / rate
    print(f"integrate, {count} increments in one call")
    for name in ALGORITHMS:
        ours = 1e9 * best(lambda name=name: integrate(increments, name), repeats=3) / count
        print(f"  {name:34} {ours:8.0f} ns each")
    ours = 1e9 * best(lambda: integrate(increments, "memory-4"), repeats=3) / count
    print("the same with others, as a multiple of memory-4; and the angle, in rad, from their last")
    print("attitude to the product of the increments that they were given")
    for name, peer in (
        ("scipy Rotation, a Python loop", scipy_one_by_one),
        ("ahrs, a Python loop", ahrs_one_by_one),
        ("pyins, compiled, with navigation", pyins_navigation),
    ):
        try:
            theirs, gap = peer(increments, rate)
        except ImportError as missing:
            print(f"  {name:34} left out: {missing}")
        else:
            print(f"  {name:34} {theirs:8.0f} ns each {theirs / ours:6.1f} x   {gap:.0e}")


Peer = tuple[float, float]
"""Nanoseconds for one increment, and the angle between the peer's last attitude and ours."""


def gap_to(attitude: Rotation, increments: np.ndarray) -> float:
    """Angle to the product of the increments as they are, which is what the peers compute."""
    product = cumulative_product(from_rotation_vector(increments))[-1]
    return float((Rotation.from_quat(product).inv() * attitude).magnitude())


def scipy_one_by_one(increments: np.ndarray, rate: float) -> Peer:
    rows = increments[:10_000]

    def run() -> Rotation:
        attitude = Rotation.identity()
        for row in rows:
            attitude = attitude * Rotation.from_rotvec(row)
        return attitude

    return 1e9 * best(run, repeats=3) / len(rows), gap_to(run(), rows)


def ahrs_one_by_one(increments: np.ndarray, rate: float) -> Peer:
    from ahrs.filters import AngularRate

    rows = increments[:10_000]
    method = AngularRate(frequency=rate)

    def run() -> np.ndarray:
        attitude = np.array([1.0, 0.0, 0.0, 0.0])
        for row in rows * rate:
            attitude = method.update(attitude, row, method="closed")
        return attitude

    attitude = Rotation.from_quat(run(), scalar_first=True)
    return 1e9 * best(run, repeats=3) / len(rows), gap_to(attitude, rows)


def pyins_navigation(increments: np.ndarray, rate: float) -> Peer:
    """Its integrator carries velocity and position along; there is no part for attitude alone."""
    import pandas as pd
    from pyins import earth, strapdown, transform, util

    warnings.filterwarnings("ignore", message="The copy keyword is deprecated")
    rows = increments[:100_000]
    at_rest = np.zeros_like(rows)
    columns = [*util.GYRO_COLS, *util.ACCEL_COLS]
    index = np.arange(len(rows)) / rate
    imu = pd.DataFrame(np.hstack([rows, at_rest]), index=index, columns=columns)
    place = pd.Series([45.0, 30.0, *[0.0] * 7], index=util.TRAJECTORY_COLS, name=0.0)

    def run() -> tuple[np.ndarray, pd.DataFrame]:
        steps = strapdown.compute_increments_from_imu(imu, "increment")
        navigation = strapdown.Integrator(place, with_altitude=False).integrate(steps)
        return steps[["theta_x", "theta_y", "theta_z"]].to_numpy(), navigation

    steps, navigation = run()
    attitude = Rotation.from_matrix(transform.mat_from_rph(navigation.iloc[-1][util.RPH_COLS]))
    # Its reference frame turns with the Earth.
    latitude, seconds = np.radians(45.0), len(steps) / rate
    turned = earth.RATE * seconds * np.array([np.cos(latitude), 0.0, -np.sin(latitude)])
    gap = gap_to(Rotation.from_rotvec(turned) * attitude, steps)
    return 1e9 * best(run, repeats=3) / len(rows), gap


def from_rates() -> None:
    """Attitude from sampled rates, on numpy-quaternion's own test of a precession."""
    count = 2000
    times = np.linspace(0.0, PRECESSION_SECONDS, count + 1)
    true, rates = precession(times)
    print(f"attitude from {count} sampled rates of a precession")
    fastest = np.inf
    for degree in (3, 5, 7):
        ours = best(lambda degree=degree: precession_error(count, degree), repeats=3)
        fastest = min(fastest, ours)
        error = precession_error(count, degree)
        print(f"  spline of degree {degree}, iteration    {1e3 * ours:8.1f} ms   error {error:.0e}")
    try:
        import quaternion
    except ImportError as missing:
        print(f"  numpy-quaternion                   left out: {missing}")
        return
    start = quaternion.quaternion(*np.roll(true[0], 1))

    def run() -> np.ndarray:
        found = quaternion.integrate_angular_velocity((times, rates), 0.0, times[-1], R0=start)[1]
        return np.roll(quaternion.as_float_array(found), -1, axis=-1)

    theirs = best(run, repeats=1)
    error = rotation_angle(multiply(conjugate(true), run())).max()
    print(
        f"  numpy-quaternion                   {1e3 * theirs:8.1f} ms   error {error:.0e} "
        f"{theirs / fastest:6.1f} x"
    )


def redraws(moves: int = 10) -> None:
    for explorer_class in EXPLORERS:
        explorer = explorer_class()
        times = []
        for control in explorer.controls:
            listed = control.options or control.examples
            for place in listed or np.linspace(control.low, control.high, moves):
                value = {control.name: place if listed else type(control.start)(place)}
                start = perf_counter()
                explorer.set(**value)
                times.append(perf_counter() - start)
        median, late = 1e3 * np.percentile(times, [50, 95])
        print(
            f"redraw {explorer_class.__name__:24}     {median:8.1f} ms   "
            f"95 % below {late:.1f} ms, {len(times)} moves"
        )


def browser_latencies() -> None:
    home = Path(__file__).parents[2]
    settings = tomllib.loads((home / "pyproject.toml").read_text("utf-8"))
    folders = settings["tool"]["pytest"]["ini_options"]["pythonpath"]  # where the tests look, too
    sys.path += [str(home / folder) for folder in folders]
    from latency import latencies
    from latency_in_page import page_latencies

    latencies()
    page_latencies(home / "_site")


if __name__ == "__main__":
    print(f"Python {platform.python_version()}, NumPy {np.__version__}, {platform.machine()}")
    error_quaternions()
    exponentials()
    products()
    attitudes()
    from_rates()
    navigation()
    calibration()
    gyrocompass()
    redraws()
    browser_latencies()
