"""What holds of every call, whatever numbers it is given."""

import copy
import dataclasses
import re
import warnings
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from driftlab.calibration import InconsistentCalibrationWarning
from driftlab.checks import UnusualWarning
from driftlab.gyrocompass import InconsistentAlignmentWarning
from fuzzing import TAKEN, Change

# What is NaN where nothing is known of it, as the docstring says.
UNKNOWN = {
    *(
        "align.latitude_discrepancy",
        "align.heading_uncertainty",
        "align_multi_position.heading_uncertainty",
    ),
    *("static_intervals.gyro_noise", "static_intervals.accelerometer_noise"),
}
IN_WORDS = {
    "integrate_finite_word",
    "step_rotation_vectors",
    "step_finite_word",
}  # which are asked for
VIEWS = {"Increments.part", "Recording.part", "Recording.between"}  # as of a slice
# What is made of an argument that is far too large, and is told by its own name.
TRIADS = ("gyro_matrix", "gyro_offset", "accelerometer_matrix", "accelerometer_offset")
ALSO_TOLD = {
    **{f"{name}Matrices": TRIADS for name in ("Psins", "Ros", "Kalibr", "Imucal", "ImuTk")},
    "navigate_static": ("increments",),
    "static_error_sources": ("increments",),
    "simulate_gyrocompass": ("increments", "gains"),
    # A log is called by its name.
    "read_csv": ("phone: gyro",),
    "from_dataframe": ("recording: gyro",),
    "read_imu_tk": ("gyro: gyro", "gyro: accelerometer"),
}
PLAIN = (int, float, complex, str, bytes, bool, type(None))


class Outcome(NamedTuple):
    """An answer or the sentence of a refusal, and what is wrong with it."""

    answer: Any
    refusal: str
    complaints: list[str]


def leaves(value: Any, name: str = "") -> Iterator[tuple[str, Any]]:
    """Arrays and single values in an answer or an argument, by their places in it."""
    if isinstance(value, (np.ndarray, np.generic, *PLAIN)):
        yield name, value
    elif hasattr(value, "_fields"):
        for field, each in zip(value._fields, value, strict=True):
            yield from leaves(each, f"{name}.{field}")
    elif dataclasses.is_dataclass(value) and not isinstance(value, type):
        for field in dataclasses.fields(value):
            yield from leaves(getattr(value, field.name), f"{name}.{field.name}")
    elif isinstance(value, list | tuple):
        for number, each in enumerate(value):
            yield from leaves(each, f"{name}[{number}]")
    elif isinstance(value, dict):
        for key, each in value.items():
            yield from leaves(each, f"{name}[{key!r}]")


def arrays(value: Any, name: str = "") -> list[tuple[str, np.ndarray]]:
    found = list(leaves(value, name))
    return [(name, each) for name, each in found if isinstance(each, np.ndarray)]


def outcome(change: Change) -> Outcome:
    """Make a call, and look at what it leaves of its arguments and what it returns."""
    arguments = change.arguments()
    for name, value in arguments.items():
        if isinstance(value, np.random.Generator):
            arguments[name] = copy.deepcopy(value)
    receiver = getattr(change.slot.door.call, "__self__", None)
    given = [*arrays(arguments), *arrays(receiver, "self")]
    before = [array.tobytes() for _, array in given]
    answer, refusal, complaints = None, "", []
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            for spoken in (
                UnusualWarning,
                InconsistentCalibrationWarning,
                InconsistentAlignmentWarning,
            ):
                warnings.simplefilter("ignore", spoken)
            answer = change.slot.door.call(**arguments)
    except (ValueError, TypeError) as reason:
        refusal = str(reason)
        names = "|".join(
            sorted(
                {
                    *change.slot.door.names(),
                    *change.slot.name.split("."),
                    *ALSO_TOLD.get(change.slot.door.name, ()),
                }
            )
        )
        if not re.fullmatch(
            rf"({names})\b[\w., ]*(: what <lambda> returned)?: expected [^\n]*[.?)]", refusal
        ):
            complaints.append(f"{type(reason).__name__}: {refusal!r:.200}")
    except Warning as leaked:
        complaints.append(f"leaks {type(leaked).__name__}: {leaked}")
    except Exception as other:
        complaints.append(f"{type(other).__name__}: {str(other)!r:.150}")
    if any(a.tobytes() != b for (_, a), b in zip(given, before, strict=True)):
        complaints.append("has changed an argument")
    for place, value in leaves(answer):
        if isinstance(value, float | complex | np.inexact | np.ndarray):
            kind = np.asarray(value).dtype
            if kind.kind in "fc":
                if not np.isfinite(value).all() and change.slot.door.name + place not in UNKNOWN:
                    complaints.append(f"returns {value!s:.60} in its answer{place}")
                if (
                    kind not in (np.float64, np.complex128)
                    and change.slot.door.name not in IN_WORDS
                ):
                    complaints.append(f"returns {kind} in its answer{place}")
    for place, array in arrays(answer) if change.slot.door.name not in VIEWS else ():
        for name, argument in given:
            if np.shares_memory(array, argument) and array.flags.writeable:
                complaints.append(f"answer{place} is a window into {name}")
    return Outcome(answer, refusal, complaints)


def answered(change: Change) -> list[str]:
    """What is wrong with the answer or refusal of a call."""
    return outcome(change).complaints


def refused(change: Change) -> list[str]:
    """What is wrong where a call can only be refused, in a sentence that begins with its slot."""
    found = outcome(change)
    last = change.slot.name.split(".")[-1]
    if not found.refusal and not found.complaints:
        return [] if (last, change.what) in TAKEN else ["is accepted"]
    if found.refusal and not re.match(rf"[\w., ]*\b{last}\b[\w., ]*: ", found.refusal):
        return [*found.complaints, f"is refused as another's: {found.refusal:.150}"]
    return found.complaints


def compared(first: Change, second: Change) -> list[str]:
    """What differs between two calls with the same numbers."""
    one, other = outcome(first), outcome(second)
    complaints = [*one.complaints, *other.complaints]
    # How the number that came is written depends on its form.
    if one.refusal.split(", got")[0] != other.refusal.split(", got")[0]:
        complaints.append(
            f"is told {other.refusal or 'nothing'!r}, not {one.refusal or 'nothing'!r}"
        )
    elif not one.refusal:
        mine, its = dict(leaves(one.answer)), dict(leaves(other.answer))
        if mine.keys() != its.keys():
            return [*complaints, "another answer"]
        complaints += [
            f"answer{k}: {its[k]!r:.60}, not {mine[k]!r:.60}"
            for k in mine
            if not _alike(mine[k], its[k])
        ]
    windows = [array for _, array in arrays(one.answer) if array.flags.writeable]
    for place, array in arrays(other.answer) if first.slot.door.name not in VIEWS else ():
        if any(np.shares_memory(array, mine) for mine in windows):
            complaints.append(f"answer{place} is a window into what the next answer has, too")
    return complaints


def _alike(one: Any, other: Any) -> bool:
    if isinstance(one, np.ndarray | np.number | float | complex | int):
        one, other = np.asarray(one), np.asarray(other)
        if one.shape != other.shape or one.dtype.kind != other.dtype.kind:
            return False
        if one.dtype.kind in "fc" and one.size:
            return np.allclose(
                one,
                other,
                rtol=0,
                atol=1e-9 * np.max(np.abs(one), where=np.isfinite(one), initial=0),
                equal_nan=True,
            )
        return bool(np.array_equal(one, other))
    return bool(one == other)
