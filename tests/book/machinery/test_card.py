"""What a card shows of a verdict, of hints and of progress; everything in it is escaped."""

import re
from html.parser import HTMLParser

import pytest

from driftlab.book.machinery.exercise.card import Card, HintCard
from driftlab.book.machinery.exercise.exercise import Verdict
from driftlab.book.machinery.exercise.hints import Help
from driftlab.book.machinery.exercise.progress import Progress, as_text

HELP = Help("The worst <axis> of 2", "Look at `n`.", "Think of n < 1.", "Because.")
RIGHT = Verdict(True, "right. Now see.")
WRONG = Verdict(False, "not yet. The first is 'too' <b>small</b>.", ((False, True), (True, True)))


class Text(HTMLParser):
    """What a reader sees of a page, and its elements."""

    def __init__(self, page):
        super().__init__()
        self.words, self.elements = [], []
        self.feed(page)

    def handle_data(self, data):
        self.words.append(data)

    def handle_starttag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))


def test_right_answer_has_a_sign_in_words_the_remark_the_model_and_the_progress():
    card = Card("3.2", RIGHT, HELP, ("Your guess.",), "2 of 6 right in chapter 03")
    page = " ".join(Text(card._repr_html_()).words)
    for words in ("✓ Right", "Exercise 3.2", "Now see.", "Your guess.", "In words: Because."):
        assert words in page
    assert "2 of 6 right in chapter 03" in page
    assert "A nudge" not in page
    assert repr(card) == "Exercise 3.2: right. Now see.\nYour guess.\nIn words: Because."


def test_wrong_answer_has_its_reason_a_tick_for_each_part_and_hints_to_unfold():
    card = Card("3.2", WRONG, HELP)
    text = Text(card._repr_html_())
    page = " ".join(text.words)
    assert "✗ Not yet" in page
    assert "The first is 'too' <b>small</b>." in page
    assert [word for word in text.words if re.fullmatch("[✓✗ ]+", word)] == ["✗ ✓", "✓ ✓"]
    assert "it is not yet, it is right" in {a.get("aria-label") for _, a in text.elements}
    assert [tag for tag, _ in text.elements].count("details") == 2
    assert ("a", {"href": "#The-worst-<axis>-of-2"}) in text.elements
    assert "In words" not in page
    assert repr(card).splitlines()[1:] == ["✗ ✓", "✓ ✓"]


@pytest.mark.parametrize("card", [Card("3.2", WRONG, HELP), HintCard("3.2", HELP, 3)])
def test_card_has_no_script_and_its_colours_suit_a_dark_page(card):
    page = card._repr_html_()
    assert {tag for tag, _ in Text(page).elements} <= {
        "div", "span", "b", "code", "details", "summary", "a"
    }  # fmt: skip
    assert "<code>n</code>" in page
    assert "color: inherit" in page
    assert all("rgba" in paint for paint in re.findall(r"background: (\w+)", page))


def test_hints_come_one_by_one():
    shown = [repr(HintCard("3.2", HELP, rungs)) for rungs in (1, 2, 3)]
    assert [len(each.splitlines()) for each in shown] == [2, 3, 4]
    assert shown[2].endswith("The section that helps: The worst <axis> of 2.")


def test_progress_counts_keeps_the_first_guess_and_climbs_the_ladder_once():
    progress = Progress()
    assert progress.of(["1.1", "1.2"]) == (0, 2)
    progress.note("1.1", "?", Verdict(None, "not answered yet."))
    progress.note("1.1", "two", Verdict(False, "not readable. No."))
    progress.note("1.1", [1, 2.50001], Verdict(False, "not yet. No."))
    progress.note("1.1", [3, 4], Verdict(True, "right."))
    assert progress.of(["1.1", "1.2"]) == (1, 2)
    assert progress.guess_against("1.1", [3, 4]) == (
        "Your first guess was 1, 2.5, the answer is 3, 4."
    )
    progress.note("1.2", "ace", Verdict(True, "right."))
    assert progress.guess_against("1.2", "ace") == "You had it at the first guess."
    assert [progress.next_rung("1.1", 3) for _ in range(4)] == [1, 2, 3, 3]


@pytest.mark.parametrize(
    ("answer", "text"), [("ace", "a, c, e"), ("a, c", "a, c"), (["a", "c"], "a, c"), (2.0, "2")]
)
def test_answer_is_told_as_a_reader_would_say_it(answer, text):
    assert as_text(answer) == text
