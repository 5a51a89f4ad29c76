"""Links and names in the notebooks' text, led to where things stand on the site."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from urllib.parse import unquote

from reading.doors import aliases, documented

PUBLISHED = {
    "ERRATA.md": "/errata.md",
    "README.md": "/index.md",
    "figures/README.md": "/gallery/index.md",
}
"""Where files beside the notebooks, to which they link, stand on the site."""


def with_links(text: str) -> str:
    """Return Markdown of a notebook, its links and names led to where things stand on the site.

    Notebooks are pages under their own names, so links between them hold as they are.
    """

    def led(match: re.Match[str]) -> str:
        path, _, fragment = match[1].partition("#")
        if path and not path.endswith(".ipynb"):
            return f"]({_place(path)})"
        # Jupyter's address of a heading has its commas and capitals, MyST's has not.
        heading = re.sub("[^a-z0-9_-]", "", unquote(fragment).lower().replace(" ", "-"))
        return f"]({path}#{heading})" if fragment else match[0]

    def named(match: re.Match[str]) -> str:
        return f"{{py:obj}}`{match[1]}`" if match[1] in _public() else match[0]

    text = re.sub(r"(?<!`)`(driftlab\.[\w.]+)`(?!`)", named, text)
    return re.sub(r"\]\((?!https?:)([^)\s]+)\)", led, text)


def _place(path: str) -> str:
    """The place on the site of a file that a notebook names from its own folder."""
    inside = path.removeprefix("../")
    if inside == path:
        return path
    if inside.startswith("figures/") and Path(inside).suffix in (".svg", ".csv"):
        return f"/gallery/{Path(inside).name}"
    return PUBLISHED[inside]


@cache
def _public() -> frozenset[str]:
    return frozenset([*documented().values(), *aliases()])
