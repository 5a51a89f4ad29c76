"""Pictures of outputs as files that Typst reads, with the size that they have on paper."""

from __future__ import annotations

import base64
import html
import re
from pathlib import Path
from typing import NamedTuple

from driftlab.book.machinery.scene.look import colour
from reading.pictures import size

WIDEST, HIGHEST = 482.0, 540.0
"""In points: the width of the text, and a height that leaves room for a caption."""
WIDE = 800
"""Pixels: a scene that is wider would have labels too small to read."""
BELOW = 330
"""Pixels: the height of a scene's views, with their titles."""
DATA = re.compile(r'src="data:image/(svg\+xml|jpeg|png);base64,([^"]+)"')
CAPTION = re.compile(r"<figcaption>(.*?)</figcaption>", re.S)
ALT = re.compile(r'\balt="([^"]*)"')
READING = re.compile(r"(?<=[.?] )[a-z](?=[a-z])")
"""What a panel or a scene reads begins a sentence of its caption."""
VARIABLE = re.compile(r"(--[\w-]+):\s*([^;}]+)")
MIXED = re.compile(r"color-mix\(in srgb, [^;\"]*?\d+%, (?:var\([^)]*\)|[^()]*?)\)")
VIEWS = re.compile(r'<svg x="(\d+)" y="\d+" width="(\d+)"')
PLACE = re.compile(r'\bx="(\d+)" y="(\d+)"(?: width="\d+" height="(\d+)")?')
SIZE = re.compile(r'viewBox="0 0 (\d+) (\d+)" width="\1" height="\2"')
DARK = re.compile(r"\.driftlab-dark [^{}]*\{[^{}]*\}")


class Picture(NamedTuple):
    """A picture in a file."""

    file: str  # its name in the folder
    width: float  # on paper, in points
    caption: str  # what stands below it, plain
    is_still: bool  # whether it is a panel or a scene that moves elsewhere


def picture(markup: str, folder: Path, name: str) -> Picture | None:
    """Return the picture of an output's HTML, written under a name; None if it has none."""
    found = DATA.search(markup)
    if found is None:
        return None
    content = base64.b64decode(found[2])
    if found[1] == "svg+xml":
        content = narrowed(plain_svg(content.decode())).encode()
    file = f"{name}.{found[1].partition('+')[0]}"
    (folder / file).write_bytes(content)
    is_still = "driftlab-still" in markup
    words = (ALT if is_still else CAPTION).search(markup) or ALT.search(markup)
    caption = html.unescape(words[1]).replace("?. ", "? ") if words else ""
    caption = READING.sub(lambda begin: begin[0].upper(), caption) if is_still else caption
    caption += "" if caption.endswith((".", "?")) else "."
    return Picture(file, paper_width(content), caption, is_still)


def plain_svg(text: str) -> str:
    """Return an SVG without what only browsers know: mixed and named colours, a dark theme."""
    text = MIXED.sub(lambda match: colour(match[0]), DARK.sub("", text))
    values = dict(reversed(VARIABLE.findall(text)))  # the first that is said holds
    return re.sub(r"var\((--[\w-]+)\)", lambda match: values[match[1]].strip(), text)


def narrowed(text: str) -> str:
    """Return a scene of several views with its plots and numbers below them, not beside them."""
    whole = SIZE.search(text)
    if whole is None or int(whole[1]) < WIDE or 'class="dl-scene"' not in text:
        return text
    across = max(int(x) + int(width) for x, width in VIEWS.findall(text))
    bottom = BELOW

    def below(place: re.Match[str]) -> str:
        nonlocal bottom
        x, y, height = int(place[1]), int(place[2]) + BELOW, int(place[3] or 10)
        if x < across:  # a view, or a place within a plot
            return place[0]
        bottom = max(bottom, y + height)
        moved = f'x="{x - across}" y="{y}"'
        return moved + place[0].partition(f'y="{place[2]}"')[2]

    text = PLACE.sub(below, text)
    narrow = f'viewBox="0 0 {across} {bottom}" width="{across}" height="{bottom}"'
    behind = f'<rect width="{whole[1]}" height="{whole[2]}"'
    return text.replace(whole[0], narrow, 1).replace(
        behind, f'<rect width="{across}" height="{bottom}"', 1
    )


def paper_width(content: bytes) -> float:
    """Return the width of a picture on paper in points."""
    width, height = _size(content)
    return round(min(WIDEST, width, HIGHEST * width / height), 1)


def _size(content: bytes) -> tuple[float, float]:
    """The size on the screen in points, of a picture drawn twice as fine if it is of pixels."""
    scale = 0.75 if b"<svg" in content[:2000] else 0.5
    width, height = size(content)
    return scale * width, scale * height
