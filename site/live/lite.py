"""JupyterLite with the notebooks of the book, and what the site adds to its page."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
from collections.abc import Iterable
from html import escape
from pathlib import Path
from typing import Any

from addresses import LINK, PAGES, anchor, file_of, page_of
from executed import FOLDER, published
from unfinished import Unfinished

from .versions import ROOT, VERSIONS

PAGE = Path(__file__).resolve().parent / "page"
"""What the site adds: the strip above the notebook."""
STORAGE = "Drift Lab"
"""Under which name a browser keeps what a reader changes."""
APP = "lab"
HEAD = """\
<link rel="icon" href="favicon.ico">
<link rel="stylesheet" href="../strip.css">
<script type="module" src="../strip.js"></script>
"""
"""What the page of JupyterLite gets besides."""


def make_lite(build: Path, made: Path, extensions: Iterable[Path], about: dict[str, str]) -> None:
    """Write JupyterLite with every notebook of the book.

    The strip above the notebook knows what is in `about`.
    """
    source = build / "lite"
    shutil.rmtree(source, ignore_errors=True)
    write_contents(source / "files")
    _write(source / "jupyter-lite.json", settings())
    _write(source / "overrides.json", OVERRIDES)
    options = [f"--LiteBuildConfig.federated_extensions={wheel}" for wheel in extensions]
    command = [sys.executable, "-m", "jupyterlite_core", "build", "--apps", APP, "--no-sourcemaps"]
    command += ["--no-unused-shared-packages", "--ignore-sys-prefix", f"--output-dir={made}"]
    done = subprocess.run([*command, *options], cwd=source, capture_output=True, encoding="utf-8")
    if done.returncode:
        raise Unfinished(f"JupyterLite is not built:\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    shutil.rmtree(made / "extensions/@jupyterlite/pyodide-kernel-extension/static/pypi")
    shutil.copytree(PAGE, made, dirs_exist_ok=True)
    # JupyterLab asks for a picture beside its page before it looks among the notebooks.
    shutil.copytree(source / "files/figures", made / APP / "figures")
    _tell(made / APP / "index.html", about)


QUIET = {"HOME": "/home/pyodide", "PYTHONWARNINGS": "ignore:tqdm:RuntimeWarning"}
"""tqdm warns, in red, that it has no thread to watch its bars; a browser has none."""


def settings() -> dict[str, Any]:
    """Return what jupyter-lite.json says."""
    kernel = {
        "disablePyPIFallback": True,
        "loadPyodideOptions": {"env": QUIET, "packages": VERSIONS["kernel"]["packages"]},
        "pyodideUrl": "./static/pyodide/pyodide.mjs",
    }
    return {
        "jupyter-lite-schema-version": 0,
        "jupyter-config-data": {
            "appName": "Drift Lab",
            "contentsStorageName": STORAGE,
            "enableMemoryStorage": True,
            "exposeAppInBrowser": True,
            "litePluginSettings": {"@jupyterlite/pyodide-kernel-extension:kernel": kernel},
            "contentsStorageDrivers": ["asyncStorage", "memoryStorageDriver"],
            "settingsStorageName": f"{STORAGE}: settings",
            # A link opens its chapter, and not those of last time with a Python for each.
            "workspacesStorageDrivers": ["memoryStorageDriver"],
        },
    }


OVERRIDES = {
    "@jupyterlab/apputils-extension:themes": {"adaptive-theme": True},
    "@jupyterlab/docmanager-extension:plugin": {"autosaveInterval": 10},
}
"""Settings of JupyterLab: light or dark as the computer is, and nothing is lost in a closed tab."""


def write_contents(folder: Path) -> None:
    """Write the notebooks, their links led to what a reader of the live book has."""
    for name in published():
        notebook = json.loads((FOLDER / name).read_text("utf-8"))
        for cell in notebook["cells"]:
            if cell["cell_type"] == "markdown":
                cell["source"] = with_links("".join(cell["source"]), name)
        _write(folder / name, notebook)
    for path in pictures(folder):
        target = folder / path.relative_to(ROOT)
        target.parent.mkdir(exist_ok=True)
        shutil.copy(path, target)


def with_links(text: str, notebook: str) -> str:
    """Return Markdown with links out of the book led to the site, as "#site/errata.html"."""

    def led(match: re.Match[str]) -> str:
        path, _, fragment = match[1].partition("#")
        file = file_of(path, notebook)
        if file in PAGES:
            return f"](#site/{page_of(file)}.html{anchor(fragment)})"
        return f"]({file})" if file.startswith("figures/") else match[0]

    return LINK.sub(led, text)


def pictures(folder: Path) -> list[Path]:
    """Return the figures that the notebooks of a folder show as files."""
    found: set[str] = set()
    for path in folder.glob("*.ipynb"):
        found.update(re.findall(r"\]\((figures/[\w.-]+\.svg)\)", path.read_text("utf-8")))
    return [ROOT / name for name in sorted(found)]


def _tell(path: Path, about: dict[str, str]) -> None:
    """Put the site's script into a page, with what it must know."""
    data = "".join(f' data-{name}="{escape(value)}"' for name, value in about.items())
    text = path.read_text("utf-8")
    text = text.replace("<title>JupyterLite</title>", "<title>Drift Lab</title>")
    text = text.replace("</head>", f"{HEAD}</head>", 1)
    path.write_text(text.replace("<html", f"<html{data}", 1), "utf-8")


def _write(path: Path, data: object) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(data, indent=1, ensure_ascii=False), "utf-8")
