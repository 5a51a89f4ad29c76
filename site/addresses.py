"""Where a file of the project stands on the site, and the places in it that links lead to."""

from __future__ import annotations

import posixpath
import re
from pathlib import Path
from urllib.parse import unquote

DOCS = [f"docs/{path.stem}" for path in sorted(Path(__file__).parents[1].glob("docs/*.md"))]
"""Pages for users: every Markdown file in docs, under its own name."""
DOCS.sort(key=lambda name: name != "docs/using")  # the first that a reader needs
NOTEBOOKS = Path(__file__).parents[1] / "notebooks"
COMPANIONS = [f"papers/{path.stem}" for path in sorted(NOTEBOOKS.glob("papers/*.ipynb"))]
"""One notebook for each paper, in the order of the book, which is that of the alphabet."""
PAGES = {"ERRATA.md": "errata", "README.md": "index", "figures/README.md": "gallery/index"}
PAGES |= {f"{name}.md": name for name in DOCS}
"""Pages of files that are no notebooks; a notebook's page has its name."""
LINK = re.compile(r"\]\((?!https?:)([^)\s]+)\)")
"""The second half of a link or picture in Markdown, if it leads to something of the project."""
PDF = "drift-lab.pdf"


def live_address(notebook: str) -> str:
    """Return where a notebook, "solutions/03_systematic_drift.ipynb", can be run."""
    return f"live/lab/index.html?path={notebook}"


def file_of(path: str, notebook: str) -> str:
    """Return the file of the project that a link means, seen from the project's folder.

    The path is that of the link without what follows a "#"; an empty one is the notebook itself.
    """
    own = posixpath.normpath(posixpath.join("notebooks", notebook))
    return posixpath.normpath(posixpath.join(posixpath.dirname(own), path)) if path else own


def page_of(file: str) -> str:
    """Return the page of a file of the project, without the page's ending."""
    if file.endswith(".ipynb"):
        return file.removeprefix("notebooks/").removesuffix(".ipynb")
    return PAGES[file]


def anchor(fragment: str) -> str:
    """Return a heading's end of an address with its "#", from Jupyter's name of it; "" for none.

    Jupyter's has the commas and capitals of the heading, a page's has not.
    """
    name = re.sub("[^a-z0-9_-]", "", unquote(fragment).lower().replace(" ", "-"))
    return f"#{name}" if name else ""


def slug(text: str) -> str:
    """Return a text as a part of a label; a star of the papers' letters stays a word in it."""
    return re.sub(r"[^a-z0-9]+", "-", text.lower().replace("*", "-star")).strip("-")


def section_label(chapter: str, heading: str) -> str:
    """Return the label of a section of a chapter, or of "papers/larin", for links to it."""
    return f"chapter-{slug(chapter)}-{slug(heading)}"
