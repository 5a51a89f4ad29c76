"""When lab.py ends, in whatever way, so do JupyterLab and the steps of a set-up."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from tiny_project import comes_true, command, is_alive, load

pytestmark = [
    pytest.mark.xdist_group("lab"),
    pytest.mark.skipif(os.name == "nt", reason="a console of Windows ends them"),
]
ENDS = ["SIGINT", "SIGTERM", "SIGHUP", "SIGKILL"]
# It leaves the number of its process and waits for a stop, as JupyterLab does.
WAITING_JUPYTERLAB = """
def start():
    import os, signal, time
    signal.signal(signal.SIGTERM, lambda *_: (print("in order", flush=True), os._exit(0)))
    with open("number.new", "w") as file:
        file.write(str(os.getpid()))
    os.rename("number.new", "number")
    time.sleep(600)

LabApp.start = start
"""
# A step with a step of its own.
STEPS = """
import os, subprocess, sys, time
if len(sys.argv) == 1:
    below = subprocess.Popen([sys.executable, __file__, "below"])
    with open("number.new", "w") as file:
        file.write(f"{os.getpid()} {below.pid}")
    os.rename("number.new", "number")
time.sleep(600)
"""
SET_UP = """
import sys
sys.path.insert(0, {folder!r})
from bootstrap.steps import catch_signals, run_step
catch_signals()
try:
    run_step([sys.executable, {steps!r}])
except KeyboardInterrupt:
    sys.exit("interrupted")
"""


def numbers_in(folder: Path) -> list[int]:
    """The numbers of the processes that wait in a project, once they do."""
    assert comes_true((folder / "number").exists)
    return [int(word) for word in (folder / "number").read_text("utf-8").split()]


@pytest.mark.parametrize("end", ["SIGTERM", "SIGKILL"])
def test_jupyterlab_ends_in_order(copied: Path, end: str) -> None:
    load(copied).environment.set_up()  # it was moved
    with (copied / "src/jupyterlab/labapp.py").open("a", encoding="utf-8") as file:
        file.write(WAITING_JUPYTERLAB)
    call = command(copied, "--no-browser")
    with subprocess.Popen(call, stdout=subprocess.PIPE, encoding="utf-8") as process:
        (server,) = numbers_in(copied)
        assert is_alive(server)
        process.send_signal(getattr(signal, end))
        try:
            assert comes_true(lambda: not is_alive(server), 20)
        finally:
            if is_alive(server):
                os.kill(server, signal.SIGKILL)
        assert "in order" in process.stdout.read()


@pytest.mark.parametrize("end", ENDS)
def test_a_step_ends_with_all_that_it_started(tiny: Path, end: str) -> None:
    """The lock is free when lab.py is gone: whoever starts next is alone."""
    steps = tiny / "steps.py"
    steps.write_text(STEPS, "utf-8")
    code = SET_UP.format(folder=str(tiny), steps=str(steps))
    with subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.DEVNULL) as process:
        numbers = numbers_in(tiny)
        assert all(map(is_alive, numbers))
        process.send_signal(getattr(signal, end))
        process.wait(20)
        try:
            assert comes_true(lambda: not any(map(is_alive, numbers)), 5)
        finally:
            for number in filter(is_alive, numbers):
                os.kill(number, signal.SIGKILL)


def test_a_step_reads_nothing_and_its_failure_is_seen(tiny: Path) -> None:
    steps = load(tiny).steps
    assert steps.run_step([sys.executable, "-c", "print([input for _ in open(0)])"]) == "[]\n"
    with pytest.raises(steps.Trouble, match="The set-up failed"):
        steps.run_step([sys.executable, "-c", "import os; os.kill(os.getpid(), 9)"])
