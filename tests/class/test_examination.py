"""The examination: marks and minutes add up, numbers can be read, sheets differ."""

import re
from pathlib import Path

import numpy as np
import pytest
from exam_numbers import EDITIONS, NUMBER, question, questions

from driftlab.book.instructors.exam_questions import BY_CHOICE, COMPULSORY, shown
from driftlab.book.instructors.examination import CHOSEN, READING, exam_paper

FOLDER = Path(__file__).parents[2] / "notebooks"


@pytest.mark.parametrize("edition", EDITIONS[:5])
def test_marks_and_minutes_add_up_whatever_is_chosen(edition):
    paper = exam_paper(edition)
    assert (paper.marks, paper.minutes) == (60, 90)
    assert len({(q.marks, q.minutes) for q in paper.by_choice}) == 1
    fixed = sum(q.minutes for q in paper.compulsory)
    assert fixed + CHOSEN * paper.by_choice[0].minutes + READING == 90


def test_the_core_and_the_choice_are_of_the_chapters_they_say():
    assert [q.chapter for q in questions("a")] == [
        *("01", "02", "03", "05", "10", "13", "14"),
        *("06", "07", "11", "17"),
    ]
    assert (len(COMPULSORY), len(BY_CHOICE)) == (7, 4)


def test_each_question_examines_an_outcome_of_its_chapter():
    for each in questions("a"):
        (path,) = FOLDER.glob(f"{each.chapter}_*.ipynb")
        assert f'"- {each.outcome}' in path.read_text("utf-8"), (
            f"question on {each.chapter}: no outcome of the chapter begins {each.outcome!r}"
        )


def test_each_edition_has_numbers_of_its_own_in_every_question():
    sheets = [questions(edition) for edition in EDITIONS]
    for same in zip(*sheets, strict=True):
        texts = {each.given + "".join(part.asks for part in each.parts) for each in same}
        assert len(texts) > 0.8 * len(EDITIONS), same[0].title
    assert len({exam_paper(edition).sheet() for edition in EDITIONS}) == len(EDITIONS)
    assert exam_paper("a ").scheme() == exam_paper("a").scheme()


def test_each_part_has_three_tasks_or_more_which_earn_the_same():
    for same in zip(*map(questions, EDITIONS), strict=True):
        for parts in zip(*(each.parts for each in same), strict=True):
            tasks = {re.sub(r"\d", "", str([a.name for a in part.answers])) for part in parts}
            assert len(tasks) >= 3, f"{same[0].title}: {tasks}"
            assert len({part.marks for part in parts}) == 1, f"{same[0].title}: {tasks}"


def test_the_deepest_idea_earns_more_than_a_convention():
    for edition in EDITIONS:
        idea, convention = (question(edition, chapter).parts[0] for chapter in ("10", "06"))
        # That no motion reveals which mounting a box has; the sign and the length of a vector.
        assert "no motion reveals" in idea.works
        assert "Cayley vector" in convention.asks
        assert idea.marks > convention.marks


def test_the_edition_is_not_on_the_sheet_nor_an_answer():
    paper = exam_paper("autumn, rowan")
    sheet = paper.sheet().text
    assert "rowan" not in sheet + paper.scheme().text
    assert f"Sheet {paper.mark}" in sheet
    assert f"sheet {paper.mark}" in paper.scheme().text
    for each in questions("autumn, rowan"):
        for part in each.parts:
            assert not part.works or part.works not in sheet
            for answer in part.answers:
                assert str(answer) not in sheet


@pytest.mark.parametrize("edition", EDITIONS)
def test_numbers_are_sensible_and_can_be_read(edition):
    paper = exam_paper(edition)
    for text in (paper.sheet().text, paper.scheme().text):
        assert not re.search(r"nan|inf\b|e[-+]\d\d|array|np\.", text)
        digits = [n.strip("−-").replace(".", "").lstrip("0") for n in re.findall(NUMBER, text)]
        assert max(map(len, digits)) <= 7
    for each in questions(edition):
        for part in each.parts:
            for answer in part.answers:
                assert np.isfinite(answer.value)
                assert answer.value, f"{each.title}: {answer.name} is zero"


@pytest.mark.parametrize("edition", EDITIONS[:3])
def test_the_scheme_has_each_mark_and_number(edition):
    paper = exam_paper(edition)
    lines = re.findall(r"^- (\d): ", paper.scheme().text, re.MULTILINE)
    assert sum(map(int, lines)) == sum(each.marks for each in questions(edition))
    for each in questions(edition):
        assert len(each.parts) == 2
        for part in each.parts:
            assert all(str(answer) in paper.scheme().text for answer in part.answers)


@pytest.mark.parametrize("wrong", ["", "  ", 7, None])
def test_an_edition_is_a_text(wrong):
    with pytest.raises(ValueError, match=r"^edition: expected a text"):
        exam_paper(wrong)


def test_three_digits_are_shown():
    numbers = (0.0123456, -0.00123456, -1.23456, 86.397, 12345.6, 123456.0, 0.0)
    words = ["0.0123", "−0.00123", "−1.23", "86.4", "12346", "123456", "0"]
    assert [shown(x) for x in numbers] == words
