"""Attitude from a million increments, by every algorithm and by the peers.

The body goes round a cone, so that the true attitude is known in closed form, and the increments
with it. Errors are against that truth: what an algorithm leaves out counts. They are the largest of
the first two minutes, because not all peers go through the whole in a bearable time.
"""

import warnings
from collections.abc import Callable, Iterator
from functools import partial

import numpy as np
from scipy.spatial.transform import Rotation

from driftlab.attitude import ALGORITHMS, CONING_ALGORITHMS
from driftlab.attitude.integration import integrate
from driftlab.book.ch06_picard_algorithms.experiments import (
    PRECESSION_SECONDS,
    precession,
    precession_error,
)
from driftlab.core.coning import cone_increments
from driftlab.quaternion import (
    conjugate,
    cumulative_product,
    from_rotation_vector,
    multiply,
    rotation_angle,
)

from . import floor
from .contenders import IN_C, Maker, and_compiled, every, floors_here, largest_angle, those_here
from .measuring import Contender, Row, Target

DEFAULT = "two-step-4"
BESIDE_PEERS = (DEFAULT, "picard-1")
"""What one has without a choice, and what multiplies the increments as they are, as most peers."""
INTERVAL, HALF_ANGLE, FREQUENCY = 0.01, np.radians(1.0), 5.0
COUNT = 10**6 - 10**6 % 12
_SOME = 12_000
"""Increments for what goes through them in a Python loop, and for the errors."""
_WITH_NAVIGATION = 120_000


def cone(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Increments (count, 3) on the cone, and the attitudes (count, 4) after them."""
    around = 2 * np.pi * FREQUENCY * INTERVAL
    middles = around * (np.arange(count) + 0.5)
    increments = cone_increments(np.array(HALF_ANGLE), np.array(around), middles)
    leaning = _leaning(around * np.arange(count + 1))
    return np.ascontiguousarray(increments), multiply(conjugate(leaning[0]), leaning[1:])


def _leaning(phase: np.ndarray) -> np.ndarray:
    around = np.stack([np.cos(phase), np.sin(phase), np.zeros_like(phase)], axis=-1)
    return from_rotation_vector(HALF_ANGLE * around)


def rows() -> Iterator[Row]:
    increments, true = cone(COUNT)
    for name in (DEFAULT, *(name for name in ALGORITHMS if name != DEFAULT)):
        row = _algorithm(name, increments, true)
        yield from and_compiled(row) if name in CONING_ALGORITHMS else [row]
    yield from and_compiled(_products())
    yield _from_rates()


def _algorithm(name: str, increments: np.ndarray, true: np.ndarray) -> Row:
    samples, held = getattr(ALGORITHMS[name], "samples", 1), every(true[:_SOME], 12)

    def error(found: np.ndarray) -> float:
        return largest_angle(every(found[: _SOME // samples], 12 // samples), held)

    in_c = None
    if name in CONING_ALGORITHMS:
        in_c = partial(floor.attitude, increments, name)
    floors, without = floors_here(increments, in_c, error)
    peers, left_out = those_here(_peers(increments, true)) if name in BESIDE_PEERS else ([], [])
    if name not in CONING_ALGORITHMS:
        without.append("It is products with matrices, for which C would call what NumPy calls.")
    return Row(
        "attitude",
        f"{name}{' (the default)' if name == DEFAULT else ''}, {COUNT} increments",
        Contender("driftlab", lambda: integrate(increments, name), error),
        peers,
        floors,
        [Target(3.0, IN_C)] if name in CONING_ALGORITHMS else [],
        left_out + without,
        (COUNT, "an increment"),
        "rad in two minutes",
    )


def _peers(increments: np.ndarray, true: np.ndarray) -> dict[str, Maker]:
    """All of them multiply the increments as they are; pyins corrects them for coning."""

    def scipy() -> Contender:
        rows = increments[:_SOME]

        def run() -> np.ndarray:
            return _scan(Rotation.from_rotvec(rows).as_quat())[-1]

        return part("SciPy Rotation, products of whole arrays", run, _SOME)

    def numpy_quaternion() -> Contender:
        import quaternion

        def run() -> np.ndarray:
            steps = quaternion.from_rotation_vector(increments)
            return quaternion.as_float_array(np.multiply.accumulate(steps))

        def error(found: np.ndarray) -> float:
            return largest_angle(np.roll(found[:_SOME], -1, axis=-1), true[:_SOME])

        return Contender("numpy-quaternion, accumulate", run, error)

    def ahrs() -> Contender:
        from ahrs.filters import AngularRate

        method, rates = AngularRate(frequency=1 / INTERVAL), increments[:_SOME] / INTERVAL

        def run() -> np.ndarray:
            attitude = np.array([1.0, 0.0, 0.0, 0.0])
            for rate in rates:
                attitude = method.update(attitude, rate, method="closed")
            return np.roll(attitude, -1)

        return part("ahrs AngularRate, a Python loop", run, _SOME)

    def pyins() -> Contender:
        return part(
            "pyins, compiled, with navigation",
            _pyins_navigation(increments[:_WITH_NAVIGATION]),
            _WITH_NAVIGATION,
        )

    def part(name: str, run: Callable[[], np.ndarray], count: int) -> Contender:
        """Goes through the first increments, and returns the attitude after two minutes."""
        place = true[_SOME - 1]
        return Contender(name, run, lambda found: largest_angle(found, place), count / COUNT)

    return {
        "SciPy": scipy,
        "numpy-quaternion": numpy_quaternion,
        "ahrs": ahrs,
        "pyins": pyins,
    }


def _scan(quaternions: np.ndarray) -> np.ndarray:
    """Cumulative product with SciPy, which has none: first of pairs, then what is between."""
    if len(quaternions) == 1:
        return quaternions

    def product(first: np.ndarray, second: np.ndarray) -> np.ndarray:
        return (Rotation.from_quat(first) * Rotation.from_quat(second)).as_quat()

    even, odd = quaternions[::2], quaternions[1::2]
    products = quaternions.copy()
    products[1::2] = _scan(product(even[: len(odd)], odd))
    if len(even) > 1:
        products[2::2] = product(products[1:-1:2], even[1:])
    return products


def _pyins_navigation(rows: np.ndarray) -> Callable[[], np.ndarray]:
    """Its integrator carries velocity and position along; there is no part for attitude alone."""
    import pandas as pd
    from pyins import earth, strapdown, transform, util

    warnings.filterwarnings("ignore", message="The copy keyword is deprecated")
    # It wants one more row, for what happened before the start.
    rows = np.vstack([rows[:1], rows])
    imu = pd.DataFrame(
        np.hstack([rows, np.zeros_like(rows)]),
        index=INTERVAL * np.arange(len(rows)),
        columns=[*util.GYRO_COLS, *util.ACCEL_COLS],
    )
    place = pd.Series([45.0, 30.0, *[0.0] * 7], index=util.TRAJECTORY_COLS, name=0.0)
    # Its reference frame turns with the Earth.
    latitude, seconds = np.radians(45.0), INTERVAL * _SOME
    turned = earth.RATE * seconds * np.array([np.cos(latitude), 0.0, -np.sin(latitude)])

    def run() -> np.ndarray:
        steps = strapdown.compute_increments_from_imu(imu, "increment")
        # Without altitude and forces it stays where it is, but for the free fall that is held.
        way = strapdown.Integrator(place, with_altitude=False).integrate(steps)
        attitude = Rotation.from_matrix(transform.mat_from_rph(way.iloc[_SOME][util.RPH_COLS]))
        return (Rotation.from_rotvec(turned) * attitude).as_quat()

    return run


def _products() -> Row:
    """Cumulative product of a million small random rotations."""
    rng = np.random.default_rng(0)
    quaternions = from_rotation_vector(1e-3 * rng.normal(size=(10**6, 3)))
    exact = extended_product(quaternions)

    def error(found: np.ndarray) -> float:
        return float(np.abs(found - exact).max())

    def numpy_quaternion() -> Contender:
        import quaternion

        scalar_first = quaternion.as_quat_array(np.roll(quaternions, 1, axis=-1))
        return Contender(
            "numpy-quaternion, accumulate",
            lambda: quaternion.as_float_array(np.multiply.accumulate(scalar_first)),
            lambda found: error(np.roll(found, -1, axis=-1)),
        )

    peers, left_out = those_here({"numpy-quaternion": numpy_quaternion})
    copies, without = floors_here(quaternions)
    return Row(
        "attitude",
        "cumulative product of 1000000 quaternions",
        Contender("driftlab", lambda: cumulative_product(quaternions), error),
        peers,
        copies,
        [],
        left_out + without,
        (10**6, "a quaternion"),
        "of a component",
        1e-12,
    )


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


def _from_rates(count: int = 2000) -> Row:
    """Attitude from sampled rates, on numpy-quaternion's own test of a precession."""
    times = np.linspace(0.0, PRECESSION_SECONDS, count + 1)
    true, rates = precession(times)

    def numpy_quaternion() -> Contender:
        import quaternion

        start = quaternion.quaternion(*np.roll(true[0], 1))

        def run() -> np.ndarray:
            found = quaternion.integrate_angular_velocity((times, rates), 0.0, times[-1], R0=start)
            return np.roll(quaternion.as_float_array(found[1]), -1, axis=-1)

        return Contender(
            "numpy-quaternion, integrate_angular_velocity",
            run,
            lambda found: float(rotation_angle(multiply(conjugate(true), found)).max()),
        )

    def spline(degree: int) -> Contender:
        name = f"driftlab, spline of degree {degree}, iteration"
        return Contender(name, lambda: precession_error(count, degree), float)

    peers, left_out = those_here({"numpy-quaternion": numpy_quaternion})
    return Row(
        "attitude",
        f"from {count} sampled rates of a precession",
        spline(7),
        peers,
        [spline(3), spline(5)],
        [],
        left_out,
        error_in="rad",
    )
