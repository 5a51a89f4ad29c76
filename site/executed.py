"""The notebooks of the book with their outputs, as a kernel leaves them.

They are kept in build/site/executed, so that a change of the site's own pages runs none of them
again; a change of the package, or of what it stands on, runs all.
"""

from __future__ import annotations

import hashlib
import os
import shutil
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbformat import NotebookNode
from traitlets.config import Config

ROOT = Path(__file__).resolve().parent.parent
KEPT = ROOT / "build/site/executed"
COPY = ROOT / "build/site/run"
"""A copy of the book to run in: what a notebook writes stays out of the book's own folder."""
FOLDER = ROOT / "notebooks"
PUBLISHED = ("", "solutions")
"""Folders of the book that the site shows."""
NOT_PUBLISHED = "instructors"
"""Folder of what students should not find, the examination above all."""
LONGEST = ("08_", "06_")
"""Beginnings of those that run longest: they are begun first."""
AT_ONCE = 2
SECONDS = 600
"""For one cell, on a busy machine."""


def notebooks(folder: Path = FOLDER) -> list[str]:
    """Return the names of all notebooks, "solutions/03_systematic_drift.ipynb" for solutions."""
    return sorted(
        path.relative_to(folder).as_posix()
        for path in folder.rglob("*.ipynb")
        if ".ipynb_checkpoints" not in path.parts
    )


def published(folder: Path = FOLDER) -> list[str]:
    """Return the names of the notebooks that the site shows, not those of lecturers."""
    return [name for name in notebooks(folder) if Path(name).parent.name in PUBLISHED]


def executed(wanted: Iterable[str] | None = None) -> dict[str, NotebookNode]:
    """Return notebooks with the outputs of all their cells, by name."""
    below = _digest(_what_notebooks_stand_on())
    shutil.rmtree(COPY, ignore_errors=True)
    shutil.copytree(FOLDER, COPY, ignore=shutil.ignore_patterns(".ipynb_checkpoints", "*.json"))
    names = sorted(wanted or notebooks(), key=lambda name: (not name.startswith(LONGEST), name))
    with ThreadPoolExecutor(AT_ONCE) as threads:
        runs = threads.map(lambda name: _executed(name, below), names)
        found = dict(zip(names, runs, strict=True))
    return {name: found[name] for name in sorted(found)}


def _executed(name: str, below: str) -> NotebookNode:
    source = FOLDER / name
    kept = KEPT / name
    digest = _digest([source], below)
    if kept.exists():
        notebook = _read(kept)
        if notebook.metadata.get("digest") == digest:
            return notebook
    notebook = _read(source)
    place = {"metadata": {"path": str((COPY / name).parent)}}
    # Encrypted, for other users of the computer can listen at the ports of kernels.
    through = Config({"KernelManager": {"transport_encryption": "auto"}})
    NotebookClient(notebook, timeout=SECONDS, resources=place, config=through).execute()
    notebook.metadata["digest"] = digest
    kept.parent.mkdir(parents=True, exist_ok=True)
    nbformat.write(notebook, kept)  # type: ignore[no-untyped-call]
    return notebook


def _read(path: Path) -> NotebookNode:
    notebook: NotebookNode = nbformat.read(path, as_version=4)  # type: ignore[no-untyped-call]
    return notebook


def _what_notebooks_stand_on() -> Iterable[Path]:
    package = (path for path in (ROOT / "src").rglob("*") if path.is_file())
    yield from sorted(path for path in package if "__pycache__" not in path.parts)
    yield ROOT / "environment.txt"


def _digest(paths: Iterable[Path], begin: str = "") -> str:
    found = hashlib.sha256(begin.encode())
    found.update(os.environ.get("DRIFTLAB_RECORDINGS", "").encode())
    for path in paths:
        found.update(f"{path.relative_to(ROOT)}\0".encode() + path.read_bytes())
    return found.hexdigest()
