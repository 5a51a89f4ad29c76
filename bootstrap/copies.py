"""Keeps the reader's own copies of the notebooks, which git ignores.

A copy carries the fingerprint of the notebook it was made from. As long as it holds the same text
and no outputs nobody has worked in it, and it follows the book; from then on it is the reader's,
and nothing here replaces it: on request it gets another name and a clean copy takes its place.
"""

import hashlib
import json
import os
import platform
import re
import time
from collections.abc import Iterable
from enum import Enum
from itertools import chain, count
from pathlib import Path
from typing import Any

from bootstrap.environment import alone, write
from bootstrap.steps import HOME, Trouble, say

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
    "version": platform.python_version(),
}


State = Enum("State", ["CLEAN", "UNTOUCHED", "KEPT", "BEHIND"])
"""What there is in the place of a copy: what the book has; nothing, or an older notebook of the
book in which nobody has worked; the reader's; the reader's, and the book has changed since."""


def bring_copies() -> Path:
    """Make the copies that are missing, renew the untouched ones, and return their folder.

    It is the book's own folder if nothing can be written here.
    """
    copies = clean_copies()
    if not os.access(HOME, os.W_OK):
        if all(path.exists() for path in copies):
            return COPIES
        say(f"{HOME} cannot be written: the book opens to be read, and keeps no changes.")
        return BOOK
    if not COPIES.exists():
        say(f"Your own copies of the notebooks are in {COPIES.name}; git ignores them.")
    states = {path: state_of(path, clean) for path, clean in copies.items()}
    if State.UNTOUCHED in states.values():
        renew(copies)
    behind = [short(path) for path, state in states.items() if state is State.BEHIND]
    if behind:
        say(
            f"The book has changed since you began {', '.join(behind)}; what is yours stays. "
            f"'python3 lab.py fresh {behind[0]}' brings the new one and puts yours aside."
        )
    return COPIES


def bring_clean(beginnings: list[str]) -> None:
    """Put clean copies in place, all or those of some names; the reader's own are put aside."""
    copies = clean_copies()
    begins = [re.sub(r"^\d$", r"0\g<0>", Path(name).name) for name in beginnings]
    for name, begin in zip(beginnings, begins, strict=True):
        if not any(path.name.startswith(begin) for path in copies):
            there = ", ".join(short(path) for path in copies if path.parent == COPIES)
            raise Trouble(f'There is no chapter "{name}"; there are {there}.')
    copies = {path: copies[path] for path in copies if path.name.startswith(tuple(begins) or "")}
    with alone():
        for path, clean in copies.items():
            if state_of(path, clean) in (State.KEPT, State.BEHIND):
                # JupyterLab, killed while it saves, leaves under this name what was there before.
                before = path.with_name(f".~{path.name}")
                for mine in filter(os.path.lexists, (before, path)):
                    aside = free_name(path)
                    mine.rename(aside)
                    say(f"{short(path)}: yours is now {aside.relative_to(HOME)}.")
    renew(copies)
    what = ", ".join(map(short, copies)) if beginnings else "all notebooks"
    say(f"{COPIES.name} has clean copies of {what}.")


def renew(copies: dict[Path, str]) -> None:
    """Write clean copies, but where somebody has worked in one by now."""
    with alone():
        for path, clean in copies.items():
            if state_of(path, clean) is State.UNTOUCHED:
                try:
                    write(path, clean)
                except (FileExistsError, NotADirectoryError) as error:
                    what = f"{path.parent} is in the way of the copies: move it away"
                    raise Trouble(f"{what} and run this again.") from error


def clean_copies() -> dict[Path, str]:
    """Return where the copies of the book's notebooks are, and what each has when it is clean."""
    copies = {}
    for path in sorted(BOOK.rglob("*.ipynb")):
        if ".ipynb_checkpoints" not in path.parts:
            try:
                copies[COPIES / path.relative_to(BOOK)] = clean_text(path.read_text("utf-8"))
            except (OSError, ValueError, LookupError, TypeError):
                say(f"{path.relative_to(HOME)} is damaged and brings no copy.")
    if not copies:
        raise Trouble(f"The project is incomplete, get it afresh: {BOOK} has no notebooks.")
    return copies


def clean_text(original: str) -> str:
    """Return a notebook of the book as a copy has it."""
    notebook = json.loads(original)
    cells = [{**cell, "outputs": []} for cell in notebook["cells"]]
    # Outputs in the book are somebody's work: with them a copy counts as touched.
    made_from = {KEY: fingerprint(cells), "language_info": LANGUAGE}
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
        return State.UNTOUCHED
    try:
        text = "" if path.is_symlink() else path.read_text("utf-8")
        notebook = json.loads(text)
        made_from = notebook["metadata"][KEY]
        touched = fingerprint(notebook["cells"]) != made_from
    except (OSError, ValueError, LookupError, TypeError):
        return State.KEPT
    if not touched:
        return State.CLEAN if text == clean else State.UNTOUCHED
    return State.KEPT if made_from == json.loads(clean)["metadata"][KEY] else State.BEHIND


def short(path: Path) -> str:
    """Return the name of a copy without folder and ending; of a chapter the number."""
    return re.sub(r"(\d)_.*", r"\1", path.relative_to(COPIES).with_suffix("").as_posix())


def free_name(path: Path) -> Path:
    """Return a name beside `path` with today's date that nothing has yet."""
    start = f"{path.stem}.{time.strftime('%Y-%m-%d')}"
    endings = chain([""], (f"-{number}" for number in count(2)))
    names = (path.with_name(start + end + path.suffix) for end in endings)
    return next(free for free in names if not os.path.lexists(free))
