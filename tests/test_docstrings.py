"""Every public thing of the numerics is explained, and every argument that is listed is listed."""

import inspect
import re
from dataclasses import fields, is_dataclass
from importlib import import_module

import pytest

from test_layers import MODULES, rank

NUMERICS = [
    import_module(f"driftlab.{path.stem}")
    for path in MODULES
    if len(path.parts) == 1 and path.stem != "__init__" and rank(path.stem) == 0
]


def public_objects():
    """Public functions, classes and their public methods and properties, where they are defined."""
    for module in NUMERICS:
        for name, thing in vars(module).items():
            if name.startswith("_") or getattr(thing, "__module__", None) != module.__name__:
                continue
            if not (inspect.isfunction(thing) or inspect.isclass(thing)):
                continue
            yield f"{module.__name__}.{name}", thing
            for key, member in vars(thing).items() if inspect.isclass(thing) else ():
                if not key.startswith("_") and (callable(member) or isinstance(member, property)):
                    yield f"{module.__name__}.{name}.{key}", member


OBJECTS = dict(public_objects())


def section(thing, title):
    """Names that a numpydoc section explains, or None where there is no such section."""
    found = re.search(
        rf"^{title}\n-+\n(.*?)(?=^\w[\w ]*\n-+$|\Z)",
        inspect.getdoc(thing),
        re.DOTALL | re.MULTILINE,
    )
    if found is None:
        return None
    heads = [line.split(" : ")[0] for line in found[1].splitlines() if re.match(r"[\w*]", line)]
    return {name.strip("* ") for head in heads for name in head.split(",")}


@pytest.mark.parametrize("module", NUMERICS, ids=lambda module: module.__name__)
def test_module_has_a_docstring(module):
    assert module.__doc__


@pytest.mark.parametrize("name", OBJECTS)
def test_public_object_is_explained(name):
    thing = OBJECTS[name]
    assert thing.__doc__
    assert not thing.__doc__.startswith(f"{name.split('.')[-1]}(")  # a dataclass's own signature


@pytest.mark.parametrize("name", [name for name in OBJECTS if callable(OBJECTS[name])])
def test_listed_arguments_are_the_arguments(name):
    thing = OBJECTS[name]
    if is_dataclass(thing):
        assert section(thing, "Attributes") == {field.name for field in fields(thing)}
    elif (listed := section(thing, "Parameters")) is not None:
        assert listed == set(inspect.signature(thing).parameters) - {"self", "cls"}
