"""What waits without an end fails, wherever it waits, and the tests after it go on."""

import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest

TESTS = """
import subprocess, sys, time
import pytest
from hypothesis import given, strategies

@pytest.fixture(scope="module")
def endless():
    time.sleep(60)

@pytest.fixture
def endless_at_the_end():
    yield
    time.sleep(60)

def test_another_program():
    subprocess.run([sys.executable, "-c", "import time; time.sleep(60)"])

@given(strategies.integers(0, 1000))
def test_examples(n):
    while n > 10:
        pass

def test_set_up(endless):
    pass

def test_set_up_once(endless):
    pass

def test_taken_down_after_a_failure(endless_at_the_end):
    assert False

def test_goes_on():
    pass
"""


@pytest.mark.skipif(not hasattr(signal, "SIGALRM"), reason="no alarm here: the process is ended")
def test_what_waits_without_an_end_fails_and_the_others_go_on(tmp_path: Path) -> None:
    folder = Path(__file__).parent
    conftest = (folder / "conftest.py").read_text("utf-8")
    (tmp_path / "conftest.py").write_text(f"import limits\nlimits.LIMIT = 2\n{conftest}", "utf-8")
    (tmp_path / "test_it.py").write_text(TESTS, "utf-8")
    (tmp_path / "pytest.ini").write_text(f'[pytest]\npythonpath="{folder.as_posix()}"\n', "utf-8")
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-rA", "--tb=line"],
        cwd=tmp_path,
        capture_output=True,
        encoding="utf-8",
        timeout=120,
    )
    ends = done.stdout.partition("short test summary info")[2]
    long = re.findall(
        r"^(FAILED|ERROR) test_it.py::test_(\w+) - limits.TooLong", ends, re.MULTILINE
    )
    assert long == [
        ("ERROR", "set_up"),
        ("ERROR", "set_up_once"),
        ("ERROR", "taken_down_after_a_failure"),
        ("FAILED", "another_program"),
        ("FAILED", "examples"),
    ]
    assert "PASSED test_it.py::test_goes_on" in ends
