"""What a reader waits for: imports in a fresh Python, redraws of panels, whole chapters."""

import shutil
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

import nbformat
import numpy as np
from nbclient import NotebookClient

from driftlab.book.panels import EXPLORERS

from .measuring import Alone, Contender, Maker, Row

NOTEBOOKS = Path(__file__).parents[2] / "notebooks"
MODULES = (
    "allantools", "ahrs", "filterpy.kalman", "navtk.inertial", "pyins.strapdown", "quaternion",
)  # fmt: skip
SCIPY = "import scipy.linalg, scipy.stats, scipy.spatial.transform"
MOVES = 5
"""Places of each slider."""


def imports() -> Iterator[Row]:
    floor = [
        partial(_fresh, "pass", "Python alone"),
        partial(_fresh, "import numpy", "NumPy"),
        partial(_fresh, SCIPY, "SciPy's linalg, stats, Rotation"),
    ]
    # Peers load all that they have; `import driftlab` alone loads nothing before it is asked for.
    four = "from driftlab import integrate, navigate, align, allan_deviation"
    for code, peers in (
        ("from driftlab import integrate", map(_peer, MODULES)),
        (four, map(_peer, MODULES)),
        ("import driftlab", ()),
        ("import driftlab.book", ()),
    ):
        yield Row(f"`{code}`, in a fresh Python", _fresh(code, "driftlab"), [*peers], floor)


def _peer(module: str) -> Maker:
    def make() -> Contender:
        if find_spec(module.split(".")[0]) is None:
            raise ImportError(f"No module named {module!r}")
        why = "It loads NumPy alone; the confidence of an Allan deviation needs SciPy."
        return replace(_fresh(f"import {module}", f"import {module}"), why=why)

    return make


def _fresh(code: str, name: str) -> Contender:
    command = [sys.executable, "-c", code]
    return Contender(name, partial(subprocess.run, command, check=True, stderr=subprocess.DEVNULL))


def redraws() -> Iterator[Alone]:
    """How long a panel's picture takes after a slider has moved, without a browser."""
    for explorer_class in EXPLORERS:
        explorer, times = explorer_class(), []
        for control in explorer.controls:
            listed = control.options or control.examples
            for place in listed or np.linspace(control.low, control.high, MOVES):
                value = {control.name: place if listed else type(control.start)(place)}
                begin = perf_counter()
                explorer.set(**value)
                times.append(perf_counter() - begin)
        yield Alone(explorer_class.__name__, np.array(times), 0.05)


def chapters() -> Iterator[Alone]:
    """How long each chapter takes, with the start of its kernel, two at a time; and all of them."""
    with TemporaryDirectory() as folder:
        # Guesses and answers are kept beside a notebook, and those of a reader are not ours.
        copy = Path(folder, "notebooks")
        shutil.copytree(NOTEBOOKS, copy, ignore=shutil.ignore_patterns("*.json", ".*"))
        paths = sorted(copy.glob("[01][0-9]_*.ipynb"))
        begin = perf_counter()
        with ThreadPoolExecutor(2) as pool:
            for path, seconds in zip(paths, pool.map(_execute, paths), strict=True):
                yield Alone(f"chapter {path.stem}", np.array([seconds]), 60.0)
        whole = np.array([perf_counter() - begin])
        yield Alone(f"the whole book, {len(paths)} chapters, two at a time", whole, 240.0)


def _execute(path: Path) -> float:
    begin = perf_counter()
    where = {"metadata": {"path": str(path.parent)}}
    NotebookClient(nbformat.read(path, as_version=4), timeout=600, resources=where).execute()
    return perf_counter() - begin
