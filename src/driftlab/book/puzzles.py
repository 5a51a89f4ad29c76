"""The puzzles of the book: ``guess("03")`` asks, and ``guesses()`` looks back at all of them."""

from __future__ import annotations

import html
import math
from collections.abc import Callable
from statistics import median
from typing import NamedTuple

from .chapters import chapters_with, part_of
from .machinery.exercise.guess import GuessControl
from .machinery.exercise.kept_guesses import kept_guess
from .machinery.exercise.puzzle import Answer, Number, Puzzle, Question, rounded

ENOUGH = 4
"""With fewer numbers in a half of the book nothing is said of that half."""

REACH = 3
"""Decades that the common scale of all guesses goes to each side of the truth."""


def puzzle_of(chapter: str) -> Puzzle:
    """Return the puzzle of a chapter."""
    known = chapters_with("puzzle")
    if chapter not in known:
        raise ValueError(f'chapter: expected "{known[0]}" to "{known[-1]}", got {chapter!r}.')
    return part_of(chapter, "puzzle").PUZZLE


def guess(chapter: str) -> GuessControl:
    """Ask for a guess at the puzzle of a chapter, and show the answer after it.

    The guess is kept in ``guesses.json`` beside the notebook, and shown again the next time. To
    guess anew, delete that file.

    Parameters
    ----------
    chapter : str
        Its number, "00" to "19".

    Raises
    ------
    ValueError
        If no chapter of that number opens with a puzzle.
    """
    return GuessControl(puzzle_of(chapter))


HEAD = ("", "asked", "you", "it is", "you / it is", "too small | too large")


class Guessed(NamedTuple):
    """One question, what was guessed and what is true."""

    chapter: str
    question: Question
    guess: Answer
    truth: Answer

    @property
    def decades(self) -> float | None:
        """Guess over truth as powers of ten; None where there is no such ratio."""
        if isinstance(self.question, Number) and not self.question.whole:
            return math.log10(float(self.guess) / float(self.truth))
        return None

    @property
    def ratio(self) -> str:
        """Guess over truth, in two digits, or whether a choice or a count is right."""
        if self.decades is None:
            return "right" if self.guess == self.truth else "not so"
        ratio = rounded(10**self.decades)
        return f"{ratio:,.0f}".replace(",", "\u202f") if ratio >= 100 else f"{ratio:g}"


class Guesses:
    """All guesses that were kept, each beside its truth; the last line of a cell shows them."""

    def __init__(self, rows: list[Guessed]) -> None:
        self.rows = rows

    @property
    def says(self) -> str:
        """How the guesses moved, as far as there are enough of them."""
        if not self.rows:
            return "No guess is kept yet. Each chapter opens with a puzzle; guess at a few of them."
        numbers = [(row.chapter, abs(row.decades)) for row in self.rows if row.decades is not None]
        early = [off for chapter, off in numbers if chapter < "07"]
        late = [off for chapter, off in numbers if chapter >= "07"]
        if min(len(early), len(late)) < ENOUGH:
            return (
                f"Guesses kept: {len(self.rows)}. With {ENOUGH} numbers or more guessed before "
                "chapter 07 and as many from it on, this line says how your intuition moved."
            )
        before, after = (10 ** median(off) for off in (early, late))
        moved = "closer" if after < before else "no closer"
        return (
            f"Half of your guesses before chapter 07 were within a factor {before:.2g} of the "
            f"truth, half of those from it on within {after:.2g}: your intuition came {moved}. "
            "These are few guesses, at puzzles of unequal difficulty."
        )

    def __repr__(self) -> str:
        lines = [
            f"{row.chapter}  {row.question.asks}  you: {row.question.written(row.guess)}, "
            f"it is: {row.question.written(row.truth)}; {row.ratio}"
            for row in self.rows
        ]
        return "\n".join([*lines, self.says])

    def _repr_html_(self) -> str:
        says = f"<p>{html.escape(self.says)}</p>"
        if not self.rows:
            return says
        head = "".join(f"<th scope='col' style='text-align: left'>{name}</th>" for name in HEAD)
        rows = "".join(map(_row, self.rows))
        return f"<table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>{says}"


def _row(row: Guessed) -> str:
    guess, truth = map(row.question.written, (row.guess, row.truth))
    words = (row.chapter, row.question.asks, guess, truth, row.ratio)
    cells = "".join(f"<td style='text-align: left'>{html.escape(word)}</td>" for word in words)
    return f"<tr>{cells}<td>{'' if row.decades is None else _strip(row.decades)}</td></tr>"


def _strip(decades: float) -> str:
    """A line with the truth in its middle and the guess where its ratio puts it."""
    at = 50 + 50 * max(-1.0, min(1.0, decades / REACH))
    left, width = min(at, 50.0), abs(at - 50)
    line = "position: absolute; background: currentColor"
    return (
        "<div aria-hidden='true' style='position: relative; width: 14em; height: 1em'>"
        f"<div style='{line}; left: 50%; top: 0; width: 1px; height: 1em'></div>"
        f"<div style='{line}; left: {left:.1f}%; width: {width:.1f}%; top: 0.45em; height: 2px'>"
        f"</div><div style='{line}; left: {at:.1f}%; top: 0.22em; width: 0.55em; height: 0.55em; "
        "border-radius: 50%; transform: translateX(-50%)'></div></div>"
    )


def guesses() -> Guesses:
    """Look back at the guesses that are kept beside this notebook."""
    return looked_back(lambda puzzle: kept_guess(puzzle)[1])


def looked_back(kept: Callable[[Puzzle], list[Answer] | None]) -> Guesses:
    """Look back at all guesses; `kept` gives that at a puzzle, if there is one."""
    rows = []
    for chapter in chapters_with("puzzle"):
        puzzle = puzzle_of(chapter)
        guess = kept(puzzle)
        if guess is not None:
            truths = puzzle.truths()
            rows += [
                Guessed(chapter, *each)
                for each in zip(puzzle.questions, guess, truths, strict=True)
            ]
    return Guesses(rows)
