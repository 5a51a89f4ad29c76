"""Times, ratios and errors as a reader wants them."""

from .measuring import Ratio, Result, Target
from .verdicts import is_met, reached

_UNITS = ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns"))


def digits(value: float, count: int = 2) -> str:
    """A number with so many digits, never in powers of ten."""
    if value == 0:
        return "0"
    rounded = float(f"{value:.{count}g}")
    places = max(0, count - 1 - int(f"{rounded:e}".split("e")[1]))
    return f"{rounded:.{places}f}"


def time(seconds: float) -> str:
    """A time in the unit that suits it."""
    for size, unit in _UNITS:
        if seconds >= 0.9995 * size:
            return f"{digits(seconds / size, 3)} {unit}"
    return f"{digits(seconds / 1e-9, 2)} ns"


def times(ratio: Ratio) -> str:
    """A ratio with its interval."""
    return f"{digits(ratio.median)} ({digits(ratio.low)} to {digits(ratio.high)})"


def error(value: float | None) -> str:
    return "" if value is None else f"{value:.0e}" if value else "0"


def target(result: Result, wanted: Target) -> str:
    """What was wanted, what came, and whether that is enough."""
    found = reached(result, wanted)
    if wanted.than is None:
        aim, came = f"at most {time(wanted.most)}", time(result.ours.median)
    else:
        aim = f"at most {digits(wanted.most)} times {wanted.than}"
        came = "" if found is None else times(found)
    if found is None:
        return f"{aim}: **not held against it**, which is left out"
    return f"{aim}: {came}, {'met' if is_met(result, wanted) else '**missed**'}"
