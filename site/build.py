"""Builds the site: ``python3 lab.py site`` runs this in an environment that has Sphinx.

The book is executed (`executed`), and from that come its pages (`reading`). Everything is made in
build/site and moved to ``_site`` when it is whole.
"""

from __future__ import annotations

import argparse
import shutil
import sys
from pathlib import Path

from executed import executed
from reading.make import Unfinished, make_reading

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build/site"
SITE = ROOT / "_site"


def main(arguments: list[str]) -> int:
    """Make the site; the exit code."""
    parser = argparse.ArgumentParser(prog="lab.py site", usage="python3 lab.py --help")
    parser.parse_args(arguments)
    notebooks = executed()
    made = BUILD / "html"
    shutil.rmtree(made, ignore_errors=True)
    try:
        make_reading(notebooks, BUILD, made)
    except Unfinished as trouble:
        print(trouble, file=sys.stderr)
        return 1
    shutil.rmtree(SITE, ignore_errors=True)
    shutil.move(made, SITE)
    print(f"The site is ready: open {SITE / 'index.html'}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
