"""Chapters on paper: what a lecturer prints of a notebook."""

import ctypes
import json
import re
import subprocess
from pathlib import Path

import nbformat
import pypdfium2
import pytest
from pypdfium2 import raw
from test_pdf import SIDES, text_of, words

from driftlab.book.instructors.examination import exam_paper
from executed import notebooks
from pdf.cells import markdown_of
from pdf.contents import OUTSIDE, part_of
from support import ROOT

pytestmark = [pytest.mark.slow, pytest.mark.xdist_group("site-print")]
CHAPTER = "03_systematic_drift.ipynb"
# What print_small.py puts into its notebooks.
LONG = "a_long_name = another_name"
WAITS = "not answered yet"
A4, LETTER = (595.3, 841.9), (612, 792)
CAPITALS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
FEET = 25
"""Points that stay white above and below on every page."""


@pytest.fixture(scope="module")
def made(site_python, tmp_path_factory) -> tuple[Path, dict[str, str]]:
    """Folder of what was printed, and what names mean."""
    folder = tmp_path_factory.mktemp("printed")
    command = [str(site_python), str(Path(__file__).with_name("print_small.py")), str(folder)]
    done = subprocess.run(command, capture_output=True, encoding="utf-8")
    assert done.returncode == 0, done.stderr
    return folder, json.loads(done.stdout)


@pytest.fixture
def printed(made):
    """Opens a file by its name."""

    def by(name: str) -> pypdfium2.PdfDocument:
        path = made[0] / f"{name}.pdf"
        if not path.exists():
            pytest.skip("the chapter was not run; 'python3 lab.py print 03' runs it")
        return pypdfium2.PdfDocument(path)

    return by


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


def test_a_chapter_alone_has_its_title_contents_and_page_numbers(printed):
    pages = texts(printed("long"))
    for said in ("Part I: A bent triad and its drift", "03 A title", "Drift Lab", "CC BY 4.0"):
        assert words(said) in words(pages[0]), said
    assert all(f"Section{n}" in words(pages[0]) for n in range(12))
    assert len(pages) > 8
    for number, text in enumerate(pages, 1):
        assert re.search(rf"\b{number}\s*$", text), number


def test_a_short_one_needs_no_contents(printed):
    assert words(texts(printed("short"))[0]).count("Section0") == 1
    assert words(texts(printed("long"))[0]).count("Section0") == 2


def test_a_chapter_that_is_not_there_is_words_and_no_link(printed):
    document = printed("short")
    assert "Seechapter04" in words(texts(document)[0])
    place, link = ctypes.c_int(0), raw.FPDF_LINK()
    inside = []
    while raw.FPDFLink_Enumerate(document[0], place, link):
        inside.append(bool(raw.FPDFLink_GetDest(document, link)))
    assert not any(inside)


def test_nothing_is_said_of_answers_and_no_code_is_cut(printed):
    document = printed("short")
    text = words("".join(texts(document)))
    assert words(WAITS) not in text
    assert words(LONG) in text
    assert_within_the_margins(document)


def test_a_handout_without_code_has_what_the_code_gave(printed):
    text = words("".join(texts(printed("without-code"))))
    assert words(LONG) not in text
    assert "whatitgave" in text


@pytest.mark.parametrize(("name", "size"), [("short", A4), ("us-letter", LETTER)])
def test_the_page_has_its_size_and_its_fonts(printed, name, size):
    page = printed(name)[0]
    assert page.get_size() == pytest.approx(size, abs=0.5)
    shown = [each for each in page.get_objects() if each.type == raw.FPDF_PAGEOBJ_TEXT]
    assert shown
    for each in shown:
        assert raw.FPDFFont_GetIsEmbedded(raw.FPDFTextObj_GetFont(each)) == 1


def test_a_whole_chapter_stays_within_the_margins(printed):
    document = printed("chapter")
    assert_within_the_margins(document)
    assert "not answered yet" not in "".join(texts(document))
    assert len(document) > 10


@pytest.mark.parametrize(
    ("asked", "name"),
    [
        ("03", CHAPTER),
        (f"notebooks/{CHAPTER}", CHAPTER),
        ("lab_sheet", "lab_sheet.ipynb"),
        ("conventions", "conventions.ipynb"),
        ("solutions/03", f"solutions/{CHAPTER}"),
        ("14", 'No notebook is called "14"; there are 00, 01, '),
        ("0", 'More than one notebook is called "0"; there are 00, 01, '),
        ("", 'No notebook is called ""; there are 00, 01, '),
    ],
)
def test_a_notebook_is_known_by_how_it_begins(made, asked, name):
    assert made[1][asked].startswith(name)


def test_the_sheet_of_an_examination_is_printed_without_its_scheme(printed):
    exam = exam_paper("spring, tests")  # as in print_small.py
    sheet, scheme = (printed(f"examination-{exam.mark}-{kind}") for kind in ("sheet", "scheme"))
    on_sheet, on_scheme = (words("".join(texts(document))) for document in (sheet, scheme))
    found = set()
    for question in (*exam.compulsory, *exam.by_choice):
        assert words(question.title) in on_sheet
        assert words(question.title) in on_scheme
        answers = [words(str(a)) for part in question.parts for a in part.answers]
        assert not any(answer in on_sheet for answer in answers)
        found.update(answer for answer in answers if answer in on_scheme)
    assert found  # some, without a formula, stand there as they are written
    assert "Number" in on_sheet
    assert "scheme" not in on_sheet
    assert words(f"Marking scheme of sheet {exam.mark}") in on_scheme
    for document in (sheet, scheme):
        assert_within_the_margins(document)


def test_no_question_of_an_examination_and_no_part_of_its_scheme_goes_on_overleaf(printed):
    exam = exam_paper("spring, tests")
    sheet, scheme = (printed(f"examination-{exam.mark}-{kind}") for kind in ("sheet", "scheme"))
    _, *others = texts(sheet)
    begin = [
        words(f"{number}. {question.title}")
        for number, question in enumerate((*exam.compulsory, *exam.by_choice), 1)
    ]
    head = words("Inertial navigation: a bent triad and its errors")
    assert others
    for page in others:
        assert words(page).removeprefix(head).startswith(tuple(begin))
    for page in texts(scheme)[1:]:
        assert re.match(rf"Marking scheme of sheet {exam.mark}\s+(\([a-c]\)|\d+\.)\s", page)


@pytest.mark.parametrize(
    "arguments",
    [
        ("14",),
        ("instructors/examination",),
        ("--edition", " "),
        ("03", "--edition", "autumn"),
    ],
)
def test_what_cannot_be_printed_is_said_in_one_sentence(site_python, arguments):
    command = [str(site_python), str(ROOT / "site/paper.py"), *arguments]
    done = subprocess.run(command, capture_output=True, encoding="utf-8")
    assert done.returncode == 1
    assert len(done.stderr.splitlines()) == 1
    assert done.stderr.startswith(("edition: ", "--edition ")) or done.stderr[0] in CAPITALS


def test_what_is_printed_is_ignored_by_git():
    assert "/_print\n" in (ROOT / ".gitignore").read_text("utf-8")


def test_letters_that_no_font_has_are_boxes_of_their_width(tmp_path):
    cell = nbformat.v4.new_code_cell("print(report)")
    names = "Ада 王 שיר क़ल Nguyễn\n"
    cell.outputs = [nbformat.v4.new_output("stream", name="stdout", text=names)]
    paper = markdown_of(nbformat.v4.new_notebook(cells=[cell]), "label", tmp_path)
    assert "Ада □  □□□ □□ Nguyễn" in paper


def test_every_notebook_can_be_printed_under_a_heading():
    outside = {name for name in notebooks() if part_of(name) is OUTSIDE}
    assert outside == {"instructors/examination.ipynb"}
    assert all(part_of(name).title for name in notebooks())
