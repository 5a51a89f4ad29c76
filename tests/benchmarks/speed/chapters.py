"""How long each chapter takes in a kernel, and the whole book on two processes."""

import shutil
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

import nbformat
import numpy as np
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError

from .measuring import Contender, Result, Row, Target, Timing

FOLDER = Path(__file__).parents[3] / "notebooks"
_CHAPTER, _BOOK = 60.0, 240.0


def results() -> Iterator[Result]:
    with TemporaryDirectory() as folder:
        # Guesses and answers are kept beside a notebook, and those of a reader are not ours.
        copy = Path(folder, "notebooks")
        shutil.copytree(FOLDER, copy, ignore=shutil.ignore_patterns("*.json", ".*"))
        chapters = sorted(copy.glob("[01][0-9]_*.ipynb"))
        begin = perf_counter()
        failed = []
        with ThreadPoolExecutor(2) as pool:
            for path, (seconds, error) in zip(chapters, pool.map(_execute, chapters), strict=True):
                stopped = [f"{path.stem} stopped: {error}."] if error else []
                failed += stopped
                yield _result(f"chapter {path.stem}", seconds, _CHAPTER, stopped)
        yield _result(
            f"the whole book, {len(chapters)} chapters, two at a time",
            perf_counter() - begin,
            _BOOK,
            failed,
        )


def _execute(path: Path) -> tuple[float, str]:
    """Seconds of a chapter with the start of its kernel, and why it stopped if it did."""
    notebook = nbformat.read(path, as_version=4)
    begin, error = perf_counter(), ""
    try:
        NotebookClient(
            notebook, timeout=600, resources={"metadata": {"path": str(path.parent)}}
        ).execute()
    except CellExecutionError as stopped:
        error = f"{stopped.ename}: {stopped.evalue}".split("\n")[0]
    return perf_counter() - begin, error


def _result(title: str, seconds: float, most: float, left_out: list[str]) -> Result:
    row = Row(
        "chapters",
        title,
        Contender("driftlab", lambda: None),
        targets=[] if left_out else [Target(most)],
        left_out=left_out,
    )
    return Result(row, Timing("driftlab", np.array([seconds])))
