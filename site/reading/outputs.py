"""What a page shows of the outputs of a cell.

Pictures become files, a figure of the book leads to its numbers, a panel's still keeps the class
and the values of its panel, and what asks for an answer makes room for one: scripts of the site
make the last two live, and without them the page reads as it is.
"""

from __future__ import annotations

import re
from html import unescape
from urllib.parse import unquote

from nbformat import NotebookNode
from nbformat.v4 import new_output

from addresses import section_label
from reading.pictures import Pictures
from reading.solutions import link_to_solution

WIDGET = "application/vnd.jupyter.widget-view+json"
STILL = re.compile(r'<style>.*?</style>(<figure class="driftlab-still".*?)<figcaption>.*', re.S)
STOOD = "<figcaption>This is how it stood when the chapter was run.</figcaption></figure>"
FIGURE = re.compile(r'<figure style="margin: 0">(<img.*?>)(<figcaption>.*)</figcaption></figure>')
PUBLISHED = re.compile(r"driftlab\.figure\('([\w-]+)'\)$", re.M)
"""What a figure says first of itself, if nobody has changed its parameters."""
OPEN = re.compile(
    r"<div role='status'[^>]*><div><b>○ Open</b> &nbsp;Exercise ([\d.]+).*?</div>(.*)</div>"
)
"""The card of an exercise that nobody has answered: its number, and its hints."""
PROGRESS = re.compile(r"<span style='float: right[^>]*>.*?</span>")
SECTION = re.compile(r"href='#([^']*)'")
LEDGER = re.compile(r'^paper_table\("([\w-]+)"\)$', re.M)
"""The whole table of a paper's equations, which has a page of its own on the site."""
GUESS = re.compile(r"(<p><b>A guess first.*)<p>.*?</p>", re.S)
"""The questions of a puzzle, and the sentence that only holds in JupyterLab."""

LOOK_BACK = "<p>No guess is kept yet."
ROOM = re.compile(r'<div class="(exercise|guess)" data-')
"""What an output begins with that has room for an answer."""


class Outputs:
    """The outputs of the cells of one page."""

    def __init__(self, pictures: Pictures, page: str, chapter: str) -> None:
        self.pictures = pictures
        self.page = page  # its name, as "solutions/03_systematic_drift"
        self.up = "../" * page.count("/")  # the way to the begin of the site
        self.chapter = chapter  # whose the page or its solutions are; "" if neither

    def shown(self, cell: NotebookNode) -> list[NotebookNode]:
        """Return what the page shows of a cell's outputs."""
        kept: list[NotebookNode] = []
        for output in cell.outputs:
            data = output.get("data", {})
            if WIDGET in data and "text/html" not in data:
                continue  # a panel, which lives in a kernel only; its still follows
            if "text/html" in data:
                output = _output("text/html", self._html(data["text/html"], data["text/plain"]))
            elif ledger := LEDGER.search(cell.source):
                output = _output("text/markdown", f"See [the ledger](/ledger/{ledger[1]}.md).")
            kept.append(output)
        return kept

    def _html(self, html: str, plain: str) -> str:
        if still := STILL.fullmatch(html):
            return f"{self.pictures.as_files(still[1], self.up)}{STOOD}"
        if figure := FIGURE.fullmatch(html):
            return self._figure(figure, plain)
        if card := OPEN.fullmatch(html):
            hints = SECTION.sub(self._section, card[2])
            room = f'<div class="exercise" data-exercise="{card[1]}"></div>'
            solution = link_to_solution(card[1], f"solutions/{self.page}.html")
            return f'{room}<div class="hints">{hints}</div>{solution}'
        if guess := GUESS.fullmatch(html):
            return f'<div class="guess" data-guess="{self.chapter}">{guess[1]}</div>'
        if html.startswith(LOOK_BACK):
            return f'<div class="guesses">{html}</div>'
        return self.pictures.as_files(PROGRESS.sub("", html), self.up)

    def _figure(self, figure: re.Match[str], plain: str) -> str:
        """A figure of the book; as published it leads to its numbers."""
        more = ""
        if name := PUBLISHED.match(plain):
            address = f"{self.up}gallery/index.html#figure-{name[1]}"
            more = f' <a class="reference internal" href="{address}">Its numbers</a>'
        picture = self.pictures.as_files(figure[1], self.up)
        return f'<figure class="driftlab-figure">{picture}{figure[2]}{more}</figcaption></figure>'

    def _section(self, found: re.Match[str]) -> str:
        """A link to a section, for which Jupyter has another address."""
        heading = unescape(unquote(found[1])).replace("-", " ")
        return f"class='reference internal' href='#{section_label(self.chapter, heading)}'"


def has_room(shown: list[NotebookNode]) -> bool:
    """Return whether outputs, as a page shows them, have room for an answer."""
    return any(ROOM.match(output.get("data", {}).get("text/html", "")) for output in shown)


def _output(kind: str, text: str) -> NotebookNode:
    return new_output("display_data", {kind: text})  # type: ignore[no-untyped-call]
