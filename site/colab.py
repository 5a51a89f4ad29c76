"""Copies of the notebooks for Google Colab, with a cell in front that installs the package.

Colab opens a notebook alone: nothing stands beside it, so links lead to the published site. Where
release.toml does not say where that is, or where the package lies, the copy says so.
"""

from __future__ import annotations

import base64
import json
import posixpath
import re
import tomllib
from pathlib import Path
from typing import Any

from addresses import LINK, anchor, file_of, page_of
from driftlab import __version__
from executed import published

ROOT = Path(__file__).resolve().parent.parent
WHOLE_LINK = re.compile(rf"(!?)\[([^\]]*){LINK.pattern}")
BESIDE = "Where it speaks of another page, look there: from here no link leads to it."
WIDGETS = """\
import sys

if "google.colab" in sys.modules:  # which shows scenes and panels only when it is told to
    from google.colab import output

    output.enable_custom_widget_manager()"""


def make_colab(book: Path, target: Path) -> None:
    """Write a copy of every notebook that Colab can run."""
    release = tomllib.loads((ROOT / "release/release.toml").read_text("utf-8"))
    address = release["urls"]["Documentation"].rstrip("/")
    for name in published(book):
        notebook = json.loads((book / name).read_text("utf-8"))
        for cell in notebook["cells"]:
            if cell["cell_type"] == "markdown":
                cell["source"] = _with_links("".join(cell["source"]), name, book, address)
        notebook["cells"][:0] = _first_cells(name, address, release)
        copy = target / name
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", "utf-8")


def requirement(release: dict[str, Any]) -> str:
    """Return what pip is asked for, in this version: a file, a tag, or a name on the index."""
    if release["sdist"]["url"]:
        return f"driftlab[book] @ {release['sdist']['url']}"
    if release["urls"]["Repository"]:
        return f"driftlab[book] @ git+{release['urls']['Repository']}@v{__version__}"
    return f"driftlab[book]=={__version__}"


def _first_cells(name: str, address: str, release: dict[str, Any]) -> list[dict[str, Any]]:
    """What stands before the notebook: whose copy this is, and the cell that installs."""
    page = posixpath.splitext(name)[0]
    whose = f"[a page of Drift Lab]({address}/{page}.html)" if address else "a page of Drift Lab"
    words = f"*A copy, for Google Colab, of {whose}. Run the next cell first.*"
    asked = requirement(release)
    lines = [f'%pip install -q "{asked}"']
    if not address:
        words += f" *{BESIDE}*"
    if "@" not in asked:
        note = "No address of the package is known to this copy, so it asks the index by name;"
        lines[:0] = [f"# {note}", "# if it is not there, give the address of a wheel of yours."]
    source = "\n".join([*lines, WIDGETS])
    identifier = page.replace("/", "-")
    return [
        {
            "cell_type": "markdown",
            "id": f"{identifier}-colab"[-64:],
            "metadata": {},
            "source": words,
        },
        {
            "cell_type": "code",
            "id": f"{identifier}-install"[-64:],
            "metadata": {},
            "source": source,
            "execution_count": None,
            "outputs": [],
        },
    ]


def _with_links(text: str, notebook: str, book: Path, address: str) -> str:
    """Return Markdown with its links led to the site, or taken off; its pictures are in it."""

    def led(match: re.Match[str]) -> str:
        is_picture, words, target = match.groups()
        file, _, fragment = target.partition("#")
        if is_picture:
            picture = (book.parent / file_of(file, notebook)).read_bytes()
            inlined = base64.b64encode(picture).decode()
            return f"![{words}](data:image/svg+xml;base64,{inlined})"
        if not address:
            return words
        page = page_of(file_of(file, notebook))
        return f"[{words}]({address}/{page}.html{anchor(fragment)})"

    return WHOLE_LINK.sub(led, text)
