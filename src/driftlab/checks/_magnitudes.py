"""Sizes that are hardly meant, and the mistaken unit behind most of them.

An unusual size, such as that of degrees taken for radians, is let through with an `UnusualWarning`.
A size for which the functions behind the door are not made is refused, whatever instrument has it.
"""

from __future__ import annotations

import warnings
from typing import NamedTuple

import numpy as np

from ._arrays import FloatArray
from ._values import finite_number, nonnegative_number

FASTEST_TABLE = 200.0
"""rad/s: a turn in 31 ms, three samples at 100 Hz; numbers of degrees a second are often larger."""
USUAL_TABLE = 2 * np.pi
"""rad/s: a turn a second; more is the business of centrifuges and tables for wide-range gyros."""
USUAL_GYRO_BIAS, LARGEST_GYRO_BIAS = 1.0, 10.0
"""rad/s: 57 degrees a second, as gyros of a wide range may have, and ten times that, beside which
the Earth's rate is less than a hundred thousandth and nothing can be calibrated by it."""
USUAL_ACCELEROMETER_BIAS, LARGEST_ACCELEROMETER_BIAS = 10.0, 1000.0
"""m/s^2: about gravity, as accelerometers for shocks may have, and a hundred times that, beside
which gravity is lost."""
GRAVITY_RANGE = (1.2, 50.0)
"""m/s^2: the Moon and Jupiter are within, and one g, taken for a number of m/s^2, is not."""
_ON_EARTH, _LOCAL = 9.80665, 0.05
"""m/s^2: standard gravity, and by how much that of places on the Earth differs from it."""
_FOOT = 0.3048
LIGHT = 299792458.0
"""m/s: nothing that is navigated moves faster, or gains so much from one sample to the next."""
TWO_TURNS = 4 * np.pi
"""rad: where an angle of a body is more likely one in degrees."""
LARGEST_ERROR = 1.0
"""Largest entry of an error matrix: with more, a gyro feels more across its axis than along it."""
LARGEST_SCALE = 4.0
"""Largest scale error of a unit whose readings were given another nominal scale than they have."""
_NEAR_ONE, _PERHAPS_ONE = 0.2, 0.4
"""Within the first of one, all three diagonal entries are taken for those of I + M; within the
second they may be. A triad that reads double is possible where its nominal scale is another: the
range of a gyro set to twice what one thought, say."""
_WHOLE = (
    "expected the matrix M of measured = (I + M) true, got a diagonal near one: "
    "is it the whole matrix I + M?"
)


class _Usual(NamedTuple):
    most: float
    unit: str
    likely: str


# A bias of 0.1 may be that of a phone in rad/s: only the largest are certain to be in another unit.
_USUAL = {
    # About 0.1 deg/s and 2 mg per root hertz: many times what a phone has.
    "angle_random_walk": _Usual(2e-3, "rad/√s", "deg/√h were meant, np.radians({0:g}) / 60"),
    "velocity_random_walk": _Usual(
        2e-2, "(m/s)/√s", "m/s/√h were meant, {0:g} / 60; of µg/√Hz, {0:g}e-6 * 9.81"
    ),
    "attitude": _Usual(1.0, "rad", "arc minutes were meant, np.radians({0:g} / 60)"),
    "gyro_bias": _Usual(LARGEST_GYRO_BIAS, "rad/s", "deg/h were meant, np.radians({0:g}) / 3600"),
    "accelerometer_bias": _Usual(
        LARGEST_ACCELEROMETER_BIAS, "m/s^2", "mg were meant, {0:g}e-3 * 9.81"
    ),
    # 200 deg/h and 10 mg: many times what a phone has.
    "gyro_bias_instability": _Usual(1e-3, "rad/s", "deg/h were meant, np.radians({0:g}) / 3600"),
    "accelerometer_bias_instability": _Usual(0.1, "m/s^2", "µg were meant, {0:g}e-6 * 9.81"),
    "scale_factor": _Usual(1.0, "parts of the scale", "ppm were meant, {0:g}e-6"),
    "scale_factor_asymmetry": _Usual(0.1, "parts of the scale", "ppm were meant, {0:g}e-6"),
    "installation": _Usual(1.0, "rad", "arc seconds were meant, np.radians({0:g} / 3600)"),
}


class UnusualWarning(UserWarning):
    """An argument is of a size that is possible but seldom meant, as degrees taken for radians.

    The message says what it was taken for. If it was meant, silence it by
    ``warnings.simplefilter("ignore", UnusualWarning)``.
    """


def table_rate(value: object, name: str, most: float = FASTEST_TABLE) -> float:
    """Return the rate of a turntable, rad/s, of either sign and at most `most` in size.

    A rate above one turn per second gives an `UnusualWarning`.
    """
    number = finite_number(value, name)  # type: ignore[arg-type]  # it refuses the rest itself
    if number == 0:
        raise ValueError(f"{name}: expected a rate that is not zero, got 0.")
    if abs(number) > most:
        raise ValueError(
            f"{name}: expected rad/s, at most {most:.4g}, got {number:g}: "
            f"is it in degrees? np.radians({number:g})."
        )
    if abs(number) > USUAL_TABLE:
        warnings.warn(
            f"{name}: {number:g} rad/s is {np.degrees(number):.0f} degrees a second. If degrees "
            f"were meant, np.radians({number:g}).",
            UnusualWarning,
            stacklevel=4,
        )
    return number


def within(
    array: FloatArray, name: str, most: float, unit: str, slip: str, usual: float = np.inf
) -> FloatArray:
    """Return an array whose entries are at most `most` in size.

    `slip` names the likely mistake. An entry above `usual` gives an `UnusualWarning`.
    """
    worst = array.flat[np.abs(array).argmax()]
    if abs(worst) > most:
        raise ValueError(
            f"{name}: expected {unit}, at most {most:.4g} in size, got {worst:g}: {slip}"
        )
    if abs(worst) > usual:
        warnings.warn(f"{name}: {worst:g} {unit} is much: {slip}", UnusualWarning, stacklevel=4)
    return array


def speed_of_body(array: FloatArray, name: str) -> FloatArray:
    """Return velocities or velocity increments, m/s, none of which is faster than light."""
    least, most = float(array.min()), float(array.max())
    if max(-least, most) > LIGHT:
        worst = most if most > -least else least
        raise ValueError(f"{name}: expected m/s, slower than light, got {worst:g}.")
    return array


def pull_of_gravity(array: FloatArray, name: str = "gravity") -> FloatArray:
    """Return magnitudes of gravity, m/s^2, all within `GRAVITY_RANGE`.

    The Earth's gravity in ft/s^2 gives an `UnusualWarning`.
    """
    least, most = GRAVITY_RANGE
    if array.min() < least or array.max() > most:
        worst = array.min() if array.min() < least else array.max()
        likely = ": is it in g?" if abs(worst - 1) < 0.1 else "."
        raise ValueError(f"{name}: expected m/s^2, {least:g} to {most:g}, got {worst:g}{likely}")
    if (feet := np.abs(array * _FOOT - _ON_EARTH) < _LOCAL).any():
        warnings.warn(
            f"{name}: {array[feet].flat[0]:g} m/s^2 is that of the Earth in ft/s^2. If these were "
            "meant, multiply by 0.3048.",
            UnusualWarning,
            stacklevel=4,
        )
    return array


def one_pull(value: object, name: str = "gravity") -> float:
    """Return a single magnitude of gravity, m/s^2, within `GRAVITY_RANGE`."""
    number = finite_number(value, name)  # type: ignore[arg-type]  # it refuses the rest itself
    return float(pull_of_gravity(np.array(number), name))


def increments_of_velocity(velocity: FloatArray, interval: float, name: str) -> FloatArray:
    """Return velocity increments, (..., n, 3) in m/s, each gained over one `interval`, s.

    An acceleration, as the root mean square of a run, outside `GRAVITY_RANGE` gives an
    `UnusualWarning`: under way it is about gravity, and only a body in free fall has none.
    """
    squares = np.vecdot(velocity, velocity).mean(axis=-1)
    least, most = (force * interval for force in GRAVITY_RANGE)
    if not least**2 <= squares.min() <= squares.max() <= most**2:
        worst = squares.max() if squares.max() > most**2 else squares.min()
        warnings.warn(
            f"{name}: {np.sqrt(worst) / interval:.2g} m/s^2 on the average, where gravity alone is "
            f"9.8. Expected m/s, gained over {interval:g} s, not m/s^2, and not an angle.",
            UnusualWarning,
            stacklevel=3,
        )
    return velocity


def turned_angle(array: FloatArray, name: str) -> FloatArray:
    """Return angles, rad; one of more than two turns gives an `UnusualWarning`."""
    if np.abs(array).max() > TWO_TURNS:
        worst = array.flat[np.abs(array).argmax()]
        warnings.warn(
            f"{name}: {worst:g} rad is {abs(worst) / (2 * np.pi):.1f} turns. If degrees were "
            f"meant, np.radians({name}).",
            UnusualWarning,
            stacklevel=4,
        )
    return array


def usual_deviation(value: object, name: str, stacklevel: int = 4) -> float:
    """Return a standard deviation or random walk, in SI units and radians, that is zero or more.

    A value larger than instruments usually have gives an `UnusualWarning`. The limit follows from
    `name`, such as "gyro_bias"; a quantity that is not in `_USUAL` has none.
    """
    number = nonnegative_number(value, name)  # type: ignore[arg-type]  # it refuses the rest itself
    usual = _USUAL.get(name)
    if usual is not None and number > usual.most:
        warnings.warn(
            f"{name}: {number:g} {usual.unit} is more than instruments usually have. "
            f"If {usual.likely.format(number)}.",
            UnusualWarning,
            stacklevel=stacklevel,
        )
    return number


def plausible_error_matrix(
    matrix: FloatArray, name: str, scale: float = LARGEST_ERROR
) -> FloatArray:
    """Return the error matrix M of a triad, refusing the whole matrix I + M.

    A large entry gives an `UnusualWarning`. `scale` is the largest usual diagonal entry; above one
    a triad may well read double, so the whole matrix gives that warning as well.
    """
    if scale <= LARGEST_ERROR and _is_whole(matrix):
        raise ValueError(f"{name}: {_WHOLE} Subtract the identity.")
    if _is_whole(matrix, _PERHAPS_ONE):
        warnings.warn(f"{name}: {_WHOLE} If so, subtract the identity.", UnusualWarning, 3)
    excess = np.abs(matrix) / (LARGEST_ERROR + (scale - LARGEST_ERROR) * np.eye(3))
    if excess.max() > 1:
        warnings.warn(
            f"{name}: an entry is {matrix.flat[excess.argmax()]:g}, and they are rad or parts of "
            "the scale. If mrad, ppm or arc seconds were meant, multiply by 1e-3, 1e-6 or "
            "scipy.constants.arcsecond.",
            UnusualWarning,
            stacklevel=3,
        )
    return matrix


def linear_error_matrix(matrix: FloatArray, name: str) -> FloatArray:
    """Return an error matrix on which the result depends linearly.

    Such a result is right in any unit of the matrix and even for the whole matrix I + M, which
    gives an `UnusualWarning`.
    """
    if _is_whole(matrix):
        warnings.warn(f"{name}: {_WHOLE} If so, subtract the identity.", UnusualWarning, 3)
    return matrix


def _is_whole(matrix: FloatArray, near: float = _NEAR_ONE) -> bool:
    diagonal = np.einsum("...ii->...i", matrix)
    return bool((np.abs(diagonal - 1) <= near).all(axis=-1).any())
