"""The guess control of a puzzle: first a guess, then the answer.

It is made of ipywidgets alone, with no script. The number field is for the keyboard and for screen
readers, which hear its label; the slider moves with it.
"""

from __future__ import annotations

import html
from collections.abc import Sequence
from typing import Any

import ipywidgets as widgets

from ..one_at_a_time import one_at_a_time
from ..panel.control import TOOLTIP
from ..panel.widget_view import widget_view
from .kept_guesses import keep, kept_guess
from .puzzle import Answer, Choice, Number, Puzzle, rounded
from .revealed import CLOSE, revealed

GUESS_CLASS = "driftlab-guess"
"""HTML class of every guess control."""

UNITS = {"°": "degrees (°)", "′": "arc minutes (′)", "″": "arc seconds (″)"}
"""Units whose signs are too small to stand alone beside a field."""


STEP = 0.005
"""Of a slider, as a part of its length."""

KEPT = "This is the guess that you made first; it is kept in guesses.json."


UNANSWERED = (
    "Move each slider, or type a number, and choose an answer where there is a choice. "
    "Then it is a guess."
)


class NumberInput:
    """A field and a slider for one number; they move together."""

    def __init__(self, question: Number) -> None:
        self.question = question
        limits = {"value": question.start, "min": question.low, "max": question.high}
        slider = {
            "readout": False,
            "layout": {"width": "auto", "max_width": "30em", "margin": "0"},
            TOOLTIP: f"{question.asks} ({question.unit})",
        }
        if question.whole:
            self.field = widgets.BoundedIntText(**limits, description="Your guess")
            self.slider = widgets.IntSlider(**limits, **slider)
        else:
            self.field = widgets.BoundedFloatText(**limits, description="Your guess")
            # A page moves a slider to the nearest step, which would pass for a guess.
            start = round(STEP * round(question.place(question.start) / STEP), 9)
            self.slider = widgets.FloatSlider(start, min=0, max=1, step=STEP, **slider)
        self.field.layout = {"width": "14em"}
        self.slider.observe(self._slid, "value")
        self.field.observe(self._typed, "value")
        typed = widgets.HBox([self.field, widgets.Label(UNITS.get(question.unit, question.unit))])
        self.widget = widgets.VBox([_text(question.asks), typed, self.slider])
        self._moving = False
        self._touched = False  # where the slider stands at first is nobody's guess

    @property
    def value(self) -> Answer | None:
        """The guess, in the question's unit; None before there is one."""
        return float(self.field.value) if self._touched else None

    @one_at_a_time
    def _slid(self, change: Any) -> None:
        if not self._touched and abs(change["new"] - change["old"]) < STEP / 2:
            return  # a page's own rounding, nobody's move
        self._touched = True
        question = self.question
        value = change["new"]
        if not question.whole:
            value = rounded(question.low * (question.high / question.low) ** value)
        self._move(self.field, value)

    @one_at_a_time
    def _typed(self, change: Any) -> None:
        self._touched = True
        value = change["new"]
        self._move(self.slider, value if self.question.whole else self.question.place(value))

    def _move(self, other: Any, value: float) -> None:
        if not self._moving:
            self._moving = True
            try:
                other.value = value
            finally:
                self._moving = False


class ChoiceInput:
    """Buttons for the answers of one question; none is chosen at first."""

    def __init__(self, question: Choice) -> None:
        self.question = question
        self.radio = widgets.RadioButtons(
            options=question.options,
            value=None,
            layout={"width": "max-content"},
        )
        self.widget = widgets.VBox([_text(question.asks), self.radio])

    @property
    def value(self) -> Answer | None:
        """The chosen words, if any."""
        return self.radio.value


class GuessControl:
    """What stands under a puzzle: its questions in short, a guess for each, then the answers."""

    def __init__(self, puzzle: Puzzle) -> None:
        self.puzzle = puzzle
        self.inputs = [
            NumberInput(q) if isinstance(q, Number) else ChoiceInput(q) for q in puzzle.questions
        ]
        self.button = widgets.Button(description="That is my guess", button_style="primary")
        self.look = widgets.Button(
            description="Show me",
            tooltip="See the answer without a guess; that is possible too",
        )
        self.answer = widgets.HTML()
        self.button.on_click(lambda _: self.take())
        self.look.on_click(lambda _: self.reveal(None, keep(puzzle, None)))
        self.buttons = widgets.HBox([self.button, self.look])
        self.widget = widgets.VBox(
            [*(each.widget for each in self.inputs), self.buttons, self.answer],
            layout={"max_width": "46em"},
        )
        self.widget.add_class(GUESS_CLASS)
        answered, guess = kept_guess(puzzle)
        if answered:
            self.reveal(guess, "" if guess is None else KEPT)
            self.widget.children = [self.answer]  # nobody has pressed a button

    @one_at_a_time
    def take(self) -> None:
        """Keep the guess that the controls show, and show the answer."""
        guess = [each.value for each in self.inputs]
        if None in guess:
            self.answer.value = f"<p role='alert'>{html.escape(UNANSWERED)}</p>"
            return
        self.reveal(guess, keep(self.puzzle, guess))  # type: ignore[arg-type]

    def reveal(self, guess: Sequence[Answer] | None, note: str) -> None:
        """Show the answers next to a guess, if there was one, and a note on whether it was kept."""
        self.answer.value = revealed(self.puzzle, guess, note)
        self.button.disabled = self.look.disabled = True
        # The answer takes the place of the questions. The buttons stay: one of them has the focus.
        self.widget.children = [self.buttons, self.answer]

    def __repr__(self) -> str:
        asks = " ".join(question.asks for question in self.puzzle.questions)
        return f"{FIRST} {asks}\n{HOW_TO_SEE}"

    def _repr_mimebundle_(self, **_: Any) -> dict[str, Any]:
        """The control, and for a page that is not live, the question without the answer."""
        first, how = html.escape(FIRST), html.escape(HOW_TO_SEE)
        asks = "".join(f"<li>{html.escape(q.asks)}</li>" for q in self.puzzle.questions)
        return {
            **widget_view(self.widget),
            "text/html": f"<p><b>{first}</b></p><ul>{asks}</ul><p>{how}</p>",
            "text/plain": repr(self),
        }


FIRST = "A guess first:"
HOW_TO_SEE = "Run this cell in JupyterLab to make your guess; then the answer appears here."


def _text(words: str) -> widgets.HTML:
    return widgets.HTML(f"<div style='{CLOSE}'>{html.escape(words)}</div>")
