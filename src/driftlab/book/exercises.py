"""The exercises of the book, which answer back: ``check("3.2", answer)``.

Each chapter's exercises are data in a module of their own: what is right, and what likely mistakes
lead to, both as computed by the package. `reading` takes an answer in any form, `answers` and
`formulas` judge it, `slips` finds the mistake that explains it, `sizes` says how far off it is,
and `card` shows all that, with the chapter's `hints`.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from functools import cache
from importlib.resources import files
from typing import Any

from .chapters import CHAPTERS, chapters_with, part_of
from .machinery.exercise.card import Card, HintCard, show
from .machinery.exercise.exercise import (
    KINDS,
    NOTHING_SAID,
    NUMBER,
    Exercise,
    NotRightError,
    Said,
    Verdict,
    is_missing,
)
from .machinery.exercise.given_numbers import Given
from .machinery.exercise.hints import NO_HELP, Help
from .machinery.exercise.progress import Progress
from .machinery.exercise.records import record_of

_OWN: dict[str, tuple[Exercise, Help]] = {}
"""Exercises that are not the book's, and the help with each."""

PROGRESS = Progress()
"""What has been answered since the kernel started."""


def all_exercises(chapter: str | None = None) -> dict[str, Exercise]:
    """Return the exercises of the book, or of one chapter, by number.

    Parameters
    ----------
    chapter : str, optional
        Its number, "01" to "18". Only that chapter's module is imported then.

    Notes
    -----
    Those that `add_exercise` has brought come last.
    """
    with_some = chapters_with("exercises")
    chapters = with_some if chapter is None else [chapter] if chapter in with_some else []
    found = {n: each for c in chapters for n, each in part_of(c, "exercises").EXERCISES.items()}
    own = {n: each for n, (each, _) in _OWN.items() if chapter in (None, _chapter(n))}
    return {**found, **own}


def add_exercise(number: str, exercise: Exercise, help_: Help = NO_HELP) -> None:
    """Add an exercise of your own, for `check`, `hint` and `verdict` in this kernel.

    Parameters
    ----------
    number : str
        As "90.1", or "3.3a" for one that follows 3.3; none of the book's. A number of your own
        that is there already gets the new exercise, so that a cell may run twice.
    exercise : Exercise
        `Value`, `Choice` or `Formula`.
    help_ : Help, optional
        What helps with it.

    Raises
    ------
    ValueError
        If the number is none, or the book's.

    Examples
    --------
    >>> from driftlab.book import add_exercise, check
    >>> from driftlab.book.machinery.exercise.answers import Value
    >>> slip = {"That is in radians.": lambda: 3.141592653589793}
    >>> half = Value(kind="compute", right=lambda: 180.0, unit="degrees", mistakes=slip)
    >>> add_exercise("90.1", half)
    >>> check("90.1", 3.1416)
    Exercise 90.1: not yet. That is in radians.
    """
    if not isinstance(number, str) or not NUMBER.fullmatch(number):
        raise ValueError(f'number: expected one like "90.1" or "3.3a", got {number!r}.')
    if not isinstance(exercise, Exercise):
        raise ValueError(f"exercise: expected an Exercise, got {type(exercise).__name__}.")
    if number not in _OWN and number in all_exercises():
        raise ValueError(f"number: expected one that the book has not, got {number!r}.")
    _OWN[number] = exercise, help_


@cache
def hints_of(chapter: str) -> dict[str, Help]:
    """Return the help with each exercise of a chapter, "01" to "18", by the exercise's number."""
    text = (files(__package__) / CHAPTERS[chapter] / "hints.toml").read_text("utf-8")
    return {number: Help(**each) for number, each in tomllib.loads(text).items()}


def check(
    number: str | float,
    answer: Any,
    *,
    because: str = "",
    student: str = "",
    strict: bool = False,
) -> None:
    """Show a card that says whether `answer` is right, and what may be wrong with it.

    Parameters
    ----------
    number : str
        The exercise's number, as in the text: "3.2" is the second one of chapter 03. A number
        without quotation marks will do, ``check(3.2, answer)``; but to Python 6.10 is 6.1.
    answer
        A number or an array in any form, a SymPy expression or a function, or the letters of the
        chosen statements, as the exercise asks. An exercise with a slider panel takes the panel as
        well. ``...`` stands for an answer that is still missing.
    because : str
        Why, in your own words. They are kept with the answer; among statements, the reply goes
        into what was chosen only for who has said why, in other words than of another choice.
    student : str
        The name with which `given` was asked for numbers of one's own.
    strict : bool
        Raise an error unless the answer is right, for programs that mark notebooks.

    Raises
    ------
    ValueError
        If there is no exercise of that number.
    NotRightError
        With `strict`, if the answer is wrong or missing; it is an AssertionError.

    Notes
    -----
    Outside a notebook the card is plain text. How many exercises of the chapter are right, and how
    many different answers there were to one, is counted since the kernel started, and the first
    guess at a "predict" exercise is kept as long, to be shown beside the answer.
    """
    card = judged(number, answer, PROGRESS, _said(because, student))
    show(card)
    if strict and not card.verdict.right:
        said = f"{card.record['word']}. {card.record['says']}".rstrip()
        raise NotRightError(f"Exercise {card.number}: {said}")


def judged(number: str | float, answer: Any, progress: Progress, said: Said = NOTHING_SAID) -> Card:
    """Return the card that `check` shows; `progress` is what was answered, and takes note of it."""
    name, exercise = _exercise(number)
    if isinstance(answer, Iterator):
        answer = list(answer)  # it gives its letters or numbers only once
    counted = progress.without_used_words(said, name, answer)
    is_said = counted == said
    found = exercise.verdict(answer, counted)
    progress.note(name, answer, found)
    chapter = _chapter(name)
    right, count = progress.of(all_exercises(chapter))
    attempts = progress.attempts(name)
    notes = [] if is_said else ["These are your words on another answer: why this one?"]
    if found.right and exercise.kind == "predict":
        notes.append(progress.guess_against(name, answer))
    if said.student and getattr(exercise, "given", None):
        notes.append(f"Judged with the numbers of {said.student}.")
    if not isinstance(number, str) and f"{name}0" in all_exercises(chapter):
        notes.append(f'This is {name}. For the tenth exercise write "{name}0", as text.')
    done = f"{right} of {count} right in chapter {chapter}"
    if attempts > 1:
        done = f"attempt {attempts}; {done}"
    record = record_of(name, answer, found, attempts, said)
    return Card(name, found, _help(name), tuple(notes), done, because=said.because, record=record)


def given(number: str | float, *, student: str = "") -> Given:
    """Return the numbers that an exercise gives: the book's, or some of your own.

    Parameters
    ----------
    number : str
        The exercise's number, as in `check`.
    student : str
        Your name, or what your teacher has agreed with you; capitals and blanks do not matter.
        The same name has the same numbers everywhere. Hand it to `check` as well.

    Returns
    -------
    mapping
        The numbers by name, in the units of the exercise; shown, the lines of code for them.

    Raises
    ------
    ValueError
        If there is no exercise of that number, or if all have the same numbers in it.

    Examples
    --------
    >>> from driftlab.book import given
    >>> given("5.1")
    # Exercise 5.1, the numbers of the book
    latitude = -33.9  # degrees
    table_rate = -20.0  # degrees a second
    >>> mine = given("5.1", student="Ada Lovelace")
    >>> mine["latitude"] == given("5.1", student="ada  lovelace")["latitude"]
    True
    """
    name, exercise = _exercise(number)
    numbers = getattr(exercise, "given", None)
    if numbers is None:
        there = [n for n, each in all_exercises().items() if getattr(each, "given", None)]
        raise ValueError(
            f"number: expected one of {', '.join(there)}, which can have numbers of one's own, "
            f"got {name!r}."
        )
    who = _said("", student).student
    whose = f"numbers of {who}" if who else "the numbers of the book"
    return Given(f"Exercise {name}, {whose}", numbers.numbers(who), numbers.units)


def hint(number: str | float) -> None:
    """Show one hint more than the last time: a nudge, then the idea, then the section that helps.

    Parameters
    ----------
    number : str
        The exercise's number, as in `check`.

    Raises
    ------
    ValueError
        If there is no exercise of that number, or no hint for it.
    """
    name, _ = _exercise(number)
    each = _help(name)
    if not each.is_there:
        raise ValueError(f"number: expected an exercise with hints; {name} has none.")
    show(HintCard(name, each, PROGRESS.next_rung(name, len(each.rungs) + bool(each.section))))


def verdict(number: str | float, answer: Any, *, because: str = "", student: str = "") -> Verdict:
    """Return what `check` says, and whether the answer is right; arguments as there.

    It counts among the attempts that `check` shows.
    """
    name, exercise = _exercise(number)
    said = PROGRESS.without_used_words(_said(because, student), name, answer)
    found = exercise.verdict(answer, said)
    PROGRESS.count(name, answer, found)
    return found


def _said(because: Any, student: Any) -> Said:
    """What came with an answer, as text; ``...`` stands for words that are still missing."""
    for name, text in (("because", because), ("student", student)):
        if not isinstance(text, str) and not is_missing(text):
            raise ValueError(f"{name}: expected text, got {type(text).__name__}.")
    words = ["" if is_missing(text) else " ".join(text.split()) for text in (because, student)]
    return Said(*words)


def _exercise(number: str | float) -> tuple[str, Exercise]:
    """The exercise of a number, and the number as text."""
    name = str(number) if isinstance(number, (str, float)) else ""
    known = all_exercises(_chapter(name)) or all_exercises()
    if name not in known:
        first, last = next(iter(known)), next(reversed(known))
        raise ValueError(f'number: expected "{first}" to "{last}", got {number!r}.')
    return name, known[name]


def _help(name: str) -> Help:
    """What helps with an exercise, the book's or one's own."""
    return _OWN[name][1] if name in _OWN else hints_of(_chapter(name))[name]


def _chapter(name: str) -> str:
    return name.split(".")[0].zfill(2)


def by_kind(kind: str) -> dict[str, Exercise]:
    """Return all exercises of one kind by number, for a teacher's lists.

    Parameters
    ----------
    kind : str
        "predict", "slide", "explain" or "compute".

    Raises
    ------
    ValueError
        If there is no such kind.
    """
    if kind not in KINDS:
        raise ValueError(f"kind: expected one of {', '.join(KINDS)}, got {kind!r}.")
    return {n: exercise for n, exercise in all_exercises().items() if exercise.kind == kind}
