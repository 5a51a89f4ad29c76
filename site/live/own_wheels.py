"""Wheels that are made here: the book's package, and files that stand beside packages."""

from __future__ import annotations

import os
import shutil
import subprocess
import zipfile
from collections.abc import Sequence
from hashlib import sha256
from pathlib import Path

from flit_core.wheel import make_wheel_in

from driftlab import __version__
from driftlab.book.figures import figure_definitions
from unfinished import Unfinished

from .brought import found
from .versions import ROOT

HERE = Path(__file__).resolve().parent
KEPT_SOURCE = "driftlab"
"""Of what the source stays readable, so that ``driftlab.align??`` shows it."""
EPOCH = "1577836800"
"""2020: the same files give the same wheel, whenever it is made."""


def driftlab_wheel(folder: Path) -> Path:
    """Make the wheel of the package from the repository as it is."""
    folder.mkdir(parents=True, exist_ok=True)
    before = os.environ.get("SOURCE_DATE_EPOCH")
    os.environ["SOURCE_DATE_EPOCH"] = EPOCH
    try:
        return Path(make_wheel_in(ROOT / "pyproject.toml", folder).file)
    finally:
        if before is None:
            del os.environ["SOURCE_DATE_EPOCH"]
        else:
            os.environ["SOURCE_DATE_EPOCH"] = before


def fontlist_wheel(folder: Path, matplotlib: str) -> Path:
    """Make a wheel that puts a list of Matplotlib's own fonts in the place of Pyodide's.

    That list is of another version; Matplotlib makes its own at each start, and says so in red in
    a reader's first figure.
    """
    files = {"matplotlib/fontlist.json": (HERE / "fontlist.json").read_bytes()}
    return _wheel(folder, "matplotlib-fontlist", matplotlib, files, f"matplotlib=={matplotlib}")


def figures_wheel(folder: Path, python: str) -> Path:
    """Make a wheel with the numbers of figures that no browser computes.

    A study takes minutes, and a recording is not at hand; `driftlab.book.figure` reads their
    numbers from the folder where the package finds the book's.
    """
    place = f"driftlab_figures-{__version__}.data/data/lib/python{python}/figures"
    definitions = figure_definitions().values()
    names = [f"{each.name}.csv" for each in definitions if each.is_kept]
    files = {f"{place}/{name}": (ROOT / "figures" / name).read_bytes() for name in names}
    return _wheel(folder, "driftlab-figures", __version__, files, f"driftlab=={__version__}")


def _wheel(folder: Path, name: str, version: str, files: dict[str, bytes], needs: str) -> Path:
    """Make a wheel of a few files; what compiles it writes its RECORD."""
    info = f"{name.replace('-', '_')}-{version}.dist-info"
    path = folder / f"{info.removesuffix('.dist-info')}-py3-none-any.whl"
    metadata = f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\nRequires-Dist: {needs}\n"
    about = "Wheel-Version: 1.0\nGenerator: driftlab\nRoot-Is-Purelib: true\nTag: py3-none-any\n"
    texts = {"METADATA": metadata, "WHEEL": about, "RECORD": ""}
    files = files | {f"{info}/{key}": text.encode() for key, text in texts.items()}
    with zipfile.ZipFile(path, "w") as wheel:
        for inside, data in files.items():
            wheel.writestr(zipfile.ZipInfo(inside), data)
    return path


def from_within(outer: Path, name: str, folder: Path) -> Path:
    """Take the wheel of a package out of another wheel."""
    begin = f"{name.replace('-', '_')}-"
    if name == "widgetsnbextension":  # there are two, for the two ages of ipywidgets
        begin += "4."
    with zipfile.ZipFile(outer) as files:
        (inner,) = (
            path
            for path in files.namelist()
            if path.rpartition("/")[2].startswith(begin) and "/static/pypi/" in path
        )
        target = folder / inner.rpartition("/")[2]
        target.write_bytes(files.read(inner))
    return target


def compiled(wheels: Sequence[Path], runtime: Path, build: Path) -> list[Path]:
    """Return the compiled twins of wheels; those of an earlier build are taken again."""
    script = HERE / "compile.mjs"
    below = sha256(script.read_bytes() + (runtime / "package.json").read_bytes())
    twins = {}
    for wheel in wheels:
        digest = below.copy()
        digest.update(wheel.read_bytes())
        twins[wheel] = build / "compiled" / digest.hexdigest()[:20] / wheel.name
    missing = [wheel for wheel, twin in twins.items() if not twin.exists()]
    if missing:
        source, target = build / "to-compile", build / "just-compiled"
        for folder in (source, target):
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir(parents=True)
        for wheel in missing:
            shutil.copy(wheel, source)
        command = [found("node"), str(script), str(runtime), str(source), str(target), KEPT_SOURCE]
        done = subprocess.run(command, capture_output=True, encoding="utf-8")
        if done.returncode:
            raise Unfinished(f"Node does not compile the wheels:\n{done.stderr.strip()}")
        for wheel in missing:
            twins[wheel].parent.mkdir(parents=True, exist_ok=True)
            (target / wheel.name).replace(twins[wheel])
    return list(twins.values())
