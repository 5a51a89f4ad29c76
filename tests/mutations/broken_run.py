"""Tests of one break, in a forked process: the first failure ends it, and src stays as it is.

The process imports the package anew, the broken module from code in memory.
"""

import os
import resource
import signal
import sys
from collections.abc import Sequence
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec, SourceFileLoader
from importlib.util import spec_from_file_location
from multiprocessing.connection import Connection
from types import CodeType, ModuleType

import pytest
from quietly import ARGUMENTS
from tests_of_lines import FileOfTests

LONGER = 5
"""A test that takes so many times as long as without the break hangs,"""
AT_LEAST = 5.0
"""but so many seconds of processor time it may take,"""
IDLE = 120
"""and so many seconds may pass, whatever else the machine does."""
_MEMORY = 6 << 30


class _BrokenLoader(SourceFileLoader):
    def __init__(self, name: str, path: str, code: CodeType) -> None:
        super().__init__(name, path)
        self._code = code

    def get_code(self, fullname: str) -> CodeType:
        return self._code


class _BrokenFinder(MetaPathFinder):
    """Gives one module the code of a break."""

    def __init__(self, module: str, code: CodeType) -> None:
        self._module, self._code = f"driftlab.{module}", code
        self.asked = False

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if fullname != self._module:
            return None
        self.asked = True
        file = self._code.co_filename
        return spec_from_file_location(
            fullname, file, loader=_BrokenLoader(fullname, file, self._code)
        )


class _Chosen:
    """Only some tests of a file, in an order of their own; each has a time limit."""

    def __init__(self, seconds: dict[str, float], outside: float) -> None:
        self._seconds = seconds  # in the order wanted
        self._outside = outside
        self.failed = ""

    @pytest.hookimpl(trylast=True)
    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        by_name = {item.nodeid: item for item in items}
        items[:] = [by_name[name] for name in self._seconds if name in by_name]

    def pytest_runtest_logstart(self, nodeid: str) -> None:
        _limit(self._seconds[nodeid])

    def pytest_runtest_logfinish(self, nodeid: str) -> None:
        _limit(self._outside)

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.failed and not self.failed:
            self.failed = report.nodeid


def _limit(seconds: float) -> None:
    """End the process by a signal when it calculates much longer than it should."""
    signal.setitimer(signal.ITIMER_PROF, max(LONGER * seconds, AT_LEAST))
    signal.setitimer(signal.ITIMER_REAL, max(LONGER * seconds, IDLE))


def run_broken(module: str, code: CodeType, plan: list[FileOfTests], answer: Connection) -> None:
    """Try the files of tests one after the other; tell which test failed, or an empty text."""
    signal.signal(signal.SIGPROF, signal.SIG_DFL)
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
    finder = _BrokenFinder(module, code)
    sys.meta_path.insert(0, finder)
    for tests in plan:
        _limit(tests.outside)
        chosen = _Chosen(tests.seconds, tests.outside)
        ended = pytest.main([*ARGUMENTS, "-x", tests.path], plugins=[chosen])
        if ended not in (pytest.ExitCode.OK, pytest.ExitCode.NO_TESTS_COLLECTED):
            answer.send(chosen.failed or f"{tests.path}, when it is imported")
            os._exit(0)
    if not finder.asked:
        raise RuntimeError(f"no test has imported {module}")
    answer.send("")
