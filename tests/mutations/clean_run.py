"""Which tests execute which lines of the package, and how long each takes: one file of tests.

A file runs in a process of its own, so that nothing that another file's tests have computed and
kept hides which lines its tests need. What ran when the file was imported has the context "".
"""

from __future__ import annotations

import json
import resource
from collections.abc import Iterator
from pathlib import Path
from time import process_time
from typing import TYPE_CHECKING

import pytest
from quietly import ARGUMENTS, PACKAGE

if TYPE_CHECKING:
    from coverage import Coverage


class Watch:
    """Tells coverage which test runs, and keeps the processor time of each."""

    def __init__(self, coverage: Coverage) -> None:
        self._coverage = coverage
        self.seconds: dict[str, float] = {}
        self.failed: list[str] = []
        self.ran: list[str] = []

    @pytest.hookimpl(wrapper=True, tryfirst=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        self._coverage.switch_context(item.nodeid)
        begun = process_time()
        result = yield
        self.seconds[item.nodeid] = process_time() - begun
        self._coverage.switch_context("")
        return result

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.failed:
            self.failed.append(report.nodeid)
        elif report.when == "call" and report.passed:
            self.ran.append(report.nodeid)

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        if report.failed:
            self.failed.append(report.nodeid)


def run_clean(tests: str, data: Path, times: Path) -> None:
    """Run a file of tests; write coverage's data, and the times of the tests that passed."""
    from coverage import Coverage  # fetched by lab.py, but not for --help

    coverage = Coverage(data_file=str(data), include=[f"{PACKAGE}/*"], config_file=False)
    watch = Watch(coverage)
    begun = process_time()
    coverage.start()
    code = pytest.main([*ARGUMENTS, tests], plugins=[watch])
    coverage.stop()
    coverage.save()
    passed = {name: watch.seconds[name] for name in watch.ran if name not in watch.failed}
    found = {
        "code": int(code),
        "passed": passed,
        "failed": sorted(set(watch.failed)),
        "outside": process_time() - begun - sum(watch.seconds.values()),
        "memory": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss,
    }
    times.write_text(json.dumps(found), "utf-8")
