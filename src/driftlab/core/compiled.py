"""Whether arithmetic is compiled, and the way to what is compiled.

The functions here take and return what those of the same name in NumPy do. They stand between:
arrays of any leading axes there, one leading axis and no gaps here.
"""

from __future__ import annotations

import os
import warnings
from functools import cache, lru_cache
from importlib.metadata import version
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from driftlab.checks import FloatArray

if TYPE_CHECKING:
    from driftlab.attitude.coning_algorithms import Algorithm

    from .strapdown import Navigation

VARIABLE = "DRIFTLAB_COMPILED"
"""Of the environment: "1" where arithmetic is compiled, else "0" or not set. Processes that are
started inherit it."""

_STAGES = ("rotation vector", "first iterate", "second iterate", "third iterate", "tangent")


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
def _kernels() -> Any:
    """Compiled attitude and navigation; Numba takes half a second to be loaded."""
    from . import _kernels

    return _kernels


@cache
def _filters() -> Any:
    """Compiled steps of a filter."""
    from . import _filter_kernels

    return _filter_kernels


def attitudes(
    first: FloatArray, algorithm: Algorithm, angle: FloatArray, past: int
) -> tuple[FloatArray, float]:
    """Attitudes (..., k, 4) after each step, and the largest square of a gamma."""
    places, weights, starts = _arrays(algorithm)
    lead = _lead(first[..., np.newaxis, :], angle)
    begun, rows = _runs(first[..., np.newaxis, :], lead), _runs(angle, lead)
    found = np.empty((*lead, (angle.shape[-2] - past) // algorithm.samples, 4))
    memory, stage = algorithm.memory, _STAGES.index(algorithm.last_stage)
    largest = _kernels().attitudes(
        begun, rows, algorithm.samples, memory, past, places, weights, starts, stage,
        _runs(found, lead),
    )  # fmt: skip
    return found, largest


def cumulative_product(quaternions: FloatArray) -> FloatArray:
    """As `driftlab.core.quaternion.cumulative_product`."""
    rows = _runs(quaternions, quaternions.shape[:-2])
    found = np.empty(rows.shape)
    _kernels().cumulative_product(rows, found)
    return found.reshape(quaternions.shape)


def navigate(
    start: Navigation,
    angle: FloatArray,
    velocity: FloatArray,
    interval: float,
    algorithm: Algorithm,
    chunk: int,
    every: int,
    hold_altitude: bool,
) -> tuple[tuple[FloatArray, ...], float, float]:
    """Fields of the states, the largest square of a gamma and the smallest one of a distance.

    `chunk` and `every` are numbers of steps.
    """
    place = start.latitude, start.longitude, start.altitude
    lead = np.broadcast_shapes(
        *(each.shape for each in place),
        *(each.shape[:-1] for each in (start.velocity, start.attitude)),
        *(each.shape[:-2] for each in (angle, velocity)),
    )
    begun = np.empty((*lead, 10))
    begun[..., 0], begun[..., 1], begun[..., 2] = place
    begun[..., 3:6], begun[..., 6:] = start.velocity, start.attitude
    angles, pushes = _runs(angle, lead), _runs(velocity, lead)
    samples = algorithm.samples
    places, weights, _ = _arrays(algorithm)
    count = angles.shape[1] // samples // every
    begun = begun.reshape(-1, 10)
    found = np.empty((len(begun), count, 10))
    stage = _STAGES.index(algorithm.last_stage)
    largest, lowest = _kernels().navigate(
        begun, angles, pushes, interval, samples, places, weights, stage, chunk,
        every, hold_altitude, found,
    )  # fmt: skip
    states = found.reshape(*lead, count, 10)
    fields = *(states[..., i].copy() for i in range(3)), states[..., 3:6].copy()
    return (*fields, states[..., 6:].copy()), largest, lowest


def predict(covariance: FloatArray, transition: FloatArray, noise: FloatArray) -> FloatArray:
    """As `driftlab.core.kalman.predict`."""
    if covariance.ndim == transition.ndim == noise.ndim == 2:
        return _filters().predict(covariance, transition, noise)
    lead = _lead(covariance, transition, noise)
    given = (_runs(each, lead) for each in (covariance, transition, noise))
    return _filters().predict_each(*given).reshape(*lead, *covariance.shape[-2:])


def correct_covariance(
    covariance: FloatArray, observation: FloatArray, noise: FloatArray
) -> tuple[FloatArray, NDArray[Any], NDArray[Any]]:
    """As `driftlab.core.kalman.correct_covariance`."""
    lead = _lead(covariance, observation, noise)
    given = (_runs(each, lead) for each in (covariance, observation, noise))
    *found, regular = _filters().correct_covariance_each(*given)
    if not regular:
        raise _singular()
    after, gain, weights = (each.reshape(*lead, *each.shape[1:]) for each in found)
    return after, gain, weights


def correct(
    covariance: FloatArray, innovation: FloatArray, observation: FloatArray, noise: FloatArray
) -> tuple[FloatArray, FloatArray, Any]:
    """As `driftlab.core.kalman.correct`, for one filter."""
    correction, after, nis, regular = _filters().correct(covariance, innovation, observation, noise)
    if not regular:
        raise _singular()
    return correction, after, np.float64(nis)


def _singular() -> np.linalg.LinAlgError:
    return np.linalg.LinAlgError("Singular matrix")  # as np.linalg.inv says


def _lead(*values: FloatArray) -> tuple[int, ...]:
    """Leading axes of arrays (..., a, b) together; sooner than NumPy where they are alike."""
    shapes = {each.shape[:-2] for each in values if each.ndim > 2}
    return np.broadcast_shapes(*shapes) if len(shapes) > 1 else shapes.pop() if shapes else ()


def _runs(values: FloatArray, lead: tuple[int, ...]) -> FloatArray:
    """Arrays (..., a, b) as (r, a, b) without gaps: one run, or all that the axes come to."""
    if values.ndim == 2:
        return np.ascontiguousarray(values)[np.newaxis]
    if values.shape[:-2] != lead:
        values = np.broadcast_to(values, (*lead, *values.shape[-2:]))
    return np.ascontiguousarray(values).reshape(-1, *values.shape[-2:])


@lru_cache(maxsize=64)
def _arrays(algorithm: Algorithm) -> tuple[NDArray[np.int64], FloatArray, FloatArray]:
    """Places (p, 2) of the pairs of a window, their weights (p,) and those of starts (m, p)."""
    given = [dict(algorithm.coning), *map(dict, algorithm.starts)]
    pairs = sorted({pair for weights in given for pair in weights}, key=lambda pair: pair[::-1])
    values = np.array([[weights.get(pair, 0.0) for pair in pairs] for weights in given])
    places = np.array(pairs, np.int64).reshape(-1, 2)
    return places, values[0].copy(), values[1:].copy()
