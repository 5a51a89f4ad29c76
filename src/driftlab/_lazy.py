"""Names that a package offers, each imported when it is first asked for.

``import driftlab`` must be instant, so a package says in a stub beside it, its ``__init__.pyi``,
where each name comes from. Type checkers read the stub as it is; this module reads it for Python.
It is what the package lazy_loader does (SPEC 1 of Scientific Python), without the dependency.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any


def attach(
    package: str, file: str
) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """Return ``__getattr__``, ``__dir__`` and ``__all__`` of a package with a stub (PEP 562)."""
    stub = ast.parse(Path(file).with_suffix(".pyi").read_text(encoding="utf-8"))
    homes = {
        alias.asname or alias.name: (node.module, alias.name)
        for node in stub.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }

    def load(name: str) -> Any:
        if name not in homes:
            deeper = "" if name.startswith("_") else _deeper(name, package, file, homes)
            raise AttributeError(f"module {package!r} has no attribute {name!r}{deeper}")
        module, attribute = homes[name]
        if module is None:  # "from . import name": a module of the package
            return import_module(f"{package}.{attribute}")
        return getattr(import_module(f"{package}.{module}"), attribute)

    return load, lambda: sorted(homes), sorted(homes)


def _deeper(name: str, package: str, file: str, homes: dict[str, tuple[str | None, str]]) -> str:
    """Where a name is that one of the package's own packages or modules offers, for a sentence."""
    offered = rf"^(?:def |class ){name}\b|^{name}\b.* =|\b{name} as {name}\b|^    \"{name}\",$"
    for home in (each for each, (module, _) in homes.items() if module is None):
        path = Path(file).parent / home
        places = path.with_suffix(".py"), path / "__init__.pyi", path / "__init__.py"
        text = next(place for place in places if place.exists()).read_text(encoding="utf-8")
        if re.search(offered, text, re.MULTILINE):
            return f"; did you mean {package}.{home}.{name}?"
    return ""
