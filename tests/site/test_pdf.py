"""The book as a PDF: all of it, its links, no formula left raw, nothing beyond the page."""

import ctypes
import json
import re
from pathlib import Path

import pypdfium2
import pytest
from pypdfium2 import raw

from pdf.pictures import plain_svg
from support import ROOT

pytestmark = pytest.mark.xdist_group("site-pdf")
FOLDER = ROOT / "notebooks"
NOTEBOOKS = sorted([*FOLDER.glob("[!.]*.ipynb"), *FOLDER.glob("papers/[!.]*.ipynb")])
CODE_FONT = "DejaVuSansMono"
RAW = re.compile(r"\\[a-zA-Z]{2,}|\$\S|</?(?:details|summary|br|div|span|style)\b|&nbsp;")
SIDES = 50, 545
"""Of a page in points, with a little room for what hangs into the margin."""


@pytest.fixture(scope="module")
def book(site):
    return pypdfium2.PdfDocument(site / "drift-lab.pdf")


@pytest.fixture(scope="module")
def pages(book):
    """The text of every page, sign by sign."""
    return [text_of(page.get_textpage()) for page in book]


def text_of(page) -> str:
    signs = range(page.count_chars())
    return "".join(chr(raw.FPDFText_GetUnicode(page, sign)) for sign in signs)


def font_of(page, sign: int) -> str:
    name = ctypes.create_string_buffer(100)
    raw.FPDFText_GetFontInfo(page, sign, name, len(name), ctypes.c_int())
    return name.value.decode()


def links_of(document):
    """Whether each link leads to a place in the document, and its address elsewhere."""
    for page in document:
        place, link = ctypes.c_int(0), raw.FPDF_LINK()
        while raw.FPDFLink_Enumerate(page, place, link):
            if raw.FPDFLink_GetDest(document, link):
                yield True, b""
                continue
            action = raw.FPDFLink_GetAction(link)
            size = raw.FPDFAction_GetURIPath(document, action, None, 0)
            address = ctypes.create_string_buffer(size)
            raw.FPDFAction_GetURIPath(document, action, address, size)
            yield False, address.value


def words(text: str) -> str:
    """Without anything that a new line or a nicer sign may change."""
    return re.sub(r"\W+", "", text)


def cells_of(notebook: Path, kind: str) -> str:
    cells = json.loads(notebook.read_text("utf-8"))["cells"]
    return "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == kind)


def test_every_heading_is_a_bookmark_and_every_link_leads_somewhere(book):
    toc = list(book.get_toc(max_depth=9))
    assert all(mark.get_dest() is not None for mark in toc)
    marks = {words(mark.get_title()) for mark in toc}
    for notebook in [*NOTEBOOKS, *sorted(FOLDER.glob("solutions/*.ipynb"))]:
        for heading in re.findall(r"^#{1,3} (.*)$", cells_of(notebook, "markdown"), re.M):
            if "$" not in heading and heading != "Drift Lab":
                assert words(heading) in marks, (notebook.name, heading)
    assert {"00Starthere", "PartIVFindingNorth", "Errataofthefourpapers"} <= marks
    links = list(links_of(book))
    assert sum(inside for inside, _ in links) > 500
    assert all(inside or address.startswith(b"https://") for inside, address in links)


def test_no_formula_and_no_markup_is_left_raw_and_no_page_is_empty(book, pages):
    """In code all of it may stand; code has a font of its own."""
    for number, text in enumerate(pages):
        assert len(text.strip()) > 40, number + 1
        assert not re.search("[\x00\x01\ufffd]", text), number + 1
        found = list(RAW.finditer(text))
        page = book[number].get_textpage() if found else None
        for match in found:
            assert CODE_FONT in font_of(page, match.start()), (number + 1, match[0])


def test_nothing_is_beyond_the_sides_of_the_page(book):
    for number, page in enumerate(book, 1):
        text = page.get_textpage()
        for place in range(text.count_rects()):
            left, bottom, right, top = text.get_rect(place)
            if not SIDES[0] < left or not right < SIDES[1]:
                pytest.fail(f"{number}: {text.get_text_bounded(left, bottom, right, top)}")


def test_every_figure_has_its_caption_and_nothing_speaks_of_a_screen(pages):
    everything = "".join(pages)
    all_of_it = words(everything)
    gallery = (ROOT / "figures/README.md").read_text("utf-8")
    captions = dict(re.findall(r"^\*\*([\w-]+)\.\*\* (.*)$", gallery, re.M))
    for notebook in NOTEBOOKS:
        for name in re.findall(r'\bfigure\("([\w-]+)"\)', cells_of(notebook, "code")):
            assert words(captions[name]) in all_of_it, name
    for of_a_screen in ("answer=...", "threedots", "Unfoldthe", "isfoldedaway", "foldedsection"):
        assert of_a_screen not in re.sub(r"\s", "", everything), of_a_screen


def test_the_file_says_what_it_is(book, site):
    said = book.get_metadata_dict()
    assert said["Title"].startswith("Drift Lab: ")
    assert said["Author"]
    assert len(book) > 300
    assert (site / "drift-lab.pdf").stat().st_size < 12e6


def test_a_figure_on_paper_asks_for_no_colour_that_only_browsers_mix():
    for path in (ROOT / "figures").glob("*.svg"):
        assert not re.search(r"var\(|color-mix\(", plain_svg(path.read_text("utf-8"))), path
