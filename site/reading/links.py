"""Links and names in the notebooks' text, led to where things stand on the site."""

from __future__ import annotations

import re
from functools import cache
from posixpath import basename

from addresses import LINK, anchor, file_of, page_of
from reading.doors import aliases, documented


def with_links(text: str, notebook: str) -> str:
    """Return Markdown of a notebook, its links and names led to where things stand on the site.

    Notebooks are pages under their own names, so links between them hold as they are. The
    notebook's name is seen from the book's folder: "../docs/using.md" for a page.
    """

    def led(match: re.Match[str]) -> str:
        path, _, fragment = match[1].partition("#")
        return f"]({_place(path, notebook)}{anchor(fragment)})"

    def named(match: re.Match[str]) -> str:
        return f"{{py:obj}}`{match[1]}`" if match[1] in _public() else match[0]

    text = re.sub(r"(?<!`)`(driftlab\.[\w.]+)`(?!`)", named, text)
    return LINK.sub(led, text)


def _place(path: str, notebook: str) -> str:
    """What Sphinx calls a file that a notebook names; what is beside the notebook stays there."""
    file = file_of(path, notebook)
    if not path:
        return path
    if file.startswith("notebooks/"):
        return f"/{file.removeprefix('notebooks/')}" if notebook.startswith("../") else path
    is_figure = file.startswith("figures/") and file.endswith((".svg", ".csv"))
    return f"/gallery/{basename(file)}" if is_figure else f"/{page_of(file)}.md"


@cache
def _public() -> frozenset[str]:
    return frozenset([*documented().values(), *aliases()])
