"""Where nobody reads what lab.py says, or it finds no place, it ends without a traceback."""

import os
import subprocess
from pathlib import Path

import pytest
from tiny_project import ROOT, command, load


@pytest.mark.parametrize("arguments", [["--help"], ["fresh"]])
def test_nobody_reads(arguments: list[str], tiny: Path) -> None:
    """With `fresh` it is in the middle of its work: it speaks before it makes an environment."""
    reader, writer = os.pipe()
    os.close(reader)
    with os.fdopen(writer, "wb") as pipe:
        done = subprocess.run(
            command(tiny, *arguments), stdout=pipe, stderr=subprocess.PIPE, text=True
        )
    assert (done.returncode, done.stderr) == (1, "")
    assert not list(tiny.glob(".venv*"))


@pytest.mark.skipif(os.name == "nt", reason="a shell closes it")
def test_output_is_closed() -> None:
    line = ["sh", "-c", 'exec "$@" >&-', "sh", *command(ROOT, "--help")]
    done = subprocess.run(line, stderr=subprocess.PIPE, text=True)
    assert (done.returncode, done.stderr) == (0, "")


def test_a_step_shows_nothing_where_there_is_no_output(
    tiny: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    steps = load(tiny).steps
    monkeypatch.setattr("sys.stdout", None)
    steps.show("the latest line")


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="there is no device that is full")
def test_output_goes_to_a_disk_that_is_full() -> None:
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            command(ROOT, "--help"), stdout=full, stderr=subprocess.PIPE, text=True
        )
    assert done.returncode == 1
    assert done.stderr.startswith("The disk is full: ")
    assert done.stderr.count("\n") == 1
