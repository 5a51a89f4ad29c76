"""Parameters of a figure as Python writes them, and the imports that such a line needs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from importlib import import_module
from inspect import isfunction
from typing import Any

import numpy as np


def written(value: Any) -> str:
    """Return a value as Python writes it, on one line; arrays as lists, functions by name.

    After `imports` the line has the value again, but for a function without a name.
    """
    value = _plain(value)
    if isinstance(value, float) and not np.isfinite(value):
        return f"float('{value}')"
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{written(k)}: {written(v)}" for k, v in value.items()) + "}"
    if isfunction(value) or isinstance(value, type):
        return value.__name__
    if names := _fields(value):
        inner = ", ".join(f"{name}={written(getattr(value, name))}" for name in names)
        return f"{type(value).__name__}({inner})"
    if isinstance(value, list | tuple):
        inner = ", ".join(map(written, value))
        return f"[{inner}]" if isinstance(value, list) else f"({inner}{',' * (len(value) == 1)})"
    return repr(value) if isinstance(value, str) else " ".join(repr(value).split())


def imports(values: Mapping[str, Any]) -> list[str]:
    """Return the imports that the values need as they are written, one line a module."""
    found: dict[str, set[str]] = {}
    for value in values.values():
        for each in _named(value):
            if module := _door(each):
                found.setdefault(module, set()).add(each.__name__)
    return [f"from {module} import {', '.join(sorted(found[module]))}" for module in sorted(found)]


def _plain(value: Any) -> Any:
    return value.tolist() if isinstance(value, np.ndarray | np.generic) else value


def _fields(value: Any) -> list[str]:
    """Names of what a tuple with names or a dataclass is made with; none for anything else."""
    if isinstance(value, type):
        return []
    if isinstance(value, tuple):
        return list(getattr(value, "_fields", ()))
    return [each.name for each in fields(value) if each.init] if is_dataclass(value) else []


def _named(value: Any) -> Iterator[Any]:
    """Types and functions that stand in a value by their names."""
    value = _plain(value)
    if isfunction(value) or isinstance(value, type):
        yield value
    elif isinstance(value, Mapping):
        for pair in value.items():
            yield from _named(pair)
    elif names := _fields(value):
        yield type(value)
        for name in names:
            yield from _named(getattr(value, name))
    elif isinstance(value, list | tuple):
        for each in value:
            yield from _named(each)
    else:
        yield type(value)


def _door(named: Any) -> str:
    """The nearest package from which a reader gets it; empty if it is at hand, or of a page."""
    parts = named.__module__.split(".")
    if parts[0] in ("builtins", "__main__") or "<" in named.__qualname__:
        return ""
    for n in range(1, len(parts) + 1):
        module = ".".join(parts[:n])
        if getattr(import_module(module), named.__name__, None) is named:
            return module
    return ""
