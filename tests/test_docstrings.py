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


def test_functions_are_explained_with_an_example_and_all_else_in_a_sentence():
    found = {n: complaints(n, FUNCTION if is_function(t) else SUMMARY) for n, t in THINGS.items()}
    assert {name: said for name, said in found.items() if said} == {}
    assert len(found) > 250


def test_classes_are_explained_with_all_their_fields():
    for name, thing in THINGS.items():
        if not inspect.isclass(thing):
            continue
        assert not thing.__doc__.startswith(f"{thing.__name__}("), name  # a dataclass's signature
        own = fields(thing) if is_dataclass(thing) else getattr(thing, "_fields", ())
        names = {getattr(field, "name", field) for field in own}
        entries = ClassDoc(thing)["Attributes"]
        assert names <= {n.strip() for entry in entries for n in entry.name.split(",")}, name


@pytest.mark.parametrize("module", MODULES, ids=lambda module: module.__name__)
def test_examples_run(module):
    assert doctest.testmod(import_module(module.__name__), optionflags=OPTIONS).failed == 0
