"""The slips that anyone makes anywhere: whatever the exercise, none gets a bare "not yet"."""

import re
from collections.abc import Iterator
from itertools import permutations

import numpy as np

from driftlab.book.exercises import all_exercises
from driftlab.book.machinery.exercise.answers import Choice, Value, computed
from driftlab.book.machinery.exercise.exercise import key_of
from driftlab.book.machinery.exercise.formulas import Formula
from driftlab.book.machinery.exercise.reading import numbers

EXERCISES = all_exercises()


def of_numbers(right: np.ndarray) -> Iterator[np.ndarray]:
    """Wrong answers made of the right one without knowing what it means."""
    yield from (-right, 2 * right, right / 2, 0 * right, 3.7 * right, 0.3 * right)
    yield from (1e3 * right, 1e-6 * right, np.degrees(right), np.radians(right))
    yield from (right + 1, right - 1, 90 - right, 180 - right, 360 - right, 1 - right)
    with np.errstate(divide="ignore"):
        yield 1 / right
    if right.ndim == 0:
        return
    yield from (right[::-1], np.roll(right, 1), right.T)
    for part in range(right.size):
        for factor in (-1, 2, 1.3):
            wrong = np.array(right)
            wrong.flat[part] = factor * wrong.flat[part] + 0.3 * np.abs(right).max()
            yield wrong


def of_formula(right):
    """The same for a formula; the functions take its arguments."""
    yield from (lambda *a: -numbers(right(*a)), lambda *a: 2 * numbers(right(*a)))
    yield from (lambda *a: numbers(right(*a)) ** 2, lambda *a: numbers(right(*a)) + 1)
    yield lambda *a: right(*(np.asarray(x) * 2 for x in a))
    yield lambda *a: right(*a[::-1])
    yield lambda *a: np.sin(numbers(right(*a)))


def said_of(number: str) -> list[str]:
    exercise = EXERCISES[number]
    if isinstance(exercise, Choice):
        letters = exercise.letters
        answers = ["".join(each) for n in (1, 2) for each in permutations(letters, n)]
    elif isinstance(exercise, Value):
        answers = [a for a in of_numbers(computed(exercise)[0]) if np.isfinite(a).all()]
    elif isinstance(exercise, Formula):
        answers = list(of_formula(key_of(exercise).right))
    else:
        answers = ["", "+90X"]
    found = [exercise.verdict(answer) for answer in answers]
    return [each.says for each in found if each.right is False]


def test_natural_slip_is_told_more_than_that_it_is_wrong():
    for number, exercise in EXERCISES.items():
        says = said_of(number)
        assert says, number
        for each in says:
            kind, _, reason = each.partition(". ")
            assert kind in ("not yet", "not readable"), (number, each)
            assert len(reason) > 8, (number, each)
        if isinstance(exercise, Value):
            right = {f"{entry:.3g}" for entry in np.abs(computed(exercise)[0]).flat if entry > 0.1}
            own = {f"not yet. {m}" for m in key_of(exercise).mistakes}
            told = " ".join(each for each in says if each not in own)
            assert not right & set(re.findall(r"\d+\.?\d*", told)), number
