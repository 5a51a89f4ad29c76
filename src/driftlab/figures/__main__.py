"""Rebuild every published figure and table: ``python -m driftlab.figures [--output FOLDER]``."""

import argparse
import sys
from pathlib import Path

from ..larin_table import NAMES, PRINTED, larin_table
from . import publish
from .catalogue import CATALOGUE


def main(folder: Path) -> None:
    """Write all figures, their numbers and the gallery; print Larin's table."""
    folder.mkdir(parents=True, exist_ok=True)
    total = len(CATALOGUE)
    gallery = ["# The figures of the book", "", publish.GALLERY_NOTE, ""]
    for done, entry in enumerate(CATALOGUE, start=1):
        gallery += publish.write_entry(entry, folder)
        bar = "#" * done + "." * (total - done)
        end = "\n" if done == total or not sys.stdout.isatty() else ""
        print(f"\r[{bar}] {done}/{total} {entry.name:<24}", end=end, flush=True)
    table = larin_table()
    publish.write_columns(folder / "04-larin-table.csv", {"name": NAMES, **table})
    (folder / "README.md").write_text("\n".join(gallery), encoding="utf-8", newline="\n")
    print(f"\nLarin's table, written to {folder / '04-larin-table.csv'}:\n")
    print(f"{'':10}{'printed':>14}{'reconstructed':>18}{'exact method':>18}")
    for row in zip(NAMES, PRINTED, table["reconstructed"], table["exact"], strict=True):
        print(f"{row[0]:10}{row[1]:>14}{row[2]:>18.6e}{row[3]:>18.6e}")
    print("\nThe printed sigma4* has lost its minus sign (chapter 4).")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="driftlab.figures", description=__doc__)
    parser.add_argument("--output", type=Path, default=Path("figures"), metavar="FOLDER")
    main(parser.parse_args().output)
