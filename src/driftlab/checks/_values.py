"""Single values: numbers, names, and objects of a class, functions and paths among them."""

from __future__ import annotations

import operator
import os
from collections.abc import Callable, Collection, Mapping
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import LARGEST_NUMBER, SMALLEST_DIVISOR, finite_array
from ._words import named_in, shown, with_article

Kind = TypeVar("Kind")

_MOST = 2**31 - 1
"""More than anything here is counted to, and less than what overflows in a product of counts."""


def finite_number(value: ArrayLike, name: str) -> float:
    """Return a single finite real number as a float."""
    if type(value) is float and -LARGEST_NUMBER <= value <= LARGEST_NUMBER:
        return value
    number = finite_array(value, name)
    if number.ndim:
        raise ValueError(f"{name}: expected one number, got shape {number.shape}.")
    return float(number)


def positive_number(value: ArrayLike, name: str) -> float:
    """Return a single number, no smaller than `SMALLEST_DIVISOR`, as a float."""
    number = finite_number(value, name)
    if number <= 0:
        raise ValueError(f"{name}: expected a positive number, got {shown(value)}.")
    if number < SMALLEST_DIVISOR:
        raise ValueError(
            f"{name}: expected a number of at least {SMALLEST_DIVISOR:g}, got {shown(value)}."
        )
    return number


def nonnegative_number(value: ArrayLike, name: str) -> float:
    """Return a single number that is zero or more as a float."""
    number = finite_number(value, name)
    if number < 0:
        raise ValueError(f"{name}: expected a number of at least 0, got {shown(value)}.")
    return number


def probability(value: ArrayLike, name: str) -> float:
    """Return a single number between 0 and 1, both excluded, as a float."""
    number = finite_number(value, name)
    if not 0 < number < 1:
        raise ValueError(f"{name}: expected a number between 0 and 1, got {shown(value)}.")
    return number


def whole_number(value: int, name: str, least: int = 1, most: int | None = _MOST) -> int:
    """Return an integer from `least` to `most`; a seed, of any number of digits, has no `most`."""
    number = _whole(value)
    if number is None or number < least:
        raise ValueError(
            f"{name}: expected a whole number of at least {least}, got {shown(value)}."
        )
    if most is not None and number > most:
        raise ValueError(f"{name}: expected a whole number of at most {most}, got {shown(value)}.")
    return number


def chosen_number(value: int, numbers: tuple[int, ...], name: str) -> int:
    """Return an integer that is one of a few known ones."""
    number = _whole(value)
    if number is None or number not in numbers:
        known = " or ".join(map(str, numbers))
        raise ValueError(f"{name}: expected {known}, got {shown(value)}.")
    return number


def row_number(value: int, name: str) -> int:
    """Return the index of a row, counted from the end if negative, as in a slice."""
    number = _whole(value)
    if number is None:
        raise ValueError(
            f"{name}: expected a whole number, the place of a row, got {shown(value)}."
        )
    return number


def truth_value(value: object, name: str) -> bool:
    """Return True or False as a bool; 0, 1 and None are refused."""
    if not isinstance(value, bool | np.bool):
        raise ValueError(f"{name}: expected True or False, got {shown(value)}.")
    return bool(value)


def _whole(value: object) -> int | None:
    """Return an integer as an int, or None for anything else, truth values included."""
    try:
        # NumPy 2.0 takes its own truth values for whole numbers, with a warning.
        return None if isinstance(value, bool | np.bool) else operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        return None


def one_of(value: object, names: Collection[str], name: str) -> str:
    """Return a name if it is one of the known `names`."""
    if not isinstance(value, str) or value not in names:
        raise ValueError(f"{name}: expected one of {', '.join(names)}, got {shown(value)}.")
    return value


def some_of(value: object, names: Collection[str], name: str) -> tuple[str, ...]:
    """Return several known names as a tuple; a single one need not be in a list."""
    given = (value,) if isinstance(value, str) else value
    if not isinstance(given, Collection) or isinstance(given, bytes | np.ndarray):
        raise ValueError(f"{name}: expected some of {', '.join(names)}, got {shown(value)}.")
    for each in given:
        if not isinstance(each, str) or each not in names:
            raise ValueError(f"{name}: expected some of {', '.join(names)}, got {shown(each)}.")
    return tuple(given)


def named_or_own(
    value: object, kind: type[Kind], table: Mapping[str, Kind], name: str, hint: str = ""
) -> Kind:
    """Return an object of a class, or the one that a name stands for in a table.

    Wherever the package has a table of named objects, an argument may be a name in it or the
    reader's own object.
    """
    if isinstance(value, kind):
        return value
    if isinstance(value, str) and value in table:
        return table[value]
    more = f" {hint}" if hint else ""
    raise ValueError(
        f"{name}: expected {with_article(kind.__name__)}{more} or the name of one "
        f"({', '.join(table)}), got {shown(value)}."
    )


def checked_instance(value: object, kind: type[Kind], name: str, hint: str = "") -> Kind:
    """Return an object if it is of class `kind`; `hint` tells how to get one."""
    if not isinstance(value, kind):
        fields = getattr(kind, "_fields", ())  # of a NamedTuple
        wanted = f"({', '.join(fields)})" if fields else ""
        more = f" {hint}" if hint else ""
        raise ValueError(
            f"{name}: expected {with_article(kind.__name__)}{wanted}{more}, got {shown(value)}"
            f"{named_in(value, kind.__name__)}."
        )
    return value


def keep(record: object, **checked: object) -> None:
    """Store the checked values of its fields in a frozen dataclass, from its ``__post_init__``.

    Otherwise a record computes in the type that came in: 3 times 100 is 44 in eight-bit integers.
    """
    for name, value in checked.items():
        object.__setattr__(record, name, value)


def checked_generator(rng: object) -> np.random.Generator:
    """Return `rng` if it is a random generator, or a new generator if it is a seed.

    A seed makes a new generator each time, so check it once and pass the result on.
    """
    if isinstance(rng, np.random.Generator):
        return rng
    try:
        seed = -1 if isinstance(rng, bool | np.bool) else operator.index(rng)  # type: ignore[arg-type]
    except TypeError:
        seed = -1
    if seed < 0:
        raise ValueError(
            "rng: expected a numpy Generator to draw the noise, or a seed for one, "
            f"got {shown(rng)}."
        )
    return np.random.default_rng(seed)


def checked_function(value: object, name: str, of: str) -> Callable[..., Any]:
    """Return a function; `of` says what it is called with. Classes are refused."""
    if not callable(value) or isinstance(value, type):
        raise ValueError(f"{name}: expected a function of {of}, got {shown(value)}.")
    return value


def checked_path(value: object, name: str) -> Path:
    """Return the path of a file, which need not exist; an empty text is refused."""
    path = os.fspath(value) if isinstance(value, str | os.PathLike) else None
    if isinstance(path, str) and path:
        return Path(path)
    raise ValueError(f"{name}: expected a path, got {shown(value)}.")


def checked_text(value: object, name: str) -> str:
    """Return a text."""
    if not isinstance(value, str):
        raise ValueError(f"{name}: expected text, got {shown(value)}.")
    return value
