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
from zlib import crc32

from addresses import LINK, PAGES, anchor, file_of, page_of
from executed import FOLDER, published
from unfinished import Unfinished

from .versions import ROOT, VERSIONS

PAGE = Path(__file__).resolve().parent / "page"
"""What the site adds: the strip above the notebook, and the page with a reader's work."""
APP = "lab"
HEAD = """\
<link rel="icon" href="favicon.ico">
<link rel="stylesheet" href="../strip.css">
<script type="module" src="../strip.js"></script>
"""
"""What the page of JupyterLite gets besides."""
BEGIN = "await import("
"""How JupyterLite begins, in its page. Before, copies that can be had anew are forgotten."""
RENEW = """\
await import("../copies.js").then(({ renew }) => renew()).catch(console.info);
        """
MARK = "driftlab-text"
"""In a notebook's metadata: the mark of the book's text that a reader's copy began with."""


def make_lite(build: Path, made: Path, extensions: Iterable[Path], about: dict[str, str]) -> None:
    """Write JupyterLite with every notebook of the book.

    The strip above the notebook knows what is in `about`: "version", "storage", ...
    """
    source = build / "lite"
    shutil.rmtree(source, ignore_errors=True)
    texts = write_contents(source / "files")
    _write(source / "jupyter-lite.json", settings(about["storage"]))
    _write(source / "overrides.json", OVERRIDES)
    options = [f"--LiteBuildConfig.federated_extensions={wheel}" for wheel in extensions]
    command = [sys.executable, "-m", "jupyterlite_core", "build", "--apps", APP, "--no-sourcemaps"]
    command += ["--no-unused-shared-packages", "--ignore-sys-prefix", f"--output-dir={made}"]
    done = subprocess.run([*command, *options], cwd=source, capture_output=True, encoding="utf-8")
    if done.returncode:
        raise Unfinished(f"JupyterLite is not built:\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    shutil.rmtree(made / "extensions/@jupyterlite/pyodide-kernel-extension/static/pypi")
    shutil.copytree(PAGE, made, dirs_exist_ok=True)
    _write(made / "texts.json", texts)
    # JupyterLab asks for a picture beside its page before it looks among the notebooks.
    shutil.copytree(source / "files/figures", made / APP / "figures")
    for path in (made / APP / "index.html", made / "my-work.html"):
        _tell(path, about)


QUIET = {"HOME": "/home/pyodide", "PYTHONWARNINGS": "ignore:tqdm:RuntimeWarning"}
"""tqdm warns, in red, that it has no thread to watch its bars; a browser has none."""


def settings(storage: str) -> dict[str, Any]:
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
            "contentsStorageName": storage,
            "enableMemoryStorage": True,
            "exposeAppInBrowser": True,
            "litePluginSettings": {"@jupyterlite/pyodide-kernel-extension:kernel": kernel},
            "contentsStorageDrivers": ["asyncStorage", "memoryStorageDriver"],
            "settingsStorageName": f"{storage}: settings",
            # A link opens its chapter, and not those of last time with a Python for each.
            "workspacesStorageDrivers": ["memoryStorageDriver"],
        },
    }


OVERRIDES = {
    "@jupyterlab/apputils-extension:themes": {"adaptive-theme": True},
    "@jupyterlab/docmanager-extension:plugin": {"autosaveInterval": 10},
}
"""Settings of JupyterLab: light or dark as the computer is, and nothing is lost in a closed tab."""


def write_contents(folder: Path) -> dict[str, str]:
    """Write the notebooks, their links led to what a reader of the live book has.

    Return the mark of each notebook's text, by its path; the notebook has it in its metadata, too.
    """
    texts = {}
    for name in published():
        notebook = json.loads((FOLDER / name).read_text("utf-8"))
        for cell in notebook["cells"]:
            if cell["cell_type"] == "markdown":
                cell["source"] = with_links("".join(cell["source"]), name)
        texts[name] = notebook["metadata"][MARK] = mark(notebook["cells"])
        _write(folder / name, notebook)
    for path in pictures(folder):
        target = folder / path.relative_to(ROOT)
        target.parent.mkdir(exist_ok=True)
        shutil.copy(path, target)
    return texts


def mark(cells: Iterable[dict[str, Any]]) -> str:
    """Return the mark of a notebook's text, as copies.js computes it: other text, other mark."""
    parts = [part for cell in cells for part in (cell["cell_type"], "".join(cell["source"]))]
    return f"{crc32(chr(0).join(parts).encode()):x}"


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
    if path.name == "index.html":
        text = text.replace("<title>JupyterLite</title>", "<title>Drift Lab</title>")
        text = text.replace("</head>", f"{HEAD}</head>", 1)
        if text.count(BEGIN) != 1:
            raise Unfinished("JupyterLite's page begins in another way than lite.py knows.")
        text = text.replace(BEGIN, RENEW + BEGIN)
    path.write_text(text.replace("<html", f"<html{data}", 1), "utf-8")


def _write(path: Path, data: object) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(data, indent=1, ensure_ascii=False), "utf-8")
