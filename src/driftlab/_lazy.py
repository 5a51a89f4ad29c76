"""Names that a package offers, each imported when it is first asked for.

``import driftlab`` must be instant, so a package says in a stub beside it, its ``__init__.pyi``,
where each name comes from. Type checkers read the stub as it is; this module reads it for Python.
It is what the package lazy_loader does (SPEC 1 of Scientific Python), without the dependency.
"""

from __future__ import annotations

import ast
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any


def attach(
    package: str, file: str
) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """Return ``__getattr__``, ``__dir__`` and ``__all__`` of a package (PEP 562).

    Parameters
    ----------
    package : str
        Its ``__name__``.
    file : str
        Its ``__file__``; the stub lies beside it.
    """
    stub = ast.parse(Path(file).with_suffix(".pyi").read_text(encoding="utf-8"))
    homes = {
        alias.asname or alias.name: (node.module, alias.name)
        for node in stub.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }

    def load(name: str) -> Any:
        if name not in homes:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        module, attribute = homes[name]
        if module is None:  # "from . import name": a module of the package
            return import_module(f"{package}.{attribute}")
        return getattr(import_module(f"{package}.{module}"), attribute)

    return load, lambda: sorted(homes), sorted(homes)
