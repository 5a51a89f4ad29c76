"""Every public door of the numerical modules, with a call of it that is right.

The valid calls are those of the docstrings' examples: an example is run until it calls what it
explains, or a method of its module, and that call is kept. So a new public function is tested as
soon as it has an example, which `test_docstrings` asks for.
"""

import doctest
import inspect
import io
import shutil
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import redirect_stdout
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

from driftlab.imu import NO_ERRORS

# Loops call these with what has been checked; they are public for who builds a filter of his own.
CORES = {
    *("higher_order_effects", "attitude_of_axes", "step_finite_word"),
    *("free_transition", "transition_of_increments", "process_noise"),
}
# What functions return, and nobody makes by hand.
RETURNED = {"HandTurn", "HandTurnFit", "DataProblem"}
# Arrays in the words of other programs, which are looked at when they are converted.
CONVERTED = {"ImuTkMatrices", "KalibrMatrices", "ImucalMatrices", "PsinsMatrices", "RosMatrices"}


class Called(BaseException):
    """An example has come to its point."""


class Door(NamedTuple):
    """A public function, method or class, and a call of it that is right."""

    name: str
    call: Callable[..., Any]
    arguments: dict[str, Any]

    def names(self) -> set[str]:
        """How a sentence may call an argument; `text` is that of several readers of files."""
        also = {"units"} if "text" in self.arguments else set()
        return {*self.arguments, *also, "imu_errors", *NO_ERRORS._fields}


KEPT = TemporaryDirectory()


def kept(value: Any) -> Any:
    """The same, or the path of a copy of a file that ends with its example."""
    if not isinstance(value, Path) or not value.is_file():
        return value
    return shutil.copy(value, KEPT.name)


def first_call(example: doctest.DocTest, owner: Any, key: str) -> tuple[Any, dict[str, Any]] | None:
    """Object and arguments of an example's first call of what it explains, which is not made."""
    original = inspect.getattr_static(owner, key)
    bare = getattr(original, "__func__", original)
    signature, found = inspect.signature(bare), []

    def stop(*args: Any, **kwargs: Any) -> Any:
        if sys._getframe(1).f_code.co_filename != "<slips>":
            return bare(*args, **kwargs)
        bound = signature.bind(*args, **kwargs)
        bound.apply_defaults()
        kinds = {n: parameter.kind for n, parameter in signature.parameters.items()}
        of = inspect.Parameter
        call = {n: v for n, v in bound.arguments.items() if kinds[n] != of.VAR_POSITIONAL}
        for n in [n for n in call if kinds[n] == of.VAR_KEYWORD]:
            call |= call.pop(n)
        found.append({n: kept(v) for n, v in call.items()})
        raise Called

    wrapped = type(original)(stop) if bare is not original else stop
    setattr(owner, key, wrapped)
    example.globs[key] = stop  # of a function; an example does not use this name for else
    try:
        with redirect_stdout(io.StringIO()), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for part in example.examples:
                exec(compile(part.source, "<slips>", "single"), example.globs)
    except (Called, Exception):
        pass
    finally:
        setattr(owner, key, original)
    if not found:
        return None
    arguments = found[0]
    receiver = arguments.pop(next(iter(signature.parameters))) if inspect.isclass(owner) else None
    return receiver, arguments


@cache
def doors(module: Any) -> tuple[Door, ...]:
    """What a module offers, with a call of each; nobody may change their arguments."""
    return tuple(_doors(module))


def _doors(module: Any) -> Iterator[Door]:
    examples = {test.name: test for test in doctest.DocTestFinder().find(module)}
    for name, thing in list(vars(module).items()):
        if (
            name.startswith(("_", "checked_"))
            or getattr(thing, "__module__", "") != module.__name__
        ):
            continue
        example = examples.get(f"{module.__name__}.{name}")
        if inspect.isfunction(thing):
            if called := first_call(example, module, name):
                yield Door(name, thing, called[1])
        elif inspect.isclass(thing) and name not in RETURNED:
            if hasattr(thing, "__dataclass_fields__") and (
                called := first_call(example, thing, "__init__")
            ):
                yield Door(name, converted(thing) if name in CONVERTED else thing, called[1])
            for key, member in list(vars(thing).items()):
                bare = getattr(member, "__func__", member)
                if key.startswith("_") or not inspect.isfunction(bare):
                    continue
                calling = [each for each in examples.values() if f".{key}(" in each.docstring]
                for each in calling:
                    if called := first_call(each, thing, key):
                        yield Door(f"{name}.{key}", getattr(called[0], key), called[1])
                        break


def converted(kind: type) -> Callable[..., Any]:
    def convert(**arguments: Any) -> Any:
        return kind(**arguments).imu_errors

    convert.__signature__ = inspect.signature(kind)  # type: ignore[attr-defined]
    return convert
