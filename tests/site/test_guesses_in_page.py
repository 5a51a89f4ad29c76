"""Puzzles that answer in the page: what Python says of a guess, and in a browser."""

import pytest
from answer_form import PATIENCE

from driftlab.book.puzzles import puzzle_of
from in_place import guesses


def test_guesses_are_answered_and_looked_back_at():
    shown = guesses.reveal("03", ["the first", 100.0], "Kept.")
    assert "That is what you guessed." in shown
    assert "Kept." in shown
    assert "You looked without a guess" in guesses.reveal("03", None, "")
    keys = [puzzle_of("03").key, puzzle_of("05").key]
    table = guesses.look_back({keys[0]: ["the first", 100.0], keys[1]: ["out of date"]})
    assert table.count("<tr>") == 3
    assert "No guess is kept yet" in guesses.look_back({keys[0]: None})


def overlap(a, b):
    return all(
        a[low] < b[low] + b[size] and b[low] < a[low] + a[size]
        for low, size in (("x", "width"), ("y", "height"))
    )


@pytest.mark.browser
@pytest.mark.xdist_group("site-answers")
def test_a_puzzle_is_guessed_answered_and_remembered(page, address, packages):
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
    scale = puzzle.get_by_role("img")
    diamonds = [each.bounding_box() for each in scale.locator("div[style*='rotate']").all()]
    words = [each.bounding_box() for each in scale.locator("small").all()]
    assert len(diamonds) == 2
    assert len(words) > 3
    assert not [(a, b) for a in diamonds for b in words if overlap(a, b)]
    page.reload()
    puzzle.get_by_role("button", name="Show the answer").wait_for()
    assert "Your guess: the second" in puzzle.inner_text()
    assert page.complaints == []
