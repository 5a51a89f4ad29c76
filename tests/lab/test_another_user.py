"""A user who may only read the folder uses what is there, or is told in a sentence."""

import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from tiny_project import NO_INDEX, make_tiny, run_as

NOBODY: dict[str, Any] = {"user": 65534, "group": 65534, "extra_groups": []}


@cache
def python_of_all() -> str:
    """A Python that another user can run, and make environments with; empty if there is none."""
    if not hasattr(os, "geteuid") or os.geteuid() != 0:
        return ""  # only root can be another user
    asked = ["-c", "import sys, venv, ensurepip; assert sys.version_info >= (3, 11)"]
    for python in (sys.executable, "/usr/bin/python3", "/usr/local/bin/python3"):
        try:
            subprocess.run([python, *asked], check=True, capture_output=True, **NOBODY)
        except (OSError, subprocess.CalledProcessError):
            continue
        return python
    return ""


pytestmark = [
    pytest.mark.xdist_group("lab"),
    pytest.mark.skipif(not python_of_all(), reason="no Python can be run as another user"),
]


@pytest.fixture
def shared() -> Iterator[Path]:
    """A folder that everybody can read; those of pytest are for one user."""
    with tempfile.TemporaryDirectory(prefix="drift lab ") as folder:
        os.chmod(folder, 0o755)
        yield Path(folder)


def start(folder: Path, *arguments: str, as_nobody: bool) -> SimpleNamespace:
    """Run lab.py as root or as a user whom nothing belongs to, and who has no HOME."""
    command = [python_of_all(), str(folder / "lab.py"), *arguments]
    return run_as(command, NOBODY if as_nobody else None, **NO_INDEX, HOME="/nonexistent")


def owners(folder: Path) -> set[int]:
    return {path.lstat().st_uid for path in folder.rglob("*")}


def test_a_folder_of_somebody_else_that_was_never_set_up(shared: Path) -> None:
    theirs = make_tiny(shared / "book")
    done = start(theirs, "figures", as_nobody=True)
    assert (done.code, done.said) == (1, "")
    assert "cannot be written: make the project folder writable" in done.complained
    assert done.complained.count("\n") == 0
    assert not list(theirs.glob(".venv*"))
    assert owners(theirs) == {0}


@pytest.mark.setup
def test_a_folder_of_somebody_else_that_is_set_up(shared: Path) -> None:
    """It is used as it is; its notebooks open to be read."""
    theirs = make_tiny(shared / "book")
    assert start(theirs, "figures", as_nobody=False).code == 0
    done = start(theirs, "figures", as_nobody=True)
    assert (done.code, done.complained, done.said) == (0, "", "figures drawn\n")
    done = start(theirs, "fresh", as_nobody=True)
    assert done.code == 1
    assert "cannot be written: make the project folder writable" in done.complained
    done = start(theirs, "--no-browser", as_nobody=True)
    assert "the book opens to be read, and keeps no changes" in done.said
    assert owners(theirs) == {0}

    # Who used sudo once in a folder of one's own goes on without: places of root's are not used.
    for path in (theirs, *theirs.glob("*"), *theirs.glob(".*")):
        os.chown(path, NOBODY["user"], NOBODY["group"])
    assert start(theirs, "--no-browser", as_nobody=False).code == 0
    assert (theirs / ".jupyter").stat().st_uid == 0
    (theirs / "my-book").rename(theirs / "roots-book")
    done = start(theirs, "--no-browser", as_nobody=True)
    assert done.complained == "", done.complained
    assert "Drift Lab is open at" in done.said
