"""Chapters on paper: what a lecturer prints of a notebook, and an examination."""

import json
import re
import subprocess
from pathlib import Path

import pypdfium2
import pytest
from pypdfium2 import raw
from test_pdf import SIDES, links_of, text_of, words

from driftlab.book.exercises import all_exercises, hints_of
from driftlab.book.instructors.examination import exam_paper
from executed import notebooks
from pdf.contents import OUTSIDE, part_of

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("site-pdf")]
CHAPTER = "03_systematic_drift.ipynb"
EDITION = "spring, tests"  # as in print_small.py
LONG = "a_long_name = another_name"
A4, LETTER = (595.3, 841.9), (612, 792)
FEET = 25
"""Points that stay white above and below on every page."""


@pytest.fixture(scope="module")
def made(site_python, tmp_path_factory) -> tuple[Path, dict]:
    """Folder of what was printed, and what print_small.py was told."""
    folder = tmp_path_factory.mktemp("printed")
    command = [str(site_python), str(Path(__file__).with_name("print_small.py")), str(folder)]
    done = subprocess.run(command, capture_output=True, encoding="utf-8")
    assert done.returncode == 0, done.stderr
    return folder, json.loads(done.stdout)


@pytest.fixture
def printed(made):
    """Opens what was printed, by its name."""
    return lambda name: pypdfium2.PdfDocument(made[0] / f"{name}.pdf")


def texts(document) -> list[str]:
    return [text_of(page.get_textpage()) for page in document]


def assert_within_the_margins(document, sides=SIDES) -> None:
    for number, page in enumerate(document, 1):
        text = page.get_textpage()
        assert text.count_rects() > 0, number
        for place in range(text.count_rects()):
            left, bottom, right, top = text.get_rect(place)
            what = (number, text.get_text_bounded(left, bottom, right, top))
            assert sides[0] < left, what
            assert right < sides[1], what
            assert bottom > FEET, what
            assert top < page.get_height() - FEET, what


def test_a_chapter_alone_has_its_title_contents_code_and_page_numbers(printed):
    document = printed("long")
    pages = texts(document)
    for said in ("Part I: A misaligned triad", "03 A title", "Drift Lab", "CC BY 4.0"):
        assert words(said) in words(pages[0]), said
    assert all(f"Section{n}" in words(pages[0]) for n in range(9))
    for number, text in enumerate(pages, 1):
        assert re.search(rf"\b{number}\s*$", text), number
    everything = words("".join(pages))
    assert words(LONG) in everything
    assert "notansweredyet" not in everything
    assert_within_the_margins(document)
    assert document[0].get_size() == pytest.approx(A4, abs=0.5)
    shown = [each for each in document[0].get_objects() if each.type == raw.FPDF_PAGEOBJ_TEXT]
    fonts = [raw.FPDFTextObj_GetFont(each) for each in shown]
    assert all(raw.FPDFFont_GetIsEmbedded(font) == 1 for font in fonts)


def test_a_short_handout_without_code_has_what_the_code_gave(printed):
    document = printed("short")
    assert document[0].get_size() == pytest.approx(LETTER, abs=0.5)
    first = words(texts(document)[0])
    assert first.count("Section0") == 1, "it needs no contents"
    assert words(LONG) not in first
    assert "whatitgave" in first
    assert "Seechapter04" in first
    assert not any(inside for inside, _ in links_of(document)), "which is not there"


def test_a_sheet_has_every_exercise_and_none_of_its_hints(printed):
    document = printed("exercises")
    text = words("".join(texts(document)))
    assert all(words(number) in text for number in all_exercises("03"))
    assert text.count("Tickthe") + text.count("Youranswerand") == len(all_exercises("03"))
    for helps in hints_of("03").values():
        for hint in (helps.nudge, helps.idea, helps.model):
            plain = [each for each in re.split(r"[$`*.?:\[]", hint) if len(each) > 40]
            assert not any(words(each) in text for each in plain), hint
    assert_within_the_margins(document, (50, 542))  # a frame has the space behind a line


def test_an_examination_is_a_sheet_and_a_scheme_and_no_question_goes_on_overleaf(printed):
    exam = exam_paper(EDITION)
    questions = (*exam.compulsory, *exam.by_choice)
    sheet, scheme = (printed(f"examination-{exam.mark}-{kind}") for kind in ("sheet", "scheme"))
    on_sheet, on_scheme = (words("".join(texts(document))) for document in (sheet, scheme))
    answers = {
        words(str(a)) for question in questions for part in question.parts for a in part.answers
    }
    assert all(words(question.title) in on_sheet for question in questions)
    assert not any(answer in on_sheet for answer in answers)
    assert any(answer in on_scheme for answer in answers)
    assert "Number" in on_sheet
    assert "scheme" not in on_sheet
    assert words(f"Marking scheme of sheet {exam.mark}") in on_scheme
    begin = tuple(words(f"{n}. {question.title}") for n, question in enumerate(questions, 1))
    head = words("Inertial navigation: a bent triad and its errors")
    for page in texts(sheet)[1:]:
        assert words(page).removeprefix(head).startswith(begin)
    for page in texts(scheme)[1:]:
        assert re.match(rf"Marking scheme of sheet {exam.mark}\s+(\([a-c]\)|\d+\.)\s", page)
    for document in (sheet, scheme):
        assert_within_the_margins(document)


def test_a_notebook_is_known_by_how_it_begins_and_a_refusal_is_one_sentence(made):
    assert list(made[1]["found"].values()) == [
        *(CHAPTER, CHAPTER, "lab_sheet.ipynb", f"solutions/{CHAPTER}"),
    ]
    assert [len(said.splitlines()) for said in made[1]["refusals"]] == [1] * 7
    outside = {name for name in notebooks() if part_of(name) is OUTSIDE}
    assert outside == {"instructors/examination.ipynb"}
