"""``python -m driftlab``: what there is: commands for your own log, tasks, then every module.

``python -m driftlab WORD`` lists the tasks and the modules that speak of a word: IMU, boresight,
sculling. The name of a command starts the command; ``python -m driftlab find allan`` looks for the
word.
"""

from __future__ import annotations

import ast
import os
import re
import sys
import tomllib
from collections.abc import Iterator, Sequence
from pathlib import Path

from driftlab.commands import COMMANDS

NOTHING, STOPPED = 2, 130
"""Exit codes: nothing was found, as of a command mistyped; Ctrl-C."""
PACKAGE = Path(__file__).parent
RECIPES = "notebooks/i_want_to.ipynb"
END = (
    "\nThat was much. python -m driftlab find covariance shows what speaks of a word, tasks first;",
    f"tasks with their code, ten lines each at most, are in {RECIPES} of the book.",
)
"""What stays on the screen when the list has run past."""
FIND_HELP = """usage: python -m driftlab find [-h] [WORD ...]

Lists the tasks that mention all the words, in any order, and the modules that
mention them in the order given, with the names that these offer. Without a word
it lists everything.

example:

python -m driftlab find covariance"""
GROUND_FLOOR = (
    *("checks", "vectors", "quaternion", "earth", "axes", "conventions", "frames"),
    *(
        "triad",
        "body_frames",
        "imu",
        "higher_order_errors",
        "increments",
        "sampled_rates",
        "strapdown",
    ),
    *("allan", "noise_terms", "monte_carlo", "diagnosis"),
)
SUBJECTS = (
    *(
        "motion",
        "drift",
        "attitude",
        "recordings",
        "calibration",
        "gyrocompass",
        "symbolic",
        "book",
    ),
)


def first_line(tree: ast.Module | ast.FunctionDef | ast.ClassDef) -> str:
    """First line of a docstring."""
    return (ast.get_docstring(tree) or "").split("\n")[0]


def public_names(tree: ast.Module) -> list[str]:
    """Names that a module offers: constants, functions and classes, in their order.

    Checks of arguments, which the modules share, are left out.
    """
    names = []
    for node in tree.body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            names.append(node.name)
        elif isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            names += [t.id for t in targets if isinstance(t, ast.Name) and t.id.isupper()]
            if [t.id for t in targets if isinstance(t, ast.Name)] == ["__all__"] and node.value:
                names += ast.literal_eval(node.value)
    offered = dict.fromkeys(names)  # each once
    return [name for name in offered if not name.startswith(("_", "checked_"))]


def overview(word: str = "") -> Iterator[str]:
    """Lines that say what the package holds, without importing any of it.

    Parameters
    ----------
    word : str
        Only what has it in a name or a docstring, in capitals or not; everything if empty.
    """
    yield first_line(_tree(PACKAGE / "__init__.py"))
    for name in GROUND_FLOOR:
        module = PACKAGE / f"{name}.py"
        home = module if module.exists() else PACKAGE / name / "__init__.py"
        yield from _module(home, name, word)
    for name in SUBJECTS:
        modules = [
            line
            for path in sorted((PACKAGE / name).glob("[!_]*.py"))
            for line in _module(path, f"{name}.{path.stem}", word, indent="  ")
        ]
        if modules:
            yield f"\ndriftlab.{name}: {first_line(_tree(PACKAGE / name / '__init__.py'))}"
            yield from modules


def _tree(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


def _module(path: Path, name: str, word: str, indent: str = "") -> Iterator[str]:
    tree = _tree(path)
    names = public_names(tree)
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef)
    nodes = [node for node in ast.walk(tree) if isinstance(node, documented)]
    texts = [name, *names, *(ast.get_docstring(node) or "" for node in nodes)]
    if not _speak_of(word, texts):
        return
    yield f"\n{indent}driftlab.{name}: {first_line(tree)}"
    if names:
        yield f"{indent}    {', '.join(names)}"


def _speak_of(word: str, texts: Sequence[str]) -> bool:
    sought = r"\b" + r"\s+".join(map(re.escape, word.split()))
    return re.search(sought, " ".join(texts), re.IGNORECASE) is not None


def tasks(word: str = "") -> Iterator[str]:
    """Lines that say what readers want to do, and which functions do it.

    Parameters
    ----------
    word : str
        As for `overview`, but several words may stand in any order. A task has words besides
        those of its title.
    """
    subject = ""
    for task in tomllib.loads((PACKAGE / "tasks.toml").read_text(encoding="utf-8"))["task"]:
        functions = [f"driftlab.{name}" for name in task["functions"]]
        texts = [task["subject"], task["title"], *task["words"], *functions]
        if not all(_speak_of(one, texts) for one in word.split()):
            continue
        if not subject:
            yield f"Each in ten lines of code at most: {RECIPES}"
        if subject != task["subject"]:
            subject = task["subject"]
            yield f"\n{subject}"
        yield f"    {task['title']}"
        yield f"        {', '.join(functions)}"


def commands() -> Iterator[str]:
    """Lines that say which commands there are."""
    yield "Your own log: python -m driftlab COMMAND log.csv ...; COMMAND --help shows an example."
    width = max(map(len, COMMANDS))
    yield from (f"    {name:{width}}  {purpose}" for name, purpose in COMMANDS.items())
    yield f"    {'find':{width}}  tasks and modules that speak of a word; or leave find out"
    yield "The log of a turntable goes to driftlab.calibration.calibrate: chapter 11.\n"


def main(arguments: Sequence[str]) -> int:
    """Start a command, or list what there is."""
    if arguments and (arguments[0] in COMMANDS or arguments[0].startswith("-")):
        from driftlab.commands.line import main as start

        return start(arguments)
    sought = arguments[1:] if arguments[:1] == ["find"] else arguments
    if sought != arguments and sought[:1] in (["-h"], ["--help"]):
        print(FIND_HELP)
        return 0
    words = " ".join(sought)
    wanted, (title, *modules) = list(tasks(words)), overview(words)
    unknown = not wanted and not modules
    lines = [title, *(["", *wanted] if wanted else []), *modules]
    if unknown:
        from difflib import get_close_matches

        meant = get_close_matches(arguments[0].lower(), COMMANDS, 1)
        lines.append(
            f"Nothing here speaks of {words!r}. The words of the book are in chapter 19."
            f"{f' Did you mean the command {meant[0]}?' if meant else ''}"
        )
    try:
        print("\n".join(lines if arguments else [*commands(), *lines, *END]), flush=True)
    except BrokenPipeError:  # "| head" has read enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    return NOTHING if unknown else 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except KeyboardInterrupt:
        print("driftlab: stopped.", file=sys.stderr)
        sys.exit(STOPPED)
