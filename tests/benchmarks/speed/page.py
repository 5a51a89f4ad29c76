"""The page of a run: what is fast, what is slow, and where others are ahead."""

import os
import platform
from collections.abc import Iterable
from datetime import date
from importlib.metadata import PackageNotFoundError, version
from itertools import groupby
from pathlib import Path

import numpy as np

from . import words
from .growth import SIZES, Growth
from .measuring import Result, Timing, median_interval, ratio
from .verdicts import ahead_of, is_met, verdict

_PACKAGES = (
    "numpy", "scipy", "numba", "python-ins", "ahrs", "numpy-quaternion", "filterpy", "allantools",
    "navtk",
)  # fmt: skip
_SUBJECTS = {
    "attitude": "Attitude",
    "exponentials": "Exponentials",
    "navigation": "Navigation",
    "filter": "A filter's step",
    "calibration": "Whole calibrations",
    "drift": "Drift",
    "alignment": "Alignment",
    "gyrocompass": "Gyrocompass",
    "allan": "Allan deviation",
    "import": "Import",
    "redraw": "Redraws of panels",
    "chapters": "Chapters",
}
_HEAD = """# How fast it is

Written by `python3 lab.py bench`, never by hand. {machine}

All contenders of a row run in turn, again and again, so that what disturbs the machine for a \
while disturbs all of them. A time is the median of the rounds. *Times ours* is the median of \
the ratios of single rounds, with an interval that holds the true median with a chance of 95 % \
or more (the extremes, if there are fewer than six rounds): above one, we are faster. Errors are \
the largest found against an independent reference: a closed form, mpmath, or NumPy's longest \
floating point numbers. Two errors within a factor of two are called equal, and so are errors \
that no one would notice. A faster answer that is less exact is not ahead. *The same in C* is \
the package's arithmetic, compiled; a copy of the data is the least that any program does.

![Times as multiples of ours, and growth with size](speed.svg)
"""


def page(results: list[Result], growths: list[Growth], load: float) -> str:
    """The whole page in Markdown."""
    parts = [_HEAD.format(machine=machine(load)), _targets(results), _behind(results)]
    for subject, group in groupby(results, lambda result: result.row.subject):
        parts.append(f"## {_SUBJECTS[subject]}\n")
        together = list(group)
        if all(not result.others for result in together):
            parts.append(_alone(together))
        else:
            parts += [_compared(result) for result in together]
    parts.append(_growth(growths) if growths else "")
    there = {result.row.subject for result in results}
    if absent := [name.lower() for key, name in _SUBJECTS.items() if key not in there]:
        parts.append(f"This run was interrupted. Not measured: {', '.join(absent)}.")
    return "\n".join(parts).rstrip() + "\n"


def machine(load: float) -> str:
    """Processor, system, date and versions in a sentence each."""
    there = []
    for name in _PACKAGES:
        try:
            there.append(f"{name} {version(name)}")
        except PackageNotFoundError:
            continue
    cores = os.cpu_count() or 1
    busy = (
        f" Other programs ran meanwhile (load {load:.1f} at the start): "
        "believe the ratios, not the times."
        if load > 0.5 * cores
        else ""
    )
    return (
        f"{date.today():%d %B %Y}, {processor()}, {cores} cores, {platform.system()}, "
        f"Python {platform.python_version()}, {', '.join(there)}.{busy}"
    )


def processor() -> str:
    """The processor's name, where the system tells it."""
    try:
        lines = Path("/proc/cpuinfo").read_text("utf-8").splitlines()
    except OSError:
        lines = []
    named = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return (named or [platform.processor() or platform.machine()])[0]


def _targets(results: list[Result]) -> str:
    lines = ["## Targets\n", "| row | wanted | reached |", "| --- | --- | --- |"]
    for result in results:
        row = result.row
        title = f"{_SUBJECTS[row.subject]}: {row.title}"
        if result.peers:
            won = sum(ahead_of(result, peer) for peer in result.peers)
            met = "met" if won == len(result.peers) else "**missed**"
            came = f"{won} of {len(result.peers)}, {met}"
            lines.append(f"| {title} | ahead of every peer, as exact | {came} |")
        for wanted in row.targets if row.subject != "redraw" else []:
            aim, came = words.target(result, wanted).split(": ", 1)
            lines.append(f"| {title} | {aim} | {came} |")
    redraws = [result for result in results if result.row.subject == "redraw"]
    if redraws:
        good = sum(bool(is_met(each, aim)) for each in redraws for aim in each.row.targets)
        aim = words.time(redraws[0].row.targets[0].most)
        met = "met" if good == len(redraws) else "**missed**"
        lines.append(
            f"| {_SUBJECTS['redraw']} | median at most {aim} | {good} of {len(redraws)}, {met} |"
        )
    return "\n".join(lines) + "\n"


def _behind(results: list[Result]) -> str:
    lines = [
        f"- {_SUBJECTS[result.row.subject]}, {result.row.title}: {peer.name} is "
        f"{verdict(result, peer).replace('*', '')}, "
        f"{words.times(ratio(peer, result.ours))} times ours."
        for result in results
        for peer in result.peers
        if not ahead_of(result, peer)
    ]
    head = "## Where others are ahead\n"
    return "\n".join([head, *(lines or ["Nowhere, among those that were there."])]) + "\n"


def _compared(result: Result) -> str:
    row = result.row
    amount, name = row.each
    unit = f", {name}" if name else ""
    lines = [
        f"### {row.title[:1].upper()}{row.title[1:]}\n",
        f"| | time{unit} | times ours | error{', ' + row.error_in if row.error_in else ''} | |",
        "| --- | ---: | ---: | ---: | --- |",
        _line(result.ours.name, result.ours, result, "", amount),
        *(_line(peer.name, peer, result, verdict(result, peer), amount) for peer in result.peers),
        *(_line(f"*{each.name}*", each, result, "", amount) for each in result.floor),
        "",
        *(f"Target: {words.target(result, wanted)}.\n" for wanted in row.targets),
        *(f"{sentence}\n" for sentence in row.left_out),
    ]
    return "\n".join(lines)


def _line(name: str, timing: Timing, result: Result, verdict: str, amount: float) -> str:
    against = "1" if timing is result.ours else words.times(ratio(timing, result.ours))
    return (
        f"| {name} | {words.time(timing.median / amount)} | {against} | "
        f"{words.error(timing.error)} | {verdict} |"
    )


def _alone(results: Iterable[Result]) -> str:
    lines = ["| | median | its interval | 95 % below | |", "| --- | ---: | ---: | ---: | --- |"]
    sentences = []
    for result in results:
        seconds = result.ours.seconds
        low, high = median_interval(seconds)
        many = len(seconds) > 1
        met = ["met" if is_met(result, aim) else "**missed**" for aim in result.row.targets]
        lines.append(
            f"| {result.row.title} | {words.time(result.ours.median)} | "
            f"{f'{words.time(low)} to {words.time(high)}' if many else ''} | "
            f"{words.time(float(np.percentile(seconds, 95))) if many else ''} | {''.join(met)} |"
        )
        sentences += result.row.left_out
    return "\n".join([*lines, "", *(f"{each}\n" for each in dict.fromkeys(sentences))])


def _growth(growths: list[Growth]) -> str:
    heads = " | ".join(f"{n}" for n in SIZES)
    lines = [
        "## Growth with size\n",
        "The exponent of a power law through all sizes, with its 95 % interval, and that of the "
        "last decade alone: 1 is in proportion. At small sizes most of the time are calls and "
        "checks, which do not grow.\n",
        f"| | {heads} | exponent | last decade |",
        f"| --- |{' ---: |' * (len(SIZES) + 2)}",
    ]
    for each in growths:
        slope = each.slope
        cells = " | ".join(words.time(seconds) for seconds in each.seconds)
        lines.append(
            f"| {each.name} | {cells} | "
            f"{slope.exponent:.2f} ({slope.low:.2f} to {slope.high:.2f}) | {each.last:.2f} |"
        )
    return "\n".join(lines)
