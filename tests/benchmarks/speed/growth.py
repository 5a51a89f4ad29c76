"""How time grows with the size of a problem, over four decades."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

import numpy as np
from scipy.stats import linregress, t

from driftlab.allan import allan_deviation
from driftlab.attitude.integration import integrate
from driftlab.drift import drift_per_turn, error_transition_matrix
from driftlab.gyrocompass import align
from driftlab.increments import Increments
from driftlab.quaternion import cumulative_product
from driftlab.strapdown import at_rest, navigate

from . import alignment, allan, attitude, drift, exponentials, navigation
from .measuring import Contender, Row, measure

SIZES = (100, 1000, 10_000, 100_000, 1_000_000)


class Slope(NamedTuple):
    """Exponent of a power law, with the ends of its 95 % interval."""

    exponent: float
    low: float
    high: float


@dataclass(frozen=True)
class Growth:
    """Median seconds at each size; `slope` over all, `last` over the last decade."""

    name: str
    sizes: np.ndarray
    seconds: np.ndarray

    @property
    def slope(self) -> Slope:
        return power_law(self.sizes, self.seconds)

    @property
    def last(self) -> float:
        return float(np.log10(self.seconds[-1] / self.seconds[-2]))


def power_law(sizes: np.ndarray, seconds: np.ndarray) -> Slope:
    """Least squares on logarithms."""
    line = linregress(np.log(sizes), np.log(seconds))
    half = float(t.ppf(0.975, len(sizes) - 2) * line.stderr)
    return Slope(float(line.slope), line.slope - half, line.slope + half)


def growths(repeats: int = 9) -> Iterator[Growth]:
    """Each after the other, the sizes of each in turn."""
    for name, make in _problems().items():
        largest, *smaller = (Contender(f"{n}", make(n)) for n in reversed(SIZES))
        result = measure(Row("growth", name, largest, smaller), repeats)
        times = [result.others[f"{n}"].median for n in SIZES[:-1]]
        yield Growth(name, np.array(SIZES), np.array([*times, result.ours.median]))


def _problems() -> dict[str, Callable[[int], Callable[[], object]]]:
    """Problems by name, each made for n increments, cases or samples."""

    def attitude_of(n: int) -> Callable[[], object]:
        return partial(integrate, attitude.cone(n)[0], attitude.DEFAULT)

    def products(n: int) -> Callable[[], object]:
        return partial(cumulative_product, attitude.cone(n)[1])

    def navigation_of(n: int) -> Callable[[], object]:
        # So short that a million of them are no more than a quarter of an hour.
        interval = 1e-3
        angle, velocity = np.zeros((n, 3)), np.tile([0.0, 0.0, 9.8 * interval], (n, 1))
        start = at_rest(navigation.LATITUDE, [0.0, 0.0, 0.0, 1.0])
        return partial(navigate, start, Increments(interval, angle, velocity))

    def exponentials_of(n: int) -> Callable[[], object]:
        return partial(error_transition_matrix, *exponentials.cases(n), 1.0)

    def drift_of(n: int) -> Callable[[], object]:
        return partial(drift_per_turn, *drift.cases(n))

    def alignment_of(n: int) -> Callable[[], object]:
        return partial(align, *alignment.cases(n)[1:])

    def allan_of(n: int) -> Callable[[], object]:
        return partial(allan_deviation, allan.record(n), allan.INTERVAL)

    return {
        "attitude from increments": attitude_of,
        "cumulative product": products,
        "navigation": navigation_of,
        "exponentials": exponentials_of,
        "drift after a turn": drift_of,
        "static alignment": alignment_of,
        "Allan deviation": allan_of,
    }
