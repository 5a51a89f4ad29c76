"""Times of several contenders, taken in turn, and their ratios.

Each round runs all contenders of a row once, one after the other: a disturbance of the machine
affects all of them, and the ratio of two times of one round hardly moves. asv, pyperf and
pytest-benchmark time each subject by itself, and compare no errors.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from importlib.util import find_spec
from time import perf_counter
from timeit import timeit
from typing import Any, NamedTuple

import numpy as np
from scipy.stats import quantile_test

from driftlab.core.loops import by_numpy_alone
from driftlab.quaternion import conjugate, multiply, rotation_angle

from . import floor

IN_C, BY_NUMPY = "the same in C", "NumPy alone"
_SHORTEST, _BUDGET, _LEAST_ROUNDS = 2e-3, 8.0, 3
"""Shorter calls (s) are timed several at once; a row ends after so many seconds, or rounds."""


@dataclass(frozen=True)
class Contender:
    """Something that computes the quantity of a row.

    `error` compares a result with an independent reference. `part` is the part of the work that
    one call does, if the whole would take too long; times are scaled up to the whole. `why` says
    why it may be faster.
    """

    name: str
    run: Callable[[], Any]
    error: Callable[[Any], float] | None = None
    part: float = 1.0
    why: str = ""


Maker = Callable[[], Contender]
"""Imports what a contender needs; the contender is left out where that is missing."""


@dataclass(frozen=True)
class Row:
    """One quantity, computed by this package, by its peers, and by a floor that does less."""

    title: str
    ours: Contender
    peers: Sequence[Maker] = ()
    floor: Sequence[Maker] = ()
    each: tuple[int, str] = (1, "")
    """How many of what one run makes: times are of one of them."""
    error_in: str = ""
    rounding: float = 0.0
    """Errors below this are equal: nobody would notice."""


class Ratio(NamedTuple):
    median: float
    low: float
    high: float


class Line(NamedTuple):
    """A contender as measured: seconds, times ours, error, what that says of a peer or of C."""

    name: str
    seconds: float
    ratio: Ratio
    error: float | None = None
    verdict: str = ""
    floor: bool = False
    why: str = ""


class Result(NamedTuple):
    """A row as measured. The first line is ours."""

    title: str
    lines: list[Line]
    each: str = ""
    error_in: str = ""
    left_out: Sequence[str] = ()


class Alone(NamedTuple):
    """Times (s) of something without contenders, and what their median should not exceed."""

    title: str
    seconds: np.ndarray
    most: float


def median_ratio(seconds: np.ndarray, unit: np.ndarray) -> Ratio:
    """Median of the ratios of rounds, and its 95 % interval: between two order statistics.

    Fewer than six rounds have no such interval: then the smallest and the largest.
    """
    ratios = seconds / unit
    low, high = quantile_test(ratios, p=0.5).confidence_interval(0.95)
    if np.isnan(low):
        low, high = ratios.min(), ratios.max()
    return Ratio(float(np.median(ratios)), float(low), float(high))


def verdict(ratio: Ratio, theirs: float | None, ours: float | None, rounding: float) -> str:
    """Compare a peer with ours; in bold unless ours is faster as exact, or more exact.

    Errors within a factor of two are equal: roundings differ that much.
    """
    exact = 0  # 1 where the peer is more exact
    if theirs is not None and ours is not None:
        theirs, ours = max(theirs, rounding), max(ours, rounding)
        exact = int(ours > 2 * theirs) - int(theirs > 2 * ours)
    said = "slower" if ratio.low > 1 else "faster" if ratio.high < 1 else "as fast"
    said += {-1: ", less exact", 0: "", 1: ", more exact"}[exact]
    return said if exact < 0 or said == "slower" else f"**{said}**"


def measure(row: Row, repeats: int = 9) -> Result:
    """Run all contenders of a row in turn, `repeats` times or until the budget is spent."""
    contenders, kinds, left_out = [row.ours], ["ours"], []
    for kind, makers in (("peer", row.peers), ("floor", row.floor)):
        for make in makers:
            try:
                contenders.append(make())
                kinds.append(kind)
            except ImportError as missing:
                left_out.append(f"Left out: {missing}.")
    warm = [_warmed(contender) for contender in contenders]
    rounds: list[list[float]] = []
    begin = perf_counter()
    while len(rounds) < repeats:
        spent = perf_counter() - begin
        if len(rounds) >= _LEAST_ROUNDS and spent * (1 + 1 / len(rounds)) > _BUDGET:
            break
        pairs = zip(contenders, warm, strict=True)
        rounds.append([timeit(one.run, number=n) / n / one.part for one, (n, _) in pairs])
    lines, times = [], np.transpose(rounds) / row.each[0]
    for each, kind, (_, error), seconds in zip(contenders, kinds, warm, times, strict=True):
        ratio, middle, said = median_ratio(seconds, times[0]), float(np.median(seconds)), ""
        if kind == "peer":
            said = verdict(ratio, error, warm[0][1], row.rounding)
        elif each.name == IN_C and 3 * ratio.median < 1:
            said = "**over 3 times faster**"
        lines.append(Line(each.name, middle, ratio, error, said, kind == "floor", each.why))
    return Result(row.title, lines, row.each[1], row.error_in, left_out)


def _warmed(contender: Contender) -> tuple[int, float | None]:
    """Calls that make one time, and the error; what compiles itself has done so afterwards."""
    begin = perf_counter()
    result = contender.run()
    took = perf_counter() - begin
    error = None if contender.error is None else float(contender.error(result))
    del result
    if took < 1:  # else one call makes a time either way, whether part of it was compiling or not
        took = timeit(contender.run, number=1)
    return max(1, int(_SHORTEST / max(took, 1e-7))), error


def copy_of(data: np.ndarray) -> Maker:
    """The least that any program does with its data."""
    return partial(Contender, "copy of the data", data.copy)


def in_c(run: Callable[[], Any], error: Callable[[Any], float] | None = None) -> Maker:
    """The same in C, left out where nothing compiles it."""

    def make() -> Contender:
        floor.library()
        return Contender(IN_C, run, error, why="Python's calls and checks take the rest.")

    return make


def and_by_numpy(row: Row) -> Iterator[Row]:
    """The row as a user has it, and once more by NumPy alone, if Numba is here."""

    def run() -> Any:
        with by_numpy_alone():
            return row.ours.run()

    yield row
    if find_spec("numba"):
        ours = replace(row.ours, name=f"driftlab, {BY_NUMPY}", run=run)
        yield replace(row, title=f"{row.title}, {BY_NUMPY}", ours=ours)


def largest_angle(found: np.ndarray, true: np.ndarray) -> float:
    """Largest angle in rad between attitudes (n, 4), whose norms do not count."""
    return float(rotation_angle(multiply(conjugate(true), found)).max())
