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
import time
from pathlib import Path

# Old Pythons read this file too, so its syntax stays that of Python 3.6 and they stop here.
if sys.version_info < (3, 11):  # noqa: UP036
    sys.exit(
        f"Drift Lab needs Python 3.11 or newer; this is {platform.python_version()}. "
        "Install a newer one (https://www.python.org/downloads/) and run lab.py with that."
    )

sys.path.append(str(Path(__file__).resolve().parent))

from bootstrap.beside import (
    LOWEST_HEAD,
    LOWEST_LIST,
    SITE_HEAD,
    SITE_LIST,
    apart,
    of_today,
    without,
)
from bootstrap.copies import BOOK, bring_clean, bring_copies
from bootstrap.environment import (
    ENVIRONMENT,
    PYPROJECT,
    lock_line,
    pins,
    project,
    runs,
    set_up,
    write,
)
from bootstrap.release import version, written
from bootstrap.server import serve
from bootstrap.steps import (
    DISK_FULL,
    HOME,
    PYTHON,
    NoPackages,
    Trouble,
    catch_signals,
    running,
    say,
    surroundings,
)
from bootstrap.teaching import TEACHING, by_site_tools, expect_whole, seen_from_here

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
FIRST_STEPS = """\
  open      set up what is missing and open your copy of the book (the default)
              --no-browser   only print the address
              --port N       use this port
              --original     open the book itself, for authors
  fresh     make clean notebooks and keep yours ("fresh 03": of a chapter)
  test      check that everything works on your computer
              --quick        leave out browsers, chapters, set-ups, long studies
              --site         only the site that "site" built, in _site or in
                             the folder that DRIFTLAB_SITE names
              other arguments go to pytest, which then runs alone
  figures   rebuild all figures and tables ("figures 03": those of a chapter)
              "figures 10-operating-formula" rebuilds one figure
              --workers N           processes for studies of many runs;
                                    one per core if this is not given
              --scheduler ADDRESS   send those runs to a dask cluster
              --keep FOLDER         keep finished runs, and continue from them
              --compare             write nothing; list numbers that differ
  print     make a PDF of the whole book in _print ("print 03": of a chapter)
              "print 03 lab_sheet solutions/03" prints these notebooks
              --no-code      only the results of the cells
              --exercises    only the exercises of a chapter, with room to write
              --edition TEXT only the examination with the numbers that belong
                             to this text, and its marking scheme
              --paper us-letter   instead of A4
  slides    make slides that need no network ("slides 03": of a chapter)
              they are written to _slides
              --code         show the code as well
"""
OTHERS = """\
For a class

  student   pack a copy for students, without solutions and teachers' pages
              a name for the zip file may follow
  class     report what a class got wrong: "class FOLDER", its notebooks
              --chapters 03,04   exercises of these chapters only
              --output FOLDER    where to write; else next to what is read
  site      build the book as a live web site and as a PDF, in _site
              --self-contained FOLDER   with Pyodide from this folder
  wheels    download all packages for use without a network: "wheels FOLDER"
              --system windows   for another system: windows, mac or linux
              --python 3.12      for another version of Python

For developers

  lowest    run the quick tests with the oldest packages that are allowed
  newest    run the quick tests with the newest packages that are allowed
  bench     measure the speed, next to other packages and C; write speed.md
              "bench attitude filter" prints these subjects only
              --repeats N    rounds of each row
              --no-write     print only
  peers     download programs of others and compare their results with ours
  lock      renew all lists of packages from pyproject.toml
  release   write the facts of release/release.toml where they are needed
"""
ENTRY = re.compile(r"^  (\w+) .*\n(?: {14}.*\n)*", re.MULTILINE)
"""A command in these texts: its first line, then its options, which are indented further."""
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
LONG = ("browser", "kernel", "setup", "slow")
QUICK = ["--hypothesis-profile=quick", "-m", " and ".join(f"not {mark}" for mark in LONG)]


def run(*arguments: str) -> int:
    """Run the environment's Python in sight of the user and return its exit code."""
    with running([str(PYTHON), *arguments]) as process:
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
    marks = QUICK if "--quick" in arguments else []
    chosen = [argument for argument in arguments if argument not in ("--quick", "--site")]
    if "--site" in arguments:
        if not (HOME / os.environ.setdefault("DRIFTLAB_SITE", SITE)).is_dir():
            raise Trouble("There is no site to test; 'python3 lab.py site' builds it.")
        paths = [argument for argument in chosen if (HOME / argument.split("::")[0]).exists()]
        # Pages that compute seldom wait: two processors have enough of two.
        at_once = [*AT_ONCE, "-n", "2"]
        return run("-m", "pytest", *at_once, *chosen, *(() if paths else ["tests/site"]))
    if chosen:
        return run("-m", "pytest", *marks, *chosen)
    begun = time.monotonic()
    checks = {"ruff": ["-m", "ruff", "check"], "mypy": ["-m", "mypy"]}
    if "importlinter" in project()["tool"]:
        linter = "from importlinter.cli import lint_imports_command; lint_imports_command()"
        checks["import-linter"] = ["-c", linter]
    # pytest comes last so that its summary closes the output.
    checks["pytest"] = ["-m", "pytest", *AT_ONCE, *marks]
    codes = {name: run(*command) for name, command in checks.items()}
    failed = [name for name, code in codes.items() if code]
    minutes, seconds = divmod(round(time.monotonic() - begun), 60)
    say(f"{', '.join(failed) or 'nothing'} failed; {minutes} min {seconds} s in all")
    return max(codes.values())


def lowest(arguments: list[str]) -> int:
    """Run the quick tests in an environment of the oldest packages that are allowed."""
    return quick_tests(apart(LOWEST_LIST), arguments)


def newest(arguments: list[str]) -> int:
    """Run the quick tests in an environment of the newest packages that are allowed."""
    return quick_tests(of_today(NEWEST_EXTRAS), arguments)


def quick_tests(python: Path, arguments: list[str]) -> int:
    """Run the quick tests, or some of them, in an environment whose packages are of another age."""
    asked = [*QUICK, *OF_DIFFERENT_AGE, *(arguments or AT_ONCE)]
    around = surroundings(python.parents[1])
    with running([str(python), "-m", "pytest", *asked], env=around) as process:
        return abs(process.wait())


def figures(arguments: list[str]) -> int:
    """Rebuild every figure and table, or some."""
    set_up()
    # Of what is said, only this is a path.
    seen = [
        seen_from_here(each) if last == "--keep" or each.startswith("--keep=") else each
        for last, each in zip(["", *arguments], arguments, strict=False)
    ]
    return run("-m", "driftlab.book", "figures", *seen)


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
    pip = ["pip", "install", "--quiet", "--no-input", "--retries=2", "--only-binary=:all:"]
    if wanted and run("-m", *pip, *wanted, *pins()):
        say("Going on without the packages to compare with.")


def site(arguments: list[str]) -> int:
    """Build the site in an environment of its own; a warning is an error."""
    return by_site_tools("site/build.py", arguments)


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
        write(SITE_LIST, SITE_HEAD + without(ENVIRONMENT.read_text("utf-8"), found))
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


def release(arguments: list[str]) -> int:
    """Write addresses, date and digest of this version into the files that need them."""
    expect_none(arguments)
    for path, text in written().items():
        write(path, text)
    say(f"Written for version {version()}; release/README.md says what comes next.")
    return 0


def expect_none(arguments: list[str]) -> None:
    if arguments:
        raise Trouble(f"This command takes no arguments; there came: {' '.join(arguments)}.")


COMMANDS = {
    "open": open_book,
    "fresh": fresh,
    "test": test,
    "lowest": lowest,
    "newest": newest,
    "figures": figures,
    "bench": bench,
    "peers": peers,
    "site": site,
    **TEACHING,
    "lock": lock,
    "release": release,
}


def help_text(subject: str = "") -> str:
    """Return the help on six commands to begin with, on the others ("developers"), or on one."""
    if not subject:
        lines = [entry[0].splitlines()[0] for entry in ENTRY.finditer(FIRST_STEPS)]
        return HEAD + "\n".join([*lines, TAIL])
    entries = {entry[1]: entry[0] for entry in ENTRY.finditer(FIRST_STEPS + OTHERS)}
    if subject not in {"developers", *entries}:
        raise no_command(subject)
    return OTHERS if subject == "developers" else entries[subject]


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
    expect_whole(command)
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
