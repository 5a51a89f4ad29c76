"""Exercises and puzzles that answer in the page: one of each kind; what is kept and exported."""

import json
import re

import nbformat
import pytest
from answer_form import FORMULA, REACH, Form
from lively import PATIENCE

import driftlab
from driftlab.book.exercises import all_exercises
from driftlab.book.puzzles import puzzle_of
from in_place import guesses

browser = pytest.mark.browser
pytestmark = pytest.mark.xdist_group("site-answers")
NAME = f"Drift Lab {driftlab.__version__}: answers"


def test_guesses_are_answered_and_looked_back_at():
    shown = guesses.reveal("03", ["the first", 100.0], "Kept.")
    assert "That is what you guessed." in shown
    assert "Kept." in shown
    assert "You looked without a guess" in guesses.reveal("03", None, "")
    keys = [puzzle_of("03").key, puzzle_of("06").key]
    table = guesses.look_back({keys[0]: ["the first", 100.0], keys[1]: ["out of date"]})
    assert table.count("<tr>") == 3
    assert "No guess is kept yet" in guesses.look_back({keys[0]: None})


def overlap(a, b):
    return all(
        a[low] < b[low] + b[size] and b[low] < a[low] + a[size]
        for low, size in (("x", "width"), ("y", "height"))
    )


def guess(puzzle) -> None:
    """Guess in the page, and look at the answer."""
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
    scale = puzzle.get_by_role("img")
    diamonds = [each.bounding_box() for each in scale.locator("div[style*='rotate']").all()]
    words = [each.bounding_box() for each in scale.locator("small").all()]
    assert len(diamonds) == 2
    assert len(words) > 3
    assert not [(a, b) for a in diamonds for b in words if overlap(a, b)]


@browser
def test_answers_of_each_kind_are_judged_in_the_page_kept_and_exported(page, address, packages):
    chapter = f"{address}/03_systematic_drift.html"
    page.goto(chapter)
    puzzle = page.locator('div.guess[data-guess="03"]')
    guess(puzzle)
    numbers, panel, letters, computed, formula = (Form(page, f"3.{i}") for i in range(1, 6))
    export = page.get_by_role("button", name="Export my answers")
    export.wait_for()
    assert export.is_disabled()
    numbers.line("1, 1, 1, 0, 0, 0.5")
    assert "0 of 6 right in chapter 03" in numbers.expect("false")
    exercise = page.locator("section", has=numbers.part).last
    exercise.get_by_text("A nudge").click()  # of which there is one
    assert exercise.get_by_text("Begin with the axes of the gyros").is_visible()
    cell = exercise.get_by_text("answer = ...")
    assert not cell.is_visible()
    exercise.get_by_text("In a notebook, this is the cell").click()
    assert cell.is_visible()
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
    assert "in your own words" in letters.expect("false")
    letters.letters("ad", because="One number a <b>mounting</b>.")
    letters.expect("true")

    formula.python("import sympy\nanswer = sympy.Symbol('x')")  # which brings SymPy
    assert "found also x" in formula.expect("false")
    formula.python(FORMULA)
    assert "4 of 6 right" in formula.expect("true")
    computed.python("print('as if')\nanswer = [0, 0, 0]")
    computed.expect("false")
    assert computed.part.locator("pre").inner_text() == "as if\n"
    computed.python("while True:\n    pass")
    computed.button("Stop").click()
    computed.part.get_by_text("Stopped. What you typed is still here.").wait_for()
    assert page.evaluate("document.activeElement.textContent") == "Run and check"

    page.get_by_label("Your name").fill("Zoë van 't Hoff")
    with page.expect_download() as download:
        export.click()
    assert download.value.suggested_filename == "drift-lab-answers-zoe-van-t-hoff.ipynb"
    notebook = nbformat.read(download.value.path(), as_version=4)
    nbformat.validate(notebook)
    title, *cells = notebook.cells
    assert title.source.startswith("# Answers of Zoë van 't Hoff\n\n")
    assert "chapter 03, answered" in title.source
    code = "\n".join(cell.source for cell in cells if cell.cell_type == "code")
    assert re.findall(r'check\("([\d.]+)"', code) == ["3.1", "3.2", "3.3", "3.4", "3.5"]

    page.reload()
    puzzle.get_by_role("button", name="Show the answer").wait_for()
    assert "Your guess: the second" in puzzle.inner_text()
    assert page.get_by_label("Your name").input_value() == "Zoë van 't Hoff"
    numbers.part.get_by_text("when you last checked it").wait_for()
    assert numbers.part.get_by_role("textbox").first.input_value() == "1, 1, −1, 0, 0, 1/2"
    assert letters.part.get_by_role("checkbox", checked=True).count() == 2
    assert "while True" in computed.part.locator("textarea").input_value()
    assert page.complaints == []


SOUND = {
    "typed": {"letters": "ad"},
    "checked": {"letters": "ad"},
    "cell": "answer = 'ad'",
    "says": "right.",
    "right": True,
}
BROKEN = {
    "3.1": {"typed": {"line": None}},
    "3.2": None,
    "3.3": {"typed": {"letters": 5}},
    "3.4": {"typed": "x", "cell": 5},
    "3.5": [5],
}


def keep(page, kept):
    page.add_init_script(f"localStorage[{json.dumps(NAME)}] = {json.dumps(json.dumps(kept))}")


@browser
@pytest.mark.parametrize(
    ("kept", "answered", "marks"),
    [
        ({"exercises": None, "guesses": "5"}, 0, 0),
        ({"exercises": BROKEN, "guesses": {puzzle_of("03").key: ["a"]}}, 0, 0),
        ({"exercises": {**BROKEN, "3.3": SOUND}, "reader": {"name": 5}}, 1, 1),
        ({"exercises": {"3.3": {**SOUND, "checked": {"letters": "a"}}}}, 1, 0),
    ],
)
def test_what_the_page_did_not_write_takes_no_form_away(page, address, kept, answered, marks):
    """Nor does an address that is none; and a mark is only of what was checked."""
    keep(page, kept)
    page.goto(f"{address}/03_systematic_drift.html#%")
    page.get_by_role("button", name="Export my answers").wait_for()
    page.locator('div.guess[data-guess="03"] form').wait_for()
    assert page.locator("div.exercise form").count() == len(all_exercises("03"))
    assert page.get_by_text("So far 1 of").count() == answered
    assert page.get_by_text("when you last checked it").count() == marks
    boxes = Form(page, "3.3").part.get_by_role("checkbox")
    assert [box.is_checked() for box in boxes.all()].count(True) == 2 * answered
    boxes.nth(1).check()
    written = page.evaluate("(name) => JSON.parse(localStorage[name])", NAME)
    assert "b" in written["exercises"]["3.3"]["typed"]["letters"]
    assert page.complaints == []


@browser
def test_a_browser_that_keeps_nothing_is_told_so(page, address):
    page.add_init_script(
        "Object.defineProperty(window, 'localStorage', "
        "{ get() { throw new DOMException('no', 'SecurityError'); } })"
    )
    page.set_viewport_size({"width": 390, "height": 800})
    page.goto(f"{address}/03_systematic_drift.html")
    page.get_by_text("does not let the page keep anything").wait_for()
    Form(page, "3.3").part.get_by_role("checkbox").first.check()
    assert page.evaluate("document.documentElement.scrollWidth - innerWidth") <= 0


@browser
def test_the_export_bears_the_readers_name(page, address):
    keep(page, {"exercises": {"3.3": SOUND, "16.1": SOUND}})
    page.goto(f"{address}/03_systematic_drift.html")
    for name, file, title in (
        ("", "drift-lab-answers", "My answers"),
        ("../Ørsted: 1*", "drift-lab-answers-ørsted-1", r"Answers of ..\/Ørsted\: 1\*"),
        ("?!", "drift-lab-answers", r"Answers of \?\!"),
        ("O’Brien", "drift-lab-answers-o-brien", "Answers of O’Brien"),
        ("李" * 80, "drift-lab-answers-" + "李" * 50, "Answers of " + "李" * 80),
    ):
        page.get_by_label("Your name").fill(name)
        with page.expect_download() as download:
            page.get_by_role("button", name="Export my answers").click()
        assert download.value.suggested_filename == f"{file}.ipynb"
        notebook = nbformat.read(download.value.path(), as_version=4)
        nbformat.validate(notebook)
        first = notebook.cells[0].source
        assert first.startswith(f"# {title}\n\nExercises of Drift Lab {driftlab.__version__}, ")
        assert re.search(r"chapters 03, 16, .* exported \d{4}-\d\d-\d\d\.$", first)
