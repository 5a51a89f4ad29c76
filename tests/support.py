"""What several tests share: random inputs, strategies, and the order at which an error shrinks."""

import os
import re
from collections.abc import Callable
from decimal import Decimal
from functools import cache
from importlib import import_module
from pathlib import Path
from pkgutil import walk_packages
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.stats import chi2, studentized_range

import driftlab
from driftlab.recordings import Recording, RecordingUnavailable, published

ROOT = Path(__file__).parents[1]
"""The project's folder."""
EPS = float(np.finfo(float).eps)
IDENTITY = np.array([0.0, 0.0, 0.0, 1.0])


def numbers(most: float) -> st.SearchStrategy:
    """Numbers up to `most`: zero, or large enough for a fourth power.

    LAPACK's determinants and eigenvalues, which some results are compared with, are not
    good for smaller ones. What the package does with those is tested one by one.
    """
    return st.floats(-most, most).map(lambda x: x if abs(x) > 1e-60 else 0.0)


def vectors(most: float = 10.0) -> st.SearchStrategy:
    """Vectors (3,) of any direction and size, the zero vector included."""
    return arrays(float, 3, elements=numbers(most))


def directions() -> st.SearchStrategy:
    """Vectors (3,) that are not zero."""
    return vectors().filter(lambda vector: np.abs(vector).max() > 1e-3)


def matrices(most: float) -> st.SearchStrategy:
    """Triad errors (3, 3) with entries up to `most`."""
    return arrays(float, (3, 3), elements=numbers(most))


def quaternions() -> st.SearchStrategy:
    """Unit quaternions (4,), scalar last."""
    elements = arrays(float, 4, elements=st.floats(-1, 1))
    return elements.filter(lambda q: np.linalg.norm(q) > 0.1).map(lambda q: q / np.linalg.norm(q))


def random_quaternions(*shape: int, seed: int = 0) -> np.ndarray:
    """Unit quaternions (*shape, 4), uniform over all rotations: normal deviates prefer no axis."""
    deviates = np.random.default_rng(seed).normal(size=(*shape, 4))
    return deviates / np.linalg.norm(deviates, axis=-1, keepdims=True)


def same_rotation(first: np.ndarray, second: np.ndarray, tolerance: float) -> bool:
    """Are two quaternions equal or opposite, within `tolerance` in each component?"""
    sign = np.sign(np.sum(first * second, axis=-1, keepdims=True))
    return np.allclose(first, sign * second, rtol=0, atol=tolerance)


def order_of(error: Callable[[float], float]) -> float:
    """Fitted exponent of a positive error as its argument shrinks from 2^-6 to 2^-10."""
    sizes = 2.0 ** -np.arange(6, 11)
    return float(np.polyfit(np.log(sizes), np.log([error(size) for size in sizes]), 1)[0])


def range_distribution(count: int) -> Callable[[np.ndarray], np.ndarray]:
    """Distribution of the range of `count` normal values of deviation one.

    SciPy integrates it anew at each place; between 1001 of them it is off by 4e-5 at most.
    """
    grid = np.linspace(0, 20, 1001)
    below = studentized_range(count, np.inf).cdf(grid)
    return lambda places: np.interp(places, grid, below)


def written(value: float, like: str, rounding: str) -> str:
    """A number as it would be written with as many decimals as `like`."""
    return str(Decimal(float(value)).quantize(Decimal(like), rounding))


def largest(values) -> float:
    """The largest size of any of the values."""
    return float(np.abs(values).max())


def printed_numbers(text: str) -> list[float]:
    """All numbers in what an example prints, nan and inf too; none of words such as two-step-4."""
    number = r"(?<![\w.-])-?(?:\d+\.?\d*(?:e[+-]?\d+)?|nan|inf)\b"
    return [float(found) for found in re.findall(number, text, re.IGNORECASE)]


def chi_bounds(count: int) -> np.ndarray:
    """Bounds of a mean of `count` squares of normal numbers, passed once in a million draws."""
    return chi2.ppf([0.5e-6, 1 - 0.5e-6], count) / count


def helper_modules() -> list[ModuleType]:
    """All modules of the helper: all but book, commands, SymPy, checks, cores, private ones."""
    names = (module.name for module in walk_packages(driftlab.__path__, "driftlab."))
    parts = ("book", "checks", "commands", "conftest", "core", "symbolic")
    apart = tuple(f"driftlab.{part}" for part in parts)
    return [
        import_module(name) for name in names if not name.startswith(apart) and "._" not in name
    ]


def replaced(arguments: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    """Arguments of a function with some of them changed; ``"a.b"`` is the field b of argument a."""
    changed = dict(arguments)
    for name, value in changes.items():
        argument, _, field = name.partition(".")
        changed[argument] = changed[argument]._replace(**{field: value}) if field else value
    return changed


def assert_normal(values, deviation):
    """Values (n, m): rows and columns independent, of mean zero and this standard deviation.

    Each bound is passed by chance once in a million draws; the seeds are fixed.
    """
    unit = values / deviation
    low, high = chi_bounds(len(unit))
    squares = (unit**2).mean(axis=0)
    assert (low < squares).all()
    assert (squares < high).all()
    # Means and correlations of n normal numbers have deviations of 1/sqrt(n); 4.9 of them.
    bound = 4.9 / np.sqrt(len(unit))
    assert (np.abs(unit.mean(axis=0)) < bound).all()
    products = unit.T @ unit / len(unit)
    assert (np.abs(products[np.triu_indices(unit.shape[1], 1)]) < bound).all()
    assert (np.abs((unit[1:] * unit[:-1]).mean(axis=0)) < bound).all()


def site_or_skip() -> Path:
    """Folder of a built site, which DRIFTLAB_SITE names; else the test is skipped."""
    folder = os.environ.get("DRIFTLAB_SITE")
    if not folder:
        pytest.skip("DRIFTLAB_SITE names no site that 'python3 lab.py site' built, as _site")
    return (ROOT / folder).resolve()


@cache
def recording_or_skip(name: str) -> Recording:
    """A published recording; without its file the test is skipped. Tests fetch nothing."""
    try:
        recording = published(name, download=False)
    except RecordingUnavailable as reason:
        pytest.skip(str(reason))
    for rows in (recording.gyro, recording.accelerometer):
        if rows is not None:
            rows.setflags(write=False)  # all tests share them
    return recording
