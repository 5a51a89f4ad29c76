"""The loops that may be compiled, each in NumPy or by Numba: the one place that chooses.

Whatever uses one of them takes it from here, and nothing else asks which it is.
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable
from functools import cache, wraps
from importlib.metadata import version
from importlib.util import find_spec
from types import ModuleType
from typing import Any, TypeVar, cast

from . import attitude, kalman, quaternion, strapdown

_Loop = TypeVar("_Loop", bound=Callable[..., Any])

VARIABLE = "DRIFTLAB_COMPILED"
"""Of the environment: "1" where arithmetic is compiled, else "0" or not set. Processes that are
started inherit it."""


def available() -> bool:
    """Whether Numba is installed."""
    return find_spec("numba") is not None


def _asked() -> bool:
    """Whether the environment asks for it, and it can be had; if not, a warning says why.

    Of a process that another one started, that one has said it.
    """
    asked = os.environ.get(VARIABLE, "")
    if asked in ("", "0"):
        return False
    from multiprocessing import parent_process

    if parent_process():
        return asked == "1" and available()
    if asked != "1":
        warnings.warn(
            f"{VARIABLE}: expected 0 or 1, got {asked!r}; nothing is compiled.", stacklevel=2
        )
    elif not available():
        warnings.warn(
            f"{VARIABLE} is 1, but numba is not installed: pip install driftlab[compiled] brings "
            "it. Nothing is compiled.",
            stacklevel=2,
        )
    return asked == "1" and available()


on = _asked()


def arithmetic() -> str:
    """What computes, as "NumPy" or "Numba 0.62.1"; it decides on last digits."""
    return f"Numba {version('numba')}" if on else "NumPy"


def switch(wanted: bool) -> None:
    """Compile from now on, or no longer; here and in processes started later."""
    global on
    on = wanted
    os.environ[VARIABLE] = "1" if wanted else "0"


@cache
def _compiled() -> ModuleType:
    """Those of Numba, which takes half a second to be loaded."""
    from . import compiled

    return compiled


def _chosen(plain: _Loop) -> _Loop:
    """A loop of NumPy, or where it is `on` the one of the same name in `compiled`."""

    @wraps(plain)
    def loop(*given: Any, **named: Any) -> Any:
        return (getattr(_compiled(), plain.__name__) if on else plain)(*given, **named)

    return cast(_Loop, loop)


attitudes = _chosen(attitude.attitudes)
correct = _chosen(kalman.correct)
correct_covariance = _chosen(kalman.correct_covariance)
cumulative_product = _chosen(quaternion.cumulative_product)
navigate = _chosen(strapdown.navigate)
predict = _chosen(kalman.predict)
