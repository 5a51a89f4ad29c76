"""Lets one thread at a time move panels and draw.

Matplotlib has one style and each panel one picture, but a page may move two sliders of a panel in
two threads: where a kernel has subshells, JupyterLab sends what some widgets say to one of them and
what others say to the main shell.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from threading import RLock
from typing import Any, TypeVar, cast

ONE_AT_A_TIME = RLock()

Method = TypeVar("Method", bound=Callable[..., Any])


def one_at_a_time(method: Method) -> Method:
    """Let a method wait until no other thread is in one of these, or draws."""

    @wraps(method)
    def waiting(*args: Any, **kwargs: Any) -> Any:
        with ONE_AT_A_TIME:
            return method(*args, **kwargs)

    return cast(Method, waiting)
