"""What the package promises of every function of arrays: leading axes, `Rotation`, shapes.

The calls are those of `doors`; a docstring says which leading axes an argument may have:
``array_like, shape (..., 3)``. What holds of any call is tested by `test_fuzz`.
"""

import inspect
import re
from itertools import cycle
from typing import Any, NamedTuple

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from doors import CORES, Door, doors
from driftlab import conventions
from driftlab.checks import finite_array
from fuzz_rules import compared, leaves
from fuzzing import Change, Slot, slots
from support import helper_modules, replaced

pytestmark = pytest.mark.filterwarnings("ignore::driftlab.checks.UnusualWarning")
TYPE = re.compile(r"^([\w, ]+) : (array_like.*)$", re.MULTILINE)
PROMISE = re.compile(r"shape \(\.\.\.(?:, ([\w, ]+))?\)(?! or)")
# Motions that close do so no more when they are bent, and a filter takes the attitude of the first
# of several runs for that of all, a way that is integrated is good to 1e-7 m, and a drift to some
# eps in a sample's interval; these have such tests of their own.
APART = {
    *("drift_per_cycle", "exact_drift_per_cycle", "coning_drift", "simulated_coning_drift"),
    *("calibrate", "navigate", "navigate_static"),
}
# Records of several arrays, which have leading axes as well.
OF_RECORDS = {"calibrate", "navigate_static", "static_error_sources"}
NO_QUATERNIONS = {"weighing_estimate.estimates", "scalar_last.quaternion"}


class Promised(NamedTuple):
    """An argument, the shape that its docstring gives it, and right numbers of that shape."""

    name: str
    kind: str
    axes: list[str]
    value: np.ndarray


def kinds(door: Door) -> dict[str, str]:
    """What the docstring of a function says of each of its arrays."""
    found = TYPE.findall(inspect.getdoc(door.call) or "")
    return {name.strip(): kind for names, kind in found for name in names.split(",")}


def promised(door: Door) -> list[Promised]:
    """The arguments of a door that may have leading axes, and fields of records among them."""
    said, found = kinds(door), []
    for slot in slots(door):
        if slot.name.startswith(("imu_errors.", "estimated.", "increments.angle", "increments.v")):
            value = np.array(slot.value, float)
            found.append(Promised(slot.name, "", ["of"] * value.ndim, value))
        elif match := PROMISE.search(said.get(slot.name, "")):
            axes = (match[1] or "").replace(",", " ").split()
            value = np.array(slot.value, float)
            first = value[(0,) * (value.ndim - len(axes))]
            found.append(Promised(slot.name, said[slot.name], axes, first))
    return found


def calls(module: Any) -> list[tuple[Door, list[Promised]]]:
    """All functions of a module that promise leading axes."""
    found = [(door, promised(door)) for door in doors(module) if door.name not in CORES]
    return [(door, arguments) for door, arguments in found if arguments]


every_module = pytest.mark.parametrize(
    "module", [m for m in helper_modules() if calls(m)], ids=lambda module: module.__name__[9:]
)


def with_leading_axes(argument: Promised, leading: tuple[int, ...], rng) -> np.ndarray:
    """Copies of right numbers along leading axes, each bent a little, and read-only."""
    bent = 0.01 * rng.uniform(-1, 1, (*leading, *argument.value.shape))
    value = argument.value * (1 + bent)
    if argument.name == "axes":
        value /= np.linalg.norm(value, axis=-1, keepdims=True)
    value.setflags(write=False)
    return value


@every_module
def test_leading_axes_are_loops(module):
    rng = np.random.default_rng(5)
    for door, arguments in calls(module):
        if door.name in APART:
            continue
        leading = dict(zip([each.name for each in arguments], cycle([(2, 1), (3,)]), strict=False))
        given = {e.name: with_leading_axes(e, leading[e.name], rng) for e in arguments}
        shape = np.broadcast_shapes(*leading.values())
        spread = {e.name: np.broadcast_to(given[e.name], shape + e.value.shape) for e in arguments}
        together = dict(leaves(door.call(**replaced(door.arguments, given))))
        for index in np.ndindex(shape):
            one_by_one = {name: value[index] for name, value in spread.items()}
            for place, one in leaves(door.call(**replaced(door.arguments, one_by_one))):
                if not isinstance(one, float | complex | np.generic | np.ndarray):
                    continue
                # As NumPy's own functions have it: a number, and no array without axes.
                assert np.ndim(one) or not isinstance(one, np.ndarray), (door.name, place)
                many = together[place]
                alike = many[index] if np.shape(many) != np.shape(one) else many
                where = f"{door.name}{place}"
                assert np.shape(alike) == np.shape(one), where
                # The same few operations in another order, some on an error matrix plus one.
                bound = 1e-13 * np.max(np.abs(one), initial=0.0) + 1e-14
                np.testing.assert_allclose(alike, one, rtol=0, atol=bound, err_msg=where)


@every_module
def test_other_shapes_are_refused_by_name(module):
    for door, arguments in calls(module):
        for each in arguments:
            vector = [*each.axes, ""][len(each.axes) - 1].isdigit()
            for value in (np.ones((*each.value.shape[:-1], 5)), 1.0) if vector else ():
                with pytest.raises(ValueError, match=rf"^{each.name}: expected .*got shape \("):
                    door.call(**door.arguments | {each.name: value})
        arguments = [each for each in arguments if each.kind]
        if len(arguments) > 1 and door.name not in OF_RECORDS:
            three, two = (
                {each.name: np.stack([each.value] * count)}
                for each, count in zip(arguments, (3, 2), strict=False)
            )
            alone = {each.name: each.value for each in arguments}
            words = r"^[\w, .]+: expected leading axes that broadcast"
            with pytest.raises(ValueError, match=words) as no:
                door.call(**door.arguments | alone | three | two)
            assert all(name in str(no.value).partition(":")[0] for name in (*three, *two)), door


def quaternions(module: Any) -> list[Slot]:
    """The arguments of a module's doors that are quaternions."""
    return [
        slot
        for door in doors(module)
        for slot in slots(door)
        if kinds(door).get(slot.name, "4)" if slot.name == "attitude" else "").rpartition("4")[1]
        and np.shape(slot.value)[-1:] == (4,)
        and door.name not in CORES
    ]


@every_module
def test_a_rotation_is_taken_like_its_quaternion(module):
    for slot in quaternions(module):
        name = f"{slot.door.name}.{slot.name}"
        told = kinds(slot.door).get(slot.name, "a method's")
        assert ("Rotation" in told) != (name in NO_QUATERNIONS) or told == "a method's", name
        if name not in NO_QUATERNIONS:
            rotation = Rotation.from_quat(slot.value)
            pair = (Change(slot, "", rotation.as_quat()), Change(slot, "", rotation))
            assert compared(*pair) == [], name


def test_rotation_in_place_of_other_numbers_is_refused():
    for wrong in (Rotation.identity(), Rotation.identity(2)):
        with pytest.raises(ValueError, match=r"^rate: expected real numbers, got "):
            finite_array(wrong, "rate", 3)
    with pytest.raises(ValueError, match=r"^quaternion: expected numbers, scalar first, got a Rot"):
        conventions.scalar_last(Rotation.identity())


def test_calls_are_found_in_every_subject():
    """Without them the tests above would try nothing."""
    found = {module.__name__: calls(module) for module in helper_modules()}
    assert sum(map(len, found.values())) > 60
    assert sum(len(quaternions(module)) for module in helper_modules()) > 25
