"""Runs the steps of a set-up and everything else, and says in one sentence what went wrong."""

import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import chain
from pathlib import Path
from typing import Any

HOME = Path(__file__).resolve().parents[1]
VENV = (HOME / ".venv").resolve()  # it may be a link to a disk with more room
BIN, PYTHON_NAME = ("Scripts", "python.exe") if os.name == "nt" else ("bin", "python")
PYTHON = VENV / BIN / PYTHON_NAME
JUPYTER = HOME / "bootstrap/jupyter"  # settings of the book's JupyterLab; the user's win
LOG = HOME / ".setup.log"  # the output of the latest step of a set-up
VERSION = f"{sys.version_info[0]}.{sys.version_info[1]}"

AGAIN = "and run this again; that is safe."
DISK_FULL = "The disk is full: free some space (a set-up takes up to 2 GB) and run this again."
SYMPTOMS = {  # in the output of a failed step of uv or pip; the first that is found counts
    r"No space left on device|not enough space on the disk": DISK_FULL,
    r"DO NOT MATCH THE HASHES[^\n]*\n\s+(\S+)|Hash mismatch for `([^`]+)": (
        f"The package {{}} differs from its entry in environment.txt: check the connection {AGAIN}"
    ),
    r"not yet valid|has expired|NotValidYet|certificate: Expired": (
        "The certificate of the package index is not valid today: check the date of this "
        f"computer {AGAIN}"
    ),
    r"CERTIFICATE_VERIFY_FAILED|invalid peer certificate": (
        "The certificate of the package index is not trusted: log in if this network asks for it "
        f"in a browser, or check pip's settings (pip config list), {AGAIN}"
    ),
    r"(\d{3} (?:Client|Server) Error[^\n]*|too many \d+ error responses)"
    r"|(?:credentials|status (?:client|server) error) \((\d{3} [^)]*)|returned a (\d{3} \w+)": (
        f'The package index answers "{{}}": check pip\'s settings (pip config list) {AGAIN}'
    ),
    r"connection broken|Max retries|timed out|error sending request|dns error": (
        "The package index cannot be reached: check the network connection (and the proxy, if "
        f"there is one) {AGAIN}"
    ),
    r"No matching distribution found for ([^\s;]+)|you require (\S+), we can conclude": (
        f"The package index has no ready-made {{}} for this computer and Python {VERSION}: check "
        "the connection and pip's settings (pip config list)."
    ),
}


class Trouble(Exception):
    """An expected problem, told to the user in one sentence."""


class NoPackages(Trouble):
    """Packages could not be fetched or installed."""


def say(text: str) -> None:
    print(text, flush=True)


def surroundings(venv: Path = VENV) -> dict[str, str]:
    """Return the user's environment variables without those that mislead Python or Jupyter."""
    # Nothing is compiled at the set-up: without its cache, each kernel would compile NumPy again.
    misleading = {"PYTHONHOME", "PYTHONPATH", "PYTHONDONTWRITEBYTECODE", "JUPYTERLAB_DIR"}
    kept = {name: value for name, value in os.environ.items() if name not in misleading}
    before = {"PATH": venv / BIN, "JUPYTER_PATH": venv / "share/jupyter"}
    for name, first in {**before, "JUPYTER_CONFIG_PATH": JUPYTER}.items():
        kept[name] = os.pathsep.join([str(first), *filter(None, [kept.get(name)])])
    return {**kept, "PYTHONNOUSERSITE": "1", "VIRTUAL_ENV": str(venv)}


def catch_signals() -> None:
    """Make Ctrl-C, a request to end and a closed terminal all raise KeyboardInterrupt."""
    for number in (signal.SIGINT, signal.SIGTERM, getattr(signal, "SIGHUP", signal.SIGTERM)):
        signal.signal(number, signal.default_int_handler)


@contextmanager
def running(command: list[str], **options: Any) -> Iterator["subprocess.Popen[str]"]:
    """Run `command` in the project folder; it does not outlive the ``with`` block."""
    with subprocess.Popen(command, **{"env": surroundings(), "cwd": HOME, **options}) as process:
        try:
            yield process
        finally:
            process.terminate()
            process.wait()


def run_step(command: list[str], env: dict[str, str] | None = None) -> None:
    """Run a step of a set-up with its output in the log; raise the Trouble it met.

    A terminal shows the latest line in place of the one before.
    """
    pipe: dict[str, Any] = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
    pipe.update(stdin=subprocess.DEVNULL, encoding="utf-8", errors="replace")
    output, width = "", shutil.get_terminal_size().columns - 1
    env = env or surroundings()
    with LOG.open("w", encoding="utf-8") as log, running(command, env=env, **pipe) as process:
        for line in chain(process.stdout or (), [""]):
            output += line
            print(line, end="", file=log, flush=True)
            if sys.stdout and sys.stdout.isatty():
                print(f"\r{line.strip():{width}.{width}}\r", end="", flush=True)
        code = process.wait()
    if code:
        raise diagnosis(output)


def diagnosis(output: str) -> NoPackages:
    """Return the trouble that the output of a failed step tells of."""
    output = re.sub(r"\n {8,}", " ", output)  # where uv breaks a line
    for pattern, sentence in SYMPTOMS.items():
        if found := re.search(pattern, output, re.I):
            return NoPackages(sentence.format(*filter(None, found.groups())))
    return NoPackages(f"The set-up failed; {LOG} tells why.")
