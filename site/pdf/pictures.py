"""Pictures of outputs as files that Typst reads, with the size that they have on paper."""

from __future__ import annotations

import base64
import html
import re
import struct
from pathlib import Path
from typing import NamedTuple

from driftlab.book.machinery.scene.look import colour

WIDEST, HIGHEST = 482.0, 540.0
"""In points: the width of the text, and a height that leaves room for a caption."""
SHRINK = 0.74
"""The size on paper over that on a screen."""
DATA = re.compile(r'src="data:image/(svg\+xml|jpeg|png);base64,([^"]+)"')
CAPTION = re.compile(r"<figcaption>(.*?)</figcaption>", re.S)
ALT = re.compile(r'\balt="([^"]*)"')
VARIABLE = re.compile(r"(--[\w-]+):\s*([^;}]+)")
MIXED = re.compile(r"color-mix\(in srgb, [^;\"]*?\d+%, (?:var\([^)]*\)|[^()]*?)\)")
DARK = re.compile(r"\.driftlab-dark [^{}]*\{[^{}]*\}")


class Picture(NamedTuple):
    """A picture in a file.

    Attributes
    ----------
    file : str
        Its name in the folder.
    width : float
        On paper, in points.
    caption : str
        What stands below it, plain.
    is_still : bool
        Whether it is a panel or a scene that moves elsewhere.
    """

    file: str
    width: float
    caption: str
    is_still: bool


def picture(markup: str, folder: Path, name: str) -> Picture | None:
    """Return the picture of an output's HTML, written under a name; None if it has none."""
    found = DATA.search(markup)
    if found is None:
        return None
    content = base64.b64decode(found[2])
    if found[1] == "svg+xml":
        content = plain_svg(content.decode()).encode()
    file = f"{name}.{found[1].partition('+')[0]}"
    (folder / file).write_bytes(content)
    is_still = "driftlab-still" in markup
    words = (ALT if is_still else CAPTION).search(markup) or ALT.search(markup)
    caption = html.unescape(words[1]).replace("?. ", "? ") if words else ""
    caption += "" if caption.endswith((".", "?")) else "."
    return Picture(file, paper_width(content), caption, is_still)


def plain_svg(text: str) -> str:
    """Return an SVG without what only browsers know: mixed and named colours, a dark theme."""
    text = MIXED.sub(lambda match: colour(match[0]), DARK.sub("", text))
    values = dict(reversed(VARIABLE.findall(text)))  # the first that is said holds
    return re.sub(r"var\((--[\w-]+)\)", lambda match: values[match[1]].strip(), text)


def paper_width(content: bytes) -> float:
    """Return the width of a picture on paper in points."""
    width, height = _size(content)
    shown = min(WIDEST, SHRINK * width)
    return round(min(shown, HIGHEST * width / height), 1)


def _size(content: bytes) -> tuple[float, float]:
    """The size on the screen in points, of a picture drawn twice as fine if it is of pixels."""
    if content.startswith(b"\xff\xd8"):
        place = 2
        while content[place + 1] not in (0xC0, 0xC1, 0xC2):
            place += 2 + struct.unpack(">H", content[place + 2 : place + 4])[0]
        height, width = struct.unpack(">HH", content[place + 5 : place + 9])
        return width / 2, height / 2
    if content.startswith(b"\x89PNG"):
        width, height = struct.unpack(">II", content[16:24])
        return width / 2, height / 2
    head = content[: content.index(b">", content.index(b"<svg"))].decode()
    sizes = re.findall(r'\b(?:width|height)="([\d.]+)(pt|px|)"', head)
    (width, unit), (height, _) = sizes
    scale = 1.0 if unit == "pt" else 0.75
    return scale * float(width), scale * float(height)
