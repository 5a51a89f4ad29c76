"""What the page keeps of answers, and what a reader takes along of them."""

import json
import re

import nbformat
import pytest
from answer_form import Form

import driftlab
from driftlab.book.exercises import all_exercises
from driftlab.book.puzzles import puzzle_of

pytestmark = [pytest.mark.browser, pytest.mark.xdist_group("site-answers")]

NAME = f"Drift Lab {driftlab.__version__}: answers"
SOUND = {"typed": {"letters": "ad"}, "cell": "answer = 'ad'", "says": "right.", "right": True}
BROKEN = {
    "3.1": {"typed": {"line": None}},
    "3.2": None,
    "3.3": {"typed": {"letters": 5}},
    "3.4": {"typed": "x", "cell": 5},
    "3.5": [5],
}


def keep(page, kept):
    page.add_init_script(f"localStorage[{json.dumps(NAME)}] = {json.dumps(json.dumps(kept))}")


@pytest.mark.parametrize(
    ("kept", "answered"),
    [
        (None, 0),
        ({"exercises": None, "guesses": "5"}, 0),
        ({"exercises": BROKEN, "guesses": {puzzle_of("03").key: 5}}, 0),
        ({"guesses": {puzzle_of("03").key: ["a"]}}, 0),
        ({"exercises": {**BROKEN, "3.3": SOUND}, "reader": {"name": 5}}, 1),
    ],
)
def test_what_the_page_did_not_write_takes_no_form_away(page, address, kept, answered):
    keep(page, kept)
    page.goto(f"{address}/03_systematic_drift.html#%")  # nor does an address that is none
    page.get_by_role("button", name="Export my answers").wait_for()
    page.locator('div.guess[data-guess="03"] form').wait_for()
    assert page.locator("div.exercise form").count() == len(all_exercises("03"))
    assert page.get_by_text("So far 1 of").count() == answered
    boxes = Form(page, "3.3").part.get_by_role("checkbox")
    assert [box.is_checked() for box in boxes.all()].count(True) == 2 * answered
    boxes.nth(1).check()
    written = page.evaluate("(name) => JSON.parse(localStorage[name])", NAME)
    assert "b" in written["exercises"]["3.3"]["typed"]["letters"]
    assert page.complaints == []


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


@pytest.mark.parametrize(("checked", "shown"), [({"letters": "ad"}, 1), ({"letters": "a"}, 0)])
def test_a_mark_is_only_of_what_was_checked(page, address, checked, shown):
    keep(page, {"exercises": {"3.3": {**SOUND, "checked": checked}}})
    page.goto(f"{address}/03_systematic_drift.html")
    page.get_by_role("button", name="Export my answers").wait_for()
    assert page.get_by_text("when you last checked it").count() == shown


@pytest.mark.parametrize(
    ("name", "file", "title"),
    [
        ("", "drift-lab-answers", "My answers"),
        ("  Ada Lovelace ", "drift-lab-answers-ada-lovelace", "Answers of Ada Lovelace"),
        ("../Ørsted: 1*", "drift-lab-answers-ørsted-1", r"Answers of ..\/Ørsted\: 1\*"),
        ("Лев Николаевич", "drift-lab-answers-лев-николаевич", "Answers of Лев Николаевич"),
        ("?!", "drift-lab-answers", r"Answers of \?\!"),
        ("O’Brien", "drift-lab-answers-o-brien", "Answers of O’Brien"),
        ("李" * 80, "drift-lab-answers-" + "李" * 50, "Answers of " + "李" * 80),
    ],
)
def test_the_export_bears_the_readers_name(page, address, name, file, title):
    kept = {"exercises": {"3.3": SOUND, "11.1": SOUND}}
    keep(page, kept)
    page.goto(f"{address}/03_systematic_drift.html")
    page.get_by_label("Your name").fill(name)
    with page.expect_download() as download:
        page.get_by_role("button", name="Export my answers").click()
    assert download.value.suggested_filename == f"{file}.ipynb"
    notebook = nbformat.read(download.value.path(), as_version=4)
    nbformat.validate(notebook)
    first = notebook.cells[0].source
    assert first.startswith(f"# {title}\n\nExercises of Drift Lab {driftlab.__version__}, ")
    assert re.search(r"chapters 03, 11, .* exported \d{4}-\d\d-\d\d\.$", first)
