"""The page that names the licences of all that the site hands out, made from what is there.

The project's own stand in LICENSE. Of others, licences.toml has the licence, the site the version.
"""

from __future__ import annotations

import json
import re
import shutil
import tomllib
from collections.abc import Iterable
from html import escape
from importlib.metadata import distribution
from pathlib import Path
from typing import Any

from live.brought import OFFICIAL
from live.versions import VERSIONS
from unfinished import Unfinished

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
PAGE, TEXTS = "licences.html", "licences"
KNOWN: dict[str, Any] = tomllib.loads((HERE / "licences.toml").read_text("utf-8"))
LOCK = Path("live/static/pyodide") / OFFICIAL
JUPYTER = "live/build/third-party-licenses.json"
FRAME = """\
<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Licences &middot; Drift Lab</title>
<style>
:root {{ color-scheme: light dark; }}
body {{ max-width: 46rem; margin: 2rem auto; padding: 0 1rem; }}
body {{ font: 1rem/1.6 system-ui, sans-serif; overflow-wrap: anywhere; }}
th, td {{ padding-right: 1rem; text-align: left; }}
pre {{ white-space: pre-wrap; font-size: 0.85rem; }}
</style>
<p><a href="index.html">Drift Lab</a></p>
<h1>Licences</h1>
{}
"""


def write_licences(made: Path) -> None:
    """Write the page, and the licences in full, into the folder of the otherwise complete site."""
    shutil.copytree(ROOT / "LICENSES", made / TEXTS)
    parts = [*_own(), *_pages(made), "<h2>Fonts in the PDF</h2>"]
    parts += [_table(("Font", "Licence"), KNOWN["fonts"].items())]
    parts += [*_python(json.loads((made / LOCK).read_text("utf-8"))), *_jupyter()]
    (made / PAGE).write_text(FRAME.format("\n".join(parts)), "utf-8")


def _own() -> Iterable[str]:
    yield "<h2>The book and its package</h2>"
    texts = [_link(f"{TEXTS}/{path.name}", path.stem) for path in sorted(_own_texts())]
    yield f"<p>In full: {', '.join(texts)}.</p>"
    yield f"<pre>{escape((ROOT / 'LICENSE').read_text('utf-8'))}</pre>"


def _own_texts() -> Iterable[Path]:
    return (ROOT / "LICENSES").glob("*.txt")


def _pages(made: Path) -> Iterable[str]:
    """What the pages bring along; whoever hands it on hands on its licence."""
    rows = []
    for name, about in KNOWN["pages"].items():
        package = distribution(about.get("package", name))
        text = made / TEXTS / f"{name}.txt"
        text.write_text(licence_texts(package.name), "utf-8")
        licence = _link(f"{TEXTS}/{text.name}", about["licence"])
        rows.append((escape(name), escape(package.version), licence))
    yield "<h2>What the pages are set with</h2>"
    yield _table(("Name", "Version", "Licence"), rows)


def licence_texts(package: str) -> str:
    """Return the licences that an installed package brings, in full."""
    files = [path for path in distribution(package).files or [] if _is_licence(Path(path))]
    return "\n\n".join(path.read_text("utf-8") for path in files)


def _is_licence(path: Path) -> bool:
    named = re.match(r"(licen[cs]e|copying)\b", path.name, re.I) or path.name.endswith(
        ".LICENSE.txt"
    )
    return bool(named) and path.suffix in ("", ".txt", ".rst", ".md")


def _python(lock: dict[str, Any]) -> Iterable[str]:
    """Python in the browser; each wheel holds its licence in full."""
    unknown = lock["packages"].keys() - KNOWN["packages"].keys()
    if unknown:
        raise Unfinished(f"licences.toml names no licence of {', '.join(sorted(unknown))}.")
    versions = {"Pyodide": VERSIONS["pyodide"]["version"], "Python": lock["info"]["python"]}
    rows = [(name, versions[name], licence) for name, licence in KNOWN["runtime"].items()]
    rows += [
        (name, entry["version"], KNOWN["packages"][name])
        for name, entry in lock["packages"].items()
    ]
    yield "<h2>Python in the page and in the live book</h2>"
    source = _link("https://github.com/pyodide/pyodide", "Pyodide's source")
    kept = ", ".join(_link(address, name) for name, address in KNOWN["elsewhere"].items())
    yield "<p>Most packages have their licence in full in their wheels; those without have it "
    yield f"here: {kept}. {source} is open to all.</p>"
    yield _table(("Name", "Version", "Licence"), ([escape(cell) for cell in row] for row in rows))


def _jupyter() -> Iterable[str]:
    version = escape(distribution("jupyterlite-core").version)
    yield "<h2>JupyterLab in the live book</h2>"
    yield f"<p>JupyterLite {version}, BSD-3-Clause, with packages of JavaScript: "
    yield f"{_link(JUPYTER, 'the licence of each, in full')}.</p>"


def _table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """A table of cells that are HTML already."""
    lines = ["".join(f"<td>{cell}</td>" for cell in row) for row in rows]
    lines.insert(0, "".join(f"<th>{name}</th>" for name in head))
    return "<table>{}</table>".format("\n".join(f"<tr>{line}</tr>" for line in lines))


def _link(address: str, words: str) -> str:
    return f'<a href="{escape(address)}">{escape(words)}</a>'
