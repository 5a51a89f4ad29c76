"""Prints chapters or the whole book as PDF: ``python3 lab.py print 03`` runs this.

Only the notebooks that are wanted are run, and what they gave is kept (`executed`).
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path, PurePosixPath

import nbformat

import examination
from addresses import PDF
from examination import print_examination
from executed import FOLDER, executed, notebooks
from pdf.contents import label
from pdf.make import Look, make_handout, make_pdf
from pdf.sheet import sheet
from unfinished import Unfinished

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build/site"
PRINTED = ROOT / "_print"


def main(arguments: list[str]) -> int:
    """Print what the command line says; the exit code."""
    parser = argparse.ArgumentParser(prog="lab.py print", usage="python3 lab.py help print")
    parser.add_argument("names", nargs="*")
    parser.add_argument("--no-code", dest="with_code", action="store_false")
    parser.add_argument("--exercises", dest="kind", action="store_const", const="exercises")
    parser.add_argument("--edition", help="of the examination: the text that its numbers are from")
    parser.add_argument("--paper", choices=("a4", "us-letter"), default="a4")
    options = parser.parse_args(arguments)
    look = Look(options.paper, options.with_code, options.kind or "notebook")
    names = options.names
    try:
        if options.edition is not None:
            if names:
                raise Unfinished("--edition prints the examination alone: name no chapter with it.")
            targets = print_examination(options.edition, BUILD, PRINTED, options.paper)
        else:
            targets = printed([found(name, notebooks()) for name in names], look)
        for target in targets:
            print(f"Printed: {target.relative_to(ROOT)}")
    except (Unfinished, ValueError) as trouble:
        print(trouble, file=sys.stderr)
        return 1
    return 0


def found(asked: str, names: list[str]) -> str:
    """Return the one name of a notebook that is meant."""
    asked = asked.removeprefix("notebooks/")
    meant = [name for name in names if name.removesuffix(".ipynb") == asked.removesuffix(".ipynb")]
    meant = meant or [name for name in names if asked and name.startswith(asked)]
    if len(meant) != 1:
        there = ", ".join(_short(name) for name in names if "/" not in name)
        raise Unfinished(
            f'{"More than one" if meant else "No"} notebook is called "{asked}"; there are '
            f"{there}, and solutions/01 and so on."
        )
    return meant[0]


def printed(names: list[str], look: Look) -> list[Path]:
    """Print notebooks, one file each, or the whole book if none is named; return the files."""
    how = "-exercises" if look.kind == "exercises" else "" if look.with_code else "-without-code"
    if not names:
        if look.kind == "exercises":
            raise Unfinished("Name the chapters whose exercises you want, as in: print 03 04.")
        target = PRINTED / f"{PurePosixPath(PDF).stem}{how}.pdf"
        make_pdf(executed(), BUILD, target, look)
        return [target]
    if examination.NAME in names:
        raise Unfinished(
            "The examination is printed as two files, so that the class does not get the scheme: "
            'print --edition "a term, and a word of your own".'
        )
    targets = []
    runs = {name: sheet(nbformat.read(FOLDER / name, as_version=4)) for name in names}  # type: ignore[no-untyped-call]
    for name, shown in (runs if look.kind == "exercises" else executed(names)).items():
        targets.append(PRINTED / f"{label(name)}{how}.pdf")
        make_handout(name, shown, BUILD, targets[-1], look)
    return targets


def _short(name: str) -> str:
    """A number if there is one, else the name."""
    return name[:2] if name[:2].isdigit() else name.removesuffix(".ipynb")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
