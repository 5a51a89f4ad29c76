"""The words of a refusal: what came, and what would have been right."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

_LONGEST = 60
"""Signs of a value that are shown as they are."""


def with_article(noun: str) -> str:
    """Return a noun with "a" or "an" before it."""
    return f"{'an' if noun[0] in 'AEIOUaeiou' else 'a'} {noun}"


def shown(value: object) -> str:
    """Say what came, in a few words on one line.

    Parameters
    ----------
    value : object
        Anything.

    Returns
    -------
    str
        Short values as Python writes them, of others the kind and the shape or length.

    Examples
    --------
    >>> for value in (2.5, "averaged", ("NED", "ENU"), np.eye(3), dict, range(3), len):
    ...     print(shown(value))
    2.5
    'averaged'
    ('NED', 'ENU')
    an array of shape (3, 3)
    the class dict
    a range
    the function len
    """
    if isinstance(value, type):
        return f"the class {value.__name__}"
    if isinstance(value, np.ndarray):
        return f"an array of shape {value.shape}"
    kind = type(value)
    plain = isinstance(value, np.generic) or kind in (type(None), bool, float, complex, str, bytes)
    if kind is int or plain or (kind in (tuple, list, dict, set) and _is_short(value)):
        text = str(value) if isinstance(value, np.generic) else _written(value)
        if len(text) <= _LONGEST:
            return text
        return f"{text[: _LONGEST - 3]}..." if plain else with_article(kind.__name__)
    if callable(value) and hasattr(value, "__name__"):
        return f"the function {value.__name__}"
    return with_article(kind.__name__)


def _is_short(values: object) -> bool:
    """Is a container one of a few plain values, whose text is short and on one line?"""
    inside = values.items() if isinstance(values, dict) else values
    assert isinstance(inside, Iterable)
    plain = (type(None), bool, int, float, complex, str, bytes)
    return all(
        type(each) in plain or (type(each) in (tuple, list) and _is_short(each)) for each in inside
    )


def _written(value: object) -> str:
    try:
        return repr(value)
    except ValueError:  # a whole number of more digits than Python writes
        return "." * (_LONGEST + 1)
