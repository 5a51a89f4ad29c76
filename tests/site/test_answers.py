"""Exercises and puzzles that answer in the page: their forms, their judge, and in a browser."""

import html
import json
import re
from contextlib import suppress

import numpy as np
import pytest

import forms
from driftlab.book import class_summary
from driftlab.book.chapters import CHAPTERS, chapters_with
from driftlab.book.exercises import all_exercises, hints_of
from driftlab.book.machinery.answers import Choice, Value
from driftlab.book.machinery.formulas import Formula
from driftlab.book.machinery.reading import UnreadableError, numbers
from driftlab.book.puzzles import puzzle_of
from in_place import exercises, guesses
from wrong_answers import WRONG

EXERCISES = all_exercises()
FORMS = forms.exercise_forms()
NOTHING = {"right": {}, "guesses": {}}
CODE = "from driftlab.book.exercises import all_exercises\nanswer = {}"
SCHEME = "+180Y -90Y -180Z +90Z +180X"
"""Six positions that show all states."""
PATIENCE = 240_000
"""Milliseconds that Python may take to come on a busy machine."""


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
        return "letters", exercise.right
    if isinstance(exercise, Value):
        return "line", typed(exercise.right())
    source = f"all_exercises()[{number!r}].right" if isinstance(exercise, Formula) else repr(SCHEME)
    return "code", CODE.format(source)


def wrong_answers(number):
    exercise = EXERCISES[number]
    if isinstance(exercise, Choice):
        return [("letters", letter) for letter in exercise.wrong]
    if isinstance(exercise, Value):
        found = []
        for answer, _ in WRONG[number]:
            with suppress(UnreadableError):
                found.append(("line", typed(answer)))
        return found
    if isinstance(exercise, Formula):
        source = f"[*all_exercises()[{number!r}].mistakes.values()][0]"
        return [("code", CODE.format(source))]
    return [("code", CODE.format("'+90X +90Y'"))]


@pytest.mark.parametrize("number", EXERCISES)
def test_a_right_answer_given_in_the_form_is_right_and_wrong_ones_are_not(number):
    form = FORMS[number]
    way, given = right_answer(number)
    assert form["way"] == way
    assert "answer = ..." in form.get("lines", "answer = ...")
    if way == "letters":
        assert {*form["letters"]} == {*EXERCISES[number].right, *EXERCISES[number].wrong}
    found = judged(number, way, given)
    assert found["right"] is True, found["says"]
    assert found["progress"]["right"] == {number: True}
    assert "1 of " in found["card"]
    assert wrong_answers(number)
    for way, given in wrong_answers(number):
        found = judged(number, way, given)
        assert found["right"] is False, given
        assert "<details>" in found["card"]
    if "lines" in form:
        assert judged(number, "code", form["lines"])["right"] is None


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


def test_the_progress_is_the_pages():
    before = {"right": {"3.1": True, "3.2": False}, "guesses": {"3.1": "5"}}
    found = exercises.check("3.1", *right_answer("3.1"), before)
    assert "Your first guess was 5, the answer is" in found["says"]
    assert "1 of 6 right in chapter 03" in found["card"]
    assert before == {"right": {"3.1": True, "3.2": False}, "guesses": {"3.1": "5"}}


def test_sympy_is_asked_for_where_an_answer_needs_it(monkeypatch):
    monkeypatch.setattr(exercises, "find_spec", lambda _: None)
    assert exercises.check("3.5", "code", "answer = 1", NOTHING) == {"needs": "sympy"}
    monkeypatch.setitem(__import__("sys").modules, "sympy", None)
    assert exercises.check("3.4", "code", "import sympy", NOTHING) == {"needs": "sympy"}
    assert judged("3.4", "code", "import nothing_of_this_name")["right"] is False


REACH = {f"m{i}{j}": 2 for i in (1, 2, 3) for j in (1, 2, 3)} | {"azimuth": 45, "elevation": 35}


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


def test_guesses_are_answered_and_looked_back_at():
    shown = guesses.reveal("03", ["the first", 100.0], "Kept.")
    assert "That is what you guessed." in shown
    assert "Kept." in shown
    assert "You looked without a guess" in guesses.reveal("03", None, "")
    keys = [puzzle_of("03").key, puzzle_of("05").key]
    table = guesses.look_back({keys[0]: ["the first", 100.0], keys[1]: ["out of date"]})
    assert table.count("<tr>") == 3
    assert "No guess is kept yet" in guesses.look_back({keys[0]: None})


def bare(words):
    return re.sub(r"[\W_]", "", html.unescape(re.sub("<.*?>", "", words)).lower())


def test_every_section_that_helps_is_a_heading_of_its_page(site):
    for chapter in chapters_with("exercises"):
        page = (site / f"{CHAPTERS[chapter][2:]}.html").read_text("utf-8")
        headings = {bare(each) for each in re.findall(r"<h[234]>(.*?)<a class=\"headerlink", page)}
        for number, each in hints_of(chapter).items():
            assert bare(each.section) in headings, number
        assert set(re.findall(r'data-exercise="([\d.]+)"', page)) == set(all_exercises(chapter))


class Form:
    """One exercise in the page."""

    def __init__(self, page, number):
        self.part = page.locator(f'div.exercise[data-exercise="{number}"]')

    def button(self, name):
        return self.part.get_by_role("button", name=name)

    def expect(self, verdict):
        card = self.part.locator(f'.answer-card[data-verdict="{verdict}"] > [role=status]')
        card.wait_for(timeout=PATIENCE)
        return card.inner_text()

    def line(self, text):
        self.part.get_by_role("textbox").first.fill(text)
        self.part.get_by_role("textbox").first.press("Enter")

    def letters(self, chosen):
        for box in self.part.get_by_role("checkbox").all():
            box.set_checked(box.get_attribute("value") in chosen)
        self.button("Check").click()

    def python(self, lines):
        area = self.part.locator("textarea")
        if not area.is_visible():
            self.part.get_by_text("Compute it in Python").click()
        area.fill(lines)
        area.press("Shift+Enter")


@pytest.mark.browser
@pytest.mark.xdist_group("site-answers")
def test_exercises_of_each_kind_answer_in_the_page_and_are_kept(page, address, tmp_path):
    chapter = f"{address}/03_systematic_drift.html"
    page.goto(chapter)
    numbers, panel, letters, computed, formula = (Form(page, f"3.{i}") for i in range(1, 6))
    export = page.get_by_role("button", name="Export my answers")
    export.wait_for()
    assert export.is_disabled()
    numbers.line("1, 1, 1, 0, 0, 0.5")
    assert "0 of 6 right in chapter 03" in numbers.expect("false")
    numbers.part.get_by_text("A nudge").click()
    assert numbers.part.get_by_text("Begin with the axes of the gyros").is_visible()
    target = numbers.part.get_by_role("link").get_attribute("href")
    assert page.locator(target).get_by_role("heading", name="Only the symmetric").count() == 1
    numbers.line("1, 1, −1, 0, 0, 1/2")
    assert "Your first guess was" in numbers.expect("true")

    figure = page.locator('figure.driftlab-still[data-panel="DriftExplorer"]').last
    panel.button("Check the panel as it stands").click()
    panel.expect("false")
    assert page.evaluate("document.activeElement.textContent") == "Check the panel as it stands"
    figure.evaluate("(figure, values) => (figure.dataset.values = JSON.stringify(values))", REACH)
    panel.button("Check the panel as it stands").click()
    assert "2 of 6 right" in panel.expect("true")

    letters.letters("ab")
    assert "(b) forgets" in letters.expect("false")
    letters.letters("ad")
    letters.expect("true")

    computed.python("while True:\n    pass")
    computed.button("Stop").click()
    computed.part.get_by_text("Stopped. What you typed is still here.").wait_for()
    assert page.evaluate("document.activeElement.textContent") == "Run and check"
    computed.python("print('as if')\nanswer = [0, 0, 0]")
    computed.expect("false")
    assert computed.part.locator("pre").inner_text() == "as if\n"

    # An answer of SymPy brings SymPy.
    formula.python("import sympy\nanswer = sympy.Symbol('x')")
    assert "found also x" in formula.expect("false")
    formula.python(
        "import numpy as np\n\ndef answer(M):\n"
        "    return 2 * np.pi * np.linalg.eigvalsh((M + M.T) / 2)[-1]\n"
    )
    assert "4 of 6 right" in formula.expect("true")

    with page.expect_download() as download:
        export.click()
    download.value.save_as(tmp_path / "answers.ipynb")
    counts = class_summary(tmp_path).counts
    assert {number: set(each) for number, each in counts.items()} == {
        "3.1": {"right"}, "3.2": {"right"}, "3.3": {"right"}, "3.4": {"wrong"}, "3.5": {"right"},
    }  # fmt: skip

    page.reload()
    numbers.part.get_by_text("when you last checked it").wait_for()
    assert numbers.part.get_by_role("textbox").first.input_value() == "1, 1, −1, 0, 0, 1/2"
    assert letters.part.get_by_role("checkbox", checked=True).count() == 2
    assert "as if" in computed.part.locator("textarea").input_value()
    assert page.complaints == []


@pytest.mark.browser
@pytest.mark.xdist_group("site-answers")
def test_a_puzzle_is_guessed_answered_and_remembered(page, address):
    page.goto(f"{address}/03_systematic_drift.html")
    puzzle = page.locator('div.guess[data-guess="03"]')
    puzzle.get_by_role("button", name="That is my guess").click()
    puzzle.get_by_text("Then it is a guess.").wait_for()
    puzzle.get_by_label("the second").check()
    slider = puzzle.get_by_role("slider")
    slider.press("End")
    assert puzzle.get_by_role("spinbutton").input_value() == "100000"
    puzzle.get_by_role("spinbutton").fill("10")
    assert slider.get_attribute("aria-valuetext") == "10 times"
    puzzle.get_by_role("button", name="That is my guess").click()
    puzzle.get_by_role("alert").wait_for(timeout=PATIENCE)
    assert "You guessed: the second." in puzzle.inner_text()
    assert puzzle.get_by_role("img").count() == 1
    page.reload()
    puzzle.get_by_role("button", name="Show the answer").wait_for()
    assert "Your guess: the second" in puzzle.inner_text()
    assert page.complaints == []


SOUND = {"typed": {"letters": "ad"}, "cell": "answer = 'ad'", "says": "right.", "right": True}
BROKEN = {
    "3.1": {"typed": {"line": None}},
    "3.2": None,
    "3.3": {"typed": {"letters": 5}},
    "3.4": {"typed": "x", "cell": 5},
    "3.5": [5],
}


@pytest.mark.browser
@pytest.mark.xdist_group("site-answers")
@pytest.mark.parametrize(
    ("kept", "answered"),
    [
        (None, 0),
        ({"exercises": None, "guesses": "5"}, 0),
        ({"exercises": BROKEN, "guesses": {puzzle_of("03").key: 5}}, 0),
        ({"exercises": {**BROKEN, "3.3": SOUND}}, 1),
    ],
)
def test_what_the_page_did_not_write_takes_no_form_away(page, address, site, kept, answered):
    version = json.loads((site / "in_place/exercises.json").read_text("utf-8"))["version"]
    name = f"Drift Lab {version}: answers"
    page.add_init_script(f"localStorage[{json.dumps(name)}] = {json.dumps(json.dumps(kept))}")
    page.goto(f"{address}/03_systematic_drift.html")
    page.get_by_role("button", name="Export my answers").wait_for()
    page.locator('div.guess[data-guess="03"] form').wait_for()
    assert page.locator("div.exercise form").count() == len(all_exercises("03"))
    assert page.get_by_text("you have answered 1 of").count() == answered
    boxes = Form(page, "3.3").part.get_by_role("checkbox")
    assert [box.is_checked() for box in boxes.all()].count(True) == 2 * answered
    boxes.nth(1).check()
    written = page.evaluate("(name) => JSON.parse(localStorage[name])", name)
    assert "b" in written["exercises"]["3.3"]["typed"]["letters"]
    assert page.complaints == []


@pytest.mark.browser
@pytest.mark.xdist_group("site-answers")
def test_a_browser_that_keeps_nothing_is_told_so(page, address):
    page.add_init_script(
        "Object.defineProperty(window, 'localStorage', "
        "{ get() { throw new DOMException('no', 'SecurityError'); } })"
    )
    page.goto(f"{address}/03_systematic_drift.html")
    page.get_by_text("does not let the page keep anything").wait_for()
    Form(page, "3.3").part.get_by_role("checkbox").first.check()
    page.set_viewport_size({"width": 390, "height": 800})
    assert page.evaluate("document.documentElement.scrollWidth - innerWidth") <= 0
