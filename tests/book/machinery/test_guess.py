"""The guess control: first a guess, then the answer; the first guess is kept."""

import json
import math
import os
import re
from dataclasses import replace
from pathlib import Path

import nbformat
import numpy as np
import pytest
from pages import CHAPTERS as CHAPTERS_IN_ORDER, LEDGER, START
from scipy.constants import arcminute

from driftlab.book import guess, guesses
from driftlab.book.chapters import CHAPTERS, chapters_with
from driftlab.book.machinery.exercise import kept_guesses
from driftlab.book.machinery.exercise.guess import GuessControl
from driftlab.book.machinery.exercise.kept_guesses import FILE, in_memory, keep, kept_guess
from driftlab.book.machinery.exercise.marks import marks
from driftlab.book.machinery.exercise.puzzle import Choice, Number, Puzzle
from driftlab.book.machinery.exercise.revealed import WITHOUT_GUESS
from driftlab.book.puzzles import ENOUGH, puzzle_of
from driftlab.book.scenarios import ship_manoeuvre

LENGTH = Number(asks="How long?", unit="m", low=0.1, high=1000, truth=lambda: 20.0)
COUNT = Number(asks="How many?", unit="of 8", low=0, high=8, truth=lambda: 6.0, whole=True)
SIDE = Choice(asks="Which <side>?", options=("left", "right"), truth=lambda: "left")
PUZZLE = Puzzle(chapter="03", edition=1, questions=(LENGTH, SIDE), says="It is {0}. Why?")


@pytest.fixture(autouse=True)
def empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(kept_guesses, "in_memory", {})
    return tmp_path


def guessed(
    length: float = 10.0,
    side: str = "right",
    puzzle: Puzzle = PUZZLE,
    control: GuessControl | None = None,
) -> GuessControl:
    control = control or GuessControl(puzzle)
    control.inputs[0].field.value = 1.0
    control.inputs[0].field.value = length
    control.inputs[1].radio.value = side
    control.button.click()
    return control


def test_nothing_is_said_before_a_guess():
    control = GuessControl(PUZZLE)
    bundle = control._repr_mimebundle_()
    assert control.answer.value == ""
    for shown in (repr(control), bundle["text/html"], bundle["text/plain"]):
        assert "20" not in shown
        assert "JupyterLab" in shown
    assert "Which &lt;side&gt;?" in bundle["text/html"]


@pytest.mark.parametrize(("side", "words"), [(None, "choose"), ("left", "Move each slider")])
def test_where_a_slider_or_a_menu_stands_at_first_is_no_guess(side, words, empty_folder):
    control = GuessControl(PUZZLE)
    control.inputs[1].radio.value = side
    control.button.click()
    assert words in control.answer.value
    assert "20" not in control.answer.value
    assert not (empty_folder / FILE).exists()


def test_a_page_that_moves_a_slider_to_its_nearest_step_has_guessed_nothing(empty_folder):
    control = GuessControl(PUZZLE)
    slider = control.inputs[0].slider
    assert slider.value == pytest.approx(slider.step * round(slider.value / slider.step))
    slider.value += 1e-6
    assert control.inputs[0].value is None
    slider.value += slider.step
    assert control.inputs[0].value is not None


def test_guess_and_truth_stand_beside_each_other():
    control = guessed()
    answer = control.answer.value
    for words in ("<b>20 m</b>", "half of it", "You guessed: right.", "It is 20 m. Why?"):
        assert words in answer
    assert "role='alert'" in answer
    assert "your guess 10 m on a scale from 0.1 m to 1000 m" in answer
    assert control.button.disabled
    assert control.inputs[0].widget not in control.widget.children


def test_field_and_slider_move_together():
    number = GuessControl(PUZZLE).inputs[0]
    number.slider.value = 0.25
    number.slider.value = 0.5
    assert number.value == 10.0
    number.field.value = 1000
    assert number.slider.value == 1
    count = GuessControl(Puzzle(chapter="x", edition=1, questions=(COUNT,), says="")).inputs[0]
    count.slider.value = 7
    assert count.value == 7


def test_first_guess_stays(empty_folder):
    second = GuessControl(PUZZLE)
    guessed(10.0, "left")
    guessed(20.0, "left", control=second)
    assert kept_guess(PUZZLE) == (True, [10.0, "left"])
    again = GuessControl(PUZZLE)
    assert "you <b>10 m</b>" in again.answer.value
    assert "that you made first" in again.answer.value
    assert os.listdir(empty_folder) == [FILE]  # nothing is left of the writing


def test_who_is_killed_while_a_guess_is_written_has_those_before(empty_folder, monkeypatch):
    class Killed(BaseException):
        pass

    def killed(*_):
        raise Killed

    keep(PUZZLE, [10.0, "left"])
    before = (empty_folder / FILE).read_bytes()
    another = replace(PUZZLE, chapter="04")
    with monkeypatch.context() as at_the_end:
        at_the_end.setattr(os, "replace", killed)
        with pytest.raises(Killed):
            keep(another, [20.0, "left"])
    assert (empty_folder / FILE).read_bytes() == before
    keep(another, [20.0, "left"])
    assert [kept_guess(one)[1][0] for one in (PUZZLE, another)] == [10.0, 20.0]


def test_looking_without_a_guess_is_said_and_kept():
    control = GuessControl(PUZZLE)
    control.look.click()
    assert WITHOUT_GUESS in control.answer.value
    assert "you <b>" not in control.answer.value
    assert WITHOUT_GUESS in GuessControl(PUZZLE).answer.value
    assert kept_guess(PUZZLE) == (True, None)


def test_another_edition_asks_anew():
    guessed()
    changed = Puzzle(chapter="03", edition=2, questions=(LENGTH, SIDE), says="")
    assert kept_guess(changed) == (False, None)
    guessed(30.0, puzzle=changed)
    assert kept_guess(PUZZLE)[1] == [10.0, "right"]
    assert kept_guess(changed)[1] == [30.0, "right"]
    kept = json.loads(Path(FILE).read_text("utf-8"))["guesses"]
    assert list(kept) == [PUZZLE.key, changed.key]
    assert in_memory == {}


@pytest.mark.parametrize(
    "content",
    [
        "",
        "not JSON",
        "[1]",
        '{"guesses": 3}',
        "\udcff",
        *(
            json.dumps({"guesses": {PUZZLE.key: entry}})
            for entry in (3, [1], [1, "up"], [True, "left"], [float("nan"), "left"], [1e9, "left"])
        ),
    ],
)
def test_foreign_file_is_left_alone(content, empty_folder):
    path = empty_folder / FILE
    path.write_text(content, "utf-8", errors="surrogateescape")
    before = path.read_bytes()
    answer = guessed().answer.value
    assert path.read_bytes() == before
    assert "stays as it is" in answer
    assert kept_guess(PUZZLE) == (True, [10.0, "right"])  # as long as the kernel lives
    assert "that you made first" in GuessControl(PUZZLE).answer.value


@pytest.mark.skipif(os.name == "nt", reason="links ask for rights there")
def test_link_stays_a_link(tmp_path, empty_folder):
    elsewhere = tmp_path / "elsewhere.json"
    (empty_folder / FILE).symlink_to(elsewhere)
    guessed()
    assert (empty_folder / FILE).is_symlink()
    assert PUZZLE.key in elsewhere.read_text("utf-8")


def test_nothing_can_be_written(monkeypatch, empty_folder):
    def refuse(*_):
        raise PermissionError

    monkeypatch.setattr(os, "replace", refuse)
    assert "cannot be written" in guessed().answer.value
    assert os.listdir(empty_folder) == []
    assert kept_guess(PUZZLE)[1] == [10.0, "right"]
    (empty_folder / FILE).mkdir()
    kept_guesses.in_memory.clear()
    assert "stays as it is" in guessed().answer.value


@pytest.mark.parametrize(
    ("question", "truth", "value", "says"),
    [
        (LENGTH, 20.0, 20, "it almost exactly"),
        (LENGTH, 20.0, 10, "half of it"),
        (LENGTH, 20.0, 2, "a tenth of it"),
        (LENGTH, 20.0, 40.5, "twice as much"),
        (LENGTH, 20.0, 1000, "about 50 times as much"),
        (LENGTH, 20.0, 0.1, "about 200 times what you guessed"),
        (LENGTH, 20.0, 23, "a little more than it is"),
        (COUNT, 6.0, 6, "exactly"),
        (COUNT, 6.0, 7, "1 too many"),
        (COUNT, 6.0, 0, "6 too few"),
    ],
)
def test_how_far_off_is_said_in_words(question, truth, value, says):
    assert says in question.how_far(value, truth)


def test_marks_stay_on_the_scale():
    for value in (LENGTH.low, LENGTH.start, LENGTH.high):
        places = re.findall(r"left: (-?[\d.]+)%", marks(LENGTH, value, 20.0))
        assert places
        assert all(0 <= float(place) <= 100 for place in places)


def test_every_chapter_opens_with_a_puzzle():
    assert chapters_with("puzzle") == list(CHAPTERS)
    with pytest.raises(ValueError, match=r"^chapter: expected .*, got '99'"):
        guess("99")


@pytest.fixture(scope="module")
def truths():
    return {chapter: puzzle_of(chapter).truths() for chapter in CHAPTERS}


def test_truth_lies_on_its_scale_and_is_not_given_away(truths):
    for chapter in CHAPTERS:
        puzzle = puzzle_of(chapter)
        assert puzzle.chapter == chapter
        assert puzzle.allows(truths[chapter])
        assert puzzle.remark(truths[chapter])
        for question, truth in zip(puzzle.questions, truths[chapter], strict=True):
            if isinstance(question, Number) and not question.whole:
                # The slider does not begin near the answer.
                assert abs(math.log10(truth / question.start)) > 0.4, chapter


def test_question_stands_before_what_computes_the_answer():
    """Under the text the question; what computes the answer is folded away when a page opens."""
    for path in (START, *CHAPTERS_IN_ORDER, LEDGER):
        text, asked, fold, computes = nbformat.read(path, as_version=4).cells[1:5]
        assert text.source.startswith("## A puzzle"), path.name
        assert asked.source == f'from driftlab.book import guess\n\nguess("{path.name[:2]}")'
        assert fold.source.startswith("### Guessed? Then compute it")
        assert fold.metadata["jp-MarkdownHeadingCollapsed"] is True
        assert computes.cell_type == "code"


def test_sentences_under_the_answers_are_true(truths):
    """What the puzzles say without a number of their own."""
    assert truths["00"][0] == pytest.approx(6.88 * 3.1416, rel=1e-3)  # a circle comes in
    assert truths["01"][0] < 0.05 * 30  # nearly all has come home
    hours, months = truths["02"]
    assert 1 < hours < 2
    assert months > 60 * 24
    assert truths["03"][1] > 1000
    assert truths["07"][0] * 60 > 15.04 * 60  # ′ a minute in °/h, and the Earth's 15.04 °/h
    assert truths["10"] == [6.0]
    assert truths["11"] == [9, 27]
    assert truths["12"] == pytest.approx([3.3, 14.7], abs=0.2)
    assert truths["14"][0] < 0.01
    assert truths["14"][1] == pytest.approx(2, abs=0.05)
    assert 50 < plumb_line() < 55
    assert truths["16"][0] > 200
    assert truths["19"] == [pytest.approx(60.0)]
    assert 50 * 0.1 < truths["17"][0] < 60 * 0.1  # a tenth of a degree made degrees


def plumb_line() -> float:
    """By how much the accelerometers of the puzzle's ship lean at the most, arc minutes."""
    forward, upward, _ = ship_manoeuvre(speed=10.0, turn=0.0).increments.velocity.T
    return np.abs(forward / upward).max() / arcminute


def test_looking_back_at_nothing_and_at_little():
    assert repr(guesses()) == guesses().says
    assert "No guess is kept yet" in guesses()._repr_html_()
    keep(puzzle_of("01"), [30.0])
    assert f"With {ENOUGH} numbers" in guesses().says
    assert guesses().rows[0].ratio == "24"


def test_looking_back_at_all(truths):
    for chapter in CHAPTERS:
        puzzle = puzzle_of(chapter)
        early = chapter < "07"
        keep(
            puzzle,
            [
                truth if isinstance(q, Choice) or q.whole else truth * (4 if early else 2)
                for q, truth in zip(puzzle.questions, truths[chapter], strict=True)
            ],
        )
    found = guesses()
    assert len(found.rows) == sum(len(each) for each in truths.values())
    assert {row.ratio for row in found.rows} == {"4", "2", "right"}
    assert "within a factor 4 of the truth" in found.says
    assert "came closer" in found.says
    assert found._repr_html_().count("<tr>") == len(found.rows) + 1
    assert len(repr(found).splitlines()) == len(found.rows) + 1
