"""Runs the steps of the set-up and everything else, and tells in words what went wrong."""

import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

HOME = Path(__file__).resolve().parents[1]
VENV = (HOME / ".venv").resolve()  # it may be a link to a disk with more room
BIN, PYTHON_NAME = ("Scripts", "python.exe") if os.name == "nt" else ("bin", "python")
PYTHON = VENV / BIN / PYTHON_NAME
JUPYTER = HOME / "bootstrap/jupyter"  # how the book's JupyterLab is set; the user's settings win
LOG = HOME / ".setup.log"  # what the latest step of the set-up printed
VERSION = f"{sys.version_info[0]}.{sys.version_info[1]}"

AGAIN = "and run this again; that is safe."
DISK_FULL = "The disk is full: free some space (a set-up takes up to 2 GB) and run this again."
NO_INDEX = (
    "What answers is not the package index: log in if this network asks for it in a browser, or "
    f"check pip's settings (pip config list), {AGAIN}"
)
SYMPTOMS = {  # in the output of a failed step; the first that is found counts
    r"No space left on device|not enough space on the disk": DISK_FULL,
    r"DO NOT MATCH THE HASHES[^\n]*\n\s+(\S+)": (
        f"What came as {{}} is not what environment.txt names: check the connection {AGAIN}"
    ),
    r"CERTIFICATE_VERIFY_FAILED": NO_INDEX,
    r"(\d{3} (?:Client|Server) Error[^\n]*|too many \d+ error responses)": (
        f'The package index answers "{{}}": check pip\'s settings (pip config list) {AGAIN}'
    ),
    r"connection broken|Max retries exceeded|timed out": (
        "The package index cannot be reached: check the network connection (and the proxy, if "
        f"there is one) {AGAIN}"
    ),
}

# A step of the set-up starts others: venv starts ensurepip, pip builds. This runs it in a group of
# their own and ends them all, should lab.py ask for it or be gone: its end of the pipe then closes.
TOGETHER = """\
import os, signal, subprocess, sys, threading
def end(*_):
    os.killpg(0, signal.SIGKILL)
def end_with_lab_py():
    os.read(0, 1)
    end()
signal.signal(signal.SIGTERM, end)
threading.Thread(target=end_with_lab_py, daemon=True).start()
sys.exit(abs(subprocess.call(sys.argv[1:], stdin=subprocess.DEVNULL)))
"""


class Trouble(Exception):
    """An expected problem, told to the user in one sentence."""


class NoPackages(Trouble):
    """The package index did not give what was asked."""


def say(text: str) -> None:
    print(text, flush=True)


def surroundings(venv: Path = VENV, **extra: str) -> dict[str, str]:
    """Return the user's environment variables without those that mislead Python, pip or Jupyter."""
    misleading = {"PYTHONHOME", "PYTHONPATH", "JUPYTERLAB_DIR"}
    # pip is told to compile nothing, so each start of a kernel would compile NumPy and all else.
    misleading.add("PYTHONDONTWRITEBYTECODE")
    misleading |= {f"PIP_{name}" for name in ("CONSTRAINT", "PREFIX", "PYTHON", "ROOT", "TARGET")}
    kept = {name: value for name, value in os.environ.items() if name not in misleading}
    before = {"PATH": venv / BIN, "JUPYTER_PATH": venv / "share/jupyter"}
    for name, first in {**before, "JUPYTER_CONFIG_PATH": JUPYTER}.items():
        kept[name] = os.pathsep.join([str(first), *filter(None, [kept.get(name)])])
    ours = {f"PIP_{name}": "0" for name in ("DRY_RUN", "QUIET", "REQUIRE_HASHES", "USER")}
    ours.update(PYTHONNOUSERSITE="1", PIP_DISABLE_PIP_VERSION_CHECK="1", VIRTUAL_ENV=str(venv))
    return {**kept, **ours, **extra}


def catch_signals() -> None:
    """Make Ctrl-C, a request to end and a closed terminal all raise KeyboardInterrupt."""
    for number in (signal.SIGINT, signal.SIGTERM, getattr(signal, "SIGHUP", signal.SIGTERM)):
        signal.signal(number, signal.default_int_handler)


@contextmanager
def running(command: list[str], **options: Any) -> Iterator["subprocess.Popen[str]"]:
    """Run `command` in the project folder; it does not outlive the ``with`` block."""
    options.setdefault("env", surroundings())
    with subprocess.Popen(command, cwd=HOME, **options) as process:
        try:
            yield process
        finally:
            signal.signal(signal.SIGINT, signal.SIG_IGN)  # an impatient second Ctrl-C
            if os.name != "nt":  # Windows would not ask but kill; there Ctrl-C has asked already
                process.terminate()
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
            catch_signals()


def run_step(command: list[str]) -> str:
    """Run a step of the set-up and return what it printed; raise the Trouble it met.

    What it prints goes to the log; a terminal shows the latest line in place of the one before.
    """
    pipe: dict[str, Any] = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
    pipe.update(stdin=subprocess.DEVNULL, encoding="utf-8", errors="replace")
    step = command
    if os.name != "nt":
        step = [sys.executable, "-I", "-S", "-c", TOGETHER, *command]
        pipe.update(stdin=subprocess.PIPE, start_new_session=True)
    output = ""
    with LOG.open("w", encoding="utf-8") as log, running(step, **pipe) as process:
        for line in process.stdout or ():
            output += line
            print(line, end="", file=log, flush=True)
            show(line.strip())
            if line.startswith("Installing collected packages") and "," in line:
                # Nothing more comes from pip until they are all there.
                show("")
                say(f"Installing {line.count(',') + 1} packages; this may take a minute.")
        show("")
        code = process.wait()
    if code:
        raise diagnosis(output, command[0])
    return output


def show(text: str) -> None:
    """Put `text` on the last line of a terminal, where the next text takes its place."""
    if sys.stdout and sys.stdout.isatty():
        width = shutil.get_terminal_size().columns - 1
        print(f"\r{text:{width}.{width}}\r", end="", flush=True)


def diagnosis(output: str, python: str) -> Trouble:
    """Return the Trouble that the output of a failed step tells of."""
    for pattern, sentence in SYMPTOMS.items():
        found = re.search(pattern, output, re.I)
        if found:
            kind = Trouble if sentence is DISK_FULL else NoPackages
            return kind(sentence.format(*found.groups()))
    missing = re.search(r"No matching distribution found for ([^\s;]+)", output)
    if not missing:
        return Trouble(f"The set-up failed; {LOG} tells why.")
    # pip prints the same if the index refuses or is none. Asked for one package, it tells more.
    ask = [*pip_install(python), "--dry-run", "-vv", missing[1]]
    told = subprocess.run(ask, env=surroundings(), capture_output=True).stdout.decode(
        "utf-8", "replace"
    )
    refusal = re.search(r"Could not fetch URL (?!.*\b404 Client Error).*", told)
    if refusal:
        return diagnosis(refusal[0], python)
    if not re.search(r"404 Client Error|Found link|Skipping link(?!: not a file)", told):
        return NoPackages(NO_INDEX)
    return NoPackages(
        f"The package index has no ready-made {missing[1]} for this computer and Python {VERSION} "
        f"({LOG.name} tells more)."
    )


def pip_install(python: str) -> list[str]:
    # --only-binary: building from source would fetch tools that environment.txt does not pin.
    options = ["--no-deps", "--no-input", "--retries=2", "--only-binary=:all:"]
    return [python, "-m", "pip", "install", *options]
