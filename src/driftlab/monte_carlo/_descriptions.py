"""What a task is, in words that are the same in every process and differ where the task does."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from functools import partial
from hashlib import sha256
from types import BuiltinFunctionType, FunctionType, MethodType
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from driftlab.checks import shown


def describe(value: Any) -> str:
    """Return an exact description of a task or of its parts; any changed bit changes it.

    A task is a function of a module, a method of a dataclass or NamedTuple, or a
    `functools.partial` of these. Its parts are numbers, texts, arrays, which are named by their
    SHA-256, and tuples, lists, sets and mappings of them. Anything else, such as a lambda, is
    refused.
    """
    if isinstance(value, np.ndarray | np.generic):
        return _of_array(np.asarray(value))
    if isinstance(value, Enum):
        return f"{_of_named(type(value))}.{value.name}"
    if value is None or isinstance(value, bool | int | float | complex | str | bytes):
        return repr(value)
    if isinstance(value, Rotation):
        return f"Rotation({_of_array(value.as_quat())})"
    if isinstance(value, partial):
        return f"partial{describe((value.func, value.args, value.keywords))}"
    if isinstance(value, MethodType):
        return f"{describe(value.__self__)}.{value.__name__}"
    if isinstance(value, FunctionType | BuiltinFunctionType | type):
        return _of_named(value)
    return _of_collection(value)


def _of_collection(value: Any) -> str:
    kind = _of_named(type(value))
    if is_dataclass(value):
        told = [f"{each.name}={describe(getattr(value, each.name))}" for each in fields(value)]
        return f"{kind}({', '.join(told)})"
    if isinstance(value, tuple) and hasattr(value, "_fields"):
        told = [f"{name}={describe(getattr(value, name))}" for name in value._fields]
        return f"{kind}({', '.join(told)})"
    if isinstance(value, tuple | list):
        return f"{type(value).__name__}({', '.join(map(describe, value))})"
    if isinstance(value, set | frozenset):
        return f"set({', '.join(sorted(map(describe, value)))})"
    if isinstance(value, Mapping):
        return f"dict({', '.join(f'{describe(k)}: {describe(v)}' for k, v in value.items())})"
    raise ValueError(
        "task: expected, to be kept, a function of a module, a method of a dataclass or a partial "
        f"of these, and numbers, texts and arrays in them, got {shown(value)}."
    )


def _of_array(array: np.ndarray[Any, Any]) -> str:
    if array.dtype.hasobject:
        raise ValueError(
            f"task: expected, to be kept, arrays of numbers in it, got dtype {array.dtype}."
        )
    digest = sha256(np.ascontiguousarray(array).tobytes()).hexdigest()
    return f"array({array.dtype.str}, {array.shape}, {digest})"


def _of_named(thing: Any) -> str:
    """A function or a class by its place, where it can be found again."""
    name = f"{thing.__module__}.{thing.__qualname__}"
    if "<" in name:
        raise ValueError(
            f"task: expected, to be kept, functions and classes of a module, got {name}."
        )
    return name
