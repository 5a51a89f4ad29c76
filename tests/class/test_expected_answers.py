"""The list of a teacher: every exercise with what is right and what wrong answers are told."""

import numpy as np
import pytest

from driftlab.book import given
from driftlab.book.exercises import KINDS, all_exercises
from driftlab.book.instructors.expected_answers import expected, expected_answers, told
from driftlab.book.machinery.exercise.answers import Choice, Value
from driftlab.book.machinery.exercise.formulas import Formula
from driftlab.drift import earth_rate_offset

VALUE = Value(kind="compute", right=lambda: np.pi / 2, unit="radians", mistakes={"No.": float})
CHOICE = Choice(kind="explain", right="db", wrong={"a": "is false.", "c": "is too."})
FORMULA = Formula(kind="compute", arguments=("U", "phi"), draw=len, right=len)


def test_every_exercise_stands_in_the_list_of_its_kind():
    exercises = all_exercises()
    listed = [row[0] for kind in KINDS for row in expected_answers(kind).rows[1:]]
    assert sorted(listed) == sorted(exercises)
    assert all(expected(each) and told(each) for each in exercises.values())


def test_answers_are_words():
    assert expected(VALUE) == "1.57 radians"
    assert expected(CHOICE) == "b, d"
    assert expected(FORMULA) == "a formula in U, phi; see the solutions"
    assert told(VALUE) == ["No."]
    assert told(CHOICE) == ["(a) is false.", "(c) is too."]


@pytest.mark.parametrize("student", ["", "Ada Lovelace", "Ян"])
def test_answer_to_a_students_own_numbers(student):
    numbers = given("5.1", student=student)
    offset = earth_rate_offset(*np.radians([numbers["latitude"], numbers["table_rate"]]))
    answer = f"{np.degrees(offset) * 3600:.3g} arc seconds"
    rows = {row[0]: row for row in expected_answers("predict", student=student).rows}
    assert rows["5.1"][1] == answer
