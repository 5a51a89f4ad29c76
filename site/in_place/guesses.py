"""Answers the puzzles in the page; the worker calls `reveal` and `look_back`."""

from __future__ import annotations

from driftlab.book.machinery.exercise.puzzle import Answer, Puzzle
from driftlab.book.machinery.exercise.revealed import revealed
from driftlab.book.puzzles import looked_back, puzzle_of


def reveal(chapter: str, guess: list[Answer] | None, note: str) -> str:
    """Return the answers of a chapter's puzzle in HTML, beside a guess."""
    return revealed(puzzle_of(chapter), guess, note)


def look_back(kept: dict[str, list[Answer] | None]) -> str:
    """Return all guesses beside their truths in HTML; `kept` has them by their puzzles' keys."""

    def guess_at(puzzle: Puzzle) -> list[Answer] | None:
        guess = kept.get(puzzle.key)
        return guess if puzzle.allows(guess) else None

    return looked_back(guess_at)._repr_html_()
