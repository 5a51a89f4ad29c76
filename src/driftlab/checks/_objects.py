"""Objects of a kind, and what is drawn from, called, opened or read."""

from __future__ import annotations

import operator
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from ._words import named_in, shown, with_article

Kind = TypeVar("Kind")


def checked_instance(value: object, kind: type[Kind], name: str, hint: str = "") -> Kind:
    """Return an object if it is of a kind.

    Parameters
    ----------
    value : object
        Anything.
    kind : type
        The class it must be of.
    name : str
        Name of the argument, for the sentence.
    hint : str
        How to get one, behind the kind: "from linearize_along(scheme, latitude)".

    Returns
    -------
    object
        `value` itself.

    Raises
    ------
    ValueError
        If it is of another class.

    Examples
    --------
    >>> checked_instance(3, str, "scheme")
    Traceback (most recent call last):
    ValueError: scheme: expected a str, got 3.
    """
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
    """Let a frozen dataclass hold what the checks of its arguments have returned.

    Without it a record computes in the kind of number that came: in single precision, or in whole
    numbers of eight bits, of which 3 times 100 is 44.

    Parameters
    ----------
    record : object
        In its ``__post_init__``.
    **checked : object
        What is to be held, by the names of its fields.

    Examples
    --------
    >>> from dataclasses import dataclass
    >>> from driftlab.checks import whole_number
    >>> @dataclass(frozen=True)
    ... class Turns:
    ...     count: int
    ...     def __post_init__(self) -> None:
    ...         keep(self, count=whole_number(self.count, "count"))
    >>> Turns(np.int8(3)).count * 100
    300
    """
    for name, value in checked.items():
        object.__setattr__(record, name, value)


def checked_generator(rng: object) -> np.random.Generator:
    """Return the generator that the argument `rng` is, or that a seed makes.

    A seed makes a new generator each time it is checked, so check it once and hand on the result.

    Parameters
    ----------
    rng : object
        Should be a `numpy.random.Generator`, or a seed: a whole number from 0 on, of which
        `numpy.random.default_rng` makes one.

    Returns
    -------
    numpy.random.Generator

    Raises
    ------
    ValueError
        If it is something else, as None: noise that cannot be drawn again is not wanted.

    Examples
    --------
    >>> float(checked_generator(1).uniform()) == float(np.random.default_rng(1).uniform())
    True
    >>> checked_generator(None)
    Traceback (most recent call last):
    ValueError: rng: expected a numpy Generator to draw the noise, or a seed for one, got None.
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
    """Return a function, refusing what cannot be called, and classes.

    Parameters
    ----------
    value : object
        Anything.
    name : str
        Name of the argument, for the sentence.
    of : str
        What it is called with, for the sentence.

    Returns
    -------
    callable
        `value` itself.

    Raises
    ------
    ValueError
        If it is no function.

    Examples
    --------
    >>> checked_function(0.5, "rate", "the time")
    Traceback (most recent call last):
    ValueError: rate: expected a function of the time, got 0.5.
    """
    if not callable(value) or isinstance(value, type):
        raise ValueError(f"{name}: expected a function of {of}, got {shown(value)}.")
    return value


def checked_path(value: object, name: str) -> Path:
    """Return the path of a file, which need not be there.

    Parameters
    ----------
    value : object
        Anything.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    pathlib.Path

    Raises
    ------
    ValueError
        If it is neither text nor a path, or an empty text, which would be this folder.

    Examples
    --------
    >>> checked_path(["a.csv", "b.csv"], "path")
    Traceback (most recent call last):
    ValueError: path: expected a path, got ['a.csv', 'b.csv'].
    """
    path = os.fspath(value) if isinstance(value, str | os.PathLike) else None
    if isinstance(path, str) and path:
        return Path(path)
    raise ValueError(f"{name}: expected a path, got {shown(value)}.")


def checked_text(value: object, name: str) -> str:
    """Return a text, refusing everything else.

    Parameters
    ----------
    value : object
        Anything.
    name : str
        Name of the argument, for the sentence.

    Returns
    -------
    str
        `value` itself.

    Raises
    ------
    ValueError
        If it is no text.

    Examples
    --------
    >>> checked_text(None, "name")
    Traceback (most recent call last):
    ValueError: name: expected text, got None.
    """
    if not isinstance(value, str):
        raise ValueError(f"{name}: expected text, got {shown(value)}.")
    return value
