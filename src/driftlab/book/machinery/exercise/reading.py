"""Answers in any form that stands for numbers, read as arrays; what cannot be read is told.

SymPy takes long to import and is not asked for here: where nobody has imported it, no answer is
of its making.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

Numbers = NDArray[np.float64] | NDArray[np.complex128]


class UnreadableError(ValueError):
    """An answer that cannot be compared: another form, another shape, not finite."""


class SettingError(UnreadableError):
    """A slider panel that is not set as the exercise says."""


def numbers(value: Any) -> Numbers:
    """Return `value`, of any form that stands for finite numbers, as an array.

    UnreadableError is raised for anything else.
    """
    if of_sympy(value, "MatrixBase"):
        value = value.tolist()
    if isinstance(value, Rotation):
        value = value.as_quat()  # scalar last, as in this book
    if any(isinstance(entry, str) for entry in entries(value)):
        raise UnreadableError("Expected numbers without quotation marks, such as 1.5 or [1, 2].")
    try:
        array = np.asarray(value)
    except ValueError:
        raise UnreadableError("Expected numbers, got rows of unequal length.") from None
    if array.dtype == object:
        found = {str(symbol) for entry in array.flat for symbol in symbols(entry)}
        if found:
            raise UnreadableError(f"Expected numbers, found the symbols {', '.join(found)}.")
        try:
            array = np.array([complex(entry) for entry in array.flat]).reshape(array.shape)
        except (TypeError, ValueError):
            raise UnreadableError(f"Expected numbers, got {name(value)}.") from None
    if array.dtype.kind not in "iufc" or array.size == 0:
        raise UnreadableError(f"Expected numbers, got {name(value)}.")
    if not np.isfinite(array).all():
        raise UnreadableError("Expected finite numbers, got NaN or infinity.")
    return array.astype(np.complex128) if np.iscomplex(array).any() else np.real(array) * 1.0


def panel_values(answer: Any) -> Mapping[str, Any] | None:
    """The values of a slider panel, by name; None if the answer is none."""
    values = getattr(answer, "values", None)
    return values if isinstance(values, Mapping) else None


class Slider:
    """What reads one control of a panel; see `slider`."""

    def __init__(self, wanted: str, says: str, needed: Mapping[str, Any]) -> None:
        self.wanted, self.says, self.needed = wanted, says, needed

    def __call__(self, values: Mapping[str, Any]) -> Any:
        if any(values[name] != value for name, value in self.needed.items()):
            raise SettingError(self.says)
        return values[self.wanted]


def slider(wanted: str, says: str, **needed: Any) -> Slider:
    """Return a reader of one control; it `says` so if other controls are not as needed."""
    return Slider(wanted, says, needed)


def read(reading: Callable[..., Any], *arguments: Any) -> Any:
    """Read an answer; whatever goes wrong in it is told, and stops nothing."""
    try:
        return reading(*arguments)
    except UnreadableError:
        raise
    except (Exception, SystemExit) as error:
        words = f"Your answer raised {type(error).__name__}: {error}"
        raise UnreadableError(words) from error


def fit(given: Numbers, right: Numbers) -> Numbers:
    """A row or a column of numbers in the shape of what is right; any other shape is refused."""
    if given.shape != right.shape and given.squeeze().shape == right.shape:
        given = given.squeeze()
    if given.shape != right.shape:
        words = f"Expected {form(right)}, got {form(given)}."
        if right.ndim == 0 and given.shape == (2,) and (given == given.real.round()).all():
            words += " With a decimal point it is {:.0f}.{:.0f}.".format(*given.real)  # 129,6
        raise UnreadableError(words)
    return given


def entries(answer: Any) -> list[Any]:
    """The entries of a matrix, an array or nested lists; of anything else, itself."""
    if isinstance(answer, (list, tuple)):
        return [entry for part in answer for entry in entries(part)]
    if isinstance(answer, np.ndarray) or of_sympy(answer, "MatrixBase"):
        return list(np.array(answer, dtype=object).flat)
    return [answer]


def of_sympy(value: Any, kind: str) -> bool:
    """Tell whether `value` is of a class of SymPy, given by its name."""
    sympy = sys.modules.get("sympy")
    return sympy is not None and isinstance(value, getattr(sympy, kind))


def symbols(entry: Any) -> set[Any]:
    return entry.free_symbols if of_sympy(entry, "Basic") else set()


def form(array: Numbers) -> str:
    if array.ndim == 0:
        return "one number"
    if array.ndim == 1:
        return f"{array.size} {'number' if array.size == 1 else 'numbers'} in a list"
    return f"an array of shape {array.shape}"


def name(value: Any) -> str:
    return f"a {type(value).__name__}"
