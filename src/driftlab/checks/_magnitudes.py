"""Sizes that are hardly meant, and the slip of the unit behind most of them.

What is only unusual, as degrees taken for radians may be, is warned of and let through. Refused is
what the functions behind the door are not for, whatever instrument has it.
"""

from __future__ import annotations

import warnings

import numpy as np

from ._arrays import FloatArray
from ._numbers import finite_number

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


class UnusualWarning(UserWarning):
    """An argument is of a size that is possible but seldom meant, as degrees taken for radians.

    The message says what it was taken for. If it was meant, silence it by
    ``warnings.simplefilter("ignore", UnusualWarning)``.
    """


def table_rate(value: object, name: str, most: float = FASTEST_TABLE) -> float:
    """Return the rate of a turntable, refusing what none has and warning of what few have.

    Parameters
    ----------
    value : float
        Rate, rad/s, of either sign.
    name : str
        Name of the argument, for the sentence.
    most : float
        Largest size allowed, rad/s.

    Returns
    -------
    float
        The rate.

    Raises
    ------
    ValueError
        If it is zero or too large, or as for `finite_number`.

    Warns
    -----
    UnusualWarning
        If it is more than a turn a second.

    Examples
    --------
    >>> table_rate(360.0, "rate")
    Traceback (most recent call last):
    ValueError: rate: expected rad/s, at most 200, got 360: is it in degrees? np.radians(360).
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
    """Return an array whose entries are at most so large, refusing others with the likely slip.

    Parameters
    ----------
    array : ndarray
        Finite numbers.
    name : str
        Name of the argument, for the sentence.
    most : float
        Largest size allowed.
    unit : str
        Of the numbers.
    slip : str
        The question at the end of the sentence.
    usual : float
        Largest size that is let through without a warning.

    Returns
    -------
    ndarray
        `array` itself.

    Raises
    ------
    ValueError
        If an entry is larger.

    Warns
    -----
    UnusualWarning
        If an entry is larger than `usual`.

    Examples
    --------
    >>> within(np.array([90.0]), "pitch", np.pi, "rad", "is it in degrees?")
    Traceback (most recent call last):
    ValueError: pitch: expected rad, at most 3.142 in size, got 90: is it in degrees?
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
    """Return velocities or their increments, refusing those that no body has.

    Parameters
    ----------
    array : ndarray
        Finite numbers, m/s.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    ndarray
        `array` itself.

    Raises
    ------
    ValueError
        If one is faster than light.

    Examples
    --------
    >>> speed_of_body(np.array([0.0, -3e9]), "velocity")
    Traceback (most recent call last):
    ValueError: velocity: expected m/s, slower than light, got -3e+09.
    """
    least, most = float(array.min()), float(array.max())
    if max(-least, most) > LIGHT:
        worst = most if most > -least else least
        raise ValueError(f"{name}: expected m/s, slower than light, got {worst:g}.")
    return array


def pull_of_gravity(array: FloatArray, name: str = "gravity") -> FloatArray:
    """Return gravity itself, refusing what is no planet's, as a number of g.

    Parameters
    ----------
    array : ndarray
        Finite numbers, m/s^2.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    ndarray
        `array` itself.

    Raises
    ------
    ValueError
        If a number is out of `GRAVITY_RANGE`.

    Warns
    -----
    UnusualWarning
        If it is gravity on the Earth in feet.

    Examples
    --------
    >>> pull_of_gravity(np.array([9.81, 1.0]))
    Traceback (most recent call last):
    ValueError: gravity: expected m/s^2, 1.2 to 50, got 1: is it in g?
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
    """Return gravity as a float, refusing everything but one number that a planet has.

    Parameters
    ----------
    value : float
        m/s^2.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    float
        The number.

    Raises
    ------
    ValueError
        As for `pull_of_gravity` and `finite_number`.

    Examples
    --------
    >>> one_pull(1.0)
    Traceback (most recent call last):
    ValueError: gravity: expected m/s^2, 1.2 to 50, got 1: is it in g?
    """
    number = finite_number(value, name)  # type: ignore[arg-type]  # it refuses the rest itself
    return float(pull_of_gravity(np.array(number), name))


def increments_of_velocity(velocity: FloatArray, interval: float, name: str) -> FloatArray:
    """Return increments of velocity, warning if they are not such as gravity alone makes.

    Parameters
    ----------
    velocity : ndarray
        Finite numbers of shape (..., n, 3), m/s.
    interval : float
        Time of each, s.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    ndarray
        `velocity` itself.

    Warns
    -----
    UnusualWarning
        If the root mean square of a run is not an acceleration of 1.2 to 50 m/s^2: at rest it is
        gravity, under way more or less. What falls freely, as a satellite, has none.

    Examples
    --------
    >>> increments_of_velocity(np.array([[0.0, 0.0, 0.0981]]), 0.01, "velocity")
    array([[0.    , 0.    , 0.0981]])
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
    """Return the angles of a body, warning of those that look like degrees.

    Parameters
    ----------
    array : ndarray
        Finite numbers, rad.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    ndarray
        `array` itself.

    Warns
    -----
    UnusualWarning
        If one is more than two turns.

    Examples
    --------
    >>> turned_angle(np.array(0.5), "heading")
    array(0.5)
    """
    if np.abs(array).max() > TWO_TURNS:
        worst = array.flat[np.abs(array).argmax()]
        warnings.warn(
            f"{name}: {worst:g} rad is {abs(worst) / (2 * np.pi):.1f} turns. If degrees were "
            f"meant, np.radians({name}).",
            UnusualWarning,
            stacklevel=4,
        )
    return array
