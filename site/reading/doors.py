"""What the package offers, module by module, and the name under which each thing is documented.

A thing is documented where a reader imports it: at the door of its subject. The module that it
comes from and every other door lead there.
"""

from __future__ import annotations

import ast
import inspect
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

import driftlab
from driftlab.__main__ import GROUND_FLOOR, SUBJECTS, first_line, public_names
from driftlab.book.ledger import ledger_entries

FOLDER = Path(driftlab.__file__).parent
DOORS = ("driftlab", *(f"driftlab.{subject}" for subject in SUBJECTS))
BOOK = "driftlab.book"


class Name(NamedTuple):
    """A public thing."""

    documented: str  # the dotted name to import it by
    home: str  # the one that says where its code stands
    kind: str  # "function", "class" or "data", as Sphinx has them


class Module(NamedTuple):
    """A module with a page of its own."""

    name: str  # dotted
    summary: str  # first line of its docstring
    names: tuple[Name, ...]  # what it offers, in its own order


def thing(name: str) -> Any:
    """Return what a dotted name means."""
    module, _, attribute = name.rpartition(".")
    return getattr(import_module(module), attribute) if module else import_module(name)


def home(name: str) -> str:
    """Return the dotted name of a thing in the module that defines it, from any name of it."""
    found = thing(name)
    if inspect.isclass(found) or _is_function(found):
        return f"{found.__module__}.{found.__qualname__}"
    module, _, attribute = name.rpartition(".")
    place = imports(module).get(attribute, "")
    return home(place) if place.startswith("driftlab.") else name


@cache
def imports(module: str) -> dict[str, str]:
    """Return where a module or a door has each name from that it hands on."""
    path = _path(module)
    stub = path.with_suffix(".pyi")
    tree = ast.parse((stub if stub.exists() else path).read_text("utf-8"))
    package = module if path.name == "__init__.py" else module.rpartition(".")[0]
    return {
        alias.asname or alias.name: f"{package}.{node.module}.{alias.name}".removeprefix(
            "" if node.level else f"{package}."
        )
        for node in tree.body
        if isinstance(node, ast.ImportFrom) and node.module and node.level < 2
        for alias in node.names
    }


@cache
def modules(subject: str) -> tuple[Module, ...]:
    """Return the public modules of a subject, or of the ground floor if it is ""."""
    if subject == "":
        found = [f"driftlab.{name}" for name in GROUND_FLOOR]
    else:
        paths = sorted((FOLDER / subject).glob("[!_]*.py"))
        found = [f"driftlab.{subject}.{path.stem}" for path in paths]
    return tuple(_module(name) for name in found)


def _module(name: str) -> Module:
    tree = ast.parse(_path(name).read_text("utf-8"))
    package = name.rpartition(".")[0]
    door = import_module(package)
    at_the_door = [key for key, place in imports(package).items() if place == f"{name}.{key}"]
    offered = dict.fromkeys([*public_names(tree), *at_the_door])
    names = []
    for key in offered:
        place = home(f"{name}.{key}")
        # What it only hands on is explained where it comes from, but for what is inside.
        if place == f"{name}.{key}" or _is_inside(place):
            shown = package != "driftlab" and key in getattr(door, "__all__", ())
            names.append(Name(f"{package if shown else name}.{key}", place, kind(place)))
    return Module(name, first_line(tree), tuple(names))


def kind(name: str) -> str:
    """Return what Sphinx calls a thing."""
    found = thing(name)
    if inspect.isclass(found):
        return "class"
    return "function" if _is_function(found) else "data"


def _is_function(found: Any) -> bool:
    """Whether something is a function, kept results or not; a type by another name is none."""
    return inspect.isfunction(inspect.unwrap(found)) if callable(found) else False


@cache
def book() -> tuple[Name, ...]:
    """Return what the book offers at its door, and whatever else the ledger names of it."""
    homes = {home(f"{BOOK}.{key}"): f"{BOOK}.{key}" for key in imports(BOOK)}
    computed = {home(name) for entry in ledger_entries() for name in entry.functions}
    homes |= {
        place: place
        for place in sorted(computed)
        if place.startswith(f"{BOOK}.") and place not in homes
    }
    return tuple(Name(shown, place, kind(place)) for place, shown in homes.items())


@cache
def names() -> tuple[Name, ...]:
    """Return everything that has an entry in the reference."""
    floors = ["", *(subject for subject in SUBJECTS if subject != "book")]
    return (
        *(name for floor in floors for module in modules(floor) for name in module.names),
        *book(),
    )


def first_door() -> tuple[Name, ...]:
    """Return what ``import driftlab`` has at once, but for modules, in the order of its door."""
    of = {name.home: name for name in names()}
    found = (f"driftlab.{key}" for key in imports("driftlab"))
    return tuple(of[home(name)] for name in found if not inspect.ismodule(thing(name)))


@cache
def documented() -> dict[str, str]:
    """Return the documented name of each home."""
    return {name.home: name.documented for name in names()}


@cache
def aliases() -> dict[str, str]:
    """Return every other public name of what is documented, with the documented one."""
    of = documented()
    others = dict(of)
    for door in DOORS:
        for key in import_module(door).__all__:
            name = f"{door}.{key}"
            if not inspect.ismodule(thing(name)):
                others[name] = of[home(name)]
    ledger = {name for entry in ledger_entries() for name in entry.functions}
    others |= {name: of[home(name)] for name in ledger}
    return {name: shown for name, shown in others.items() if name != shown}


def _is_inside(name: str) -> bool:
    """Whether a name is in a core or in a private module, to which no page leads."""
    return name.startswith("driftlab.core.") or "._" in name


def _path(module: str) -> Path:
    path = FOLDER.parent.joinpath(*module.split("."))
    return path / "__init__.py" if path.is_dir() else path.with_suffix(".py")
