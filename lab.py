#!/usr/bin/env python3
"""Set up Drift Lab and open the book: ``python3 lab.py``."""

import argparse
import errno
import io
import os
import platform
import re
import socket
import sys
import textwrap
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

# Old Pythons read this file too, so its syntax stays that of Python 3.6 and they stop here.
if sys.version_info < (3, 11):  # noqa: UP036
    sys.exit(
        f"Drift Lab needs Python 3.11 or newer; this is {platform.python_version()}. "
        "Install a newer one (https://www.python.org/downloads/) and run lab.py with that."
    )

sys.path.append(str(Path(__file__).resolve().parent))

from bootstrap.copies import BOOK, bring_clean, bring_copies
from bootstrap.environment import (
    LOWEST_LIST,
    PYPROJECT,
    SITE_LIST,
    beside,
    lock_line,
    of_today,
    pins,
    project,
    runs,
    set_up,
    write,
)
from bootstrap.installer import ENVIRONMENT, installers
from bootstrap.server import serve
from bootstrap.steps import (
    DISK_FULL,
    HOME,
    PYTHON,
    VENV,
    NoPackages,
    Trouble,
    catch_signals,
    run_step,
    running,
    say,
    surroundings,
)

LOWEST_HEAD = "# The oldest packages that pyproject.toml allows, for 'python3 lab.py lowest'.\n"
SITE_HEAD = "# What 'python3 lab.py site' needs beside environment.txt; by 'python3 lab.py lock'.\n"
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
SITE = "_site"
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
    # The page's stand-in has what ipywidgets 8 has; a slider of 7 has no tooltip.
    "--deselect=tests/site/test_widgets_standin.py::test_shows_the_same",
]
NEWEST_EXTRAS = ("book", "cluster", "compiled", "lab", "test", "dev")
# Paths are seen from where the caller is; -P: modules are not.
BOOK_PROGRAM = ("-P", "-m", "driftlab.book")
LONG = ("browser", "kernel", "long", "setup", "slow")
# Of the site and of a class, which only some change: .ci/run tries them by name.
ELSEWHERE = ["--ignore=tests/site", "--ignore=tests/class"]
QUICK = ["--hypothesis-profile=quick", "-m", " and ".join(f"not {mark}" for mark in LONG)]


def run(*arguments: str, python: Path = PYTHON, venv: Path = VENV, cwd: Path = HOME) -> int:
    """Run a Python, the environment's, in sight of the user and return its exit code."""
    with running([str(python), *arguments], env=surroundings(venv), cwd=cwd) as process:
        return abs(process.wait())


def open_book(arguments: list[str]) -> int:
    """Open the first notebook in JupyterLab, which stays open until it is told to stop."""
    parser = argparse.ArgumentParser(prog="lab.py open", usage="python3 lab.py help open")
    parser.add_argument("--no-browser", action="store_true")
    parser.add_argument("--port", type=int, default=0)  # 0: any, chosen by the system
    parser.add_argument("--original", action="store_true")
    options = parser.parse_args(arguments)
    if options.port:
        try:
            socket.create_server(("127.0.0.1", options.port)).close()
        except (OSError, OverflowError) as error:
            raise Trouble(
                f"Port {options.port} cannot be had: choose another or leave --port out."
            ) from error
    try:
        set_up()
    except NoPackages as trouble:
        if not runs():
            raise
        say(f"{trouble}\nMeanwhile the book opens with the packages of the last set-up.")
    folder = BOOK if options.original else bring_copies()
    serve(f"{folder.name}/{FIRST}", options.port, browser=not options.no_browser)
    return 0


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
        if not (HOME / os.environ.setdefault("DRIFTLAB_SITE", SITE)).is_dir():
            raise Trouble("There is no site to test; 'python3 lab.py site' builds it.")
        paths = [argument for argument in chosen if (HOME / argument.split("::")[0]).exists()]
        # Pages that compute seldom wait: two processors have enough of two.
        at_once = [*AT_ONCE, "-n", "2"]
        return run("-m", "pytest", *at_once, *chosen, *(() if paths else ["tests/site"]))
    if chosen or "--long" in arguments:
        return run("-m", "pytest", *marks, *(chosen or AT_ONCE))
    begun = time.monotonic()
    checks = {"ruff": ["-m", "ruff", "check"], "mypy": ["-m", "mypy"]}
    if "importlinter" in project()["tool"]:
        linter = "from importlinter.cli import lint_imports_command; lint_imports_command()"
        checks["import-linter"] = ["-c", linter]
    # pytest comes last so that its summary closes the output.
    checks["pytest"] = ["-m", "pytest", *AT_ONCE, *ELSEWHERE, *(marks or ("-m", "not long"))]
    codes = {name: run(*command) for name, command in checks.items()}
    failed = [name for name, code in codes.items() if code]
    minutes, seconds = divmod(round(time.monotonic() - begun), 60)
    say(f"{', '.join(failed) or 'nothing'} failed; {minutes} min {seconds} s in all")
    return max(codes.values())


def quick_tests(environment: Callable[[], Path], arguments: list[str]) -> int:
    """Run the quick tests, or some of them, in an environment whose packages are of another age."""
    python = environment()
    asked = [*QUICK, *OF_DIFFERENT_AGE, *(arguments or AT_ONCE)]
    return run("-m", "pytest", *asked, python=python, venv=python.parents[1])


def figures(arguments: list[str]) -> int:
    """Rebuild every figure and table, or some."""
    set_up()
    return run(*BOOK_PROGRAM, "figures", *arguments, cwd=Path.cwd())


def bench(arguments: list[str]) -> int:
    """Measure how fast the package is; without a choice of subjects, renew the page of it."""
    set_up()
    if not asks_for_help(arguments):
        fetch("bench")
    return run("benchmarks/bench.py", *arguments)


def peers(arguments: list[str]) -> int:
    """Ask the programs of others whether they compute the same; who is missing is skipped."""
    expect_none(arguments)
    set_up()
    for extra in ("bench", "cluster", "peers"):
        fetch(extra)
    return run("-m", "pytest", "benchmarks")


def asks_for_help(arguments: list[str]) -> bool:
    return bool({"-h", "--help"} & {*arguments})


def fetch(extra: str) -> None:
    """Bring the packages of an extra; they may not change what environment.txt pins."""
    wanted = project()["project"].get("optional-dependencies", {}).get(extra, [])
    if wanted:
        command, env = next(installers(VENV))
        try:
            run_step([*command, "--only-binary=:all:", *wanted, *pins()], env)
        except NoPackages as trouble:
            say(f"{trouble}\nGoing on without the packages to compare with.")


def by_site_tools(name: str, arguments: list[str]) -> int:
    """Run a script of the site in the environment that has its tools and return its exit code."""
    set_up()
    return run(name, *arguments, python=beside(SITE_LIST, "site", sees_venv=True))


def student(arguments: list[str]) -> int:
    """Pack a copy for students, into the file that is named, if one is."""
    if len(arguments) > 1 or any(argument.startswith("-") for argument in arguments):
        raise Trouble(f"student: expected at most one file, got {' '.join(arguments)}.")
    target = Path(*arguments).absolute() if arguments else HOME / "drift-lab-student.zip"
    return run("deployment/student.py", str(target), python=Path(sys.executable))


def class_report(arguments: list[str]) -> int:
    """Report what a class handed in."""
    if not arguments:
        raise Trouble('Say what to read: "python3 lab.py class FOLDER".')
    set_up()
    return run(*BOOK_PROGRAM, "class", *arguments, cwd=Path.cwd())


def wheels(arguments: list[str]) -> int:
    """Fetch the packages into a folder, for computers without a network."""
    if not arguments or arguments[0].startswith("-"):
        raise Trouble('Say where to put them: "python3 lab.py wheels FOLDER".')
    set_up()
    return run("-m", "bootstrap.offline", str(Path(arguments[0]).absolute()), *arguments[1:])


def lock(arguments: list[str]) -> int:
    """Write environment.txt with the newest packages that pyproject.toml allows, and more lists."""
    expect_none(arguments)
    set_up()
    write(ENVIRONMENT, lock_line() + resolved(ENVIRONMENT))
    say("environment.txt is renewed.")
    extras = project()["project"].get("optional-dependencies", {})
    if "book" in extras:
        write(LOWEST_LIST, LOWEST_HEAD + resolved(LOWEST_LIST, "--resolution", "lowest-direct"))
        say("The list of the oldest packages is renewed.")
    if "site" in extras:
        found = resolved(SITE_LIST, "--extra", "site", "--constraint", ENVIRONMENT.name)
        write(SITE_LIST, SITE_HEAD + without(found, ENVIRONMENT.read_text("utf-8")))
        say("The list of the site's packages is renewed.")
    return 0


def resolved(listed: Path, *options: str) -> str:
    """Return the packages that uv finds for a list; [tool.uv.pip] in pyproject.toml has more."""
    new = listed.with_suffix(".new")
    command = ["pip", "compile", PYPROJECT.name, "--upgrade", "--quiet", *options]
    if run("-m", "uv", *command, "--output-file", new.relative_to(HOME).as_posix()):
        raise Trouble(f"{listed.name} stays as it is; the messages above tell why.")
    found = new.read_text("utf-8")
    new.unlink()
    return found


def without(text: str, known: str) -> str:
    """Return a list of pinned packages without those, with the same hashes, of another list."""
    packages = re.findall(r"^[^\s#].*\n(?:[ \t].*\n)*", text, re.M)
    return "".join(package for package in packages if package not in known)


def release(arguments: list[str]) -> int:
    """Write addresses, date and digest of this version into the files that need them."""
    expect_none(arguments)
    return run("release/write.py", python=Path(sys.executable))


def expect_none(arguments: list[str]) -> None:
    if arguments:
        raise Trouble(f"This command takes no arguments; there came: {' '.join(arguments)}.")


COMMANDS: dict[str, Callable[[list[str]], int]] = {
    "open": open_book,
    "fresh": fresh,
    "test": test,
    "lowest": partial(quick_tests, partial(beside, LOWEST_LIST, "lowest")),
    "newest": partial(quick_tests, partial(of_today, NEWEST_EXTRAS)),
    "figures": figures,
    "bench": bench,
    "peers": peers,
    "site": partial(by_site_tools, "site/build.py"),  # where a warning is an error
    "slides": partial(by_site_tools, "site/slides/make.py"),
    "print": partial(by_site_tools, "site/paper.py"),
    "class": class_report,
    "student": student,
    "wheels": wheels,
    "lock": lock,
    "release": release,
}


NEEDS = {
    **dict.fromkeys(("test", "lowest"), "tests"),
    **dict.fromkeys(("bench", "peers"), "benchmarks"),
    **dict.fromkeys(("site", "slides", "print"), "site"),
    **dict.fromkeys(("class", "student"), "src/driftlab/book/instructors"),
    "release": "release/release.toml",
}
"""The files that commands need and that a student's copy does not have."""


def help_text(subject: str = "") -> str:
    """Return the help on six commands to begin with, on the others ("developers"), or on one.

    It is read from docs/commands.md.
    """
    text = (HOME / "docs/commands.md").read_text("utf-8").partition("\n## python")[0]
    first, *others = [re.findall(ROW, part, re.M) for part in text.split("\n### ")[1:]]
    rows = {name: (about, options) for part in (first, *others) for name, about, options in part}
    if not subject:
        return HEAD + "".join(brief(name, about) for name, about, _ in first) + TAIL
    if subject == "developers":
        return "".join(brief(name, about) for part in others for name, about, _ in part)
    if subject not in rows:
        raise no_command(subject)
    about, options = rows[subject]
    lines = textwrap.wrap(f"  {subject:<9} {about}", 78, subsequent_indent=12 * " ")
    lines += [14 * " " + option for option in options.split("<br>") if option]
    return "\n".join(lines).replace("`", "") + "\n"


def brief(name: str, about: str) -> str:
    """Return a line on a command: its first sentence, shortened."""
    words = re.split(r"[.:;]( |$)", re.sub(r"\[(.*?)\]\(.*?\)|`", r"\1", about))[0]
    return f"  {name:<9} {textwrap.shorten(words, 67, placeholder=' ...')}\n"


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
    if not (HOME / NEEDS.get(command, ".")).exists():
        raise Trouble(f'This is a student\'s copy of the book, which has no "{command}".')
    return COMMANDS[command](rest)


if __name__ == "__main__":
    catch_signals()
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):  # a terminal may lack letters of our path
            stream.reconfigure(errors="backslashreplace")
    try:
        code = main(sys.argv[1:])
        if sys.stdout:
            sys.stdout.flush()
        sys.exit(code)
    except OSError as error:
        if not sys.stdout or error.errno not in (errno.EPIPE, errno.ENOSPC):
            raise
        # What is printed finds no place, or no reader, as of "lab.py help | head". Python would
        # try once more at the end.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(DISK_FULL if error.errno == errno.ENOSPC else 1)
    except Trouble as trouble:
        sys.exit(str(trouble))
    except KeyboardInterrupt:
        sys.exit("\nStopped; it is safe to run this again.")
