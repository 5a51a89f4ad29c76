"""What a reader sees of a puzzle's answer, beside the guess: HTML in the page's own colours."""

from __future__ import annotations

import html
from collections.abc import Sequence

from .marks import marks
from .puzzle import Answer, Number, Puzzle

CLOSE = "margin: 0.5em 0; line-height: 1.45"
WITHOUT_GUESS = "You looked without a guess, so none is kept for this puzzle."


def revealed(puzzle: Puzzle, guess: Sequence[Answer] | None, note: str) -> str:
    """Return the answers next to a guess, if there was one, and a note on whether it was kept."""
    truths = puzzle.truths()
    lines = []
    for number, (question, truth) in enumerate(zip(puzzle.questions, truths, strict=True)):
        own = None if guess is None else guess[number]
        found = f"{html.escape(question.asks)} <b>{html.escape(question.written(truth))}</b>."
        far = "" if own is None else html.escape(question.how_far(own, truth))
        lines.append(f"<p style='{CLOSE}'>{found} {far}</p>")
        if isinstance(question, Number):
            lines.append(marks(question, own, truth))  # type: ignore[arg-type]
    lines.append(f"<p style='{CLOSE}'>{html.escape(puzzle.remark(truths))}</p>")
    note = " ".join(filter(None, [WITHOUT_GUESS if guess is None else "", note]))
    if note:
        lines.append(f"<p style='{CLOSE}'><small>{html.escape(note)}</small></p>")
    # An alert is read out when it appears; of a region that is put in anew with its text most
    # screen readers say nothing.
    return f"<div role='alert' aria-live='polite'>{''.join(lines)}</div>"
