"""Exercises that answer in the page, in a browser: one of each kind."""

import re

import nbformat
import pytest
from answer_form import REACH, Form

from driftlab.book import class_report
from driftlab.book.chapters import CHAPTERS, chapters_with
from driftlab.book.exercises import all_exercises, hints_of


def test_every_section_that_helps_is_a_heading_of_its_page(site):
    for chapter in chapters_with("exercises"):
        page = (site / f"{CHAPTERS[chapter][2:]}.html").read_text("utf-8")
        helping = re.findall(r"The section that helps: <a class='[\w ]+' href='#([^']+)'", page)
        assert len(helping) == len(hints_of(chapter))
        places = set(re.findall(r'id="([^"]+)"', page))
        assert places.issuperset(helping), chapter
        assert set(re.findall(r'data-exercise="([\d.]+)"', page)) == set(all_exercises(chapter))


@pytest.mark.browser
@pytest.mark.xdist_group("site-answers")
def test_exercises_of_each_kind_answer_in_the_page_and_are_kept(page, address, tmp_path, packages):
    chapter = f"{address}/03_systematic_drift.html"
    page.goto(chapter)
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
    letters.letters("abd", because="It turns both ways, <b>so</b> it sees more.")
    assert "(b) forgets" in letters.expect("false")
    letters.letters("ad", because="One number a mounting.")
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

    page.get_by_label("Your name").fill("Zoë van 't Hoff")
    with page.expect_download() as download:
        export.click()
    assert download.value.suggested_filename == "drift-lab-answers-zoe-van-t-hoff.ipynb"
    download.value.save_as(tmp_path / "answers.ipynb")
    rows = class_report(tmp_path).rows
    assert [row.exercise for row in rows if row.shows == "right"] == ["3.1", "3.2", "3.3"]
    assert [row.exercise for row in rows if row.is_slip] == ["3.4"]
    assert [row.exercise for row in rows if row.shows == "not judged"] == ["3.5"]
    title = nbformat.read(tmp_path / "answers.ipynb", as_version=4).cells[0].source
    assert title.startswith("# Answers of Zoë van 't Hoff\n\n")
    assert "chapter 03, answered" in title

    page.reload()
    assert page.get_by_label("Your name").input_value() == "Zoë van 't Hoff"
    numbers.part.get_by_text("when you last checked it").wait_for()
    assert numbers.part.get_by_role("textbox").first.input_value() == "1, 1, −1, 0, 0, 1/2"
    assert letters.part.get_by_role("checkbox", checked=True).count() == 2
    assert "as if" in computed.part.locator("textarea").input_value()
    assert page.complaints == []
