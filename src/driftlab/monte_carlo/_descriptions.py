"""What a task is, in words that are the same in every process and differ where the task does."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from functools import cache, partial
from hashlib import sha256
from pathlib import Path
from sysconfig import get_paths
from types import BuiltinFunctionType, FunctionType, MethodType, ModuleType
from typing import Any

import numpy as np
import scipy
from scipy.spatial.transform import Rotation

import driftlab
from driftlab.checks import shown

PACKAGE = Path(driftlab.__file__).parent
LIBRARIES = tuple({Path(get_paths()[kind]) for kind in ("stdlib", "purelib", "platlib")})
"""Where Python's own modules are, and those that are installed."""


def describe(value: Any) -> str:
    """Return an exact description of a task, or of what it is made of.

    Parameters
    ----------
    value : object
        A function of a module, a method of a dataclass or NamedTuple, a `functools.partial` of
        these; and in them numbers, texts, arrays, and tuples, lists, sets and mappings of such.

    Returns
    -------
    str
        Two that differ in any bit of any number have different ones. An array is named by the
        SHA-256 of its bytes.

    Raises
    ------
    ValueError
        If something cannot be described so, as a lambda, or an object that only lives here.

    Examples
    --------
    >>> from driftlab.motion import Coning
    >>> describe(Coning(0.5, 2.0).attitude)
    'driftlab.motion.profiles.Coning(half_angle=0.5, frequency=2.0).attitude'
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


def code_of(task: Any) -> str:
    """Return the SHA-256 of the code that a task runs, as far as it is known.

    That is this package without its book, NumPy and SciPy by their versions, the modules in which
    the functions and classes of the task stand, and those of your own that these import; a function
    of a notebook by its own text. What is installed otherwise, imported within a function, or
    changed in memory is not seen.

    Examples
    --------
    >>> from driftlab.motion import Coning
    >>> len(code_of(Coning(0.5, 2.0).attitude))
    64
    """
    digest = sha256(_package().encode())
    things = list(_named_in(task))
    helpers = _own_modules({thing.__module__ for thing in things})
    for text in sorted({_text(thing) for thing in things} | {_file(name) for name in helpers}):
        digest.update(text)
    return digest.hexdigest()


def _own_modules(names: set[str]) -> set[str]:
    """Modules of the user's, and all that they know of such: themselves, or something in them."""
    found: set[str] = set()
    left = {name for name in names if _is_own(name)}
    while left:
        found.add(name := left.pop())
        known = vars(sys.modules[name]).values()
        places = {
            each.__name__ if isinstance(each, ModuleType) else getattr(each, "__module__", None)
            for each in known
        }
        left |= {each for each in places if isinstance(each, str) and _is_own(each)} - found
    return found


def _is_own(name: str) -> bool:
    """Whether a module was written by the user: in no library, nor in this package."""
    file = getattr(sys.modules.get(name), "__file__", None)
    if not file or name.partition(".")[0] == "driftlab":
        return False
    return not any(Path(file).is_relative_to(library) for library in LIBRARIES)


@cache
def _package() -> str:
    digest = sha256(f"numpy {np.__version__}, scipy {scipy.__version__}".encode())
    for path in sorted(PACKAGE.rglob("*.py")):
        place = path.relative_to(PACKAGE)
        if place.parts[0] != "book":
            digest.update(place.as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()


def _named_in(value: Any) -> Iterator[Any]:
    """The functions and classes in a task."""
    if isinstance(value, partial):
        yield from _named_in((value.func, value.args, value.keywords))
    elif isinstance(value, MethodType):
        yield from _named_in(value.__self__)
    elif isinstance(value, FunctionType | type):
        yield value
    elif is_dataclass(value):
        yield type(value)
        yield from _named_in([getattr(value, each.name) for each in fields(value)])
    elif isinstance(value, Mapping):
        yield from _named_in([*value.keys(), *value.values()])
    elif isinstance(value, tuple | list | set | frozenset):
        if hasattr(value, "_fields"):
            yield type(value)
        for each in value:
            yield from _named_in(each)


def _text(thing: Any) -> bytes:
    """The text of the module of a function or class; of what is no module's, its own."""
    if text := _file(thing.__module__):
        return text
    try:
        return inspect.getsource(thing).encode()
    except (OSError, TypeError):
        return b""  # compiled, or built in


def _file(name: str) -> bytes:
    """The text of a module; empty if it has none, as one in an archive."""
    file = getattr(sys.modules.get(name), "__file__", None)
    if file and Path(file).suffix == ".py" and Path(file).is_file():
        return Path(file).read_bytes()
    return b""
