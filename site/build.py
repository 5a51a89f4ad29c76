"""Builds the site: ``python3 lab.py site`` runs this in an environment that has Sphinx.

The book is executed (`executed`), and from that come its pages (`reading`) and its PDF (`pdf`).
Beside the pages lie what makes them alive (`in_place`), the whole book live (`live`), which brings
Python for both, and copies for Colab (`colab`). One page names the `licences` of it all. Everything
is made in build/site and moved to ``_site`` when it is whole.
"""

from __future__ import annotations

import argparse
import shutil
import sys
from pathlib import Path

from addresses import PDF
from colab import make_colab
from executed import FOLDER, executed, published
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

    Without Node.js, or without a network at the first build, the pages are made all the same; they
    do not move then, and a sentence is printed. With Pyodide's `distribution` the site needs no
    network.
    """
    if distribution and not distribution.is_dir():
        raise Unfinished(f"--self-contained: expected a folder, got {distribution}.")
    reason = reason_not()
    if reason and distribution:
        raise Unfinished(reason)
    if reason:
        print(reason, file=sys.stderr)
    beside = {"colab", "pdf"} if reason else {"colab", "pdf", "in_place", "live"}
    notebooks = executed(published())
    pdf = BUILD / PDF  # first, for the pages say how large it is
    make_pdf(notebooks, BUILD, pdf)
    make_reading(notebooks, BUILD, made, beside, pdf.stat().st_size)
    shutil.move(pdf, made / PDF)
    make_colab(FOLDER, made / "colab")
    if not reason:
        make_in_place(made / "in_place")
        make_live(BUILD, made, distribution)
    write_licences(made)


def make_in_place(folder: Path) -> None:
    """Put what makes the pages alive beside them, with what exercises and puzzles ask."""
    shutil.copytree(HERE / "in_place", folder, ignore=shutil.ignore_patterns("__pycache__"))
    write_forms(folder)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
