"""How fast the package is, beside its peers and a floor in C: python3 lab.py bench.

With subjects named, only these, on the terminal. Without, all of them, and speed.md and speed.svg
are written as well.
"""

import argparse
import os
import sys
import warnings
from pathlib import Path

from speed import allan, attitude, filtering, gyrocompass, navigation, program
from speed.measuring import Alone, Row, measure
from speed.page import Found, machine, page, tables, write_picture

HERE = Path(__file__).parent
SUBJECTS = {
    "attitude": ("Attitude", attitude.rows),
    "navigation": ("Navigation", navigation.rows),
    "filter": ("A filter's step", filtering.rows),
    "alignment": ("Alignment", gyrocompass.alignments),
    "gyrocompass": ("Gyrocompass", gyrocompass.rows),
    "allan": ("Allan deviation", allan.rows),
    "import": ("Import", program.imports),
    "redraw": ("Redraws of panels", program.redraws),
    "chapters": ("Chapters", program.chapters),
}


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


def main() -> None:
    options = arguments()
    # What peers' compilers and tables say of themselves would stand between the lines.
    warnings.filterwarnings("ignore")
    sys.stdout.reconfigure(line_buffering=True)
    here = machine(os.getloadavg()[0] if hasattr(os, "getloadavg") else 0.0)
    print(here)
    found: Found = {}
    for heading, rows in (SUBJECTS[name] for name in options.subjects or SUBJECTS):
        print(f"\n## {heading}\n")
        found[heading] = []
        for row in rows():
            found[heading].append(measure(row, options.repeats) if isinstance(row, Row) else row)
            if isinstance(row, Row):
                print(*tables(found[heading][-1:]))
        if isinstance(row, Alone):
            print(*tables(found[heading]))
    if not options.subjects and not options.no_write:
        (HERE / "speed.md").write_text(page(found, here), "utf-8", newline="\n")
        write_picture(found, HERE / "speed.svg")
        print(f"Written: {HERE / 'speed.md'} and speed.svg.")


if __name__ == "__main__":
    main()
