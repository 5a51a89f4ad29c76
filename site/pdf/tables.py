"""Tables that fit the page: columns as wide as their contents ask for, smaller type if need be.

A table is one of pandoc's: ["attr", caption, columns, head, bodies, foot].
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

LINE = 112
"""Signs in a line of a table's usual type."""
GAP = 2.6
"""Signs between two columns."""
GAP_IN_MATRIX = "   "
SIZES = (8.5, 7.5, 6.8)
"""Types in points, the usual one first."""


def fitted(table: list[Any]) -> float:
    """Give a table's columns their widths; the size of its type in points.

    A table that is narrower than a line keeps the widths of its contents.
    """
    cells = [[_measures(cell) for cell in row] for row in _rows(table)]
    columns = list(zip(*cells, strict=True))
    wanted = [max(length for length, _ in column) for column in columns]
    longest = [max(word for _, word in column) for column in columns]
    gaps = GAP * len(columns)
    if sum(wanted) + gaps <= LINE:
        return SIZES[0]
    size = next((s for s in SIZES if sum(longest) + gaps <= LINE * SIZES[0] / s), SIZES[-1])
    widths = _widths(wanted, longest, LINE * SIZES[0] / size - gaps)
    table[2] = [
        [alignment, {"t": "ColWidth", "c": round((width + GAP) / (sum(widths) + gaps), 4)}]
        for (alignment, _), width in zip(table[2], widths, strict=True)
    ]
    return size


def _widths(wanted: list[float], longest: list[float], room: float) -> list[float]:
    """Short columns get what they want, the others shares that grow with the root of it."""
    widths = [0.0] * len(wanted)
    left = list(range(len(wanted)))
    while left:
        total = sum(wanted[i] ** 0.5 for i in left)
        shares = {i: room * wanted[i] ** 0.5 / total for i in left}
        settled = [i for i in left if wanted[i] <= shares[i] or longest[i] > shares[i]]
        for i in settled or left:
            widths[i] = min(wanted[i], max(longest[i], shares[i])) if settled else shares[i]
            room -= widths[i]
        room = max(room, 1.0)
        left = [i for i in left if i not in settled] if settled else []
    return widths


def _rows(table: list[Any]) -> Iterator[list[Any]]:
    _, _, _, head, bodies, _ = table
    for rows in (head[1], *(body[3] for body in bodies)):
        for _, cells in rows:
            yield [cell[4] for cell in cells]


def _measures(blocks: Any) -> tuple[float, float]:
    """How long a cell is in signs, its longest line and its longest word."""
    text = "".join(_texts(blocks))
    words = re.split(r"[ \n]|(?<=[-/–._:,=+])", text)  # where a line may end
    return max(map(len, text.split("\n"))), max(map(len, words))


def _drawn(tex: str) -> str:
    """About as many signs as a formula has when it is set, of a matrix those of its longest row."""
    tex = re.sub(r"\\(begin|end)\{\w+\}|\\(left|right)\W", "", tex)
    tex = re.sub(r"\\(text|math\w+|[td]?frac|hat|dot|bar|sqrt|displaystyle)\b|\\[,;:! ]", "", tex)
    rows = (
        re.sub(r"[{}^_ ]", "", re.sub(r"\\([a-zA-Z]+|.)", "a", row)) for row in tex.split(r"\\")
    )
    return max((row.replace("&", GAP_IN_MATRIX) for row in rows), key=len)


def _texts(node: Any) -> Iterator[str]:
    if isinstance(node, list):
        for each in node:
            yield from _texts(each)
    elif isinstance(node, dict):
        kind, content = node.get("t", ""), node.get("c", [])
        if kind in ("Space", "SoftBreak", "LineBreak"):
            yield "\n" if kind == "LineBreak" else " "
        elif kind == "Math":
            yield _drawn(content[1]).replace(" ", "\u00a0" if r"\\" in content[1] else "")
        elif kind == "Code":
            yield content[1] + "\u00a0" * (len(content[1]) // 4)  # it is wider
        elif kind == "Str":
            yield content
        else:
            yield from _texts(content)
