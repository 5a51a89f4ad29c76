"""The loops that may be compiled, each by NumPy or by Numba: the one place that chooses.

What is chosen depends on the size of a call alone, so that the same call has the same last digits
wherever and whenever it is made: by hand, in a notebook that runs again, on any number of workers.
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from importlib.util import find_spec
from pickle import UnpicklingError
from typing import Any

from driftlab.checks import FloatArray

from . import attitude, kalman, quaternion, strapdown
from .coning import ConingSteps
from .functional_iteration import WindowSteps
from .strapdown import Navigation

VARIABLE = "DRIFTLAB_COMPILED"
"""Of the environment: "0" compiles nothing, "1" whatever its size; else long records are compiled.
It is read at the start of a program, and processes that are started inherit it."""

# NumPy takes about 40 ms for so many increments or filter steps, over all runs. Numba takes 0.4 s
# to load, once in a process, and 2 to 3 s to compile, once on a computer. So short calls never wait
# for it; one call of this size does not earn the loading, and about fifteen of them do.
LONG_ATTITUDE, LONG_NAVIGATION, LONG_FILTER = 700_000, 150_000, 2_500


def _asked() -> bool | None:
    """What the environment asks for: all, nothing, or (None) what is long."""
    asked = os.environ.get(VARIABLE, "")
    if asked not in ("", "0", "1"):
        warnings.warn(
            f"{VARIABLE}: expected 0 or 1, got {asked!r}; long records are compiled.", stacklevel=2
        )
    return {"0": False, "1": True}.get(asked)


asked = _asked()


@contextmanager
def by_numpy_alone() -> Iterator[None]:
    """Compile nothing in a ``with`` block, nor in processes that are started in it."""
    global asked
    before, said = asked, os.environ.get(VARIABLE, "")
    asked, os.environ[VARIABLE] = False, "0"
    try:
        yield
    finally:
        asked, os.environ[VARIABLE] = before, said


def arithmetic() -> str:
    """What computes, as "NumPy" or "Numba 0.62.1, long records"; it decides on last digits."""
    if asked is False or find_spec("numba") is None or _numba() is None:
        return "NumPy"
    from importlib.metadata import version

    return f"Numba {version('numba')}, {'everything' if asked else 'long records'}"


@cache
def _numba() -> Any:
    """The loops by Numba, or None where it is not installed or not fit for this NumPy or disk."""
    try:
        from . import compiled
    except Exception as error:
        # Nobody else asked for it. Without a place for its cache it would compile in each process.
        if asked:
            warnings.warn(f"{VARIABLE} is 1, but NumPy computes: {error}", stacklevel=4)
        return None
    return compiled


def _run(is_long: bool, plain: Any, loop: str, *arguments: Any, **options: Any) -> Any:
    """Run the loop by Numba if this call is for it, else that of the module `plain`."""
    global asked
    compiled = _numba() if asked or (is_long and asked is None) else None
    if compiled is not None:
        try:
            return getattr(compiled, loop)(*arguments, **options)
        except (OSError, EOFError, UnpicklingError) as error:  # of its cache: we read no files
            warnings.warn(
                f"Numba cannot keep or read what it has compiled ({error}), so NumPy computes from "
                "now on. NUMBA_CACHE_DIR in the environment names another folder for it.",
                stacklevel=4,
            )
            asked = False
    return getattr(plain, loop)(*arguments, **options)


def attitudes(
    algorithm: ConingSteps | WindowSteps,
    increments: FloatArray,
    past: int = 0,
    first: FloatArray = attitude.NO_TURN,
) -> FloatArray:
    """As `driftlab.core.attitude.attitudes`."""
    rows = max(increments.size // 3, increments.shape[-2] * (first.size // 4))
    given = algorithm, increments, past, first
    return _run(rows >= LONG_ATTITUDE, attitude, "attitudes", *given)


def cumulative_product(quaternions: FloatArray) -> FloatArray:
    """As `driftlab.core.quaternion.cumulative_product`."""
    long = quaternions.size // 4 >= LONG_ATTITUDE
    return _run(long, quaternion, "cumulative_product", quaternions)


def navigate(
    start: Navigation,
    angle: FloatArray,
    velocity: FloatArray,
    interval: float,
    algorithm: ConingSteps,
    *,
    every: int = 2,
    hold_altitude: bool = False,
    calls: int = 1,
) -> Navigation:
    """As `driftlab.core.strapdown.navigate`; one of so many calls that go along a record."""
    runs = max(
        *(each.size for each in start[:3]),
        *(each[..., 0].size for each in start[3:]),
        *(each[..., 0, 0].size for each in (angle, velocity)),
    )
    long = calls * runs * angle.shape[-2] >= LONG_NAVIGATION
    given = start, angle, velocity, interval, algorithm
    options = {"every": every, "hold_altitude": hold_altitude}
    return _run(long, strapdown, "navigate", *given, **options)


def covariances(
    covariance: FloatArray,
    transitions: FloatArray,
    noises: FloatArray,
    observation: FloatArray,
    spreads: FloatArray,
) -> tuple[FloatArray, FloatArray]:
    """As `driftlab.core.kalman.covariances`."""
    given = covariance, transitions, noises, observation, spreads
    return _run(len(transitions) >= LONG_FILTER, kalman, "covariances", *given)
