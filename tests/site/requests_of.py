"""What the pages of a folder would fetch from other places than the folder."""

from __future__ import annotations

import re
from html.parser import HTMLParser
from pathlib import Path

FETCHED = {"src", "srcset", "poster", "data", "action"}
"""Attributes whose address a browser asks for by itself."""
LINKS = {"stylesheet", "preload", "prefetch", "icon", "shortcut icon", "manifest", "preconnect"}
ELSEWHERE = re.compile(r"^\s*(?:[a-z]+:)?//", re.I)


class _Page(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.asked: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        named = {name: value or "" for name, value in attrs}
        wanted = [named[name] for name in FETCHED & named.keys()]
        if tag == "link" and LINKS & {named.get("rel", "").lower()}:
            wanted.append(named.get("href", ""))
        self.asked += [address for address in wanted if ELSEWHERE.match(address)]


def requests_of(folder: Path) -> list[str]:
    """Return a line for each thing that a page or style sheet in a folder asks of another place."""
    found = []
    for path in sorted(folder.rglob("*.html")):
        page = _Page()
        page.feed(path.read_text("utf-8"))
        found += [f"{path.relative_to(folder)}: {address}" for address in page.asked]
    for path in sorted(folder.rglob("*.css")):
        addresses = re.findall(
            r"(?:url\(|@import\s+(?!url))\s*['\"]?([^'\")\s]+)", path.read_text("utf-8")
        )
        found += [f"{path.relative_to(folder)}: {a}" for a in addresses if ELSEWHERE.match(a)]
    return found
