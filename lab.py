#!/usr/bin/env python3
"""The one door to Drift Lab: ``python3 lab.py`` sets everything up and opens the book.

Only the standard library is used here. The packages of environment.txt and the book's own
package go into ``.venv`` beside this file, and so does what JupyterLab remembers of its windows.
Elsewhere nothing is installed; Jupyter and IPython keep their usual small files in the home folder.
"""

import argparse
import errno
import hashlib
import importlib.util
import io
import json
import os
import platform
import re
import secrets
import shutil
import signal
import socket
import subprocess
import sys
import sysconfig
import tempfile
import time
import urllib.request
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

# Old Pythons read this file too, so its syntax stays that of Python 3.6 and they stop here.
if sys.version_info < (3, 11):  # noqa: UP036
    sys.exit(
        f"Drift Lab needs Python 3.11 or newer; this is {platform.python_version()}. "
        "Install a newer one (https://www.python.org/downloads/) and run lab.py with that."
    )

HOME = Path(__file__).resolve().parent
VENV = HOME / ".venv"
PYTHON = VENV / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
SITE_PACKAGES = Path(sysconfig.get_path("purelib", "venv", {"base": str(VENV)}))
STAMP = VENV / "driftlab.json"  # written last: without it the set-up did not finish
LOCK = HOME / ".setup.lock"  # beside .venv, not in it, so that a rebuild leaves it alone
LOG = HOME / ".setup.log"  # what the latest step of the set-up printed
ENVIRONMENT = HOME / "environment.txt"
PYPROJECT = HOME / "pyproject.toml"
# What only tests and benchmarks use lies aside, and comes after everything else on their path.
PEERS, PEERS_LIST = VENV / "peers", HOME / "tests/benchmarks/peers.txt"
DRIVER, DRIVER_LIST = VENV / "browser", HOME / "tests/browser/driver.txt"
NOTEBOOK = "notebooks/00_start_here.ipynb"
VERSION = f"{sys.version_info[0]}.{sys.version_info[1]}"

HELP = """\
usage: python3 lab.py [command]

  open      set up what is missing and open the book (so does no command at all)
              --no-browser   only print the address
              --port N       use this port
  test      check the project: ruff, mypy, pytest (with arguments: only pytest, with those)
  figures   rebuild every figure and table of the book
  bench     print how fast the package is, against its peers, which this command fetches
  lock      renew environment.txt from pyproject.toml
"""
LOCK_HEADER = """\
# The exact packages Drift Lab runs with, for every system and every Python from 3.11 on.
# Written from pyproject.toml by "python3 lab.py lock"; run that again to renew it.
# dependencies in pyproject.toml: """

# The token travels in the environment because other users can read command lines. It becomes
# an argument inside the process because arguments, unlike JUPYTER_TOKEN, also win over a user's
# configuration that switches tokens off. The book's matrices are small: threads for them only
# get in the way of the browser.
SERVER = """\
import os, sys
from jupyterlab.labapp import main
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
main([*sys.argv[1:], "--IdentityProvider.token=" + os.environ.pop("DRIFTLAB_TOKEN")])
"""

DISK_FULL = "The disk is full: free some space (Drift Lab takes about 1 GB) and run this again."
OFFLINE = (
    "The package index cannot be reached: check the network connection (and the proxy, if there "
    "is one) and run this again; that is safe."
)
SYMPTOMS = {  # in the output of a failed step; the first that is found counts
    r"No space left on device|not enough space on the disk": DISK_FULL,
    r"connection broken by|Max retries exceeded|timed out|Failed to fetch": OFFLINE,
    r"No matching distribution found for ([^\s;]+)": (
        f"The package index has no ready-made {{}} for this computer and Python {VERSION} "
        "(.setup.log tells more)."
    ),
}


class Trouble(Exception):
    """An expected problem, told to the user in one sentence."""


class Offline(Trouble):
    """The package index did not answer; pip has changed nothing yet."""


def say(text: str) -> None:
    print(text, flush=True)


def dependency_digest() -> str:
    """Return a digest of what pyproject.toml asks for."""
    import tomllib  # not above: old Pythons do not have it

    tables = tomllib.loads(PYPROJECT.read_text("utf-8"))
    project = tables["project"]
    wishes = [
        tables["build-system"]["requires"],
        project.get("dependencies", []),
        project.get("optional-dependencies", {}),
    ]
    return "sha256:" + hashlib.sha256(json.dumps(wishes, sort_keys=True).encode()).hexdigest()


def lock_is_current() -> bool:
    """Tell whether environment.txt was written from the present pyproject.toml."""
    return f"{LOCK_HEADER}{dependency_digest()}\n" in ENVIRONMENT.read_text("utf-8")


def wanted_stamp() -> dict[str, str]:
    """Return what the stamp says when the present files are set up."""
    return {
        "environment": hashlib.sha256(ENVIRONMENT.read_bytes()).hexdigest(),
        "pyproject": hashlib.sha256(PYPROJECT.read_bytes()).hexdigest(),
        "python": f"{platform.python_implementation()} {VERSION}",
        "folder": str(HOME),
    }


def read_stamp() -> dict[str, str]:
    """Return the stamp of the last finished set-up; empty if there is none."""
    try:
        return dict(json.loads(STAMP.read_text("utf-8")))
    except (OSError, ValueError):
        return {}


def write(path: Path, text: str) -> None:
    """Write `text` so that a reader finds the old file or the new one, never half of one."""
    path.parent.mkdir(parents=True, exist_ok=True)
    half = path.with_name(path.name + ".new")
    half.write_text(text, "utf-8", newline="\n")
    half.replace(path)


def surroundings(**extra: str) -> dict[str, str]:
    """Return the user's environment variables without those that mislead Python or pip."""
    misleading = {"PYTHONHOME", "PYTHONPATH", "PIP_TARGET", "PIP_PREFIX"}
    kept = {name: value for name, value in os.environ.items() if name not in misleading}
    path = os.pathsep.join([str(PYTHON.parent), kept.get("PATH", os.defpath)])
    ours = {"PYTHONNOUSERSITE": "1", "PIP_USER": "0", "PIP_DISABLE_PIP_VERSION_CHECK": "1"}
    return {**kept, **ours, "VIRTUAL_ENV": str(VENV), "PATH": path, **extra}


def catch_signals() -> None:
    """Make Ctrl-C, a request to end and a closed terminal all raise KeyboardInterrupt."""
    for number in (signal.SIGINT, signal.SIGTERM, getattr(signal, "SIGHUP", signal.SIGTERM)):
        signal.signal(number, signal.default_int_handler)


@contextmanager
def running(command: list[str], **options: Any) -> Iterator["subprocess.Popen[bytes]"]:
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


def run(*arguments: str) -> int:
    """Run the environment's Python in sight of the user and return its exit code."""
    with running([str(PYTHON), *arguments]) as process:
        return abs(process.wait())


def run_step(command: list[str], progress: Callable[[str], str] = lambda output: "") -> None:
    """Run a step of the set-up with its output in the log; raise the Trouble it met.

    The step inherits the set-up lock. If lab.py is killed, the lock stays taken until the step
    has ended as well, and no second set-up writes into the same folder beside it.
    """
    line = ProgressLine()
    with LOG.open("wb") as log:
        output: dict[str, Any] = {"stdin": subprocess.DEVNULL, "stdout": log, "stderr": log}
        with running(command, close_fds=False, **output) as process:
            while process.poll() is None:
                line.show(progress(LOG.read_text("utf-8", "replace")))
                time.sleep(0.1)
    line.end()
    if process.returncode:
        raise diagnosis(LOG.read_text("utf-8", "replace"))


def diagnosis(output: str) -> Trouble:
    """Return the Trouble that the output of a failed step tells of."""
    for pattern, sentence in SYMPTOMS.items():
        found = re.search(pattern, output)
        if found:
            return (Offline if sentence is OFFLINE else Trouble)(sentence.format(*found.groups()))
    if shutil.disk_usage(HOME).free < 2**20:  # too full even for the log
        return Trouble(DISK_FULL)
    return Trouble(f"The set-up failed; {LOG} tells why.")


class ProgressLine:
    """A line that is rewritten on a terminal and repeated every few seconds elsewhere."""

    def __init__(self) -> None:
        self.text, self.printed_at = "", time.monotonic()

    def show(self, text: str) -> None:
        if sys.stdout.isatty() and text != self.text:
            width = shutil.get_terminal_size().columns - 1
            print("\r" + text.ljust(len(self.text))[:width], end="", flush=True)
            self.text = text
        elif text and not sys.stdout.isatty() and time.monotonic() - self.printed_at > 5:
            self.printed_at = time.monotonic()
            say(text)

    def end(self) -> None:
        if self.text:
            say("")


@contextmanager
def alone() -> Iterator[None]:
    """Hold the set-up lock; the system takes it back when all who hold it have ended."""
    try:
        with LOCK.open("a") as file:
            if not try_to_lock(file.fileno()):
                say("Another start of Drift Lab is setting up this folder; waiting for it.")
                while not try_to_lock(file.fileno()):
                    time.sleep(0.2)
            os.set_inheritable(file.fileno(), True)  # see run_step
            yield
    except OSError as error:
        if error.errno in (errno.ENOSPC, errno.EDQUOT):
            raise Trouble(DISK_FULL) from error
        if error.errno in (errno.EACCES, errno.EPERM, errno.EROFS):
            raise Trouble(
                f"{error.filename} cannot be written: make the project folder writable "
                "(or close the program that uses it) and run this again."
            ) from error
        raise


def try_to_lock(descriptor: int) -> bool:
    try:
        if sys.platform == "win32":
            import msvcrt

            msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except (BlockingIOError, PermissionError):
        return False
    return True


def set_up() -> None:
    """Bring ``.venv`` in line with the project; return at once if it is."""
    if os.pathsep in str(HOME):
        raise Trouble(f'Python cannot work in a folder with "{os.pathsep}" in its name: {HOME}.')
    for needed in (ENVIRONMENT, PYPROJECT):
        if not needed.exists():
            raise Trouble(f"{needed.name} is missing from {HOME}: get the project afresh.")
    if not lock_is_current():
        say("environment.txt is older than pyproject.toml; run 'python3 lab.py lock' to renew it.")
    with alone():
        found, wanted = read_stamp(), wanted_stamp()
        afresh = reason_to_start_afresh(found, wanted)
        if found == wanted and not afresh:
            return
        say(afresh or "The project has changed since the last set-up; updating its environment.")
        STAMP.unlink(missing_ok=True)
        if afresh:
            make_venv(VENV)
        try:
            install_packages()
        except Offline:
            if not afresh:  # the old environment is untouched: spare the next start a rebuild
                write(STAMP, json.dumps(found))
            raise
        install_project()
        write(STAMP, json.dumps(wanted))


def reason_to_start_afresh(found: dict[str, str], wanted: dict[str, str]) -> str:
    """Say why the environment has to be built anew; nothing if it can stay."""
    if not VENV.exists():
        return f"Setting up Drift Lab in {HOME}; the first time takes a minute or two."
    if not found:
        return "The last set-up did not finish; starting it afresh."
    if found.get("folder") != wanted["folder"]:
        return "The project folder has moved; building its environment afresh."
    if found.get("python") != wanted["python"]:
        return f"Building the environment afresh, now for {wanted['python']}."
    try:
        subprocess.run([PYTHON, "-I", "-S", "-c", ""], check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError):
        return "The environment's Python no longer runs; building it afresh."
    return ""


def make_venv(folder: Path) -> None:
    """Create an environment that holds only pip, in place of whatever is in `folder`."""
    for module in ("venv", "ensurepip"):
        if importlib.util.find_spec(module) is None:
            raise Trouble(
                f"This Python lacks its module {module}: install it (on Debian and Ubuntu: "
                f"sudo apt install python{VERSION}-venv) and run this again."
            )
    # lab.py may have been started from the very environment that is to be replaced.
    python = getattr(sys, "_base_executable", sys.executable)
    run_step([python, "-m", "venv", "--clear", str(folder)])


def pip_install(python: Path) -> list[str]:
    return [str(python), "-m", "pip", "install", "--no-deps", "--no-input", "--retries=2"]


def install_packages() -> None:
    """Install exactly what environment.txt lists."""
    lines = ENVIRONMENT.read_text("utf-8").splitlines()
    before = set(SITE_PACKAGES.glob("*.dist-info"))

    def progress(output: str) -> str:
        installing = re.search(r"^Installing collected packages: (.*)", output, re.M)
        if installing:  # pip says no more, but leaves one folder per package
            names = installing[1].strip().split(", ")
            count = len(set(SITE_PACKAGES.glob("*.dist-info")) - before)
            return f"Installing packages {count}/{len(names)}: {names[min(count, len(names) - 1)]}"
        fetched = [int(number) for number in re.findall(r"\(line (\d+)\)", output)]
        if not fetched:
            return ""
        total = sum(line[:1] not in ("", "#") for line in lines) - output.count("\nIgnoring ")
        return f"Fetching packages {len(set(fetched))}/{total}: {lines[fetched[-1] - 1]}"

    # --only-binary: building from source would fetch tools that environment.txt does not pin.
    # --no-compile: Python compiles a module anyway when it is first used.
    options = ["--only-binary=:all:", "--no-compile", "--progress-bar=off", "-r", ENVIRONMENT.name]
    run_step([*pip_install(PYTHON), *options], progress)


def install_project() -> None:
    """Make the book's own package importable from where it lies, and JupyterLab quiet."""
    run_step([*pip_install(PYTHON), "--no-build-isolation", "--editable", "."])
    # pip leaves the absolute path of src here, and Pythons before 3.13 misread it if it has
    # letters outside the system's encoding. A path relative to site-packages has none.
    write(SITE_PACKAGES / "driftlab.pth", os.path.relpath(HOME / "src", SITE_PACKAGES) + "\n")
    # JupyterLab would offer to fetch news from the network.
    quiet = {"disabledExtensions": {"@jupyterlab/apputils-extension:announcements": True}}
    write(VENV / "etc/jupyter/labconfig/page_config.json", json.dumps(quiet))


def open_book(arguments: list[str]) -> int:
    """Start JupyterLab on the first notebook and wait until it ends."""
    parser = argparse.ArgumentParser(prog="lab.py open", usage="python3 lab.py --help")
    parser.add_argument("--no-browser", action="store_true")
    parser.add_argument("--port", type=int)
    options = parser.parse_args(arguments)
    if options.port and not is_free(options.port):
        raise Trouble(f"Port {options.port} cannot be had: choose another or leave --port out.")
    set_up()
    port = options.port or free_port()
    address = f"http://127.0.0.1:{port}"
    token = secrets.token_hex(24)
    command = [
        *[str(PYTHON), "-c", SERVER, NOTEBOOK],
        f"--ServerApp.root_dir={HOME}",
        "--ServerApp.ip=127.0.0.1",
        f"--ServerApp.port={port}",
        "--ServerApp.port_retries=0",
        "--ServerApp.base_url=/",
        f"--ServerApp.open_browser={not options.no_browser}",
        # Or it would open the tabs of another folder's book as well.
        f"--LabApp.workspaces_dir={VENV / 'workspaces'}",
        # Not WARN: that alarms beginners with "not trusted" at each opening of a clean notebook.
        "--ServerApp.log_level=ERROR",
        "--LabApp.log_level=ERROR",
    ]
    if os.name != "nt" and os.geteuid() == 0:
        command.append("--allow-root")
    say("Starting JupyterLab ...")
    # In a session of its own Ctrl-C does not reach the server, which would end in disorder from
    # that and our request together.
    environment = surroundings(DRIFTLAB_TOKEN=token)
    with running(command, env=environment, start_new_session=True) as server:
        try:
            wait_for(server, f"{address}/api/status", token)
            say(f"Drift Lab is open at\n\n  {address}/lab/tree/{NOTEBOOK}?token={token}\n")
            say("Ctrl-C stops it.")
            return abs(server.wait())
        except KeyboardInterrupt:
            say("\nStopping ...")
            return 0


def wait_for(server: "subprocess.Popen[bytes]", url: str, token: str) -> None:
    """Return when the server answers to our token, so that it is ours and ready."""
    request = urllib.request.Request(url, headers={"Authorization": f"token {token}"})
    direct = urllib.request.build_opener(urllib.request.ProxyHandler({}))
    while server.poll() is None:
        try:
            with direct.open(request, timeout=5):
                return
        except OSError:
            time.sleep(0.1)
    raise Trouble("JupyterLab ended before it was ready; its messages above tell why.")


def is_free(port: int) -> bool:
    with socket.socket() as probe:
        if os.name != "nt":  # as the server will: a port that was just closed is free
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind(("127.0.0.1", port))
        except (OSError, OverflowError):
            return False
    return True


def free_port() -> int:
    """Return Jupyter's usual port or the next one that is free."""
    return next(port for port in range(8888, 65536) if is_free(port))


def test(arguments: list[str]) -> int:
    """Check the project; pytest comes last so that its summary closes the output."""
    set_up()
    install_aside("what drives the browser", DRIVER, DRIVER_LIST)
    if arguments:
        return run("-m", "pytest", *arguments)
    return max([run("-m", "ruff", "check"), run("-m", "mypy"), run("-m", "pytest")])


def figures(arguments: list[str]) -> int:
    expect_none(arguments)
    set_up()
    return run("-m", "driftlab.figures")


def bench(arguments: list[str]) -> int:
    expect_none(arguments)
    set_up()
    install_aside("the packages to compare with", PEERS, PEERS_LIST)
    install_aside("what drives the browser", DRIVER, DRIVER_LIST)
    return run("tests/benchmarks/bench.py")


def install_aside(what: str, folder: Path, listing: Path) -> None:
    """Install packages into a folder of their own; say so if they cannot be had."""
    wanted, done = listing.read_text("utf-8"), folder / "installed.txt"
    try:
        with alone():
            if done.exists() and done.read_text("utf-8") == wanted:
                return
            say(f"Fetching {what}; the first time takes about half a minute.")
            fresh = folder.with_name(folder.name + ".new")  # what is there stays until it is here
            shutil.rmtree(fresh, ignore_errors=True)
            options = ["--only-binary=:all:", "--progress-bar=off", "--target", str(fresh)]
            run_step([*pip_install(PYTHON), *options, "-r", str(listing)])
            write(fresh / done.name, wanted)
            shutil.rmtree(folder, ignore_errors=True)
            fresh.rename(folder)
    except Trouble as trouble:
        say(f"Going on without {what}. {trouble}")


def expect_none(arguments: list[str]) -> None:
    if arguments:
        raise Trouble(f"This command takes no arguments; there came: {' '.join(arguments)}.")


def renew_lock(arguments: list[str]) -> int:
    """Write environment.txt with the newest packages that pyproject.toml allows."""
    expect_none(arguments)
    scope = ["--extra=dev", "--universal", "--python-version=3.11", "--fork-strategy=fewest"]
    plain = ["--no-header", "--no-annotate", "--no-emit-index-url", "--no-emit-find-links"]
    with alone(), tempfile.TemporaryDirectory() as folder:
        python = Path(folder, "venv", PYTHON.relative_to(VENV))
        packages = Path(folder, "packages.txt")
        make_venv(Path(folder, "venv"))
        run_step([*pip_install(python), "uv"])
        resolve = [str(python), "-m", "uv", "pip", "compile", PYPROJECT.name]
        run_step([*resolve, *scope, *plain, "--quiet", "--output-file", str(packages)])
        write(ENVIRONMENT, f"{LOCK_HEADER}{dependency_digest()}\n{packages.read_text('utf-8')}")
    say("environment.txt is renewed.")
    return 0


COMMANDS = {"open": open_book, "test": test, "figures": figures, "bench": bench, "lock": renew_lock}


def main(arguments: list[str]) -> int:
    """Do what the command line says and return the exit code."""
    if arguments[:1] in (["-h"], ["--help"], ["help"]):
        print(HELP, end="")
        return 0
    if not arguments or arguments[0].startswith("-"):
        arguments = ["open", *arguments]
    command, *rest = arguments
    if command not in COMMANDS:
        raise Trouble(f'There is no command "{command}"; there are {", ".join(COMMANDS)}.')
    return COMMANDS[command](rest)


if __name__ == "__main__":
    catch_signals()
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):  # a terminal may lack letters of our path
            stream.reconfigure(errors="backslashreplace")
    try:
        sys.exit(main(sys.argv[1:]))
    except Trouble as trouble:
        sys.exit(str(trouble))
    except KeyboardInterrupt:
        sys.exit("\nStopped; it is safe to run this again.")
