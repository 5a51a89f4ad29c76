"""Builds the site: ``python3 lab.py site`` runs this in an environment that has Sphinx.

The book is executed (`executed`), and from that come its pages (`reading`) and its PDF (`pdf`).
Beside the pages lie what makes them alive (`in_place`) and the whole book live (`live`), which
brings Python for both. One page names the `licences` of it all. Everything is made in build/site
and moved to ``_site`` when it is whole.
"""

from __future__ import annotations

import argparse
import shutil
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from addresses import PDF
from executed import executed, published
from forms import write_forms
from licences import write_licences
from live.make import make_live, reason_not
from pdf.make import make_pdf
from reading.make import make_reading
from unfinished import Unfinished

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
BUILD = ROOT / "build/site"
SITE = ROOT / "_site"


def main(arguments: list[str]) -> int:
    """Make the site; the exit code."""
    parser = argparse.ArgumentParser(prog="lab.py site", usage="python3 lab.py help site")
    parser.add_argument("--self-contained", type=Path, metavar="FOLDER")
    distribution: Path | None = parser.parse_args(arguments).self_contained
    made = BUILD / "html"
    shutil.rmtree(made, ignore_errors=True)
    try:
        make_site(made, distribution)
    except Unfinished as trouble:
        print(trouble, file=sys.stderr)
        return 1
    shutil.rmtree(SITE, ignore_errors=True)
    shutil.move(made, SITE)
    print(f"The site is ready: python3 -m http.server --directory {SITE.relative_to(ROOT)}")
    return 0


def make_site(made: Path, distribution: Path | None) -> None:
    """Make the whole site in a folder, which is not there yet.

    With Pyodide's `distribution` the site needs no network.
    """
    if distribution and not distribution.is_dir():
        raise Unfinished(f"--self-contained: expected a folder, got {distribution}.")
    if reason := reason_not():
        raise Unfinished(reason)
    with ThreadPoolExecutor(1) as at_once:  # what takes long of it are other programs
        live = at_once.submit(make_live, BUILD, made, distribution)
        notebooks = executed(published())
        pdf = BUILD / PDF  # first, for the pages say how large it is
        make_pdf(notebooks, BUILD, pdf)
        make_reading(notebooks, BUILD, made, pdf.stat().st_size)
        shutil.move(pdf, made / PDF)
        live.result()
    make_in_place(made / "in_place")
    write_licences(made)


def make_in_place(folder: Path) -> None:
    """Put what makes the pages alive beside them, with what exercises and puzzles ask."""
    shutil.copytree(HERE / "in_place", folder, ignore=shutil.ignore_patterns("__pycache__"))
    write_forms(folder)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
