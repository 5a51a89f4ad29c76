"""Commands for whoever teaches from the book: slides and paper, made by the site's tools, and more.

A student's copy has none of what they need.
"""

from pathlib import Path

from bootstrap.beside import SITE_LIST, beside
from bootstrap.environment import set_up
from bootstrap.steps import HOME, PYTHON, Trouble, running
from bootstrap.student import NAME, write_student_copy

NEEDS = {
    **dict.fromkeys(("test", "lowest"), "tests"),
    **dict.fromkeys(("bench", "peers"), "benchmarks"),
    **dict.fromkeys(("site", "slides", "print"), "site"),
    **dict.fromkeys(("class", "student"), "src/driftlab/book/instructors"),
    "release": "release/release.toml",
}
"""What commands need that a student's copy has not."""


def expect_whole(command: str) -> None:
    """Refuse a command that this copy of the book has not the files for."""
    if not (HOME / NEEDS.get(command, ".")).exists():
        raise Trouble(f'This is a student\'s copy of the book, which has no "{command}".')


def print_(arguments: list[str]) -> int:
    """Print chapters, or the whole book, as PDF in _print."""
    return by_site_tools("site/paper.py", arguments)


def slides(arguments: list[str]) -> int:
    """Make the slides of some chapters, or of all."""
    return by_site_tools("site/slides/make.py", arguments)


def by_site_tools(script: str, arguments: list[str]) -> int:
    """Run a script of the site in the environment that has its tools and return its exit code."""
    set_up()
    python = beside(SITE_LIST)
    with running([str(python), script, *arguments]) as process:
        return abs(process.wait())


def student(arguments: list[str]) -> int:
    """Pack a copy for students, into the file that is named, if one is."""
    if len(arguments) > 1 or any(argument.startswith("-") for argument in arguments):
        raise Trouble(f"student: expected at most one file, got {' '.join(arguments)}.")
    write_student_copy(Path(*arguments) if arguments else HOME / f"{NAME}.zip")
    return 0


def class_report(arguments: list[str]) -> int:
    """Report what a class got wrong."""
    if not arguments:
        raise Trouble('Say what to read: "python3 lab.py class FOLDER".')
    set_up()
    # Paths are seen from where the caller is, and commands run in the project's folder.
    before = ["", *arguments]
    paths = [
        each if "--chapters" in (last, each.partition("=")[0]) else seen_from_here(each)
        for last, each in zip(before, arguments, strict=False)
    ]
    with running([str(PYTHON), "-m", "driftlab.book", "class", *paths]) as process:
        return abs(process.wait())


def seen_from_here(argument: str) -> str:
    """Return a path, or an option with its path as in "--output=report", as an absolute one."""
    if argument.startswith("-o") and len(argument) > 2:
        return f"-o{Path(argument[2:]).absolute()}"
    if not argument.startswith("-"):
        return str(Path(argument).absolute())
    option, equals, path = argument.partition("=")
    return f"{option}={Path(path).absolute()}" if equals and path else argument


def wheels(arguments: list[str]) -> int:
    """Fetch the packages into a folder, for computers without a network."""
    if not arguments or arguments[0].startswith("-"):
        raise Trouble('Say where to put them: "python3 lab.py wheels FOLDER".')
    set_up()
    folder, *options = arguments
    command = [str(PYTHON), "-m", "bootstrap.offline", str(Path(folder).absolute()), *options]
    with running(command) as process:
        return abs(process.wait())


TEACHING = {
    "slides": slides,
    "print": print_,
    "class": class_report,
    "student": student,
    "wheels": wheels,
}
