"""Answers to exercises as the page's forms send them: the forms, and their judge."""

import json
import re
from copy import deepcopy

import pytest
from answer_form import FORMULA, REACH

import forms
from driftlab.book.chapters import chapters_with
from driftlab.book.exercises import all_exercises
from driftlab.book.machinery.exercise.answers import Choice, Value
from driftlab.book.puzzles import puzzle_of
from in_place import exercises

pytestmark = pytest.mark.xdist_group("site")
EXERCISES = all_exercises()
NOTHING = {"right": {}, "guesses": {}, "tried": {}}
RIGHT = {
    "3.1": ("line", "1, 1, −1, 0, 0, sqrt(1)/2", "1, 1, 1, 0, 0, 0.5"),
    "3.2": ("panel", REACH, {**REACH, "azimuth": 90, "elevation": 0}),
    "3.3": ("letters", "ad", "ab"),
    "3.5": ("code", FORMULA, FORMULA.replace("[-1]", "[0]")),
    "10.2": ("line", "0, −40, 40; 40, 0, −40; −40, 40, 0", "0, 40; −40, 0"),
    "11.4": ("code", "answer = '+180Y -90Y -180Z +90Z +180X'", "answer = '+90X +90Y'"),
}
"""Of each way: what is right, and what is not."""


def judged(number, way, given, **more):
    found = exercises.check(number, way, given, NOTHING, **more)
    assert found["says"].startswith(f"Exercise {number}: ")
    return found


@pytest.mark.parametrize("number", RIGHT)
def test_an_answer_is_judged_and_its_exported_cell_gives_the_same(number, capsys):
    way, given, wrong = RIGHT[number]
    panel = {"panel": "DriftExplorer"} if way == "panel" else {}
    found = judged(number, way, given, **panel)
    assert found["right"] is True, found["says"]
    assert found["progress"]["right"] == {number: True}
    assert "1 of " in found["card"]
    exec(found["cell"], {})
    assert capsys.readouterr().out.startswith(f"Exercise {number}: right.")
    found = judged(number, way, wrong, **panel)
    assert found["right"] is False, found["says"]
    assert "<details>" not in found["card"], "the page has the hints below the form"


def test_every_exercise_has_its_form_which_holds_nothing_of_the_answer(tmp_path):
    forms.write_forms(tmp_path)
    kept = json.loads((tmp_path / "exercises.json").read_text("utf-8"))
    puzzles = json.loads((tmp_path / "puzzles.json").read_text("utf-8"))
    assert kept["version"] == puzzles["version"]
    assert kept["exercises"].keys() == EXERCISES.keys()
    for number, form in kept["exercises"].items():
        assert form.keys() <= {"way", "letters", "panel", "lines"}
        if isinstance(exercise := EXERCISES[number], Choice):
            assert (form["way"], form["letters"]) == ("letters", exercise.letters)
        elif isinstance(exercise, Value):
            assert form["way"] == "line"
        else:
            assert form["way"] == "code"
        if "lines" in form:
            assert "answer = ..." in form["lines"]
            found = judged(number, "code", form["lines"])
            assert (found["right"], found["cell"]) == (None, None), "not answered yet"
    assert list(puzzles["puzzles"]) == chapters_with("puzzle")
    scale = {"unit", "low", "high", "start", "whole"}
    for chapter, puzzle in puzzles["puzzles"].items():
        assert puzzle["key"] == puzzle_of(chapter).key
        for question in puzzle["questions"]:
            assert question.keys() - {"asks"} in ({"options"}, scale)


def test_a_line_of_numbers_is_read():
    for line, value in {
        "180, 0, 0": (180, 0, 0),
        "−2e-3, 40°": (-0.002, 40),
        "answer = sqrt(4), 2^3": (2, 8),
        "1, 2; 3, 4": [[1, 2], [3, 4]],
        " ? ": ...,
    }.items():
        assert exercises.read_line(line) == value
    for line in ("forty", "1,5,", "1 2", "exit()", "import os", "1; 2, 3;x", "[1"):
        says = judged("3.4", "line", line)["says"]
        assert re.match(r"Exercise 3\.4: not (readable|yet)\. .*$", says)


@pytest.mark.parametrize(
    ("number", "way", "given", "says"),
    [
        ("3.4", "line", "abc", r"Nothing is called abc here\. Type a number, .* as 2\*pi/3"),
        ("3.4", "line", "1/0", r"could not be computed \(ZeroDivisionError: .*\)\. Type a number"),
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
    assert (found["right"], found["printed"]) == (None, "here\n3\n")
    found = judged("3.4", "code", "def f():\n    return y\nanswer = x\n")
    assert "raised NameError: name 'x' is not defined" in found["says"]
    assert found["printed"].startswith("Traceback (most recent call last):\n")
    assert "line 3" in found["printed"]
    assert "exercises.py" not in found["printed"]
    assert "SyntaxError" in judged("3.4", "code", "answer = (1,")["says"]
    assert "SystemExit" in judged("3.4", "code", "exit(1)")["says"]


def test_a_readers_own_words_and_progress_are_kept():
    words = "It turns 'both' ways,\n<b>so</b> it sees more."
    found = judged("3.3", "letters", "abd", because=words)
    assert "&lt;b&gt;so&lt;/b&gt;" in found["card"]
    assert found["record"]["because"] == " ".join(words.split())
    names = {}
    exec(found["cell"].replace("check(", "said = dict(").replace('"3.3", answer, ', ""), names)
    assert names["said"] == {"because": words}
    before = {
        "right": {"3.1": True, "3.2": False},
        "guesses": {"3.1": "5"},
        "tried": {"3.1": ["digest of 5"]},
    }
    kept = deepcopy(before)
    found = exercises.check("3.1", *RIGHT["3.1"][:2], before)
    assert "Your first guess was 5, the answer is" in found["says"]
    assert "attempt 2; 1 of 6 right in chapter 03" in found["card"]
    assert before == kept


def test_sympy_is_asked_for_where_an_answer_needs_it(monkeypatch):
    monkeypatch.setattr(exercises, "find_spec", lambda _: None)
    assert exercises.check("3.5", "code", "answer = 1", NOTHING) == {"needs": "sympy"}
    monkeypatch.setitem(__import__("sys").modules, "sympy", None)
    assert exercises.check("3.4", "code", "import sympy", NOTHING) == {"needs": "sympy"}
    assert judged("3.4", "code", "import nothing_of_this_name")["right"] is False
