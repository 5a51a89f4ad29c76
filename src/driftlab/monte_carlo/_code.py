"""Which code a task runs: a digest that is another one where the code is."""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from functools import cache, partial
from hashlib import sha256
from importlib.machinery import PathFinder
from importlib.util import resolve_name
from pathlib import Path
from sysconfig import get_paths
from threading import Lock
from types import CodeType, FunctionType, MethodType, ModuleType
from typing import Any

import numpy as np
import scipy

import driftlab

from ._descriptions import describe

PACKAGE = Path(driftlab.__file__).parent
STANDARD_LIBRARY = Path(get_paths()["stdlib"])
INSTALLED = {"site-packages", "dist-packages"}
"""Names of the folders of what is installed."""
_PARSING = Lock()
"""CPython 3.11 may raise a SystemError on its recursion depth when two threads parse at once."""


def code_of(task: Any) -> str:
    """Return the SHA-256 of the code that a task runs, as far as it is known.

    It covers this package without its book; NumPy and SciPy by their versions; and your own
    modules that define the functions and classes of the task, with all that they import. Code
    in no file, as in a notebook, counts by its byte code and the values that it names. Other
    installed packages and changes in memory are not seen.
    """
    found: dict[str, bytes] = {}
    for thing in _named_in(task):
        _add_thing(thing, found)
    digest = sha256(_package().encode())
    for name, text in sorted(found.items()):
        digest.update(f"{name}\0{len(text)}\0".encode() + text)
    return digest.hexdigest()


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


def names_of_no_file(task: Any) -> list[str]:
    """What in a task was typed into a notebook or a prompt, where no other process finds it."""
    in_file = "__file__" in vars(sys.modules["__main__"])
    return [
        each.__qualname__
        for each in _named_in(task)
        if each.__module__ == "__main__" and not in_file
    ]


def _add_thing(thing: Any, found: dict[str, bytes]) -> None:
    """Add the module of a function or class and what that imports; or itself, if it has no file."""
    module = sys.modules.get(thing.__module__)
    place = vars(module).get("__file__") if module else None
    if place and (Path(place).is_file() or _is_known(Path(place))):
        _add_module(thing.__module__, found)
        return
    # It was typed into a notebook or a prompt, or its module came out of an archive.
    name = f"{thing.__module__}.{thing.__qualname__}"
    if name in found:
        return
    found[name] = b""
    functions = [thing] if isinstance(thing, FunctionType) else list(_functions_of(thing))
    for function in functions:
        found[name] += _bytes_of(function.__code__)
        values = [function.__defaults__, function.__kwdefaults__]
        for each in sorted(_names_in(function.__code__) & function.__globals__.keys()):
            value = function.__globals__[each]
            if isinstance(value, ModuleType):
                _add_module(value.__name__, found)
            elif isinstance(value, FunctionType | type):
                _add_thing(value, found)
            else:
                values.append((each, value))
        for value in values:
            found[name] += _described(value)


def _functions_of(cls: type) -> Iterator[FunctionType]:
    for value in vars(cls).values():
        inner = getattr(value, "fget", None) or getattr(value, "__func__", value)
        if isinstance(inner, FunctionType):
            yield inner


def _bytes_of(code: CodeType) -> bytes:
    """What a function does, without where it was written."""
    told = [code.co_code, repr((code.co_names, code.co_varnames)).encode()]
    for constant in code.co_consts:
        told.append(_bytes_of(constant) if isinstance(constant, CodeType) else _described(constant))
    return b"\0".join(told)


def _names_in(code: CodeType) -> set[str]:
    inner = (each for each in code.co_consts if isinstance(each, CodeType))
    return set(code.co_names).union(*map(_names_in, inner))


def _described(value: Any) -> bytes:
    try:
        return describe(value).encode()
    except ValueError:
        return type(value).__qualname__.encode()


def _add_module(name: str, found: dict[str, bytes]) -> None:
    """Add a module of the user's, its packages, and all of the user's that it imports."""
    left = _with_packages(name)
    while left:
        name = left.pop()
        file = None if name in found else _own_file(name)
        if file is None:
            continue
        found[name] = file.read_bytes()
        package = name if file.name == "__init__.py" else name.rpartition(".")[0]
        if name == "__main__":
            package = vars(sys.modules[name]).get("__package__") or ""
        for imported in _imported_in(found[name], package):
            left |= _with_packages(imported)


def _with_packages(name: str) -> set[str]:
    parts = name.split(".")
    return {".".join(parts[:count]) for count in range(1, len(parts) + 1)}


def _own_file(name: str) -> Path | None:
    """The file of a module that is the user's: of no library, nor of this package."""
    module = sys.modules.get(name)
    place = vars(module).get("__file__") if module else _unloaded(name)
    file = Path(place) if isinstance(place, str) else None
    if file is None or file.suffix != ".py" or not file.is_file():
        return None
    return None if _is_known(file) else file


def _is_known(file: Path) -> bool:
    """Whether a file belongs to Python, to a package that is installed, or to this one."""
    below = file.is_relative_to(STANDARD_LIBRARY) or file.is_relative_to(PACKAGE)
    return below or not INSTALLED.isdisjoint(file.parts)


def _unloaded(name: str) -> str | None:
    """Where a module would be found, without importing it or its packages."""
    spec, path = None, None
    for each in sorted(_with_packages(name), key=len):
        spec = PathFinder.find_spec(each, path)
        if spec is None:
            return None
        path = spec.submodule_search_locations
    return spec.origin if spec else None


def _imported_in(text: bytes, package: str) -> Iterator[str]:
    """Names of all that a text imports; of `from a import b` both a and a.b, which may be one."""
    with _PARSING:
        tree = ast.parse(text)
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (each.name for each in node.names)
        elif isinstance(node, ast.ImportFrom):
            try:
                base = resolve_name("." * node.level + (node.module or ""), package)
            except ImportError:  # beyond the topmost package: it is not run
                continue
            yield base
            yield from (f"{base}.{each.name}" for each in node.names if each.name != "*")
