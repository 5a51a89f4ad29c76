"""Names of objects: one of a table, some of them, or an object of the reader's own."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import TypeVar

import numpy as np

from ._words import shown, with_article

Kind = TypeVar("Kind")


def one_of(value: object, names: Collection[str], name: str) -> str:
    """Return a name if it is one of those that are known.

    Parameters
    ----------
    value : object
        Anything.
    names : collection of str
        The names: a tuple, or a table of what they stand for.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    str
        `value` itself.

    Raises
    ------
    ValueError
        If it is no text, or another.

    Examples
    --------
    >>> one_of("avaraged", ("averaged", "upper triangle"), "frame")
    Traceback (most recent call last):
    ValueError: frame: expected one of averaged, upper triangle, got 'avaraged'.
    """
    if not isinstance(value, str) or value not in names:
        raise ValueError(f"{name}: expected one of {', '.join(names)}, got {shown(value)}.")
    return value


def some_of(value: object, names: Collection[str], name: str) -> tuple[str, ...]:
    """Return several names if all are known; a single one need not be in a list.

    Parameters
    ----------
    value : object
        Anything.
    names : collection of str
        The names: a tuple, or a table of what they stand for.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    tuple of str
        In the order given.

    Raises
    ------
    ValueError
        If there is something else among them.

    Examples
    --------
    >>> some_of("gap", ("gap", "rate"), "allow")
    ('gap',)
    >>> some_of(["gap", 3], ("gap", "rate"), "allow")
    Traceback (most recent call last):
    ValueError: allow: expected some of gap, rate, got 3.
    """
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
    """Return an object, or the one that a name stands for.

    The rule of the house: where there is a table of objects with names, an argument is one of
    these names or an object of the reader's own.

    Parameters
    ----------
    value : object
        Anything.
    kind : type
        The class it must be of, if it is no name.
    table : mapping of str to object
        What the names stand for.
    name : str
        Name of the argument, for the sentence.
    hint : str
        How to make one of one's own, for the sentence.

    Returns
    -------
    object
        `value` itself, or what it names.

    Raises
    ------
    ValueError
        If it is neither a name in the table nor of the class.

    Examples
    --------
    >>> named_or_own("two", int, {"one": 1, "two": 2}, "count")
    2
    >>> named_or_own("six", int, {"one": 1, "two": 2}, "count")
    Traceback (most recent call last):
    ValueError: count: expected an int or the name of one (one, two), got 'six'.
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
