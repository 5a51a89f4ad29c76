"""The words of a refusal: what came, and what would have been right."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from inspect import isfunction

import numpy as np

_LONGEST = 60
"""Signs of a value that are shown as they are."""


def with_article(noun: str) -> str:
    """Return a noun with "a" or "an" before it."""
    return f"{'an' if noun[0] in 'AEIOUaeiou' else 'a'} {noun}"


def shown(value: object) -> str:
    """Return a short value as Python writes it; for others, their class and shape or name."""
    if isinstance(value, type):
        return f"the class {value.__name__}"
    if isinstance(value, np.ndarray):
        return f"an array of shape {value.shape}"
    kind = type(value)
    plain = isinstance(value, np.generic) or kind in (type(None), bool, float, complex, str, bytes)
    if kind is int or plain or (kind in (tuple, list, dict, set) and _is_short(value)):
        number = isinstance(value, np.generic) and not isinstance(value, str | bytes)
        text = str(value) if number else _written(value)
        if len(text) <= _LONGEST:
            return text
        return f"{text[: _LONGEST - 3]}..." if plain else with_article(kind.__name__)
    if callable(value) and hasattr(value, "__name__"):
        return f"the function {value.__name__}"
    return with_article(kind.__name__)


def named_in(value: object, kind: str) -> str:
    """Name the parts of one of the package's objects that are of class `kind`.

    The result ends a sentence, such as ": hand in its increments()"; it is empty if there is no
    such part. For arrays, `kind` is "FloatArray".
    """
    found = [
        name
        for name, said in _annotations(type(value))
        if not name.startswith("_")
        and kind in str(getattr(said, "__forward_arg__", said)).split(" | ")
    ]
    if not found:
        return ""
    if kind == "FloatArray":
        return f": hand in one of its arrays: {', '.join(found)}"
    return f": hand in its {found[0]}"


def _annotations(kind: type) -> Iterator[tuple[str, object]]:
    """Yield names and types of fields, properties and methods without arguments of our classes."""
    if not kind.__module__.startswith("driftlab"):
        return
    yield from getattr(kind, "__annotations__", {}).items()
    for name, member in vars(kind).items():
        if isinstance(member, property):
            yield name, getattr(member.fget, "__annotations__", {}).get("return")
        elif isfunction(member) and member.__code__.co_argcount == 1:
            yield f"{name}()", member.__annotations__.get("return")


def _is_short(values: object) -> bool:
    """Return whether a container holds only plain values, whose text is short and on one line."""
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
