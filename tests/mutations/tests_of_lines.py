"""Which tests to run against a break: those that execute its lines, the most telling file first."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from quietly import ARGUMENTS, PACKAGE, ROOT

if TYPE_CHECKING:
    from coverage import CoverageData

TESTS = ROOT / "tests"
# These look at the door, the files of the project and whole notebooks, not at numbers.
_APART = {
    "test_copies", "test_deployment", "test_distribution", "test_door",
    "test_i_want_to", "test_lab", "test_readme", "test_release", "test_student_copy",
}  # fmt: skip
_FOLDERS = (
    "", "attitude", "calibration", "commands", "drift", "gyrocompass", "monte_carlo", "motion",
    "recordings",
)  # fmt: skip


_LONG = 2.0


class FileOfTests(NamedTuple):
    """Tests of a file in the order in which they are to run, with their processor times."""

    path: str
    seconds: dict[str, float]
    outside: float
    """Processor time of all but the tests: mostly what is imported."""


class Covered(NamedTuple):
    """What tests of a file execute of a module."""

    path: str
    seconds: dict[str, float]
    outside: float
    lines: dict[int, set[str]]
    """Tests that execute a line; "" stands for the import."""


@cache
def test_files() -> tuple[str, ...]:
    """Files of tests that numbers of the package can fail, as there were at the beginning."""
    found = [path for folder in _FOLDERS for path in sorted((TESTS / folder).glob("test_*.py"))]
    if find_spec("numba"):
        found.append(TESTS / "peers/test_compiled.py")
    paths = [path for path in found if path.stem not in _APART]
    return tuple(path.relative_to(ROOT).as_posix() for path in paths)


@cache
def record_of(tests: str, folder: Path) -> tuple[Path, Path]:
    """Where the clean run of a file keeps coverage's data and its times.

    The name changes with the package, with the file and with what tests share, as they stood
    when it was asked for first: a file may be written while breaks are run.
    """
    told = hashlib.sha256(_package_digest() + (ROOT / tests).read_bytes()).hexdigest()[:16]
    name = f"{tests.removeprefix('tests/').removesuffix('.py').replace('/', '.')}-{told}"
    return folder / f"{name}.coverage", folder / f"{name}.json"


@cache
def _package_digest() -> bytes:
    shared = [TESTS / "conftest.py", TESTS / "support.py"]
    read = hashlib.sha256(repr(ARGUMENTS).encode())
    for path in (*sorted(PACKAGE.rglob("*.py")), *shared):
        read.update(path.read_bytes())
    return read.digest()


def covered(path: Path, folder: Path) -> list[Covered]:
    """What each file of tests executes of a module, the most telling first.

    That is the module's own by its name, then those that execute little besides.
    """
    stem = path.stem.strip("_")
    ranked = []
    for tests in test_files():
        data, times = record_of(tests, folder)
        said = json.loads(times.read_text("utf-8"))
        lines = _lines(data, path)
        if not lines or not said["passed"]:
            continue
        found = Covered(tests, said["passed"], said["outside"], lines)
        name = Path(tests).stem.removeprefix("test_")
        share = sum(any(names) for names in lines.values()) / max(1, _all_lines(data))
        ranked.append(((name != stem, -share), found))
    return [found for _, found in sorted(ranked, key=lambda each: each[0])]


def _read(data: Path) -> CoverageData:
    from coverage import CoverageData  # fetched by lab.py, but not for --help

    read = CoverageData(str(data))
    read.read()
    return read


def _lines(data: Path, path: Path) -> dict[int, set[str]]:
    read = _read(data)
    return {line: set(names) for line, names in read.contexts_by_lineno(str(path)).items()}


@cache
def _all_lines(data: Path) -> int:
    """How many lines of the package a file of tests executes, but when it is imported."""
    read = _read(data)
    read.set_query_contexts(["::"])  # names of tests have it
    return sum(len(read.lines(file) or ()) for file in read.measured_files())


def plan(
    found: Iterable[Covered], lines: tuple[int, int], patience: float
) -> tuple[list[FileOfTests], bool]:
    """Tests for a break in these lines, and whether patience was enough for all of them.

    First those that execute the lines, of each file the shortest first; then the other tests of
    the same files, which may use what a fixture has computed.
    """
    span = range(lines[0], lines[1] + 1)
    direct, others = [], []
    for each in found:
        if any(line in each.lines for line in span):
            names = set().union(*(each.lines.get(line, ()) for line in span))
            direct.append(_part(each, each.seconds.keys() & names))
            others.append(_part(each, each.seconds.keys() - names))
    # Files whose tests take long wait, so that patience lasts for as many as may be.
    direct.sort(key=lambda part: sum(part.seconds.values()) > _LONG)
    chosen = []
    for part in (*direct, *others):
        if not part.seconds:
            continue
        spent = part.outside
        for number, seconds in enumerate(part.seconds.values()):
            if spent > patience:
                kept = dict(list(part.seconds.items())[:number])
                return [*chosen, part._replace(seconds=kept)], False
            spent += seconds
        chosen.append(part)
        patience -= spent
    return chosen, True


def _part(found: Covered, names: Iterable[str]) -> FileOfTests:
    seconds = {name: found.seconds[name] for name in sorted(names, key=found.seconds.__getitem__)}
    return FileOfTests(found.path, seconds, found.outside)
