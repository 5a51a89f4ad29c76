"""Times of several contenders, taken in turn, and the ratios of what belongs together.

Each round runs all contenders of a row once, one after the other: what disturbs the machine for a
while disturbs all of them, and the ratio of two times of one round hardly moves.
"""

import gc
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cached_property
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np
from scipy.stats import binom

_SHORTEST = 2e-3
"""s: calls that take less are timed several at once."""
_LEAST_ROUNDS = 3
"""However long they take."""
EQUAL = 2.0
"""Errors whose ratio is less than this are equal: roundings differ that much."""


@dataclass(frozen=True)
class Contender:
    """Something that computes the quantity of a row.

    `part` is the part of the work that one call does, for what is too slow for the whole; times are
    scaled up to the whole. `error` is how far its result is from an independent reference.
    """

    name: str
    run: Callable[[], Any]
    error: Callable[[Any], float] | None = None
    part: float = 1.0


class Target(NamedTuple):
    """What ours should reach: at most so many times the time of another, or so many seconds."""

    most: float
    than: str | None = None


@dataclass(frozen=True)
class Row:
    """One quantity, computed by this package, by others, and by a floor that computes less."""

    subject: str
    title: str
    ours: Contender
    peers: list[Contender] = field(default_factory=list)
    floor: list[Contender] = field(default_factory=list)
    targets: list[Target] = field(default_factory=list)
    left_out: list[str] = field(default_factory=list)
    each: tuple[float, str] = (1, "")
    """How many of what one run makes: times are of one of them."""
    error_in: str = ""
    rounding: float = 0.0
    """Errors below this are equal: nobody would notice."""


@dataclass(frozen=True)
class Timing:
    """Seconds of each round for the whole work of a row, and the error."""

    name: str
    seconds: np.ndarray
    error: float | None = None

    @property
    def median(self) -> float:
        return float(np.median(self.seconds))


class Ratio(NamedTuple):
    """Median of the ratios of the rounds, and an interval that holds the true median."""

    median: float
    low: float
    high: float


@dataclass(frozen=True)
class Result:
    """A row with its times, in the order ours, peers, floor."""

    row: Row
    ours: Timing
    peers: list[Timing] = field(default_factory=list)
    floor: list[Timing] = field(default_factory=list)

    @cached_property
    def others(self) -> dict[str, Timing]:
        return {timing.name: timing for timing in (*self.peers, *self.floor)}


def median_interval(values: np.ndarray, confidence: float = 0.95) -> tuple[float, float]:
    """Order statistics between which the median of the distribution lies, whatever it is.

    Below six values no two of them reach 95 %: then the smallest and the largest.
    """
    ordered = np.sort(values)
    count = len(ordered)
    tails = binom.cdf(np.arange(count), count, 0.5)
    cut = max(0, int(np.searchsorted(tails, (1 - confidence) / 2, side="right")) - 1)
    return float(ordered[cut]), float(ordered[count - 1 - cut])


def ratio(time: Timing, unit: Timing) -> Ratio:
    """How many times as long one takes as another, round by round."""
    ratios = time.seconds / unit.seconds
    return Ratio(float(np.median(ratios)), *median_interval(ratios))


def measure(row: Row, repeats: int = 9, budget: float = 8.0) -> Result:
    """Run all contenders of a row in turn, `repeats` times or until the budget (s) is spent."""
    contenders = [row.ours, *row.peers, *row.floor]
    warm = [_warmed(contender) for contender in contenders]
    rounds: list[list[float]] = []
    begin = perf_counter()
    with _quiet():
        while len(rounds) < repeats:
            spent = perf_counter() - begin
            if len(rounds) >= _LEAST_ROUNDS and spent * (1 + 1 / len(rounds)) > budget:
                break
            rounds.append([
                _seconds(contender.run, calls) / contender.part
                for contender, (calls, _) in zip(contenders, warm, strict=True)
            ])  # fmt: skip
    timings = [
        Timing(contender.name, np.array(seconds), error)
        for contender, (_, error), seconds in zip(
            contenders, warm, np.transpose(rounds), strict=True
        )
    ]
    first_floor = 1 + len(row.peers)
    return Result(row, timings[0], timings[1:first_floor], timings[first_floor:])


def _warmed(contender: Contender) -> tuple[int, float | None]:
    """Calls that make one time, and the error; what compiles itself has done so afterwards."""
    begin = perf_counter()
    result = contender.run()
    first = perf_counter() - begin
    error = None if contender.error is None else float(contender.error(result))
    del result
    # What is slow at first may have compiled itself, or not; one call makes a time either way.
    again = first if first > 1 else _seconds(contender.run, 1)
    return max(1, int(_SHORTEST / max(again, 1e-7))), error


def _seconds(run: Callable[[], Any], calls: int) -> float:
    begin = perf_counter()
    for _ in range(calls):
        run()
    return (perf_counter() - begin) / calls


@contextmanager
def _quiet() -> Iterator[None]:
    """No garbage collection meanwhile."""
    gc.collect()
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()
