"""Every exercise of the book: its mistakes are told apart, wrong answers get the right reason."""

import re
import subprocess
import sys
from functools import cache

import numpy as np
import pytest

from driftlab.book.exercises import KINDS, all_exercises, by_kind, check, verdict
from driftlab.book.machinery.answers import Choice, Formula, Value
from driftlab.book.machinery.reading import numbers
from wrong_answers import WRONG

EXERCISES = all_exercises()
VALUES = {n: e for n, e in EXERCISES.items() if isinstance(e, Value)}
FORMULAS = {n: e for n, e in EXERCISES.items() if isinstance(e, Formula)}


@cache
def replies(number):
    """What the book says to each of the wrong answers."""
    return [verdict(number, answer) for answer, _ in WRONG[number]]


def test_chapters_have_four_or_more_of_every_kind_in_order():
    chapters = {number.split(".")[0] for number in EXERCISES}
    assert chapters == {str(chapter) for chapter in range(1, 12)}
    for chapter in chapters:
        numbers_of = [n for n in EXERCISES if n.split(".")[0] == chapter]
        assert numbers_of == [f"{chapter}.{i}" for i in range(1, len(numbers_of) + 1)]
        assert len(numbers_of) >= 4
        assert {EXERCISES[n].kind for n in numbers_of} == set(KINDS)


@pytest.mark.parametrize("number", EXERCISES)
@pytest.mark.parametrize("answer", [..., None, "", "?", "...", [1.0, ...]])
def test_what_is_not_answered_is_neither_right_nor_wrong(number, answer):
    assert verdict(number, answer) == (None, "not answered yet.")


@pytest.mark.parametrize("number", EXERCISES)
def test_wrong_answer_is_refused_with_its_reason(number):
    assert WRONG.get(number), "no wrong answer to try"
    for (_, words), (right, says) in zip(WRONG[number], replies(number), strict=True):
        assert right is False
        assert re.search(words, says), says


@pytest.mark.parametrize("number", VALUES)
def test_right_value_passes_and_each_mistake_is_told_apart(number):
    exercise = VALUES[number]
    assert exercise.verdict(exercise.right()).right
    for says, value in exercise.mistakes.items():
        assert exercise.verdict(value()) == (False, f"not yet. {says}")


@pytest.mark.parametrize("number", FORMULAS)
def test_right_formula_passes_and_each_mistake_is_told_apart(number):
    exercise = FORMULAS[number]
    assert exercise.verdict(exercise.right).right
    for says, function in exercise.mistakes.items():
        assert exercise.verdict(function) == (False, f"not yet. {says}")


@pytest.mark.parametrize("number", VALUES)
def test_no_wrong_answer_is_told_the_right_one(number):
    exercise = VALUES[number]
    right = {f"{entry:.3g}" for entry in np.abs(numbers(exercise.right())).flat if entry > 0.1}
    said = " ".join(reply.says for reply in replies(number))
    assert not right & set(re.findall(r"\d+\.?\d*", said))


@pytest.mark.parametrize("number", [n for n, e in EXERCISES.items() if isinstance(e, Choice)])
def test_choice_names_what_is_wrong_with_every_other_statement(number):
    exercise = EXERCISES[number]
    letters = "".join(sorted({*exercise.right, *exercise.wrong}))
    assert letters == "abcdefgh"[: len(letters)]
    assert not set(exercise.right) & set(exercise.wrong)
    assert exercise.verdict(exercise.right).right
    for letter, reason in exercise.wrong.items():
        assert exercise.verdict(exercise.right + letter) == (False, f"not yet. ({letter}) {reason}")


def test_importing_the_exercises_loads_no_plotting():
    code = (
        "import sys; from driftlab.book.exercises import all_exercises; all_exercises(); "
        "print('matplotlib' in sys.modules)"
    )
    command = [sys.executable, "-c", code]
    answer = subprocess.run(command, capture_output=True, text=True, check=True)
    assert answer.stdout.strip() == "False"


def test_check_prints_one_line_and_refuses_an_unknown_number(capsys):
    check("1.3", "bce")
    assert capsys.readouterr().out.startswith("Exercise 1.3: right. ")
    with pytest.raises(ValueError, match=r'^number: expected "1\.1" to "11\.\d", got \'x\''):
        check("x", 1)
    with pytest.raises(ValueError, match=r'^number: expected "1\.1" to "1\.5", got '):
        check("1.6", 1)


def test_lists_for_teachers_have_every_exercise_with_its_answer_and_its_mistakes():
    assert sorted(n for kind in KINDS for n in by_kind(kind)) == sorted(EXERCISES)
    assert by_kind("predict")["1.1"].expected() == "180, 0, 0 degrees"
    assert all(exercise.expected() and exercise.feedback() for exercise in EXERCISES.values())
    with pytest.raises(ValueError, match=r"^kind: expected one of predict, .*, got 'guess'"):
        by_kind("guess")
