"""Answers to exercises as the page's forms send them: the forms, and their judge."""

import json
import re
from contextlib import suppress
from copy import deepcopy

import numpy as np
import pytest
from answer_form import REACH

import forms
from driftlab.book.chapters import chapters_with
from driftlab.book.exercises import all_exercises
from driftlab.book.machinery.exercise.answers import Choice, Value, computed
from driftlab.book.machinery.exercise.exercise import key_of
from driftlab.book.machinery.exercise.formulas import Formula
from driftlab.book.machinery.exercise.reading import UnreadableError, numbers
from driftlab.book.puzzles import puzzle_of
from in_place import exercises
from wrong_answers import WRONG

EXERCISES = all_exercises()
FORMS = forms.exercise_forms()
NOTHING = {"right": {}, "guesses": {}, "tried": {}}
CODE = (
    "from driftlab.book.exercises import all_exercises\n"
    "from driftlab.book.machinery.exercise.exercise import key_of\n"
    "answer = {}"
)
SCHEME = "+180Y -90Y -180Z +90Z +180X"
"""Six positions that show all states."""


def typed(value) -> str:
    """Numbers as a reader types them into a line."""
    array = numbers(value)
    rows = [", ".join(f"{entry!r}" for entry in row.tolist()) for row in np.atleast_2d(array)]
    return "; ".join(rows)


def judged(number, way, given, **more):
    found = exercises.check(number, way, given, NOTHING, **more)
    assert found["says"].startswith(f"Exercise {number}: ")
    return found


def right_answer(number):
    exercise = EXERCISES[number]
    if isinstance(exercise, Choice):
        return "letters", "".join(sorted(key_of(exercise).right))
    if isinstance(exercise, Value):
        return "line", typed(computed(exercise)[0])
    source = (
        f"key_of(all_exercises()[{number!r}]).right"
        if isinstance(exercise, Formula)
        else repr(SCHEME)
    )
    return "code", CODE.format(source)


def wrong_answers(number):
    exercise = EXERCISES[number]
    if isinstance(exercise, Choice):
        return [("letters", letter) for letter in key_of(exercise).mistakes]
    if isinstance(exercise, Value):
        found = []
        for answer, _ in WRONG[number]:
            with suppress(UnreadableError):
                found.append(("line", typed(answer)))
        return found
    if isinstance(exercise, Formula):
        source = f"[*key_of(all_exercises()[{number!r}]).mistakes.values()][0]"
        return [("code", CODE.format(source))]
    return [("code", CODE.format("'+90X +90Y'"))]


@pytest.mark.parametrize("number", EXERCISES)
def test_a_right_answer_given_in_the_form_is_right_and_wrong_ones_are_not(number):
    form = FORMS[number]
    way, given = right_answer(number)
    assert form["way"] == way
    assert "answer = ..." in form.get("lines", "answer = ...")
    if way == "letters":
        assert form["letters"] == EXERCISES[number].letters
    found = judged(number, way, given)
    assert found["right"] is True, found["says"]
    assert found["progress"]["right"] == {number: True}
    assert "1 of " in found["card"]
    assert wrong_answers(number)
    for way, given in wrong_answers(number):
        found = judged(number, way, given)
        assert found["right"] is False, given
        assert "<details>" not in found["card"], "the page has the hints below the form"
    if "lines" in form:
        found = judged(number, "code", form["lines"])
        assert (found["right"], found["cell"]) == (None, None)


def test_the_forms_hold_nothing_of_the_answers(tmp_path):
    forms.write_forms(tmp_path)
    kept = json.loads((tmp_path / "exercises.json").read_text("utf-8"))
    puzzles = json.loads((tmp_path / "puzzles.json").read_text("utf-8"))
    assert kept["version"] == puzzles["version"]
    assert kept["exercises"].keys() == EXERCISES.keys()
    for form in kept["exercises"].values():
        assert form.keys() <= {"way", "letters", "panel", "lines"}
        assert form.get("letters", "") == "abcdefgh"[: len(form.get("letters", ""))]
    assert list(puzzles["puzzles"]) == chapters_with("puzzle")
    scale = {"unit", "low", "high", "start", "whole"}
    for chapter, puzzle in puzzles["puzzles"].items():
        assert puzzle["key"] == puzzle_of(chapter).key
        for question in puzzle["questions"]:
            assert question.keys() - {"asks"} in ({"options"}, scale)


@pytest.mark.parametrize(
    ("line", "value"),
    [
        ("180, 0, 0", (180, 0, 0)),
        (" 1.5 ", 1.5),
        ("−2e-3, 40°", (-0.002, 40)),
        ("answer = sqrt(4), 2^3", (2, 8)),
        ("1, 2; 3, 4", [[1, 2], [3, 4]]),
        ("", ...),
        (" ? ", ...),
        ("…", ...),
    ],
)
def test_a_line_of_numbers_is_read(line, value):
    assert exercises.read_line(line) == value


@pytest.mark.parametrize("line", ["forty", "1,5,", "1 2", "exit()", "import os", "1; 2, 3;x", "[1"])
def test_what_is_no_line_of_numbers_is_told(line):
    says = judged("3.4", "line", line)["says"]
    assert re.match(r"Exercise 3\.4: not (readable|yet)\. ", says)
    assert "\n" not in says


@pytest.mark.parametrize(
    ("number", "way", "given", "says"),
    [
        ("3.4", "line", "abc", r"Nothing is called abc here\. Type a number, .* as 2\*pi/3"),
        ("3.4", "line", "45 deg", r"This cannot be read as numbers\. Type a number"),
        ("3.4", "line", "1/0", r"could not be computed \(ZeroDivisionError: .*\)\. Type a number"),
        ("3.4", "line", "", "not answered yet. Type a number, "),
        ("3.3", "letters", "", "not answered yet. Tick the letters of all true statements"),
        ("3.4", "code", "answer = ...", "not answered yet. Put your answer in the place of the"),
    ],
)
def test_who_gives_no_answer_is_told_what_to_give(number, way, given, says):
    found = judged(number, way, given)
    assert re.search(says, found["says"])
    assert found["cell"] is None


def test_lines_run_alone_and_tell_what_they_print_and_where_they_stop():
    found = judged("3.4", "code", "x = 2\nprint('here')\nx + 1")
    assert found["right"] is None
    assert found["printed"] == "here\n3\n"
    found = judged("3.4", "code", "def f():\n    return y\nanswer = x\n")
    assert "raised NameError: name 'x' is not defined" in found["says"]
    assert found["printed"].startswith("Traceback (most recent call last):\n")
    assert "line 3" in found["printed"]
    assert "exercises.py" not in found["printed"]
    assert "SyntaxError" in judged("3.4", "code", "answer = (1,")["says"]
    assert "SystemExit" in judged("3.4", "code", "exit(1)")["says"]


def test_a_readers_own_words_are_kept_with_the_answer():
    words = "It turns 'both' ways,\n<b>so</b> it sees more."
    found = judged("3.3", "letters", "abd", because=words)
    assert "(b) forgets" in found["says"]
    assert "&lt;b&gt;so&lt;/b&gt;" in found["card"]
    assert found["record"]["because"] == " ".join(words.split())
    names = {}
    exec(found["cell"].replace("check(", "said = dict(").replace('"3.3", answer, ', ""), names)
    assert names["said"] == {"because": words}


def test_the_progress_is_the_pages():
    before = {
        "right": {"3.1": True, "3.2": False},
        "guesses": {"3.1": "5"},
        "tried": {"3.1": ["digest of 5"]},
    }
    kept = deepcopy(before)
    found = exercises.check("3.1", *right_answer("3.1"), before)
    assert "Your first guess was 5, the answer is" in found["says"]
    assert "1 of 6 right in chapter 03" in found["card"]
    assert "attempt 2; 1 of 6" in found["card"]
    assert found["record"]["attempt"] == len(found["progress"]["tried"]["3.1"]) == 2
    assert before == kept


def test_sympy_is_asked_for_where_an_answer_needs_it(monkeypatch):
    monkeypatch.setattr(exercises, "find_spec", lambda _: None)
    assert exercises.check("3.5", "code", "answer = 1", NOTHING) == {"needs": "sympy"}
    monkeypatch.setitem(__import__("sys").modules, "sympy", None)
    assert exercises.check("3.4", "code", "import sympy", NOTHING) == {"needs": "sympy"}
    assert judged("3.4", "code", "import nothing_of_this_name")["right"] is False


@pytest.mark.parametrize(
    ("number", "way", "given", "more"),
    [
        ("3.1", "line", "1, 1, −1, 0, 0, sqrt(1)/2", {}),
        ("3.2", "panel", REACH, {"panel": "DriftExplorer"}),
        ("3.3", "letters", "ad", {}),
        ("7.2", "line", "0, −40, 40; 40, 0, −40; −40, 40, 0", {}),
        ("8.5", "code", f"answer = {SCHEME!r}", {}),
    ],
)
def test_the_exported_cell_gives_the_same_answer(number, way, given, more, capsys):
    found = judged(number, way, given, **more)
    exec(found["cell"], {})
    assert found["right"] is True
    assert capsys.readouterr().out.startswith(f"Exercise {number}: right.")
