"""Names at the doors are explained in numpydoc's form, functions with an example.

All else has a plain sentence at most: checks, cores, private modules and functions.
"""

import doctest
import inspect
from dataclasses import fields, is_dataclass
from importlib import import_module

import pytest
from numpydoc.docscrape import ClassDoc
from numpydoc.validate import validate

from support import helper_modules

MODULES = helper_modules()
SUMMARY = {"GL08", "SS01"}  # there is a docstring, and it has a summary
FUNCTION = {
    *SUMMARY,
    *("PR01", "PR02", "PR03", "PR04"),  # all parameters, no others, in their order, with types
    *("RT01", "EX01"),  # what is returned; an example
}
OPTIONS = doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS


def public_things():
    """Functions, classes and their methods and properties at the doors by dotted name."""
    for module in MODULES:
        for name, thing in vars(module).items():
            if (
                name.startswith(("_", "checked_"))
                or getattr(thing, "__module__", None) != module.__name__
            ):
                continue
            if not (inspect.isfunction(thing) or inspect.isclass(thing)):
                continue
            yield f"{module.__name__}.{name}", thing
            for key, member in vars(thing).items() if inspect.isclass(thing) else ():
                if not key.startswith("_") and (callable(member) or isinstance(member, property)):
                    yield f"{module.__name__}.{name}.{key}", member


THINGS = dict(public_things())


def is_function(thing):
    """Whether it is a function of a module, not a method."""
    return inspect.isfunction(thing) and thing.__qualname__ == thing.__name__


def complaints(name, checks):
    return [f"{code}: {text}" for code, text in validate(name)["errors"] if code in checks]


@pytest.mark.parametrize("name", [n for n, thing in THINGS.items() if is_function(thing)])
def test_function_is_explained_with_an_example(name):
    assert complaints(name, FUNCTION) == []


@pytest.mark.parametrize(
    "name", [n for n, thing in THINGS.items() if not (is_function(thing) or inspect.isclass(thing))]
)
def test_method_or_property_is_explained(name):
    assert complaints(name, SUMMARY) == []


@pytest.mark.parametrize("name", [n for n, thing in THINGS.items() if inspect.isclass(thing)])
def test_class_is_explained_with_all_its_fields(name):
    thing = THINGS[name]
    assert complaints(name, SUMMARY) == []
    assert not thing.__doc__.startswith(f"{thing.__name__}(")  # a dataclass's own signature
    own = fields(thing) if is_dataclass(thing) else getattr(thing, "_fields", ())
    names = {getattr(field, "name", field) for field in own}
    listed = {n.strip() for entry in ClassDoc(thing)["Attributes"] for n in entry.name.split(",")}
    assert names <= listed


@pytest.mark.parametrize("module", MODULES, ids=lambda module: module.__name__)
def test_examples_run(module):
    assert doctest.testmod(import_module(module.__name__), optionflags=OPTIONS).failed == 0
