"""The book as a PDF: all of it, its links, no formula left raw, nothing beyond the page."""

import ctypes
import json
import re
from pathlib import Path

import pypdfium2
import pytest
from pypdfium2 import raw

from pdf.cells import said, tight
from pdf.formulas import readable
from pdf.pictures import HIGHEST, WIDEST, narrowed, paper_width, plain_svg
from pdf.tables import LINE, fitted
from support import ROOT

in_the_site = pytest.mark.xdist_group("site-pdf")
NOTEBOOKS = sorted((ROOT / "notebooks").glob("[!.]*.ipynb"))
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


def words(text: str) -> str:
    """Without anything that a new line or a nicer sign may change."""
    return re.sub(r"\W+", "", text)


def headings(notebook: Path) -> list[str]:
    cells = json.loads(notebook.read_text("utf-8"))["cells"]
    text = "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "markdown")
    return re.findall(r"^#{1,3} (.*)$", text, re.M)


@in_the_site
def test_every_heading_of_every_notebook_is_a_bookmark(book):
    marks = {words(mark.get_title()) for mark in book.get_toc(max_depth=9)}
    for notebook in [*NOTEBOOKS, *sorted((ROOT / "notebooks/solutions").glob("*.ipynb"))]:
        for heading in headings(notebook):
            if "$" not in heading and heading != "Drift Lab":
                assert words(heading) in marks, (notebook.name, heading)
    assert {"00Starthere", "PartIVFromthedrifttotheheading", "Errataofthefourpapers"} <= marks


@in_the_site
def test_every_bookmark_and_every_link_leads_somewhere(book):
    for mark in book.get_toc(max_depth=9):
        assert mark.get_dest() is not None, mark.get_title()
    inside = outside = 0
    for page in book:
        place, link = ctypes.c_int(0), raw.FPDF_LINK()
        while raw.FPDFLink_Enumerate(page, place, link):
            if raw.FPDFLink_GetDest(book, link):
                inside += 1
                continue
            size = raw.FPDFAction_GetURIPath(book, raw.FPDFLink_GetAction(link), None, 0)
            address = ctypes.create_string_buffer(size)
            raw.FPDFAction_GetURIPath(book, raw.FPDFLink_GetAction(link), address, size)
            assert address.value.startswith(b"https://"), address.value
            outside += 1
    assert inside > 500
    assert outside > 10


@in_the_site
def test_no_formula_and_no_markup_is_left_raw(book, pages):
    """In code all of it may stand; code has a font of its own."""
    for number, text in enumerate(pages):
        found = list(RAW.finditer(text))
        page = book[number].get_textpage() if found else None
        for match in found:
            assert CODE_FONT in font_of(page, match.start()), (number + 1, match[0])


@in_the_site
def test_nothing_is_beyond_the_sides_of_the_page(book):
    for number, page in enumerate(book, 1):
        text = page.get_textpage()
        for place in range(text.count_rects()):
            left, _, right, _ = text.get_rect(place)
            assert SIDES[0] < left, (number, text.get_text_bounded(left, *text.get_rect(place)[1:]))
            assert right < SIDES[1], (number, text.get_text_bounded(*text.get_rect(place)))


@in_the_site
def test_every_figure_that_the_book_shows_has_its_caption(pages):
    all_of_it = words("".join(pages))
    gallery = (ROOT / "figures/README.md").read_text("utf-8")
    captions = dict(re.findall(r"^\*\*([\w-]+)\.\*\* (.*)$", gallery, re.M))
    shown = 0
    for notebook in NOTEBOOKS:
        for cell in json.loads(notebook.read_text("utf-8"))["cells"]:
            if cell["cell_type"] == "code":
                for name in re.findall(r'\bfigure\("([\w-]+)"\)', "".join(cell["source"])):
                    assert words(captions[name]) in all_of_it, name
                    shown += 1
    assert shown > 40


@in_the_site
def test_no_page_is_empty_and_each_sign_is_drawn(pages):
    for number, text in enumerate(pages, 1):
        assert len(text.strip()) > 40, number
        assert not re.search("[\x00\x01\ufffd]", text), number


@in_the_site
def test_the_file_says_what_it_is(book, site):
    said = book.get_metadata_dict()
    assert said["Title"].startswith("Drift Lab: ")
    assert said["Author"]
    assert len(book) > 300
    assert (site / "drift-lab.pdf").stat().st_size < 10e6


@pytest.mark.parametrize(
    ("tex", "read"),
    [
        (r"k_{\rm package}", r"k_{\mathrm{package}}"),
        (r"C^{\sf T}", r"C^{\mathsf{T}}"),
        (r"2s\,{\rm tilt}", r"2s\,{\mathrm{tilt}}"),
        (r"|\omega| - |\hat\omega|", r"\left|\omega\right|  - \left|\hat\omega\right| "),
        (r"\vert a\vert", r"\left| a\right| "),
        (r"\frac{|a|}{b}|c|", r"\frac{\left|a\right| }{b}\left|c\right| "),
        (r"P(a | b)", r"P(a | b)"),
        (r"\Big|_{s=0}", r"\Big|_{s=0}"),
        (r"a \tag{2.1}", r"a \qquad (\text{2.1})"),
    ],
)
def test_formulas_become_what_pandoc_reads(tex, read):
    assert readable(tex) == read


def test_formulas_of_outputs_lose_the_blanks_that_hide_them():
    assert tight("the rate $t/\\vert a\\vert $; `$ code $`") == (
        "the rate $t/\\vert a\\vert$; `$ code $`"
    )


def test_pictures_lose_variables_and_the_dark_theme():
    text = ".a { --ink: #111; } .driftlab-dark .a { --ink: #eee; } path { fill: var(--ink); }"
    assert "fill: #111" in plain_svg(text)
    assert "#eee" not in plain_svg(text)


SCENE = """<svg class="dl-scene" viewBox="0 0 1066 330" width="1066" height="330">
<rect width="1066" height="330"/>
<svg x="0" y="20" width="310" height="310"/><svg x="318" y="20" width="310" height="310"/>
<svg class="dl-plot" x="636" y="0" width="400" height="140"><text x="40" y="13">a</text></svg>
<text x="680" y="170">b</text></svg>"""


def test_a_wide_scene_has_its_plots_below_its_views():
    narrow = narrowed(SCENE)
    assert 'viewBox="0 0 628 510" width="628" height="510"' in narrow
    assert '<rect width="628" height="510"' in narrow
    assert 'class="dl-plot" x="8" y="330" width="400" height="140"><text x="40" y="13">' in narrow
    assert '<text x="52" y="500">b' in narrow
    assert narrowed(narrow) == narrow


def test_a_picture_is_as_wide_as_the_text_if_it_is_not_too_high():
    assert paper_width(b'<svg viewBox="0 0 900 300">') == WIDEST
    assert paper_width(b'<svg width="900pt" viewBox="0 0 900 900">') == WIDEST
    assert paper_width(b'<svg width="900pt" viewBox="0 0 900 1800">') == HIGHEST / 2


@in_the_site
def test_paper_does_not_say_what_only_a_screen_does(pages):
    everything = "".join(pages)
    for of_a_screen in ("answer=...", "threedots", "Unfoldthe", "isfoldedaway", "foldedsection"):
        assert of_a_screen not in re.sub(r"\s", "", everything), of_a_screen
    assert said("Unfold the section below to compare") == "Read the section below to compare"


def table(*rows: tuple[str, ...]) -> list:
    """A table as pandoc has it."""
    lines = [
        [None, [[None, None, 1, 1, [{"t": "Plain", "c": words_of(cell)}]] for cell in row]]
        for row in rows
    ]
    columns = [["AlignDefault", {"t": "ColWidthDefault"}] for _ in rows[0]]
    return [None, None, columns, [None, lines[:1]], [[None, 0, [], lines[1:]]], None]


def words_of(cell: str) -> list:
    parts = [[{"t": "Str", "c": word}, {"t": "Space"}] for word in cell.split()]
    return [each for part in parts for each in part][:-1]


def test_a_wide_table_gets_widths_and_a_narrow_one_keeps_its_own():
    narrow, wide = table(("a", "b"), ("1", "2")), table(("a", "b"), ("long words " * LINE, "short"))
    fitted(narrow)
    assert all(width["t"] == "ColWidthDefault" for _, width in narrow[2])
    fitted(wide)
    (first, second) = (width["c"] for _, width in wide[2])
    assert first + second == pytest.approx(1, abs=1e-3)
    assert first > 5 * second


def test_type_gets_smaller_where_many_long_words_stand_side_by_side():
    row = ("a" * (LINE // 8),) * 8
    assert fitted(table(row, row)) < fitted(table(("a", "b"), ("1", "2")))


@pytest.mark.parametrize("path", sorted((ROOT / "figures").glob("*.svg")), ids=lambda p: p.stem)
def test_a_figure_on_paper_asks_for_no_colour_that_only_browsers_mix(path):
    plain = plain_svg(path.read_text("utf-8"))
    assert "var(" not in plain
    assert "color-mix(" not in plain
