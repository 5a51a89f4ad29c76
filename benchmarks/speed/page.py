"""The page of a run, its tables, and its picture."""

import os
import platform
import re
from datetime import date
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from textwrap import fill

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from .measuring import BY_NUMPY, Alone, Ratio, Result

_PACKAGES = (
    "numpy", "scipy", "numba", "python-ins", "ahrs", "numpy-quaternion", "filterpy", "allantools",
    "navtk",
)  # fmt: skip
_HEAD = """# How fast it is

Written by `python3 lab.py bench`; do not edit. {machine}

All contenders of a row are run in turn, round after round, so that a disturbance of the machine \
affects all of them alike. A time is the median over the rounds. *Times ours* is the median of \
the ratios within each round with its 95 % confidence interval (with the extremes if there were \
fewer than six rounds): above one, driftlab is faster. Errors are the largest deviations from an \
independent reference: a closed form, a finer integration, or NumPy's extended precision. Errors \
within a factor of two count as equal, and so do errors too small to matter. *The same in C* is \
the package's arithmetic in C; no program does less than *copy of the data*. The aims: to be \
faster than every peer that is as exact, and to take at most three times as long as C. Numba \
compiles long records by itself; rows of NumPy alone are for computers that it has no package for, \
and are not counted below.

![Times as multiples of ours](speed.svg)

## Where an aim is missed
"""
_UNITS = ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns"))

Found = dict[str, list[Result | Alone]]
"""What was measured, by heading."""


def page(found: Found, machine: str) -> str:
    """The whole page in Markdown."""
    missed = [
        f"- {heading}, {each.title}: {sentence}"
        for heading, results in found.items()
        for each in results
        for sentence in _missed(each)
    ]
    parts = [_HEAD.format(machine=machine), "\n".join(missed or ["Nowhere."]) + "\n"]
    for heading, results in found.items():
        parts += [f"## {heading}\n", *tables(results)]
    return "\n".join(parts).rstrip() + "\n"


def _missed(found: Result | Alone) -> list[str]:
    if isinstance(found, Alone):
        middle = float(np.median(found.seconds))
        return [] if middle <= found.most else [f"{time(middle)}, above {time(found.most)}."]
    return [
        f"{line.name} is {line.verdict.replace('*', '')}, {times(line.ratio)} times ours."
        f" {line.why}".rstrip()
        for line in found.lines
        if "*" in line.verdict and not found.title.endswith(BY_NUMPY)
    ]


def tables(results: list[Result | Alone]) -> list[str]:
    """Tables in Markdown, one for each row that was compared, or one for all that were not."""
    compared = [_compared(each) for each in results if isinstance(each, Result)]
    alone = [each for each in results if isinstance(each, Alone)]
    lines = ["| | median | wanted at most | 95 % below |", "| --- | ---: | ---: | ---: |"]
    for each in alone:
        middle, late = np.percentile(each.seconds, [50, 95])
        end = time(late) if each.seconds.size > 1 else ""
        lines.append(f"| {each.title} | {time(middle)} | {time(each.most)} | {end} |")
    return [*compared, *(["\n".join(lines) + "\n"] if alone else [])]


def _compared(result: Result) -> str:
    unit = f", {result.each}" if result.each else ""
    error_in = f", {result.error_in}" if result.error_in else ""
    lines = [
        f"### {result.title[:1].upper()}{result.title[1:]}\n",
        f"| | time{unit} | times ours | error{error_in} | |",
        "| --- | ---: | ---: | ---: | --- |",
    ]
    for line in result.lines:
        name = f"*{line.name}*" if line.floor else line.name
        against = "1" if line is result.lines[0] else times(line.ratio)
        error = "" if line.error is None else f"{line.error:.0e}" if line.error else "0"
        lines.append(f"| {name} | {time(line.seconds)} | {against} | {error} | {line.verdict} |")
    return "\n".join([*lines, "", *(f"{sentence}\n" for sentence in result.left_out)])


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
    return f"{digits(seconds / 1e-9)} ns"


def times(ratio: Ratio) -> str:
    """A ratio with its interval."""
    return f"{digits(ratio.median)} ({digits(ratio.low)} to {digits(ratio.high)})"


def machine(load: float) -> str:
    """Date, processor, system and versions in one sentence."""
    there = []
    for name in _PACKAGES:
        try:
            there.append(f"{name} {version(name)}")
        except PackageNotFoundError:
            continue
    cpuinfo, name = Path("/proc/cpuinfo"), platform.processor() or platform.machine()
    if cpuinfo.exists():
        lines = cpuinfo.read_text("utf-8").splitlines()
        name = next((line.split(": ")[1] for line in lines if line.startswith("model n")), name)
    cores = os.cpu_count() or 1
    said = (
        f"{date.today():%d %B %Y}, {name}, {cores} cores, {platform.system()}, "
        f"Python {platform.python_version()}, {', '.join(there)}."
    )
    busy = f" Other programs were running (load {load:.1f}): trust the ratios, not the times."
    return said + busy * (load > 0.5 * cores)


def write_picture(found: Found, path: Path) -> None:
    """Draw each row of computing that has others to compare with."""
    rows = [
        (f"{heading}: {each.title}", each.lines[1:])
        for heading, results in found.items()
        for each in results
        if isinstance(each, Result) and len(each.lines) > 1 and heading != "Import"
    ]
    with matplotlib.rc_context({"svg.hashsalt": "speed", "font.size": 8}):
        figure = Figure(figsize=(9.5, 0.36 * len(rows) + 0.8), layout="constrained")
        axes = figure.subplots()
        axes.axvline(1.0, color="black", linewidth=0.8)
        for height, (_, lines) in enumerate(rows):
            # Names above and below in turn, so that neighbours do not collide.
            for turn, line in enumerate(sorted(lines, key=lambda line: line.ratio.median)):
                ahead = "*" in line.verdict
                colour = "0.45" if line.floor else "#D55E00" if ahead else "#0072B2"
                marker = "|" if line.floor else "s" if ahead else "o"
                axes.plot(line.ratio[1:], [height, height], color=colour, linewidth=1)
                axes.plot(line.ratio.median, height, marker, color=colour, markersize=4)
                axes.annotate(
                    re.split("[ ,.]", line.name.removeprefix("the same in "))[0],
                    (line.ratio.median, height),
                    xytext=(0, -4 if turn % 2 else 4),
                    textcoords="offset points",
                    ha=("left", "center", "right", "center")[turn % 4],
                    va="top" if turn % 2 else "bottom",
                    fontsize=5.5,
                    color=colour,
                )
        axes.set_yticks(range(len(rows)), [fill(title, 58) for title, _ in rows])
        axes.set_ylim(len(rows) - 0.4, -0.8)
        axes.set_xscale("log")
        axes.set_xlabel(
            "time as a multiple of ours; blue: a peer behind us, red square: ahead, or more exact"
        )
        figure.savefig(path, metadata={"Date": None})
