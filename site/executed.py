"""The notebooks of the book with their outputs, as a kernel leaves them.

Each is executed once: what a run left is kept in _executed for the site, the PDF and the slides,
and the tests of the notebooks leave their runs there. A change of a notebook, of the package or of
its environment makes a new run.
"""

from __future__ import annotations

import hashlib
import os
import shutil
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbformat import NotebookNode
from traitlets.config import Config

ROOT = Path(__file__).resolve().parent.parent
KEPT = ROOT / "_executed"
COPY = ROOT / "build/site/run"
"""A copy of the book to run in: what a notebook writes stays out of the book's own folder."""
FOLDER = ROOT / "notebooks"
PUBLISHED = ("", "papers", "solutions")
"""Folders of the book that the site shows; what students should not find is in none of them."""
LONGEST = ("12_", "15_", "09_", "13_", "11_")
"""Beginnings of those that run longest: they are begun first."""
AT_ONCE = 2
# Matrices as small as the book's are done sooner by one thread, and kernels do not share threads.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
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
    wanted = sorted(wanted or notebooks())
    found = {name: kept for name in wanted if (kept := _kept(name))}
    missing = sorted(set(wanted) - found.keys(), key=lambda each: not each.startswith(LONGEST))
    if missing:
        shutil.rmtree(COPY, ignore_errors=True)
        shutil.copytree(FOLDER, COPY, ignore=shutil.ignore_patterns("*_checkpoints", "*.json"))
        with ThreadPoolExecutor(AT_ONCE) as threads:
            found |= zip(missing, threads.map(_run, missing), strict=True)
    return {name: _in_view(found[name]) for name in wanted}


def _in_view(notebook: NotebookNode) -> NotebookNode:
    """A notebook without the cells that only check the book; JupyterLab hides their code."""
    notebook.cells = [
        cell for cell in notebook.cells if not cell.metadata.get("jupyter", {}).get("source_hidden")
    ]
    return notebook


def keep(name: str, run: NotebookNode) -> NotebookNode:
    """Keep the outputs of a run for whoever needs this notebook next, and return it with them."""
    notebook = _read(FOLDER / name)
    for cell, ran in zip(notebook.cells, run.cells, strict=True):
        if cell.cell_type == "code":
            cell.outputs, cell.execution_count = ran.outputs, ran.execution_count
    notebook.metadata["digest"] = _digest(name)
    path = KEPT / name
    path.parent.mkdir(parents=True, exist_ok=True)
    nbformat.write(notebook, path)  # type: ignore[no-untyped-call]
    return notebook


def _kept(name: str) -> NotebookNode | None:
    if not (KEPT / name).exists():
        return None
    notebook = _read(KEPT / name)
    return notebook if notebook.metadata.get("digest") == _digest(name) else None


def _run(name: str) -> NotebookNode:
    notebook = _read(FOLDER / name)
    place = {"metadata": {"path": str((COPY / name).parent)}}
    # Encrypted, for other users of the computer can listen at the ports of kernels.
    through = Config({"KernelManager": {"transport_encryption": "auto"}})
    NotebookClient(notebook, timeout=SECONDS, resources=place, config=through).execute()
    return keep(name, notebook)


def _read(path: Path) -> NotebookNode:
    notebook: NotebookNode = nbformat.read(path, as_version=4)  # type: ignore[no-untyped-call]
    return notebook


def _digest(name: str) -> str:
    return hashlib.sha256(_below() + (FOLDER / name).read_bytes()).hexdigest()


@cache
def _below() -> bytes:
    """The digest of what all notebooks stand on: the package, its environment, recordings."""
    found = hashlib.sha256(b"with recordings" if os.environ.get("DRIFTLAB_RECORDINGS") else b"")
    package = sorted(path for path in (ROOT / "src").rglob("*") if path.is_file())
    for path in [*package, ROOT / "environment.txt"]:
        if "__pycache__" not in path.parts:
            found.update(f"{path.relative_to(ROOT)}\0".encode() + path.read_bytes())
    return found.digest()
