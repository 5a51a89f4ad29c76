r"""TeX that pandoc reads, with the same look, from TeX that it does not read or reads loosely.

It knows no ``\rm``, sets the bars of $|\omega|$ as single signs, gives ``\;`` no width and ``\!``
far too much, and drops the number in ``\tag``.
"""

from __future__ import annotations

import re

OLD_FONT = re.compile(r"\{\s*\\(rm|sf|bf|it)\b\s*((?:[^{}]|\{[^{}]*\})*)\}")
TAG = re.compile(r"\\tag\{([^{}]*)\}")
TOKEN = re.compile(
    r"\\(?:left|right|[bB]igg?[lr]?)\s*(?:\\[a-zA-Z]+|\\.|.)"  # a delimiter that knows its side
    r"|\\[a-zA-Z]+|\\.|.",
    re.S,
)
BARS = {"|": "|", r"\vert": "|", r"\Vert": r"\|", r"\|": r"\|"}
SIDES = {r"\lvert": r"\left|", r"\rvert": r"\right|", r"\lVert": r"\left\|", r"\rVert": r"\right\|"}


def readable(tex: str) -> str:
    """Return a formula as pandoc reads it."""
    tex = tex.replace(r"\;", r"\ ").replace(r"\!", " ")
    tex = TAG.sub(r"\\qquad (\\text{\1})", tex.strip())
    tex = OLD_FONT.sub(r"{\\math\1{\2}}", tex)
    return _paired_bars(tex)


def _paired_bars(tex: str) -> str:
    """Make delimiters of bars: the first of two opens, if both stand in one group."""
    tokens = TOKEN.findall(tex)
    groups: list[list[int]] = [[]]  # places of the bars of each group that is open
    for place, token in enumerate(tokens):
        if token == "{":
            groups.append([])
        elif token == "}" and len(groups) > 1:
            _pair(tokens, groups.pop())
        elif token in ("&", r"\\"):
            _pair(tokens, groups[-1])
            groups[-1] = []
        elif token in BARS:
            groups[-1].append(place)
        elif token in SIDES:
            tokens[place] = SIDES[token]
    for places in groups:
        _pair(tokens, places)
    return "".join(tokens)


def _pair(tokens: list[str], places: list[int]) -> None:
    if len(places) % 2:  # a condition or a restriction, not a length
        return
    for opening, closing in zip(places[::2], places[1::2], strict=True):
        tokens[opening] = rf"\left{BARS[tokens[opening]]}"
        tokens[closing] = rf"\right{BARS[tokens[closing]]} "
