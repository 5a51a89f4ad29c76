"""A guess and the truth as two marks on one scale: HTML in the page's own colours."""

from __future__ import annotations

import html

from .puzzle import Number

LABEL = "position: absolute; white-space: nowrap; line-height: 1.3"
MANY = 5
"""Ticks; of more, each second one is labelled, or the labels of a small screen touch."""


def marks(question: Number, guess: float | None, truth: float) -> str:
    """Return the scale of a question with the truth below it and the guess, if any, above."""
    # From the top: words and diamond of the guess, the line, diamond and words of the truth, the
    # numbers of the scale. A label's small letters stand inside, or its em would be another.
    line = "position: absolute; left: 0; right: 0; top: 2.3em; border-top: 2px solid currentColor"
    parts = [f"<div style='{line}'></div>"]
    ticks = question.ticks()
    every = 2 if len(ticks) > MANY else 1
    for number, tick in enumerate(ticks):
        at = 100 * question.place(tick)
        parts.append(
            f"<div style='position: absolute; left: {at:.1f}%; top: 2.1em; height: 0.5em; "
            "border-left: 1px solid currentColor; opacity: 0.6'></div>"
        )
        if number % every == 0:
            parts.append(
                f"<div style='{LABEL}; left: {at:.1f}%; top: 4.7em; transform: translateX(-50%); "
                f"opacity: 0.75'><small>{written_tick(tick)}</small></div>"
            )
    # The diamonds differ in their filling and in their words, and stand on different sides.
    parts.append(_mark(question, truth, "it is", top="2.65em", filled=True, label_top="3.4em"))
    says = f"The answer {question.written(truth)}"
    if guess is not None:
        parts.append(_mark(question, guess, "you", top="1.45em", filled=False, label_top="0"))
        says += f" and your guess {question.written(guess)}"
    low, high = question.written(question.low), question.written(question.high)
    says += f" on a scale from {low} to {high}"
    return (
        f"<div role='img' aria-label='{html.escape(says, quote=True)}' "
        "style='position: relative; height: 6.2em; margin: 0.3em 2.5em; max-width: 34em'>"
        f"{''.join(parts)}</div>"
    )


def _mark(
    question: Number, value: float, who: str, *, top: str, filled: bool, label_top: str
) -> str:
    place = 100 * question.place(value)
    # A label at an end of the scale stays within it.
    shift = "0" if place < 12 else "-100%" if place > 88 else "-50%"
    filling = "currentColor" if filled else "transparent"
    words = f"{who} <b>{html.escape(question.written(value))}</b>"
    return (
        f"<div style='position: absolute; left: {place:.1f}%; top: {top}; width: 0.55em; "
        f"height: 0.55em; background: {filling}; border: 2px solid currentColor; "
        "box-sizing: border-box; transform: translateX(-50%) rotate(45deg)'></div>"
        f"<div style='{LABEL}; left: {place:.1f}%; top: {label_top}; "
        f"transform: translateX({shift})'><small>{words}</small></div>"
    )


def written_tick(value: float) -> str:
    """Return a value of the scale as short as it can be."""
    return f"{value:,.0f}".replace(",", "\u202f") if value >= 1 or value == 0 else f"{value:g}"
