"""Where guesses are kept: a small file beside the notebook.

A file that cannot be read, or that something else has written, is left as it is; what is guessed
then lives as long as the kernel, and a sentence says so.
"""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import Any

from .puzzle import Answer, Puzzle

FILE = "guesses.json"
ABOUT = "What you guessed at the puzzles of Drift Lab. Delete this file to guess anew."

in_memory: dict[tuple[Path, str], Any] = {}
"""Guesses that could not be written, by their file and name."""


class Foreign(Exception):
    """The file is there and holds something else, or nobody may read it."""


def kept_guess(puzzle: Puzzle, path: Path | None = None) -> tuple[bool, list[Answer] | None]:
    """Return whether a puzzle was answered, and its guess; None if only the answer was looked at.

    Without a `path` the file is ``guesses.json`` in the kernel's folder.
    """
    path = _resolved(path)
    if (path, puzzle.key) in in_memory:
        return True, in_memory[path, puzzle.key]
    try:
        kept = _read(path)
    except Foreign:
        return False, None
    if puzzle.key not in kept or not puzzle.allows(kept[puzzle.key]):
        return False, None
    return True, kept[puzzle.key]


def keep(puzzle: Puzzle, guess: Sequence[Answer] | None, path: Path | None = None) -> str:
    """Keep the first guess at a puzzle; return a sentence if it could not be written.

    The guess is None if the answer was looked at first; `path` is that of `kept_guess`.
    """
    path = _resolved(path)
    answered, _ = kept_guess(puzzle, path)
    if answered:
        return ""
    value = None if guess is None else list(guess)
    try:
        kept = _read(path)
        # What does not fit this puzzle is not ours to throw away.
        if puzzle.key in kept:
            raise Foreign
        _write(path, {**kept, puzzle.key: value})
    except Foreign:
        in_memory[path, puzzle.key] = value
        return (
            f"{FILE} beside this notebook cannot be read as guesses of this book. It stays as "
            "it is, and this guess is kept until the kernel ends."
        )
    except OSError:
        in_memory[path, puzzle.key] = value
        return f"{FILE} cannot be written here; this guess is kept until the kernel ends."
    return ""


def _resolved(path: Path | None) -> Path:
    return (path or Path(FILE)).resolve()  # a link stays a link


def _read(path: Path) -> dict[str, Any]:
    """All guesses of a file, by name; none if there is no file."""
    try:
        content = json.loads(path.read_text("utf-8"))
    except FileNotFoundError:
        return {}
    except (OSError, ValueError, RecursionError) as error:
        raise Foreign from error
    if not isinstance(content, dict) or not isinstance(content.get("guesses"), dict):
        raise Foreign
    return content["guesses"]


def _write(path: Path, guesses: dict[str, Any]) -> None:
    """Put a new file in the place of the old one, whole or not at all."""
    if path.exists() and not os.access(path, os.W_OK):
        raise PermissionError(path)  # the folder might allow what the file does not
    text = json.dumps({"about": ABOUT, "guesses": guesses}, indent=1, ensure_ascii=False)
    with NamedTemporaryFile(
        "w", dir=path.parent, prefix=f"{path.name}.", suffix=".new", delete=False, encoding="utf-8"
    ) as new:
        new.write(text + "\n")
    try:
        os.replace(new.name, path)
    except OSError:
        os.unlink(new.name)
        raise
