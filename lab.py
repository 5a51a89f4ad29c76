#!/usr/bin/env python3
"""Set up Drift Lab and open the book: ``python3 lab.py``."""

import argparse
import os
import platform
import re
import signal
import subprocess
import sys
import textwrap
import time
from collections.abc import Callable
from functools import partial
from itertools import chain
from pathlib import Path

# Old Pythons read this file too, so its syntax stays that of Python 3.6 and they stop here.
if sys.version_info < (3, 11):  # noqa: UP036
    sys.exit(
        f"Drift Lab needs Python 3.11 or newer; this is {platform.python_version()}. "
        "Install a newer one (https://www.python.org/downloads/) and run lab.py with that."
    )

sys.path.append(str(Path(__file__).resolve().parent))

from bootstrap import environment, installer
from bootstrap.copies import BOOK, bring_clean, bring_copies
from bootstrap.environment import set_up, site_tools, with_extras
from bootstrap.steps import (
    HOME,
    PYTHON,
    VERSION,
    NoPackages,
    Trouble,
    catch_signals,
    running,
    say,
    surroundings,
)

FIRST = "00_start_here.ipynb"
HEAD = """\
Drift Lab: an interactive textbook on how gyro misalignments become errors.

usage: python3 lab.py [COMMAND]     (on Windows: py lab.py [COMMAND])

"""
TAIL = """
python3 lab.py help COMMAND       shows the options of a command
python3 lab.py help developers    shows the others, also those for a class
docs/commands.md                  has all of this on one page
"""
ROW = r"^\| `(\w+)` \| (.*?) \| (.*?) ?\|$"
"""A command in docs/commands.md: its name, what it does, its options."""
# The longest groups first, as tests/conftest.py orders them, not those of the most tests.
# Two processors are busy with three of them: one waits for the browser half of the time.
AT_ONCE = ["-n", "3", "--dist", "loadgroup", "--no-loadscope-reorder", "--durations=10"]
# A process that dies takes its test to the next one, which dies of it too.
AT_ONCE += ["--max-worker-restart=2"]
# Packages of different age deprecate each other's ways, which is not the book's affair; what it
# calls itself must not be deprecated in the newest. A widget that takes no such argument is.
OF_DIFFERENT_AGE = [
    *["-W", "ignore::DeprecationWarning"],
    *["-W", "error:Passing unrecognized arguments:DeprecationWarning"],
]
LONG = ("browser", "kernel", "long", "setup", "slow")
QUICK = ["--hypothesis-profile=quick", "-m", " and ".join(f"not {mark}" for mark in LONG)]
COMPILE = ("-m", "uv", "pip", "compile", "--quiet")
# Of a system what uv calls it, and the names of its wheels. Of Linux all names up to the glibc of
# Debian 12 are listed: pip adds nothing to a name of this kind.
LINUX = [*(f"manylinux_2_{minor}_x86_64" for minor in range(36, 16, -1)), "manylinux2014_x86_64"]
SYSTEMS = {
    "windows": ("x86_64-pc-windows-msvc", ["win_amd64"]),
    "mac": ("aarch64-apple-darwin", ["macosx_14_0_arm64"]),
    "linux": ("x86_64-manylinux_2_36", LINUX),
}


def run(
    *arguments: str, python: Path = PYTHON, cwd: Path = HOME, env: dict[str, str] | None = None
) -> int:
    """Run a Python, the environment's, in sight of the user and return its exit code."""
    env = env or surroundings(python.parents[1])
    with running([str(python), *arguments], env=env, cwd=cwd) as process:
        return abs(process.wait())


def open_book(arguments: list[str]) -> int:
    """Open the first notebook in JupyterLab, which stays open until it is told to stop."""
    parser = argparse.ArgumentParser(prog="lab.py open", usage="python3 lab.py help open")
    parser.add_argument("--no-browser", action="store_true")
    parser.add_argument("--port", type=int, default=0)  # 0: any, chosen by the system
    parser.add_argument("--original", action="store_true")
    options = parser.parse_args(arguments)
    if not 0 <= options.port < 2**16:
        parser.error(f"--port: expected 0 to 65535, got {options.port}")
    try:
        set_up()
    except NoPackages as trouble:
        if not environment.runs():
            raise
        say(f"{trouble}\nMeanwhile the book opens with the packages of the last set-up.")
    folder = BOOK if options.original else bring_copies()
    say("Starting JupyterLab ...")
    command = [
        *[str(PYTHON), "-P", str(HOME / "bootstrap/server.py")],
        f"--ServerApp.root_dir={HOME}",
        f"--ServerApp.port={options.port}",
        f"--ServerApp.open_browser={not options.no_browser}",
        f"--LabApp.default_url=/lab/tree/{folder.name}/{FIRST}",
    ]
    if os.name != "nt":
        os.execve(PYTHON, command, surroundings())
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # a console sends Ctrl-C to both
    return subprocess.call(command, env=surroundings())


def fresh(arguments: list[str]) -> int:
    """Bring clean copies of all notebooks, or of those whose names begin so."""
    set_up()
    bring_clean(arguments)
    return 0


def test(arguments: list[str]) -> int:
    """Check the project, or run pytest alone if there are arguments for it."""
    set_up()
    marks = QUICK if "--quick" in arguments else ["-m", "long"] if "--long" in arguments else []
    chosen = [each for each in arguments if each not in ("--quick", "--long", "--site")]
    if "--site" in arguments:
        if not (HOME / os.environ.setdefault("DRIFTLAB_SITE", "_site")).is_dir():
            raise Trouble("There is no site to test; 'python3 lab.py site' builds it.")
        paths = [argument for argument in chosen if (HOME / argument.split("::")[0]).exists()]
        # Pages that compute seldom wait: two processors have enough of two.
        chosen += [] if paths else ["tests/site"]
        return run("-m", "pytest", *AT_ONCE, "-n", "2", *chosen)
    if chosen or "--long" in arguments:
        return run("-m", "pytest", *marks, *(chosen or AT_ONCE))
    begun = time.monotonic()
    linter = "from importlinter.cli import lint_imports_command; lint_imports_command()"
    checks = {"ruff": ["-m", "ruff", "check"], "mypy": ["-m", "mypy"]}
    # pytest comes last so that its summary closes the output.
    tests = ["-m", "pytest", *AT_ONCE, *(marks or ("-m", "not long"))]
    checks |= {"import-linter": ["-c", linter], "pytest": tests}
    codes = {name: run(*command) for name, command in checks.items()}
    failed = [name for name, code in codes.items() if code]
    minutes, seconds = divmod(round(time.monotonic() - begun), 60)
    say(f"{', '.join(failed) or 'nothing'} failed; {minutes} min {seconds} s in all")
    return max(codes.values())


def quick_tests(age: str, arguments: list[str]) -> int:
    """Run the quick tests, or some of them, with packages of another age."""
    python = environment.of_age(age)
    return run("-m", "pytest", *QUICK, *OF_DIFFERENT_AGE, *(arguments or AT_ONCE), python=python)


def program(python: Callable[[], Path], *command: str) -> Callable[[list[str]], int]:
    """Return a command that runs a program of the book, which sees paths as the caller does."""
    return lambda arguments: run(*command, *arguments, python=python(), cwd=Path.cwd())


def wheels(arguments: list[str]) -> int:
    """Fetch the packages into a folder, for computers without a network."""
    parser = argparse.ArgumentParser(prog="lab.py wheels", usage="python3 lab.py help wheels")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--system", choices=SYSTEMS)
    parser.add_argument("--python", default=VERSION)
    asked = parser.parse_args(arguments)
    if asked.python != VERSION and not asked.system:
        parser.error("--python needs --system, too: for which computers is it?")
    set_up()
    folder, listed = asked.folder.absolute(), "environment.txt"
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise Trouble(f"{folder} cannot be made: {error.strerror}.") from error
    options = ["--no-deps", "--only-binary=:all:", "--require-hashes", "--dest", str(folder)]
    if asked.system:  # pip would choose the lines of the list for this computer
        system, names = SYSTEMS[asked.system]
        options += ["--implementation", "cp", "--python-version", asked.python]
        options += [part for name in names for part in ("--platform", name)]
        chosen = ["--no-config", "--no-deps", "--generate-hashes", "--python-platform", system]
        chosen += ["--python-version", asked.python, "--output-file", "wheels.new"]
        if run(*COMPILE, listed, *chosen, env=installer.variables()):
            raise Trouble("environment.txt cannot be read for that system; see the messages above.")
        listed = "wheels.new"
    if run("-m", "pip", "download", "--quiet", *options, "-r", listed):
        raise Trouble(f"{folder} is not complete; the messages above tell why.")
    say(
        f"{folder} has {len([*folder.glob('*.whl')])} wheels. Where there is no network, set "
        "PIP_NO_INDEX=1 and PIP_FIND_LINKS to this folder before the first 'python3 lab.py'."
    )
    return 0


def lock(arguments: list[str]) -> int:
    """Write environment.txt with the newest packages that pyproject.toml allows, and the site's."""
    if arguments:
        raise Trouble(f"lock: expected nothing more, got {' '.join(arguments)}.")
    set_up()
    around = installer.variables()
    wishes = (*COMPILE, "pyproject.toml", "--upgrade", "--output-file")
    if run(*wishes, "environment.txt", env=around):
        return 1
    known = [f"--no-emit-package={pin.partition('==')[0]}" for pin in environment.pins()]
    site = ("--extra", "site", "--constraint", "environment.txt", *known)
    return run(*wishes, "site/packages.txt", *site, env=around)


this_python = partial(Path, sys.executable)
BOOK_PROGRAM = ("-P", "-m", "driftlab.book")  # -P: modules are not seen from where the caller is
COMMANDS: dict[str, Callable[[list[str]], int]] = {
    "open": open_book,
    "fresh": fresh,
    "test": test,
    "lowest": partial(quick_tests, "lowest"),
    "newest": partial(quick_tests, "newest"),
    "figures": program(set_up, *BOOK_PROGRAM, "figures"),
    "bench": program(partial(with_extras, "bench"), f"{HOME}/benchmarks/bench.py"),
    "peers": program(
        partial(with_extras, "bench", "cluster", "peers"), "-m", "pytest", f"{HOME}/benchmarks"
    ),
    "site": program(site_tools, f"{HOME}/site/build.py"),  # where a warning is an error
    "slides": program(site_tools, f"{HOME}/site/slides/make.py"),
    "print": program(site_tools, f"{HOME}/site/paper.py"),
    "class": program(set_up, *BOOK_PROGRAM, "class"),
    "student": program(this_python, f"{HOME}/deployment/student.py"),
    "wheels": wheels,
    "lock": lock,
    "release": program(this_python, f"{HOME}/release/write.py"),
}
FOR_READERS = ("open", "fresh", "figures", "wheels", "lock")
"""What a student's copy has; it has no release/release.toml."""


def help_text(subject: str = "") -> str:
    """Return the help on six commands to begin with, on the others ("developers"), or on one.

    It is read from docs/commands.md.
    """
    page = (HOME / "docs/commands.md").read_text("utf-8").partition("\n## python")[0]
    first, *others = [re.findall(ROW, part, re.M) for part in page.split("\n### ")[1:]]
    if subject in ("", "developers"):
        rows = chain(*others) if subject else first
        lines = ""
        for name, about, _ in rows:
            sentence = re.split(r"[.:;]( |$)", re.sub(r"\[(.*?)\]\(.*?\)|`", r"\1", about))[0]
            lines += f"  {name:<9} {textwrap.shorten(sentence, 67, placeholder=' ...')}\n"
        return lines if subject else HEAD + lines + TAIL
    for name, about, options in chain(first, *others):
        if name == subject:
            wrapped = textwrap.fill(f"  {name:<9} {about}", 78, subsequent_indent=12 * " ")
            below = (f"\n{14 * ' '}{option}" for option in options.split("<br>") if option)
            return f"{wrapped}{''.join(below)}\n".replace("`", "")
    raise no_command(subject)


def no_command(name: str) -> Trouble:
    return Trouble(f'There is no command "{name}"; there are {", ".join(COMMANDS)}.')


def main(arguments: list[str]) -> int:
    """Do what the command line says and return the exit code."""
    if arguments[:1] in (["-h"], ["--help"], ["help"]):
        print(help_text(*arguments[1:2]), end="")
        return 0
    if not arguments or arguments[0].startswith("-"):
        arguments = ["open", *arguments]
    command, *rest = arguments
    if command not in COMMANDS:
        raise no_command(command)
    if rest[:1] in (["-h"], ["--help"]) and command != "test":
        print(help_text(command), end="")
        return 0
    if command not in FOR_READERS and not (HOME / "release/release.toml").exists():
        raise Trouble(f'This is a student\'s copy of the book, which has no "{command}".')
    return COMMANDS[command](rest)


if __name__ == "__main__":
    catch_signals()
    for stream in filter(None, (sys.stdout, sys.stderr)):  # a terminal may lack letters of our path
        stream.reconfigure(errors="backslashreplace")
    try:
        sys.exit(main(sys.argv[1:]))
    except Trouble as trouble:
        sys.exit(str(trouble))
    except KeyboardInterrupt:
        sys.exit("\nStopped; it is safe to run this again.")
