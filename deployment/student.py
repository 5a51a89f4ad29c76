"""Packs a copy of the book for a class, without solutions and answers, for ``lab.py student``.

What a student's kernel must compute with, the package, has to be in it, and with it what is right
in each exercise: whoever reads the source finds it. Left out is what shows it ready to read.
"""

import argparse
import json
import re
import sys
import zipfile
from collections.abc import Iterator
from itertools import chain
from pathlib import Path, PurePosixPath

sys.path.append(str(Path(__file__).resolve().parents[1]))

from bootstrap.steps import HOME, Trouble, say

NAME = "drift-lab-student"
README = "release/STUDENT.md"
"""What stands in the copy as README.md."""
TAKEN = (
    *("CHANGELOG.md", "CITATION.bib", "CITATION.cff", "ERRATA.md", "LICENSE", "LICENSES"),
    *("environment.txt", "lab.py", "pyproject.toml", "bootstrap", "docs"),
    *("figures", "notebooks", "src"),
    "release/PYPI.md",  # without it the package cannot be installed
    *(".binder", "deployment/Dockerfile", "deployment/Dockerfile.dockerignore"),  # for a server
)
LEFT_OUT = (
    *("notebooks/solutions", "notebooks/instructors", "notebooks/for_instructors.ipynb"),
    *("notebooks/for_your_course.ipynb", "src/driftlab/book/instructors"),
    "docs/findings.md",  # which answers the puzzles
)
KINDS = {"notebooks": ("*.ipynb",), "figures": ("*.svg", "*.csv", "*.md")}
"""What is taken of folders in which a teacher may have files of another kind, marks say."""
MODEL = re.compile(r'^model = ("""[\s\S]*?"""|"(?:[^"\\]|\\.)*")\n', re.M)
"""How the book answers in words, in a file of hints."""
NEVER = {"__pycache__", ".ipynb_checkpoints", "guesses.json"}
LINK = re.compile(r"\[([^\]]*)\]\(([^)\s#]+)(#[^)\s]*)?\)")


def write_student_copy(target: Path) -> None:
    """Write the copy as a zip file."""
    try:
        with zipfile.ZipFile(target, "x", zipfile.ZIP_DEFLATED) as copy:
            for name, content in student_files():
                entry = zipfile.ZipInfo(f"{NAME}/{name}")  # of no date
                entry.external_attr = (0o755 if name == "lab.py" else 0o644) << 16
                entry.compress_type = zipfile.ZIP_DEFLATED
                copy.writestr(entry, content)
    except FileExistsError:
        raise Trouble(f"{target} is there already: move it away, or give another name.") from None
    except OSError as error:
        raise Trouble(f"{target} cannot be written: {error.strerror}.") from error
    say(f"{target} is ready for your students: they unpack it and run 'python3 lab.py' in it.")


def student_files() -> Iterator[tuple[str, bytes]]:
    """Give each file of the copy: its name, and what is in it."""
    names = sorted(_names())
    folders = (str(parent) for name in names for parent in PurePosixPath(name).parents)
    known = {"README.md", *names, *folders}
    yield "README.md", (HOME / README).read_bytes().replace(b"](../", b"](")
    for name in names:
        content = (HOME / name).read_bytes()
        if name.endswith(".ipynb"):
            content = _notebook(content.decode(), PurePosixPath(name).parent, known).encode()
        elif name.endswith(".md"):
            content = without_links(content.decode(), PurePosixPath(name).parent, known).encode()
        elif name.endswith("/hints.toml"):
            content = MODEL.sub("", content.decode()).encode()
        yield name, content


def without_links(text: str, folder: PurePosixPath, known: set[str]) -> str:
    """Return Markdown in which a link to a file that is not in the copy is its words alone."""

    def kept(link: re.Match[str]) -> str:
        words, target, _ = link.groups()
        if ":" in target or str(_flat(folder / target)) in known:
            return link[0]
        return words

    return LINK.sub(kept, text)


def _flat(path: PurePosixPath) -> PurePosixPath:
    """The path without `..`."""
    parts: list[str] = []
    for part in path.parts:
        if part == "..":
            parts[-1:] = []
        else:
            parts.append(part)
    return PurePosixPath(*parts)


def _names() -> Iterator[str]:
    for taken in TAKEN:
        path = HOME / taken
        kinds = KINDS.get(taken)
        inside = chain.from_iterable(map(path.glob, kinds)) if kinds else path.rglob("*")
        for file in [path] if path.is_file() else sorted(inside):
            name = file.relative_to(HOME).as_posix()
            if file.is_file() and not name.startswith(LEFT_OUT) and not {*file.parts} & NEVER:
                yield name


def _notebook(text: str, folder: PurePosixPath, known: set[str]) -> str:
    notebook = json.loads(text)
    for cell in notebook["cells"]:
        if cell["cell_type"] == "markdown":
            source = without_links("".join(cell["source"]), folder, known)
            cell["source"] = source.splitlines(keepends=True)
    return json.dumps(notebook, indent=1, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="lab.py student", usage="python3 lab.py help student")
    parser.add_argument("target", nargs="?", type=Path, default=HOME / "drift-lab-student.zip")
    try:
        write_student_copy(parser.parse_args().target.absolute())
    except Trouble as trouble:
        sys.exit(str(trouble))
