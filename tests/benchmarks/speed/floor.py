"""The same arithmetic in C: how fast this machine could be without Python.

`floor.c` is compiled anew for each run, without the liberties that change results.
"""

import ctypes
import shutil
import subprocess
import sysconfig
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from driftlab.attitude.coning_algorithms import CONING_ALGORITHMS, Algorithm
from driftlab.strapdown import Navigation

SOURCE = Path(__file__).with_name("floor.c")
OPTIONS = ("-O3", "-ffp-contract=off", "-shared", "-fPIC")
_STAGES = {
    "first iterate": "FIRST",
    "second iterate": "SECOND",
    "third iterate": "THIRD",
    "tangent": "TANGENT",
    "rotation vector": "ROTATION_VECTOR",
}


class NoCompiler(ImportError):
    """No C compiler, so no floor."""


@cache
def library() -> ctypes.CDLL:
    """Compile the floor and load it."""
    compiler = compiler_command()
    with TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        source, made = Path(folder, "floor.c"), Path(folder, "floor.so")
        algorithms = map(_attitude_in_c, CONING_ALGORITHMS.values())
        source.write_text("\n".join([SOURCE.read_text("utf-8"), *algorithms]), "utf-8")
        command = [compiler, *OPTIONS, str(source), "-o", str(made), "-lm"]
        tried = subprocess.run(command, capture_output=True, text=True)
        if tried.returncode:
            raise NoCompiler(f"{compiler} does not compile the floor: {tried.stderr.strip()}")
        return ctypes.CDLL(str(made))


def compiler_command() -> str:
    """The C compiler of this machine."""
    for name in ((sysconfig.get_config_var("CC") or "cc").split()[0], "cc", "gcc", "clang"):
        if found := shutil.which(name):
            return found
    raise NoCompiler("there is no C compiler")


def _attitude_in_c(algorithm: Algorithm) -> str:
    """A C function attitude_<name> whose weights are constants."""

    def one(weights: Mapping[tuple[int, int], float], first: str) -> str:
        places = ", ".join(f"{i}, {j}" for i, j in weights) or "0"
        values = ", ".join(f"{weight!r}" for weight in weights.values()) or "0"
        return (
            f"{{ static const int p[] = {{{places}}}; static const double w[] = {{{values}}};\n"
            f"    step({first}, g + 3 * {algorithm.samples} * s, {algorithm.samples}, "
            f"{len(weights)}, p, w, {_STAGES[algorithm.last_stage]}, turn); }}"
        )

    usual = one(algorithm.coning, f"g + 3 * ({algorithm.samples} * s - {algorithm.memory})")
    chosen = "".join(
        f"if (s == {i}) {one(weights, 'g')}\n    else "
        for i, weights in enumerate(algorithm.starts)
    )
    return (
        f"void attitude_{algorithm.name.replace('-', '_')}"
        "(long steps, const double *g, double *q) {\n"
        "  double now[4] = {0, 0, 0, 1}, turn[4];\n"
        "  for (long s = 0; s < steps; s++) {\n"
        f"    {chosen}{usual}\n"
        "    multiply(now, turn, now);\n"
        "    for (int i = 0; i < 4; i++) q[4 * s + i] = now[i];\n"
        "  }\n}\n"
    )


def _call(name: str, count: int, *arguments: np.ndarray | float) -> None:
    passed = [
        each.ctypes.data_as(ctypes.c_void_p)
        if isinstance(each, np.ndarray)
        else ctypes.c_double(each)
        for each in arguments
    ]
    getattr(library(), name)(ctypes.c_long(count), *passed)


def copy(values: np.ndarray) -> np.ndarray:
    """Copy of contiguous double precision values."""
    made = np.empty_like(values)
    _call("copy", values.size, values, made)
    return made


def attitude(increments: np.ndarray, name: str) -> np.ndarray:
    """Attitudes (steps, 4) from increments (n, 3) by an algorithm with cross products."""
    attitudes = np.empty((len(increments) // CONING_ALGORITHMS[name].samples, 4))
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


def filter_steps(
    covariance: np.ndarray,
    transitions: np.ndarray,
    noise: np.ndarray,
    observation: np.ndarray,
    observation_noise: np.ndarray,
    innovation: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:
    """Covariance (27, 27) after steps of transitions (steps, 6, 27), and the last correction."""
    after, correction = covariance.copy(), np.empty(27)
    _call(
        "filter", len(transitions), after, transitions, noise, observation, observation_noise,
        innovation, correction,
    )  # fmt: skip
    return after, correction
