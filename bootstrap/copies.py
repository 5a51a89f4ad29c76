"""Keeps the reader's own copies of the notebooks, which git ignores.

A copy carries the fingerprint of the notebook it was made from. As long as it holds the same text
and no outputs nobody has worked in it, and it follows the book; from then on it is the reader's,
and nothing here replaces it: on request it gets another name and a clean copy takes its place.
"""

import errno
import hashlib
import json
import os
import re
import subprocess
import time
from collections.abc import Iterable
from enum import Enum
from pathlib import Path
from typing import Any, NamedTuple

from bootstrap.environment import alone, write
from bootstrap.steps import HOME, PYTHON, Trouble, say

BOOK = HOME / "notebooks"
COPIES = HOME / "my-book"  # beside notebooks, so that links such as ../ERRATA.md hold in both
KEY = "driftlab"  # in a copy's metadata: what the fingerprint stands under

# What a kernel says of its language. JupyterLab writes it into a notebook that it opens, and would
# ask at the end whether to save that.
LANGUAGE = {
    "codemirror_mode": {"name": "ipython", "version": 3},
    "file_extension": ".py",
    "mimetype": "text/x-python",
    "name": "python",
    "nbconvert_exporter": "python",
    "pygments_lexer": "ipython3",
}


class State(Enum):
    """What there is in the place of a copy."""

    MISSING = "nothing"
    CLEAN = "what the book has"
    UNTOUCHED = "an older notebook of the book, in which nobody has worked"
    KEPT = "the reader's"
    BEHIND = "the reader's, and the book has changed since"


class Copy(NamedTuple):
    """A notebook of the book and its copy: where it is, what it has, what it has when clean."""

    path: Path
    state: State
    clean: str

    @property
    def short(self) -> str:
        """The name without folder and ending; of a chapter the number."""
        name = self.path.relative_to(COPIES).with_suffix("").as_posix()
        return re.sub(r"(\d)_.*", r"\1", name)


def bring_copies() -> Path:
    """Make the copies that are missing, renew the untouched ones, and return their folder.

    It is the book's own folder if nothing can be written here.
    """
    copies = list_copies()
    wanting = [copy for copy in copies if copy.state in (State.MISSING, State.UNTOUCHED)]
    if wanting and os.access(HOME, os.W_OK):
        if not COPIES.exists():
            say(f"Your own copies of the notebooks are in {COPIES.name}; git ignores them.")
        with alone():
            for copy in wanting:
                place(copy)
    elif any(copy.state is State.MISSING for copy in copies):
        say(f"{HOME} cannot be written: the book opens to be read, and keeps no changes.")
        return BOOK
    behind = [copy.short for copy in copies if copy.state is State.BEHIND]
    if behind:
        say(
            f"The book has changed since you began {', '.join(behind)}; what is yours stays. "
            f"'python3 lab.py fresh {behind[0]}' brings the new one and puts yours aside."
        )
    return COPIES


def bring_clean(beginnings: list[str]) -> None:
    """Put clean copies in place, all or those of some names; the reader's own are put aside."""
    copies = list_copies()
    if beginnings:
        begins = tuple(re.sub(r"^\d$", r"0\g<0>", Path(name).name) for name in beginnings)
        for name, begin in zip(beginnings, begins, strict=True):
            if not any(copy.path.name.startswith(begin) for copy in copies):
                there = ", ".join(copy.short for copy in copies if copy.path.parent == COPIES)
                raise Trouble(f'There is no chapter "{name}"; there are {there}.')
        copies = [copy for copy in copies if copy.path.name.startswith(begins)]
    with alone():
        for copy in copies:
            if copy.state in (State.KEPT, State.BEHIND):
                mend_save(copy.path)
                aside = free_name(copy.path)
                copy.path.rename(aside)
                say(f"{copy.short}: yours is now {aside.relative_to(HOME)}.")
                copy = copy._replace(state=State.MISSING)
            if copy.state is not State.CLEAN:
                place(copy)
    what = ", ".join(copy.short for copy in copies) if beginnings else "all notebooks"
    say(f"{COPIES.name} has clean copies of {what}.")


def list_copies() -> list[Copy]:
    """Compare the book with the copies; say which of its files are no notebooks."""
    try:
        language, copies = language_of(PYTHON), []
        for original in sorted(BOOK.rglob("*.ipynb")):
            if ".ipynb_checkpoints" not in original.parts:
                try:
                    clean = clean_text(original.read_text("utf-8"), language)
                except (ValueError, LookupError, TypeError):
                    say(f"{original.relative_to(HOME)} is damaged and brings no copy.")
                    continue
                path = COPIES / original.relative_to(BOOK)
                copies.append(Copy(path, state_of(path, clean), clean))
    except OSError as error:
        raise Trouble(f"{error.filename} cannot be read: {error.strerror}.") from error
    if not copies:
        raise Trouble(f"The project is incomplete, get it afresh: {BOOK} has no notebooks.")
    return copies


def language_of(python: Path) -> dict[str, Any]:
    """Return what a kernel of this Python says of its language."""
    asked = [str(python), "-I", "-S", "-c", "import sys; print(sys.version.split()[0])"]
    version = subprocess.run(asked, check=True, capture_output=True, text=True).stdout.strip()
    return {**LANGUAGE, "version": version}


def clean_text(original: str, language: dict[str, Any]) -> str:
    """Return a notebook of the book as a copy has it."""
    notebook = json.loads(original)
    cells = [{**cell, "outputs": []} for cell in notebook["cells"]]
    # Outputs in the book are somebody's work: with them a copy counts as touched.
    made_from = {KEY: fingerprint(cells), "language_info": language}
    notebook["metadata"] = {**notebook["metadata"], **made_from}
    return json.dumps(notebook, indent=1, ensure_ascii=False, sort_keys=True) + "\n"


def fingerprint(cells: Iterable[dict[str, Any]]) -> str:
    """Return the digest of what can be somebody's work: text, outputs and attached files."""
    work = [
        [cell["cell_type"], "".join(cell["source"]), cell.get("outputs") or [], attached]
        for cell in cells
        for attached in [cell.get("attachments") or {}]
    ]
    return hashlib.sha256(json.dumps(work, sort_keys=True).encode()).hexdigest()


def state_of(path: Path, clean: str) -> State:
    """Tell what is in the place of a copy; in doubt it is the reader's."""
    if not os.path.lexists(path):
        return State.MISSING
    if path.is_symlink() or not path.is_file():
        return State.KEPT
    try:
        text = path.read_text("utf-8")
        notebook = json.loads(text)
        made_from = notebook["metadata"][KEY]
        touched = fingerprint(notebook["cells"]) != made_from
    except (ValueError, LookupError, TypeError):
        return State.KEPT
    if text == clean:
        return State.KEPT if touched else State.CLEAN
    if not touched:
        return State.UNTOUCHED
    return State.KEPT if made_from == json.loads(clean)["metadata"][KEY] else State.BEHIND


def place(copy: Copy) -> None:
    """Write a clean copy, unless somebody has been quicker."""
    if state_of(copy.path, copy.clean) is copy.state:
        try:
            write(copy.path, copy.clean)
        except OSError as error:
            if error.errno in (errno.EEXIST, errno.ENOTDIR):
                what = f"{copy.path.parent} is in the way of the copies: move it away"
                raise Trouble(f"{what} and run this again.") from error
            copy.path.with_name(copy.path.name + ".new").unlink(missing_ok=True)
            raise


def mend_save(path: Path) -> None:
    """Bring back what was there before a save that was cut off.

    JupyterLab, killed while it saves, leaves it under this name. It mends so itself when it opens
    the notebook; under another name it would not.
    """
    before = path.with_name(f".~{path.name}")
    if before.is_file():
        try:
            json.loads(path.read_text("utf-8"))
        except (OSError, ValueError):
            path.replace(path.with_name(f"{path.name}.invalid"))
            before.rename(path)


def free_name(path: Path) -> Path:
    """Return a name beside `path` with today's date that nothing has yet."""
    today = time.strftime("%Y-%m-%d")
    number = 1
    while True:
        end = f"-{number}" if number > 1 else ""
        free = path.with_name(f"{path.stem}.{today}{end}{path.suffix}")
        if not os.path.lexists(free):
            return free
        number += 1
