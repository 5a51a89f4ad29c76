"""How fast the package is, beside its peers and a floor in C: python3 lab.py bench.

With subjects named, only these, on the terminal. Without, all but "browser", which needs one and
takes long, and speed.md and speed.svg are written as well.
"""

import argparse
import os
import sys
import warnings
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

from speed import words
from speed.growth import Growth, growths
from speed.measuring import Result, measure, ratio
from speed.page import machine, page
from speed.plot import write_plot
from speed.verdicts import verdict

from driftlab.compilation import use_compiled

HERE = Path(__file__).parent
MODULES = {
    "attitude": "attitude",
    "exponentials": "exponentials",
    "navigation": "navigation",
    "filter": "filtering",
    "calibration": "calibration",
    "drift": "drift",
    "alignment": "alignment",
    "gyrocompass": "gyrocompass",
    "allan": "allan",
    "import": "imports",
    "redraw": "redraw",
    "chapters": "chapters",
}
SUBJECTS = (*MODULES, "growth", "browser")


def arguments(given: list[str] | None = None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="lab.py bench", description=__doc__)
    parser.add_argument("subjects", nargs="*", metavar="subject", help=", ".join(SUBJECTS))
    parser.add_argument(
        "--repeats", type=int, default=9, help="rounds of each row, else %(default)s"
    )
    parser.add_argument("--no-write", action="store_true", help="print only")
    options = parser.parse_args(given)
    if unknown := [name for name in options.subjects if name not in SUBJECTS]:
        parser.error(f"expected subjects among {', '.join(SUBJECTS)}; got {', '.join(unknown)}")
    if options.repeats < 3:
        parser.error(f"argument --repeats: expected at least 3, got {options.repeats}")
    return options


def results(subject: str, repeats: int) -> Iterator[Result]:
    """Rows of a subject, measured one after the other."""
    module = import_module(f"speed.{MODULES[subject]}")
    if hasattr(module, "results"):
        yield from module.results()
        return
    for row in module.rows():
        yield measure(row, repeats)


def tell(result: Result) -> None:
    row = result.row
    amount, name = row.each
    print(f"{row.subject}: {row.title}{f', for {name}' if name else ''}")
    for timing in (result.ours, *result.peers, *result.floor):
        against = "" if timing is result.ours else f"{words.times(ratio(timing, result.ours))} x"
        said = verdict(result, timing).replace("*", "") if timing in result.peers else ""
        print(
            f"  {timing.name:48} {words.time(timing.median / amount):>9}  {against:24} "
            f"{words.error(timing.error):>6}  {said}".rstrip()
        )
    for wanted in row.targets:
        print(f"  target: {words.target(result, wanted).replace('*', '')}")
    for sentence in row.left_out:
        print(f"  {sentence}")


def tell_growth(growth: Growth) -> None:
    slope = growth.slope
    print(
        f"growth: {growth.name:26} {slope.exponent:.2f} ({slope.low:.2f} to {slope.high:.2f}), "
        f"last decade {growth.last:.2f}"
    )


def write(found: list[Result], grown: list[Growth], load: float) -> None:
    write_plot(found, grown, HERE / "speed.svg")
    (HERE / "speed.md").write_text(page(found, grown, load), "utf-8", newline="\n")


def main() -> None:
    options = arguments()
    # What peers' compilers and tables say of themselves would stand between the lines.
    warnings.filterwarnings("ignore")
    load = os.getloadavg()[0] if hasattr(os, "getloadavg") else 0.0
    sys.stdout.reconfigure(line_buffering=True)
    print(machine(load))
    use_compiled(False)  # but in the rows that say so
    chosen = options.subjects or (*MODULES, "growth")
    found, grown = [], []
    whole = not options.subjects and not options.no_write
    for subject in (name for name in MODULES if name in chosen):
        for result in results(subject, options.repeats):
            tell(result)
            found.append(result)
        if whole:  # so that an interruption leaves what was measured
            write(found, grown, load)
    if "growth" in chosen:
        for growth in growths(options.repeats):
            tell_growth(growth)
            grown.append(growth)
    if whole:
        write(found, grown, load)
        print(f"Written: {HERE / 'speed.md'} and speed.svg.")
    if "browser" in chosen:
        import_module("speed.browser").latencies()


if __name__ == "__main__":
    main()
