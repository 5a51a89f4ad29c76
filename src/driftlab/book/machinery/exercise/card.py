"""What a reader sees of an exercise: a card with a sign, ticks, and a ladder of hints.

A card is a few lines of HTML without style sheet or script, so that it looks the same in every
notebook and on a saved page; its colours are transparent, so that it suits a dark page too, and
each sign says in a word what it means. Elsewhere it is plain text.
"""

from __future__ import annotations

import html
import re
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from .exercise import Verdict
from .hints import Help
from .records import MIME

SIGNS = {
    "right": ("✓ Right", "0, 158, 115"),
    "not yet": ("✗ Not yet", "213, 94, 0"),
    "not readable": ("? Not readable", "213, 94, 0"),
    "not answered yet": ("○ Open", "128, 128, 128"),
}
"""By the first words of a verdict, what the card says, and its colour."""

SECTION = "The section that helps:"

TICKS = {True: "✓", False: "✗"}


@dataclass(frozen=True)
class Card:
    """What is said of an answer."""

    number: str  # the exercise's number
    verdict: Verdict  # what is thought of the answer
    help: Help  # what helps with the exercise
    # sentences that follow: a first guess against the truth, how to write the number
    notes: tuple[str, ...] = ()
    progress: str = ""  # how the chapter stands
    because: str = ""  # the student's own words
    # the same for programs, which keep it in a saved notebook; see `records`
    record: Mapping[str, Any] = field(default_factory=dict)

    def __repr__(self) -> str:
        name = f"Exercise {self.number}"
        says = f"{self.verdict.word}. {self.verdict.reason}".rstrip()
        return "\n".join([f"{name}: {says}", *self._ticks(), *self._words()])

    def _repr_html_(self) -> str:
        return self.boxed()

    def _repr_mimebundle_(self, **_: Any) -> dict[str, Any]:
        return {MIME: dict(self.record)}

    def boxed(self, *, hints: bool = True) -> str:
        """The card in HTML; without hints for a page that has them below it anyway."""
        sign, colour = SIGNS[self.verdict.word]
        says = self.verdict.reason
        name = html.escape(f"Exercise {self.number}")
        head = f"<b>{html.escape(sign)}</b> &nbsp;{name}"
        if self.progress:
            head += f"<span style='float: right; opacity: 0.75'>{html.escape(self.progress)}</span>"
        body = [says, *self._words()] if says else self._words()
        lines = [head, *map(in_html, body)]
        wide = "style='letter-spacing: 0.3em'"
        lines[1:1] = [
            f"<span {wide} aria-label='{html.escape(_aloud(row))}'>{ticks}</span>"
            for row, ticks in zip(self.verdict.parts, self._ticks(), strict=True)
        ]
        if hints and self.help.is_there and not self.verdict.right:
            lines.append(ladder(self.help))
            lines += [link(self.help)] if self.help.section else []
        return boxed(lines, colour)

    def _ticks(self) -> list[str]:
        return [" ".join(TICKS[part] for part in row) for row in self.verdict.parts]

    def _words(self) -> list[str]:
        yours = [f"Your words: {self.because}"] if self.because else []
        if self.verdict.right and self.help.model:
            whose = "The book's words:" if self.because else "In words:"
            return [*self.notes, *yours, f"{whose} {self.help.model}"]
        return [*self.notes, *yours]


@dataclass(frozen=True)
class HintCard:
    """As much of an exercise's help as has been asked for."""

    number: str
    help: Help
    rungs: int

    def __repr__(self) -> str:
        shown = [f"Hint {i}: {text}" for i, text in enumerate(self.help.rungs[: self.rungs], 1)]
        if self.rungs > len(shown):
            shown.append(f"{SECTION} {self.help.section}.")
        return "\n".join([f"Exercise {self.number}", *shown])

    def _repr_html_(self) -> str:
        shown = [
            f"<b>{html.escape(name)}</b> &nbsp;{in_html(text)}"
            for name, text in zip(("Nudge", "Idea"), self.help.rungs[: self.rungs], strict=False)
        ]
        if self.rungs > len(shown):
            shown.append(link(self.help))
        head = html.escape(f"Exercise {self.number}")
        return boxed([head, *shown], SIGNS["not answered yet"][1])


def show(card: Card | HintCard) -> None:
    """Show a card where there is a notebook, else print it."""
    ipython = sys.modules.get("IPython")
    if ipython is None or ipython.get_ipython() is None:
        print(card)
    else:
        ipython.display.display(card)


def ladder(help_: Help) -> str:
    """The hints in HTML, each folded into the one before."""
    steps = zip(("A nudge", "More: the idea"), help_.rungs, strict=True)
    inner = ""
    for name, text in reversed(tuple(steps)):
        inner = (
            f"<details><summary style='cursor: pointer'>{html.escape(name)}</summary>"
            f"<div style='padding-left: 1em'>{in_html(text)}{inner}</div></details>"
        )
    return inner


def link(help_: Help) -> str:
    """A link to the section that helps, within the page."""
    anchor = html.escape(help_.section.replace(" ", "-"))
    return f"{html.escape(SECTION)} <a href='#{anchor}'>{html.escape(help_.section)}</a>"


def in_html(text: str) -> str:
    """Text in HTML; what stands between backticks is code."""
    return re.sub(r"`([^`]*)`", r"<code>\1</code>", html.escape(text))


def boxed(lines: list[str], colour: str) -> str:
    """Lines of HTML in a box that shines through."""
    style = (
        f"border: 1px solid rgba({colour}, 0.5); border-left: 6px solid rgb({colour}); "
        f"background: rgba({colour}, 0.08); color: inherit; border-radius: 4px; "
        "padding: 0.5em 1em; margin: 0.3em 0; max-width: 46em; line-height: 1.5; overflow: hidden"
    )
    inside = "".join(f"<div>{line}</div>" for line in lines)
    return f"<div role='status' style='{style}'>{inside}</div>"


def _aloud(row: tuple[bool, ...]) -> str:
    return ", ".join("it is right" if part else "it is not yet" for part in row)
