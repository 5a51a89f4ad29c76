"""Single numbers: finite, positive, whole, true or false."""

from __future__ import annotations

import operator

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import LARGEST_NUMBER, SMALLEST_DIVISOR, finite_array
from ._words import shown

_MOST = 2**31 - 1
"""More than anything here is counted to, and less than what overflows in a product of counts."""


def finite_number(value: ArrayLike, name: str) -> float:
    """Return a value as a float, refusing everything but one finite real number.

    Parameters
    ----------
    value : array_like, shape ()
        The number.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    float
        The number.

    Raises
    ------
    ValueError
        If `value` has axes, or as for `finite_array`.

    Examples
    --------
    >>> finite_number(np.array(2), "interval")
    2.0
    """
    if type(value) is float and -LARGEST_NUMBER <= value <= LARGEST_NUMBER:
        return value
    number = finite_array(value, name)
    if number.ndim:
        raise ValueError(f"{name}: expected one number, got shape {number.shape}.")
    return float(number)


def positive_number(value: ArrayLike, name: str) -> float:
    """Return a value as a float, refusing everything but one finite number above zero.

    Parameters
    ----------
    value : array_like, shape ()
        The number.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    float
        The number.

    Raises
    ------
    ValueError
        If `value` is not above zero, is less than `SMALLEST_DIVISOR`, or as for `finite_number`.

    Examples
    --------
    >>> positive_number(-1, "interval")
    Traceback (most recent call last):
        ...
    ValueError: interval: expected a positive number, got -1.
    """
    number = finite_number(value, name)
    if number <= 0:
        raise ValueError(f"{name}: expected a positive number, got {shown(value)}.")
    if number < SMALLEST_DIVISOR:
        raise ValueError(
            f"{name}: expected a number of at least {SMALLEST_DIVISOR:g}, got {shown(value)}."
        )
    return number


def nonnegative_number(value: ArrayLike, name: str) -> float:
    """Return a value as a float, refusing everything but one finite number of at least zero.

    Parameters
    ----------
    value : array_like, shape ()
        The number.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    float
        The number.

    Raises
    ------
    ValueError
        If `value` is below zero, or as for `finite_number`.

    Examples
    --------
    >>> nonnegative_number(-1, "damping")
    Traceback (most recent call last):
        ...
    ValueError: damping: expected a number of at least 0, got -1.
    """
    number = finite_number(value, name)
    if number < 0:
        raise ValueError(f"{name}: expected a number of at least 0, got {shown(value)}.")
    return number


def probability(value: ArrayLike, name: str) -> float:
    """Return a value as a float, refusing everything but one number between 0 and 1.

    Parameters
    ----------
    value : array_like, shape ()
        The number.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    float
        The number.

    Raises
    ------
    ValueError
        If `value` is 0 or less, 1 or more, or as for `finite_number`.

    Examples
    --------
    >>> probability(95, "confidence")
    Traceback (most recent call last):
        ...
    ValueError: confidence: expected a number between 0 and 1, got 95.
    """
    number = finite_number(value, name)
    if not 0 < number < 1:
        raise ValueError(f"{name}: expected a number between 0 and 1, got {shown(value)}.")
    return number


def whole_number(value: int, name: str, least: int = 1, most: int | None = _MOST) -> int:
    """Return a value as an int, refusing everything but a whole number that is large enough.

    Parameters
    ----------
    value : int
        The number; a truth value is refused.
    name : str
        Name of the argument, for the sentence.
    least : int
        Smallest number allowed.
    most : int or None
        Largest number allowed; None for a seed, which may have any number of digits.

    Returns
    -------
    int
        The number.

    Raises
    ------
    ValueError
        If `value` is not a whole number, is less than `least` or more than `most`.

    Examples
    --------
    >>> whole_number(np.int64(3), "turns")
    3
    >>> whole_number(2.5, "turns")
    Traceback (most recent call last):
        ...
    ValueError: turns: expected a whole number of at least 1, got 2.5.
    """
    number = _whole(value)
    if number is None or number < least:
        raise ValueError(
            f"{name}: expected a whole number of at least {least}, got {shown(value)}."
        )
    if most is not None and number > most:
        raise ValueError(f"{name}: expected a whole number of at most {most}, got {shown(value)}.")
    return number


def chosen_number(value: int, numbers: tuple[int, ...], name: str) -> int:
    """Return a value as an int, refusing everything but one of a few whole numbers.

    Parameters
    ----------
    value : int
        The number; a truth value is refused.
    numbers : tuple of int
        Those that are known.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    int
        The number.

    Raises
    ------
    ValueError
        If `value` is anything else.

    Examples
    --------
    >>> chosen_number(np.int8(4), (3, 4), "dimension")
    4
    >>> chosen_number(5, (3, 4), "dimension")
    Traceback (most recent call last):
        ...
    ValueError: dimension: expected 3 or 4, got 5.
    """
    number = _whole(value)
    if number is None or number not in numbers:
        known = " or ".join(map(str, numbers))
        raise ValueError(f"{name}: expected {known}, got {shown(value)}.")
    return number


def row_number(value: int, name: str) -> int:
    """Return the place of a row as an int, counted from the end if negative, as in a slice.

    Parameters
    ----------
    value : int
        The place; a truth value is refused.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    int
        The place.

    Raises
    ------
    ValueError
        If `value` is not a whole number.

    Examples
    --------
    >>> row_number(2.5, "begin")
    Traceback (most recent call last):
        ...
    ValueError: begin: expected a whole number, the place of a row, got 2.5.
    """
    number = _whole(value)
    if number is None:
        raise ValueError(
            f"{name}: expected a whole number, the place of a row, got {shown(value)}."
        )
    return number


def truth_value(value: object, name: str) -> bool:
    """Return a value as a bool, refusing everything but True and False.

    Parameters
    ----------
    value : bool
        The value; 0, 1, None and words are refused.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    bool
        The value.

    Raises
    ------
    ValueError
        If `value` is anything else.

    Examples
    --------
    >>> truth_value("no", "exact")
    Traceback (most recent call last):
        ...
    ValueError: exact: expected True or False, got 'no'.
    """
    if not isinstance(value, bool | np.bool):
        raise ValueError(f"{name}: expected True or False, got {shown(value)}.")
    return bool(value)


def _whole(value: object) -> int | None:
    """A whole number as an int, and nothing for what is none, of which truth values are."""
    try:
        # NumPy 2.0 takes its own truth values for whole numbers, with a warning.
        return None if isinstance(value, bool | np.bool) else operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        return None
