"""What is written from the book: ``python -m driftlab.book figures``, ``errata``, ``class`` ..."""

from __future__ import annotations

import argparse
import io
import os
import shutil
import sys
from collections.abc import Callable, Iterable, Mapping
from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from joblib import parallel_config
from tqdm import tqdm

import driftlab
from driftlab.checks import whole_number
from driftlab.core.loops import by_numpy_alone
from driftlab.monte_carlo import FOLDER

from .ch04_calibration_by_turns.experiment_numbers import IN_THE_COPY, NAMES, experiment_numbers
from .errata import errata, papers_page
from .figures import figure_definitions, measured, not_at_hand, published_paths
from .machinery.figure.csv_table import as_words, write_table
from .machinery.figure.publish import FigureDefinition, PublishedFigure, captions_in, gallery
from .machinery.figure.table_differences import Difference, folder_differences

PROJECT = Path(__file__).parents[3]
AT_HOME = (PROJECT / "lab.py").is_file()
"""Is this the project's folder? An installed package has no place of its own to write to."""
LARIN_NUMBERS = "04-larin-numbers"
LARIN_NOTE = [
    "04-larin-numbers: the seven numbers of Larin's experiment as the copy has them, by the method "
    "without error of integration, and reconstructed. Without unit.",
    f"made by: driftlab {driftlab.__version__}, "
    "driftlab.book.ch04_calibration_by_turns.experiment_numbers.experiment_numbers(); "
    "text and numbers CC BY 4.0",
]


def write_gallery(folder: Path, definitions: Mapping[str, FigureDefinition]) -> None:
    """Write figures, their numbers and the page that shows them; print Larin's numbers."""
    captions = write_figures(folder, definitions)
    _write_page(folder, captions)
    write_larin_numbers(folder)


def _write_page(folder: Path, captions: Mapping[str, str]) -> None:
    (folder / "README.md").write_text(gallery(captions), encoding="utf-8", newline="\n")


def write_figures(folder: Path, definitions: Mapping[str, FigureDefinition]) -> dict[str, str]:
    """Write figures and their numbers; return their captions.

    A figure whose recording is not at hand keeps its published files.
    """
    folder.mkdir(parents=True, exist_ok=True)
    captions, kept = {}, []
    for name, definition in tqdm(definitions.items(), unit="figure"):
        missing = not_at_hand(definition)
        data = measured(name) if missing else definition.compute()
        captions[name] = definition.caption(data)
        if missing:
            kept.append(name)
            _copy(published_paths(name), folder)
        else:
            PublishedFigure(definition, data, definition.parameters).write(folder)
    if kept:
        print(f"\nKept as published, because their recordings are not at hand: {', '.join(kept)}.")
    return captions


def write_larin_numbers(folder: Path) -> None:
    """Write Larin's seven numbers, and print them."""
    table = experiment_numbers()
    numbers = as_words({"name": NAMES, **table})
    write_table(folder / f"{LARIN_NUMBERS}.csv", numbers, LARIN_NOTE)
    print(f"\nLarin's numbers, written to {folder / LARIN_NUMBERS}.csv:\n")
    print(f"{'':10}{'the copy':>14}{'reconstructed':>18}{'exact method':>18}")
    rows = (NAMES, IN_THE_COPY, table["reconstructed"], table["exact"])
    for name, copy, reconstructed, exact in zip(*rows, strict=True):
        print(f"{name:10}{copy:>14}{reconstructed:>18.6e}{exact:>18.6e}")
    print("\nReconstructed with a minus sign before sigma4* (chapter 4).")


def write_figures_on(
    folder: Path,
    chosen: Mapping[str, FigureDefinition | None] | None,
    workers: int | None,
    scheduler: str | None,
    keep: Path | None,
) -> None:
    """Write all figures, or some, the many runs of their studies on all cores or on a cluster."""
    with ExitStack() as places:
        places.enter_context(by_numpy_alone())  # the digits that are published
        try:
            if keep is not None:
                keep.mkdir(parents=True, exist_ok=True)
                os.environ[FOLDER] = str(keep)
                places.callback(os.environ.pop, FOLDER)
            if scheduler is not None:
                places.enter_context(_cluster(scheduler))
                places.enter_context(parallel_config("dask"))
            elif workers != 1:
                count = -1 if workers is None else whole_number(workers, "workers")
                places.enter_context(parallel_config("loky", n_jobs=count, inner_max_num_threads=1))
        except (ValueError, OSError, ModuleNotFoundError) as error:
            sys.exit(str(error))
        if chosen is None:
            write_gallery(folder, figure_definitions())
            return
        figures = {name: each for name, each in chosen.items() if each is not None}
        captions = write_figures(folder, figures)
        if (page := folder / "README.md").is_file():  # those of the other figures stay
            captions = captions_in(page.read_text(encoding="utf-8")) | captions
            _write_page(
                folder, {name: captions[name] for name in figure_definitions() if name in captions}
            )
        if LARIN_NUMBERS in chosen:
            write_larin_numbers(folder)


def _cluster(scheduler: str) -> Any:
    """The client of a cluster of dask, which joblib finds."""
    try:
        from distributed import Client
    except ModuleNotFoundError:
        raise ModuleNotFoundError(
            "scheduler: dask.distributed is not installed; pip install driftlab[cluster]."
        ) from None
    return Client(scheduler)


def write_figures_or_compare(
    compare: bool, folder: Path, beginnings: list[str], **where: Any
) -> None:
    """Write all figures of the book, or some, or compare their numbers with those published."""
    chosen = figures_that_begin(beginnings) if beginnings else None
    if not compare:
        write_figures_on(folder, chosen, **where)
        return
    with TemporaryDirectory() as anew:
        write_figures_on(Path(anew), chosen, **where)
        tables = {path.name for path in Path(anew).glob("*.csv")}
        if not tables:
            print("\nThese are pictures only: there are no numbers to compare.")
            return
        try:
            found = folder_differences(folder, Path(anew), tables if beginnings else None)
        except ValueError as error:
            sys.exit(str(error))
    print(f"\n{told(found, len(tables))}")
    if not all(each.only_rounding for differences in found.values() for each in differences):
        sys.exit(1)


def figures_that_begin(beginnings: list[str]) -> dict[str, FigureDefinition | None]:
    """Return the figures whose names begin in one of these ways, as "03" or "03-drift-map".

    Larin's numbers are a table without a figure.
    """
    every: dict[str, FigureDefinition | None] = {**figure_definitions(), LARIN_NUMBERS: None}
    if strange := [each for each in beginnings if not any(map(_begins(each), every))]:
        sys.exit(
            f"figures: expected names, or how they begin, got {', '.join(strange)}. "
            f"There are {', '.join(every)}."
        )
    chosen = {name for each in beginnings for name in filter(_begins(each), every)}
    return {name: definition for name, definition in every.items() if name in chosen}


def _begins(beginning: str) -> Callable[[str], bool]:
    return lambda name: name.startswith(beginning)


def told(found: Mapping[str, list[Difference]], count: int) -> str:
    """Return what two folders of so many tables say of each other."""
    lines = [f"{count - len(found)} of {count} tables are the same to the last digit."]
    for name, differences in found.items():
        rounding = all(each.only_rounding for each in differences)
        lines.append(f"{name}: {'last digits, by rounding' if rounding else 'OTHER NUMBERS'}")
        lines += [f"  {each}" for each in differences]
    return "\n".join(lines)


def _copy(paths: Iterable[Path], folder: Path) -> None:
    """Copy files into a folder, unless it is their own."""
    for path in paths:
        if path.parent.resolve() != folder.resolve():
            shutil.copyfile(path, folder / path.name)


def write_errata(file: Path) -> None:
    """Write what the copies of the papers have wrong, from the ledger."""
    _write(errata(), file)


def write_papers(file: Path) -> None:
    """Write where the book has each figure and equation of the papers, from the ledger."""
    _write(papers_page(), file)


def _write(text: str, file: Path) -> None:
    file.write_text(text, encoding="utf-8", newline="\n")
    print(f"Written: {file}")


def write_class_report(folder: Path, chapters: str | None, output: Path | None) -> None:
    """Print what a class got wrong in its notebooks, and write it as a page and as CSV."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):  # a terminal may lack letters of a name
            stream.reconfigure(errors="backslashreplace")
    try:
        from driftlab.book import class_report

        report = class_report(folder, chapters)
        place = folder.resolve()
        written = report.write(output or place.with_name(f"{place.name}-report"))
    except (ValueError, OSError, ModuleNotFoundError) as error:
        sys.exit(str(error))
    print(f"{report}\n\nWritten: {written}")


def write_questions(folder: Path, students: int) -> None:
    """Write the exercises as a question bank for Moodle and for Canvas."""
    try:
        from .instructors.question_bank import write_question_bank
    except ModuleNotFoundError:
        raise SystemExit("A student's copy of the book makes no question bank.") from None
    write_question_bank(folder, students=students)


def main() -> None:
    """Do what the command line says."""
    parser = argparse.ArgumentParser(prog="python -m driftlab.book", description=__doc__)
    commands = parser.add_subparsers(required=True)
    a_class = commands.add_parser("class", help=write_class_report.__doc__)
    a_class.add_argument("folder", type=Path, help="the notebooks, in folders of any kind")
    a_class.add_argument("--chapters", metavar="03,04", help="exercises of these chapters only")
    a_class.add_argument("--output", "-o", type=Path, help="else FOLDER-report, next to it")
    a_class.set_defaults(write=write_class_report)
    bank = commands.add_parser("questions", help=write_questions.__doc__)
    bank.add_argument("folder", type=Path, help="where to write it")
    bank.add_argument(
        "--students", type=int, default=20, help="variants, where students can have their own"
    )
    bank.set_defaults(write=write_questions)
    drawn = commands.add_parser("figures", help=write_figures_or_compare.__doc__)
    drawn.add_argument(
        "beginnings", nargs="*", metavar="name", help='as "03", or "03-drift-map"; all if none'
    )
    drawn.add_argument("--workers", type=int, help="processes; one for each core if not")
    drawn.add_argument("--scheduler", help="of a cluster of dask: its address")
    drawn.add_argument("--keep", type=Path, help="a folder for finished runs, not to be repeated")
    drawn.add_argument(
        "--compare", action="store_true", help="write nothing, but say which numbers differ"
    )
    drawn.set_defaults(write=write_figures_or_compare)
    wrong = commands.add_parser("errata", help=write_errata.__doc__)
    wrong.set_defaults(write=write_errata)
    places = commands.add_parser("papers", help=write_papers.__doc__)
    places.set_defaults(write=write_papers)
    for command, what, default in (
        (drawn, "folder", "figures"),
        (wrong, "file", "ERRATA.md"),
        (places, "file", "docs/papers.md"),
    ):
        command.add_argument(
            *("--output", "-o"),
            dest=what,
            type=Path,
            default=PROJECT / default if AT_HOME else None,
            required=not AT_HOME,
            help="where to write it; the project's own place if it is run there",
        )
    options = vars(parser.parse_args())
    options.pop("write")(**options)


if __name__ == "__main__":
    main()
