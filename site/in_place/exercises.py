"""Judges the answers that a reader types in the page; the worker calls `check`."""

from __future__ import annotations

import ast
import io
import linecache
import re
import traceback
from collections.abc import Callable
from contextlib import redirect_stderr, redirect_stdout
from copy import deepcopy
from dataclasses import replace
from importlib.util import find_spec
from types import SimpleNamespace
from typing import Any

import numpy as np

from driftlab.book.exercises import all_exercises, hints_of, judged
from driftlab.book.machinery.exercise.card import Card
from driftlab.book.machinery.exercise.exercise import Said, Verdict
from driftlab.book.machinery.exercise.formulas import Formula
from driftlab.book.machinery.exercise.progress import Progress
from driftlab.book.machinery.exercise.reading import UnreadableError

LATE = "sympy"
"""The package that comes only when it is asked for."""
KEPT = ("right", "guesses", "tried")
"""What a page keeps of a `Progress`."""
JUDGED = ("right", "not yet")
"""Words of a verdict on an answer that could be read."""
YOURS = "<your lines>"
"""What a traceback calls the lines of an answer."""
HOW = {
    "letters": "Tick the letters of all true statements, then press Check.",
    "line": (
        "Type a number, as 1.5 or 2e-3, or an expression, as 2*pi/3; commas stand between "
        "several, semicolons between rows."
    ),
    "code": "Put your answer in the place of the three dots: it is what your lines call answer.",
}
"""What to do, said to who has given no answer yet, by the way; a line that is no number is told
the same."""
SIGNS = str.maketrans({"−": "-", "·": "*", "×": "*", "π": "pi", "°": "", "′": "", "″": ""})
"""Signs of a typed line that Python does not know; units are those that the exercise asks for."""


def check(
    number: str,
    way: str,
    given: Any,
    progress: dict[str, Any],
    panel: str = "",
    because: str = "",
) -> dict[str, Any]:
    """Judge an answer, given in one of `WAYS`: what was typed or chosen, or the values of a panel.

    Return the card in HTML, what it says as text, the verdict (true, false or null), what the lines
    of the answer printed, the cell of a notebook that gives the same answer (None if there is none
    that could be judged), the record that such a cell leaves, and the progress from now on. Or
    "needs": a package without which the answer cannot be judged.
    """
    kept = Progress(**{name: deepcopy(progress[name]) for name in KEPT})
    printed = io.StringIO()
    try:
        with redirect_stdout(printed), redirect_stderr(printed):
            card = _judged(number, way, given, kept, Said(because=" ".join(because.split())))
    except ModuleNotFoundError as error:
        if error.name != LATE:
            raise
        return {"needs": LATE}
    return {
        "card": card.boxed(hints=False),  # they stand below the form
        "says": repr(card),
        "right": card.verdict.right,
        "printed": printed.getvalue(),
        "cell": _cell(number, way, given, panel, because) if card.verdict.word in JUDGED else None,
        "record": dict(card.record),
        "progress": {name: getattr(kept, name) for name in KEPT},
    }


def _judged(number: str, way: str, given: Any, kept: Progress, said: Said) -> Card:
    chapter = number.split(".")[0].zfill(2)
    # A formula may be compared with SymPy, which reading an answer must not be blamed for.
    if isinstance(all_exercises(chapter)[number], Formula) and not find_spec(LATE):
        raise ModuleNotFoundError(name=LATE)
    try:
        answer = WAYS[way](given)
    except UnreadableError as error:
        verdict = Verdict(False, f"not readable. {error}")
        return Card(number, verdict, hints_of(chapter)[number])
    card = judged(number, answer, kept, said)
    if card.verdict.right is None and way in HOW:
        return replace(card, verdict=Verdict(None, f"{card.verdict.says} {HOW[way]}"))
    return card


def read_line(text: str) -> Any:
    """Read a line of numbers: with commas between them, and semicolons between rows."""
    try:
        return eval(compile(in_python(text), YOURS, "eval"), {**vars(np), "np": np})
    except NameError as error:
        raise UnreadableError(f"Nothing is called {error.name} here. {HOW['line']}") from None
    except SyntaxError:
        raise UnreadableError(f"This cannot be read as numbers. {HOW['line']}") from None
    except (Exception, SystemExit) as error:
        says = f"This could not be computed ({type(error).__name__}: {error})."
        raise UnreadableError(f"{says} {HOW['line']}") from None


def in_python(text: str) -> str:
    """Return a typed line as Python has it; `...` where nothing was typed."""
    text = re.sub(r"^\s*answer\s*=", "", text.translate(SIGNS)).replace("^", "**").strip(" ;,")
    if not text.strip(" ?.…"):
        return "..."
    rows = [row.strip() for row in text.split(";")]
    return rows[0] if len(rows) == 1 else f"[{', '.join(f'[{row}]' for row in rows)}]"


def run(code: str) -> Any:
    """Run the lines of an answer in a fresh namespace, and return what they call `answer`.

    The value of a last expression is printed, as in a notebook.
    """
    names: dict[str, Any] = {"__name__": "__main__", "answer": ...}
    # So that a traceback shows the lines.
    linecache.cache[YOURS] = len(code), None, code.splitlines(keepends=True), YOURS
    try:
        tree = ast.parse(code, YOURS)
        shown = None
        if tree.body and isinstance(last := tree.body[-1], ast.Expr):
            shown = ast.Expression(last.value)
            del tree.body[-1]
        exec(compile(tree, YOURS, "exec"), names)
        value = shown and eval(compile(shown, YOURS, "eval"), names)
        if value is not None:
            print(repr(value))
    except (Exception, SystemExit) as error:
        if isinstance(error, ModuleNotFoundError) and error.name == LATE:
            raise
        print(_own_part(error))
        says = f"Your answer raised {type(error).__name__}: {error}"
        raise UnreadableError(says) from None
    return names["answer"]


def _own_part(error: BaseException) -> str:
    """The traceback from the first of the answer's own lines on."""
    place = error.__traceback__
    while place and place.tb_frame.f_code.co_filename != YOURS:
        place = place.tb_next
    return "".join(traceback.format_exception(type(error), error, place))


def _cell(number: str, way: str, given: Any, panel: str, because: str) -> str:
    """The lines of a notebook's cell that give the same answer."""
    if way == "code":
        lines = given
    elif way == "panel":
        values = ", ".join(f"{name}={value!r}" for name, value in given.items())
        lines = f"from driftlab.book import {panel}\n\nanswer = {panel}()\nanswer.set({values})"
    else:
        typed = repr(given) if way == "letters" else in_python(given)
        # What functions a line may use; a cell of letters needs none.
        lines = f"from numpy import *\n\nanswer = {typed}" if "(" in typed else f"answer = {typed}"
    why = f", because={because!r}" if because else ""
    return f'from driftlab.book import check\n{lines}\n\ncheck("{number}", answer{why})'


WAYS: dict[str, Callable[[Any], Any]] = {
    "letters": str,
    "line": read_line,
    "code": run,
    "panel": lambda values: SimpleNamespace(values=values),
}
