"""Changes of right calls: the same numbers in another form, what is no number, other numbers.

A slot is an array or a number that a call is given, as an argument or as a field of a record among
them: ``"start.latitude"``.
"""

import inspect
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np

from doors import Door
from driftlab.checks import LARGEST_NUMBER
from support import replaced

# Places of rows, which no fraction can be.
WHOLE = {"static_intervals"}
# Records that a user fills; others come from the package, and are taken as they are.
MADE_BY_HAND = {"Gains", "ImuErrors", "Increments", "LevelFrame", "Navigation"}


class Slot(NamedTuple):
    """Where a call is given numbers, and those that are right."""

    door: Door
    name: str
    kind: str
    """What may stand there: "array", "number", "count", or "rows" of whole numbers."""
    value: Any

    def arguments(self, value: Any) -> dict[str, Any]:
        """Arguments of the call with other numbers in this slot."""
        return replaced(self.door.arguments, {self.name: value})


class Change(NamedTuple):
    """A call with other numbers in one slot."""

    slot: Slot
    what: str
    given: Any

    def arguments(self) -> dict[str, Any]:
        return self.slot.arguments(self.given)

    def __str__(self) -> str:
        return f"{self.slot.door.name}, {self.slot.name} {self.what}"


class Foreign:
    """An array of another library, which NumPy can ask for one of its own."""

    def __init__(self, value: np.ndarray) -> None:
        self.value = value

    def __array__(self, dtype: Any = None, copy: Any = None) -> np.ndarray:
        return self.value if dtype is None else self.value.astype(dtype)


def slots(door: Door) -> list[Slot]:
    """All slots of a right call."""
    parameters = inspect.signature(door.call).parameters
    found = []
    for name, value in door.arguments.items():
        if name not in parameters:  # a field of a record that is a door of its own
            continue
        said = str(parameters[name].annotation)
        if hasattr(value, "_fields") and type(value).__name__ not in MADE_BY_HAND:
            continue
        if hasattr(value, "_fields"):
            fields = zip(value._fields, value, strict=True)
            found += [(f"{name}.{field}", "ArrayLike", each) for field, each in fields]
        elif "FloatArray" not in said or door.name == "Recording":  # else it is checked already
            found.append((name, said, value))
    kinds = ((name, _kind(name, said, value), value) for name, said, value in found)
    return [Slot(door, name, kind, value) for name, kind, value in kinds if kind]


def _kind(name: str, said: str, value: Any) -> str:
    if isinstance(value, bool | np.bool | str | type(None)):
        return ""
    parts = {part.strip() for part in said.split("|")}
    if parts & {"int", "np.random.Generator"} and isinstance(value, int | np.integer):
        return "count"
    if "float" in parts and np.ndim(value) == 0 and isinstance(value, int | float | np.number):
        return "number"
    if not isinstance(value, int | float | np.number | np.ndarray | list | tuple):
        return ""
    try:
        array = np.asarray(value)
    except ValueError:
        return ""
    if array.size == 0 or array.dtype.kind not in "fiu":
        return ""
    if not any(
        word in said for word in ("ArrayLike", "FloatArray", "tuple[float", "Sequence[float")
    ):
        return ""
    return "rows" if array.dtype.kind in "iu" and name in WHOLE else "array"


def doubles(slot: Slot) -> Any:
    """The right numbers of a slot as NumPy's own, in double; of counts as Python's."""
    if slot.kind == "count":
        return int(slot.value)
    if slot.kind == "number":
        return float(slot.value)
    return np.array(slot.value, None if slot.kind == "rows" else float)


# The same numbers

LAYOUTS: dict[str, Callable[[np.ndarray], Any]] = {
    "read-only": lambda a: _read_only(a.copy()),
    "every second": lambda a: np.repeat(a, 2, axis=-1)[..., ::2] if a.ndim else a,
    "backwards in memory": lambda a: a[..., ::-1].copy()[..., ::-1] if a.ndim else a,
    "in Fortran's order": lambda a: a.copy(order="F"),
    "big-endian": lambda a: a.astype(a.dtype.newbyteorder(">")),
    "a masked array without a mask": lambda a: np.ma.array(a),
    "of another library": Foreign,
    "lists": lambda a: a.tolist(),
}
WORDS = ("float16", "float32", "longdouble", "int8", "uint16", "int64")


def _read_only(array: np.ndarray) -> np.ndarray:
    array.setflags(write=False)
    return array


def same_numbers(slot: Slot) -> Iterator[tuple[Change, Change]]:
    """Pairs of changes that hold the same numbers, the first in double."""
    right = doubles(slot)
    if slot.kind == "count":
        for word in ("int8", "uint8", "int64"):
            if right <= np.iinfo(word).max and (right >= 0 or word != "uint8"):
                yield _pair(slot, f"as {word}", right, np.dtype(word).type(right))
        yield _pair(slot, "without axes", right, np.array(right))
        return
    if slot.kind != "number":
        for what, form in LAYOUTS.items():
            yield _pair(slot, what, right, form(right))
    if slot.kind == "rows":
        yield _pair(slot, "as int32", right, right.astype("int32"))
        return
    for word in WORDS:
        numbers = np.asarray(right)
        if word[0] in "iu":
            ends = np.iinfo(word)
            numbers = np.clip(np.rint(numbers), max(ends.min, -(2.0**62)), min(ends.max, 2.0**62))
        elif np.abs(numbers).max() > np.finfo(word).max:
            continue
        there = numbers.astype(word)[()] if slot.kind == "number" else numbers.astype(word)
        back = there.astype(float)
        yield _pair(slot, f"as {word}", float(back) if slot.kind == "number" else back, there)
    if slot.kind == "number":
        yield _pair(slot, "without axes", right, np.array(right))


def _pair(slot: Slot, what: str, double: Any, other: Any) -> tuple[Change, Change]:
    return Change(slot, f"{what}, in double", double), Change(slot, what, other)


# What is no number

# Documented: no limit, rows counted as in a slice, a seed of any number of digits.
TAKEN = {
    *(("heading_tolerance", what) for what in ("infinite", "just too large")),
    *((name, "endless") for name in ("seed", "begin", "end")),
}
SPECIAL = {
    "NaN": np.nan,
    "infinite": np.inf,
    "minus infinite": -np.inf,
    "just too large": np.nextafter(LARGEST_NUMBER, np.inf),
    "far too large": -1e300,
}


def no_numbers(slot: Slot) -> Iterator[Change]:
    """Changes that no function can answer."""
    right = doubles(slot)
    if slot.kind == "count":
        wrong = {"a half": right + 0.5, "true": np.True_, "a row": [right], "endless": 10**400}
        yield from (Change(slot, what, value) for what, value in wrong.items())
        return
    if slot.kind == "number":
        for what, value in SPECIAL.items():
            yield Change(slot, what, value)
        yield Change(slot, "with an axis", np.array([right]))
        return
    if slot.kind == "array":
        for place, (what, value) in enumerate(SPECIAL.items()):
            bent = right.copy()
            bent.flat[place % bent.size] = value
            yield Change(slot, what, bent)
    yield Change(slot, "complex", right + 0j)
    yield Change(slot, "truth values", right > 0)
    yield Change(slot, "objects", right.astype(object))
    yield Change(slot, "text", right.astype(str))
    yield Change(
        slot, "masked", np.ma.array(right, mask=np.arange(right.size).reshape(right.shape) == 0)
    )


# Other numbers


# Where a large number asks for as many steps.
ENDLESS = {"integrate_riccati.times"}
# Powers of ten by which a duration or an interval asks for more steps than can be, and is refused;
# with less it would be answered, and take as long.
TOO_MANY = 12


def _one(value: np.ndarray, place: int, number: float) -> np.ndarray:
    changed = value.copy()
    changed.flat[place % value.size] = number
    return changed


def _scaled(value: Any, exponent: int) -> Any:
    """Times a power of ten, and no larger than is allowed."""
    with np.errstate(under="ignore"):
        return np.clip(value * 10.0**exponent, -LARGEST_NUMBER, LARGEST_NUMBER)


SHAPES: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    "with an axis": lambda a: a[np.newaxis],
    "twice": lambda a: np.stack([a, a]),
    "with axes to broadcast": lambda a: np.stack([a, a])[:, np.newaxis],
    "empty": lambda a: np.zeros((0, *a.shape)),
    "without the last": lambda a: a[..., :-1] if a.ndim else a,
    "with one more": lambda a: np.concatenate([a, a[..., :1]], axis=-1) if a.ndim else a[None],
    "without the last row": lambda a: a[..., :-1, :] if a.ndim > 1 else a,
    "the first": lambda a: a[0] if a.ndim else a,
    "one number": lambda a: a.flat[0],
}


def other_numbers(slot: Slot, exponent: int, place: int) -> Iterator[Change]:
    """Changes that a function may answer or refuse; scaled by powers of ten, or at a place."""
    right = doubles(slot)
    if slot.kind == "count":
        for number in (0, -1, 1, 2, 3, right + 1, right - 1, 2**31, 2**63, 10**30):
            yield Change(slot, f"= {number}", number)
        return
    if slot.kind == "rows":
        return
    if f"{slot.door.name}.{slot.name}" in ENDLESS:
        exponent = min(exponent, 0)
    if slot.kind == "number" and exponent:
        exponent = max(abs(exponent), TOO_MANY) * (1 if exponent > 0 else -1)
    scaled = _scaled(right, exponent)
    if slot.kind == "number":
        for number in (0.0, -0.0, -right, 5e-324, LARGEST_NUMBER, float(scaled), right + place):
            yield Change(slot, f"= {number:g}", number)
        return
    yield Change(slot, f"times 1e{exponent}", scaled)
    yield Change(slot, "zero", 0 * right)
    yield Change(slot, "negative", -right)
    yield Change(slot, "subnormal", np.full_like(right, 5e-324))
    yield Change(slot, "as large as allowed", np.full_like(right, LARGEST_NUMBER))
    yield Change(slot, "one as large as allowed", _one(right, place, -LARGEST_NUMBER))
    yield Change(
        slot, f"one times 1e{exponent}", _one(right, place, scaled.flat[place % right.size])
    )
    yield Change(slot, "one zero", _one(right, place, 0.0))
    yield Change(slot, "one like another", _one(right, place, right.flat[exponent % right.size]))
    for what, shaped in SHAPES.items():
        yield Change(slot, what, shaped(right))
