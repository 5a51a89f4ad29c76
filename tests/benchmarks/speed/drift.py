"""Drift of a bent triad: a hundred thousand cases, and the error along a million times."""

from collections.abc import Iterator

import numpy as np
from scipy.spatial.transform import Rotation

from driftlab.drift import drift_per_turn, error_quaternion

from .contenders import floors_here, largest_angle
from .measuring import Contender, Row

CASES, TIMES = 10**5, 10**6


def cases(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Axes (count, 3) and triad errors (count, 3, 3)."""
    rng = np.random.default_rng(3)
    axes = rng.normal(size=(count, 3))
    axes /= np.linalg.norm(axes, axis=-1, keepdims=True)
    return axes, 1e-4 * rng.normal(size=(count, 3, 3))


def rows() -> Iterator[Row]:
    yield _turns()
    yield _along_a_rotation()


def _turns() -> Row:
    axes, errors = cases(CASES)
    exact = 2 * np.pi * _extended_coefficient(axes, errors)

    def error(found: np.ndarray) -> float:
        return float(np.abs(found - exact).max())

    def by_scipy() -> np.ndarray:
        measured = axes + np.einsum("nij,nj->ni", errors, axes)
        turned = Rotation.from_rotvec(2 * np.pi * measured).as_rotvec()
        return np.einsum("ni,ni->n", turned, measured) / np.linalg.norm(measured, axis=-1)

    copies, left_out = floors_here(errors)
    return Row(
        "drift",
        f"drift after a turn of {CASES} triads, each about its own axis",
        Contender("driftlab", lambda: drift_per_turn(axes, errors), error),
        [Contender("SciPy Rotation of the measured turn, vectorised", by_scipy, error)],
        copies,
        [],
        left_out,
        (CASES, "a case"),
        "rad",
        1e-12,
    )


def _extended_coefficient(axes: np.ndarray, errors: np.ndarray) -> np.ndarray:
    """|A n|/|n| - 1 in NumPy's longest floating point, to the digits of double precision."""
    n, matrix = axes.astype(np.longdouble), errors.astype(np.longdouble)
    measured = n + (matrix * n[:, np.newaxis, :]).sum(axis=-1)
    return (np.sqrt((measured**2).sum(-1)) / np.sqrt((n**2).sum(-1)) - 1).astype(float)


def _along_a_rotation() -> Row:
    rate, measured = np.array([0.1, 0.2, 0.3]), np.array([0.11, 0.19, 0.31])
    times = np.linspace(0.0, 1000.0, TIMES)
    some = slice(None, None, TIMES // 1000)
    exact = _extended_error(rate, measured, times[some])

    def error(found: np.ndarray) -> float:
        return largest_angle(found[some], exact)

    def by_scipy() -> np.ndarray:
        true = Rotation.from_rotvec(rate * times[:, np.newaxis])
        apparent = Rotation.from_rotvec(measured * times[:, np.newaxis])
        return (true.inv() * apparent).as_quat()

    copies, left_out = floors_here(np.repeat(times, 4))
    return Row(
        "drift",
        f"error quaternion at {TIMES} times of a steady rotation",
        Contender("driftlab", lambda: error_quaternion(rate, measured, times), error),
        [Contender("SciPy Rotation, vectorised", by_scipy, error)],
        copies,
        [],
        left_out,
        (TIMES, "a time"),
        "rad",
        1e-12,
    )


def _extended_error(rate: np.ndarray, measured: np.ndarray, times: np.ndarray) -> np.ndarray:
    """conj(q)∘q* by its definition, in NumPy's longest floating point."""

    def turn(w: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        w = w.astype(np.longdouble)
        size = np.sqrt((w**2).sum())
        half = size * times.astype(np.longdouble) / 2
        return np.sin(half)[:, np.newaxis] * (w / size), np.cos(half)

    (u, c), (v, d) = turn(rate), turn(measured)
    vector = c[:, np.newaxis] * v - d[:, np.newaxis] * u - np.cross(u, v)
    return np.column_stack([vector, c * d + (u * v).sum(-1)]).astype(float)
