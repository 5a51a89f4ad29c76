"""Print how fast the package is, as ratios against peers in the same run: python3 lab.py bench.

Absolute times depend on the machine; the ratios much less. Each time is the best of several
repeats, a redraw the median of its moves.
"""

import timeit
from collections.abc import Callable
from time import perf_counter

import mpmath
import numpy as np
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

from driftlab.explorers import EXPLORERS
from driftlab.kinematics import error_quaternion, error_rate_matrix, error_transition_matrix
from driftlab.quaternion import cumulative_product, from_rotation_vector


def best(call: Callable[[], object], repeats: int = 5) -> float:
    """Seconds of the quickest of several calls, after one to warm up."""
    call()
    return min(timeit.repeat(call, number=1, repeat=repeats))


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
    increments = from_rotation_vector(1e-3 * rng.normal(size=(count, 3)))
    ours = best(lambda: cumulative_product(increments), repeats=3)
    each = 1e9 * ours / count
    print(f"cumulative_product, {count}:       {1e3 * ours:8.1f} ms   {each:6.0f} ns each")


def redraws(moves: int = 10) -> None:
    for explorer_class in EXPLORERS:
        explorer = explorer_class()
        times = []
        for control in explorer.controls:
            for place in control.options or np.linspace(control.low, control.high, moves):
                value = {control.name: place if control.options else type(control.start)(place)}
                start = perf_counter()
                explorer.set(**value)
                times.append(perf_counter() - start)
        median, late = 1e3 * np.percentile(times, [50, 95])
        print(
            f"redraw {explorer_class.__name__:24}     {median:8.1f} ms   "
            f"95 % below {late:.1f} ms, {len(times)} moves"
        )


if __name__ == "__main__":
    error_quaternions()
    exponentials()
    products()
    redraws()
