"""Pictures in the outputs of notebooks, as files beside the pages."""

from __future__ import annotations

import base64
import hashlib
import io
import re
from pathlib import Path

from PIL import Image

FOLDER = "_static/pictures"
INLINED = re.compile(r'<img\b[^>]*?\bsrc="data:image/(\w+)[^;"]*;base64,([^"]+)"[^>]*>')
ALT = re.compile(r'\balt="([^"]*)"')
SVG_SIZE = re.compile(r'<svg\b[^>]*?\bviewBox="[\d.-]+ [\d.-]+ ([\d.]+) ([\d.]+)"')
POINT = 96 / 72
"""Pixels of a page; Matplotlib's SVG counts in points."""


class Pictures:
    """The pictures of all pages: each is one file, however often it is shown."""

    def __init__(self) -> None:
        self.files: dict[str, bytes] = {}  # by name, a digest of what is in the file

    def as_files(self, output: str, up: str) -> str:
        """Return HTML of an output with its pictures in files, so that the page is light.

        `up` is the way from the page to the begin of the site, "../" for a page in a folder.
        """
        return INLINED.sub(lambda found: self._filed(found, up), output)

    def _filed(self, found: re.Match[str], up: str) -> str:
        raw = base64.b64decode(found[2])
        name = f"{hashlib.sha256(raw).hexdigest()[:16]}.{found[1]}"
        self.files[name] = raw
        width, height = size(raw)
        alt = ALT.search(found[0])
        words = alt[1] if alt else ""
        file = f"{up}{FOLDER}/{name}"
        return (  # a tap shows it at its full size, where a narrow page has made it small
            f'<a class="picture" href="{file}"><img src="{file}" alt="{words}" loading="lazy" '
            f'decoding="async" width="{width}" height="{height}"></a>'
        )

    def write(self, source: Path) -> None:
        """Write the files below the folder that Sphinx reads."""
        folder = source / FOLDER
        folder.mkdir(parents=True)
        for name, raw in self.files.items():
            (folder / name).write_bytes(raw)


def size(raw: bytes) -> tuple[int, int]:
    """Return width and height of a picture in pixels of a page, so that room is kept for it."""
    if found := SVG_SIZE.search(raw[:2000].decode("utf-8", "replace")):
        scale = POINT if b'pt"' in raw[:2000] else 1.0
        return round(float(found[1]) * scale), round(float(found[2]) * scale)
    with Image.open(io.BytesIO(raw)) as picture:
        return picture.size
