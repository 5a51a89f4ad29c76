"""The same arithmetic in C: how fast this machine could be without Python.

`floor.c` is compiled anew for each run, without the liberties that change results.
"""

import ctypes
import shutil
import subprocess
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from driftlab.strapdown import Navigation

SOURCE = Path(__file__).with_name("floor.c")
OPTIONS = ("-O3", "-ffp-contract=off", "-shared", "-fPIC")


@cache
def library() -> ctypes.CDLL:
    """Compile the floor and load it; an ImportError says why that cannot be done."""
    compiler = next(filter(None, map(shutil.which, ("cc", "gcc", "clang"))), None)
    if compiler is None:
        raise ImportError("there is no C compiler")
    with TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        made = str(Path(folder, "floor.so"))
        command = [compiler, *OPTIONS, str(SOURCE), "-o", made, "-lm"]
        tried = subprocess.run(command, capture_output=True, text=True)
        if tried.returncode:
            raise ImportError(f"{compiler} does not compile the floor: {tried.stderr.strip()}")
        return ctypes.CDLL(made)


def _call(name: str, count: int, *arguments: np.ndarray | float) -> None:
    passed = (
        ctypes.c_void_p(each.ctypes.data) if isinstance(each, np.ndarray) else ctypes.c_double(each)
        for each in arguments
    )
    getattr(library(), name)(ctypes.c_long(count), *passed)


def attitude(increments: np.ndarray, name: str) -> np.ndarray:
    """Attitudes (steps, 4) from increments (n, 3) by "picard-1" or "two-step-4"."""
    attitudes = np.empty((len(increments) // {"picard-1": 1, "two-step-4": 2}[name], 4))
    _call(f"attitude_{name.replace('-', '_')}", len(attitudes), increments, attitudes)
    return attitudes


def navigate(
    start: Navigation, interval: float, angle: np.ndarray, velocity: np.ndarray
) -> Navigation:
    """States after each pair of increments (n, 3)."""
    state = np.array([*np.ravel(start[:3]), *start.velocity, *start.attitude], dtype=float)
    found = np.empty((len(angle) // 2, 10))
    _call("navigate", len(found), interval, angle, velocity, state, found)
    return Navigation(*found.T[:3], found[:, 3:6], found[:, 6:])


def filter_steps(covariance: np.ndarray, *others: np.ndarray) -> np.ndarray:
    """Covariance (27, 27) after steps of transitions (steps, 6, 27); see `filtering`."""
    after = covariance.copy()
    _call("filter", len(others[0]), after, *others, np.empty(27))
    return after
