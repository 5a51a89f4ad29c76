"""How the things of a scene look, read from its style sheet, for what no browser draws."""

from __future__ import annotations

import re
from functools import cache
from typing import Any

import numpy as np
from matplotlib.colors import to_hex, to_rgb

from .svg import STYLE

ELEMENTS = {"dot": "circle", "label": "text"}
"""Which element of an SVG a kind of part is, if no path."""


def look(kind: str, style: str) -> dict[str, Any]:
    """Return how a part looks on a light page, as ``scene.css`` has it.

    "stroke" and "fill" are colours or "none"; "width" and "dashes" are those of the line, in
    units of the view; "alpha" is that of the filling; "bold" is for a label.
    """
    element = ELEMENTS.get(kind, "path")
    rules = _rules()
    classes = [f".dl-{kind}", f".dl-{style}"]
    found: dict[str, str] = {}
    for selector in (element, *classes, *(f"{element}{each}" for each in classes)):
        found |= rules.get(selector, {})
    dashes = found.get("stroke-dasharray", "none")
    return {
        "stroke": colour(found.get("stroke", "none")),
        "fill": colour(found.get("fill", "none")),
        "width": float(found.get("stroke-width", "1")),
        "dashes": () if dashes == "none" else tuple(map(float, dashes.split())),
        "alpha": float(found.get("fill-opacity", "1")),
        "bold": found.get("font-weight") == "bold",
    }


def colour(text: str) -> str:
    """Return a colour of the style sheet, or mixed of two, as Matplotlib takes it."""
    if mixed := re.fullmatch(r"color-mix\(in srgb, (.+) (\d+)%, (.+)\)", text):
        share = int(mixed[2]) / 100
        parts = [np.array(to_rgb(colour(each))) for each in (mixed[1], mixed[3])]
        return to_hex(tuple(share * parts[0] + (1 - share) * parts[1]))
    if name := re.fullmatch(r"var\((--[\w-]+)\)", text):
        return _rules()[".dl-scene"][name[1]]
    return text


@cache
def _rules() -> dict[str, dict[str, str]]:
    """Declarations by the last part of their selector: those of a scene, on a light page."""
    plain = re.sub(r"/\*.*?\*/", "", STYLE, flags=re.S)
    rules: dict[str, dict[str, str]] = {}
    for selectors, body in re.findall(r"([^{}]+)\{([^{}]*)\}", plain):
        said = dict(re.findall(r"([\w-]+):\s*([^;]+?)\s*(?:;|$)", body))
        for selector in (each.split() for each in selectors.split(",")):
            if selector[:-1] in ([], [".dl-scene"], [".dl-scene", "svg"]):
                rules.setdefault(selector[-1], {}).update(said)
    return rules
