"""A disk that is really full, or can only be read, is told of in a sentence; with room all goes on.

As root, on a small disk in memory that is mounted for the test.
"""

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from tiny_project import NO_INDEX, load, make_tiny, run

pytestmark = pytest.mark.xdist_group("lab")
FULL = "The disk is full: free some space (a set-up takes up to 2 GB) and run this again."


class Disk:
    """A small disk; its size and whether it can be written can change."""

    def __init__(self, folder: Path) -> None:
        folder.mkdir()
        self.folder = folder

    def mount(self, *options: str) -> None:
        call = ["mount", "-t", "tmpfs", "-o", ",".join(options), "tmpfs", str(self.folder)]
        subprocess.run(call, check=True, capture_output=True)

    def change(self, *options: str) -> None:
        self.mount("remount", *options)

    def fill(self) -> None:
        """Leave no room."""
        with (self.folder / "filling").open("wb", buffering=0) as file:
            try:
                while True:
                    file.write(bytes(4096))
            except OSError:
                pass

    def unmount(self) -> None:
        subprocess.run(["umount", "--lazy", str(self.folder)], check=True)


@pytest.fixture
def disk(tmp_path: Path) -> Iterator[Disk]:
    """A disk of a megabyte."""
    small = Disk(tmp_path / "disk")
    if sys.platform != "linux" or os.geteuid() != 0:
        pytest.skip("only root can mount a disk")
    try:
        small.mount("size=1m")
    except (OSError, subprocess.CalledProcessError):
        pytest.skip("no disk can be mounted here")
    try:
        yield small
    finally:
        small.unmount()


def with_answer(copies: object) -> str:
    """Answer an exercise in a copy; return the notebook's text."""
    path = copies.COPIES / "00_start_here.ipynb"
    notebook = json.loads(path.read_text("utf-8"))
    notebook["cells"] = [{"cell_type": "code", "source": ["my answer"], "outputs": []}]
    path.write_text(json.dumps(notebook), "utf-8")
    return path.read_text("utf-8")


def test_a_full_disk_costs_no_answer(disk: Disk, monkeypatch: pytest.MonkeyPatch) -> None:
    copies = load(make_tiny(disk.folder / "book")).copies
    monkeypatch.setattr(copies, "PYTHON", sys.executable)
    copies.bring_copies()
    mine = with_answer(copies)
    newer = json.dumps({"cells": [], "metadata": {"of": "x" * 9000}})
    (copies.BOOK / "00_start_here.ipynb").write_text(newer, "utf-8")
    (copies.BOOK / "01_more.ipynb").write_text(newer, "utf-8")
    disk.fill()
    for bring in (copies.bring_copies, lambda: copies.bring_clean(["00"])):
        with pytest.raises(copies.Trouble, match="The disk is full"):
            bring()
    (aside,) = copies.COPIES.glob("00_start_here.2*.ipynb")
    assert aside.read_text("utf-8") == mine
    (disk.folder / "filling").unlink()
    copies.bring_copies()
    assert sorted(path.name for path in copies.COPIES.iterdir()) == [
        aside.name, "00_start_here.ipynb", "01_more.ipynb",
    ]  # fmt: skip
    assert aside.read_text("utf-8") == mine


@pytest.mark.parametrize("arguments", [["figures"], ["--no-browser"]])
def test_a_disk_without_room_for_a_lock(disk: Disk, arguments: list[str]) -> None:
    folder = make_tiny(disk.folder / "book")
    disk.fill()
    done = run(folder, *arguments, **NO_INDEX)
    assert (done.code, done.complained) == (1, FULL)
    assert not list(folder.glob(".venv*"))


def test_a_disk_that_can_only_be_read(finished: Path, disk: Disk) -> None:
    """What is set up is used, and the book opens to be read."""
    disk.change("size=100m")
    folder = shutil.copytree(finished, disk.folder / "book", symlinks=True)
    load(folder).environment.set_up()  # it was moved
    disk.change("ro")
    done = run(folder, "figures", **NO_INDEX)
    assert (done.code, done.complained, done.said) == (0, "", "figures drawn\n")
    done = run(folder, "fresh", **NO_INDEX)
    assert done.code == 1
    assert "cannot be written: make the project folder writable" in done.complained
    done = run(folder, "--no-browser", **NO_INDEX)
    assert (done.code, done.complained) == (0, "")
    assert "the book opens to be read, and keeps no changes" in done.said
    disk.change("rw")
    done = run(folder, "--no-browser", **NO_INDEX)
    assert "Your own copies of the notebooks are in my-book" in done.said


@pytest.mark.setup
def test_a_disk_that_is_too_small_for_a_set_up(disk: Disk) -> None:
    """In whatever step it fills up; with room the next start makes everything."""
    disk.change("size=4m")
    folder = make_tiny(disk.folder / "book")
    done = run(folder, "figures", **NO_INDEX)
    assert done.code == 1
    assert done.complained == FULL
    assert not list(folder.glob(".venv*"))
    disk.change("size=100m")
    done = run(folder, "figures", **NO_INDEX)
    assert (done.code, done.complained) == (0, "")
    assert done.said.endswith("figures drawn\n")
