"""Breaks each numerical module and sees whether its tests notice: python3 lab.py mutate.

Of the breaks of a module (break_part.py) a seeded sample is drawn. Each is run in a forked
process, which imports the package with that one break from memory; the tests that execute the
broken lines run first, and the first failure ends it. Finished breaks are kept in a folder and
are not run again while the module stays as it is; with --again those, and only those, that
survived without a reason in survivors.toml are, after new tests. Without modules named, all, and
tests/mutations/mutations.md is written anew from all that is kept. Linux and macOS only: it forks.

Why not mutmut or cosmic-ray? cosmic-ray 8.7 writes each break into the source, starts a new
pytest for it, and breaks neither arguments nor functions; mutmut 3.8
leaves properties, other decorated functions, and constants of modules alone, many of which
calculate here. Neither draws a sample. What coverage.py does well is left to it.
"""

import argparse
import hashlib
import json
import sys
import time
from collections.abc import Iterator, Sequence
from importlib import import_module
from itertools import islice
from multiprocessing import Pipe
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from pathlib import Path
from tempfile import TemporaryDirectory
from types import CodeType
from typing import NamedTuple

import pytest
from break_part import Break, breaks, broken_code, line_before_and_after
from broken_run import run_broken
from clean_run import run_clean
from kept_breaks import HUNG, Kept, Tried, digest
from mutations_page import REASONS, reasons, write_page
from numerical_parts import numerical_parts, path_of
from quietly import ARGUMENTS, PACKAGE, ROOT, compile_elsewhere, end, forked
from tests_of_lines import FileOfTests, covered, plan, record_of, test_files

FOLDER = ROOT / ".mutations"
"""Of the first seed; another one has its own, so that a page shows one sample."""
BREAKS = 40
PATIENCE = 40.0
"""Processor time of a clean run of the tests that one break is given."""
_SLOWEST = 900.0
"""Seconds after which a run is given up, whatever it does: it hangs."""


class Task(NamedTuple):
    """A break and what is to be run against it."""

    module: str
    change: Break
    code: CodeType
    tests: list[FileOfTests]
    complete: bool
    """Whether these are all tests that execute its lines."""


def arguments(given: list[str] | None = None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="lab.py mutate", description=__doc__)
    parser.add_argument("modules", nargs="*", metavar="module", help='such as "core.quaternion"')
    parser.add_argument(
        "--breaks", type=int, default=BREAKS, help="of each module, else %(default)s"
    )
    parser.add_argument(
        "--seed", type=int, default=0, help="%(default)s, or another one, which draws other breaks"
    )
    parser.add_argument("--workers", type=int, default=1, help="processes, else %(default)s")
    parser.add_argument(
        "--patience", type=float, default=PATIENCE, help="seconds for one break, else %(default)s"
    )
    parser.add_argument(
        "--again", action="store_true", help="run only what survived without a reason"
    )
    parser.add_argument("--page", action="store_true", help="only write the page from what is kept")
    parser.add_argument(
        "--folder",
        type=Path,
        help=f"where results are kept, else {FOLDER.name}, with another seed {FOLDER.name}-SEED",
    )
    options = parser.parse_args(given)
    if options.folder is None:
        options.folder = FOLDER.with_name(
            FOLDER.name + (f"-{options.seed}" if options.seed else "")
        )
    names = numerical_parts()
    if unknown := [name for name in options.modules if name not in names]:
        parser.error(f"expected modules among {', '.join(names)}; got {', '.join(unknown)}")
    for name in ("breaks", "workers"):
        if getattr(options, name) < 1:
            parser.error(f"argument --{name}: expected at least 1")
    return options


def sample(module: str, source: str, options: argparse.Namespace) -> list[Break]:
    """So many breaks that do something else; a larger sample begins with the smaller one."""

    def place(change: Break) -> bytes:
        # By what the line says, so that a change elsewhere draws no others.
        said = line_before_and_after(source, change)
        return hashlib.sha256(repr((options.seed, module, change.kind, *said)).encode()).digest()

    path = str(path_of(module))
    drawn = sorted(breaks(source), key=place)
    return list(islice((each for each in drawn if broken_code(source, each, path)), options.breaks))


def run_files(folder: Path, workers: int) -> None:
    """Run all tests once without a break, for their times and for what they execute."""
    tasks = []
    for tests in test_files():
        data, times = record_of(tests, folder)
        if not times.exists():
            tasks.append((tests, data, times))
    running: dict[BaseProcess, str] = {}
    for tests, data, times in tasks:
        running[forked(run_clean, tests, data, times)] = tests
        while len(running) >= workers or (running and tests == tasks[-1][0]):
            wait([process.sentinel for process in running])
            for process in [each for each in running if not each.is_alive()]:
                end(process)
                print(f"clean: {running.pop(process)}")


def bring_in(folder: Path) -> None:
    """Import all that tests import, but not what is broken or tested: forks then have it."""
    listed = folder / "imported.json"
    process = forked(list_imported, test_files(), listed)
    process.join()
    for name in json.loads(listed.read_text("utf-8")):
        try:
            import_module(name)
        except Exception:  # a part that only another one may import
            continue


def list_imported(tests: Sequence[str], listed: Path) -> None:
    pytest.main([*ARGUMENTS, "--collect-only", *tests])
    own = ("driftlab", "tests", "conftest", "support", "__")
    names = []
    for name, module in sys.modules.items():
        file = getattr(module, "__file__", None)
        if file and not Path(file).is_relative_to(ROOT) and not name.startswith(own):
            names.append(name)
    listed.write_text(json.dumps(names), "utf-8")


def try_all(tasks: Iterator[Task], kept: Kept, workers: int) -> None:
    """Run breaks, so many at a time, and keep what became of each."""
    running: dict[BaseProcess, tuple[Task, Connection, float]] = {}
    more = True
    while more or running:
        while more and len(running) < workers:
            task = next(tasks, None)
            if task is None:
                more = False
                break
            ours, theirs = Pipe(duplex=False)
            process = forked(run_broken, task.module, task.code, task.tests, theirs)
            theirs.close()
            running[process] = task, ours, time.monotonic()
        wait([process.sentinel for process in running], timeout=5)
        for process, (task, answer, begun) in list(running.items()):
            spent = time.monotonic() - begun
            if process.is_alive() and spent < _SLOWEST:
                continue
            end(process)
            del running[process]
            kept.add(outcome(task, answer, spent))


def outcome(task: Task, answer: Connection, spent: float) -> Tried:
    """What became of a break. What does not answer was ended by its time limit, or crashed."""
    try:
        failed = answer.recv() if answer.poll() else HUNG
    except EOFError:
        failed = HUNG
    return Tried.of(
        task.module, task.change, failed,
        tests=sum(len(each.seconds) for each in task.tests), complete=task.complete, seconds=spent,
    )  # fmt: skip


def is_sound(module: str, task: Task) -> str:
    """What fails without any break, in the same way of running; empty if all is well."""
    path = path_of(module)
    code = compile(path.read_text("utf-8"), str(path), "exec", dont_inherit=True)
    ours, theirs = Pipe(duplex=False)
    process = forked(run_broken, module, code, task.tests[:1], theirs)
    theirs.close()
    process.join(_SLOWEST)
    end(process)
    try:
        return ours.recv() if ours.poll() else "no answer"
    except EOFError:
        return "no answer"


def tasks_of(module: str, options: argparse.Namespace, kept: Kept) -> Iterator[Task]:
    """Breaks of a module that are still to be run; none if its tests fail without any."""
    source = path_of(module).read_text("utf-8")
    found = covered(path_of(module), options.folder)
    known = reasons(REASONS)
    sound = not found
    if options.again:
        drawn = [each for each in breaks(source) if kept.survived_unexplained(each, known)]
    else:
        drawn = [each for each in sample(module, source, options) if not kept.has(each)]
    for change in drawn:
        code = broken_code(source, change, str(path_of(module)))
        chosen, complete = plan(found, change.lines, options.patience)
        task = Task(module, change, code, chosen, complete)
        if not chosen:
            kept.add(Tried.of(module, change, "", tests=0, complete=True, seconds=0.0))
            continue
        if not sound:
            if failed := is_sound(module, task):
                kept.not_tried(failed)
                print(f"{module}: not tried, {failed} fails without a break")
                return
            sound = True
        yield task


def main() -> None:
    options = arguments()
    sys.stdout.reconfigure(line_buffering=True)
    options.folder.mkdir(exist_ok=True)
    sys.path.insert(0, str(PACKAGE.parent))
    chosen = options.modules or numerical_parts()
    if not options.page:
        with TemporaryDirectory() as compiled:
            compile_elsewhere(Path(compiled))
            bring_in(options.folder)
            run_files(options.folder, options.workers)
            for module in chosen:
                path = path_of(module)
                kept = Kept(options.folder, module, digest(path), breaks(path.read_text("utf-8")))
                try_all(tasks_of(module, options, kept), kept, options.workers)
                print(kept.summary())
    if options.page or not options.modules:
        write_page(options.folder, options.seed)
        print("Written: tests/mutations/mutations.md.")


if __name__ == "__main__":
    main()
