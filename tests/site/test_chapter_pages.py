"""The notebooks as pages: figures, panels, exercises, places to link to, and what a page weighs."""

import base64
import gzip
import html
import io
import json
import re
from itertools import pairwise
from urllib.parse import unquote

import nbformat
import pytest
from PIL import Image

from driftlab.book.ledger import ledger_entries
from driftlab.book.machinery.card import Card
from driftlab.book.machinery.exercise import Verdict
from driftlab.book.machinery.hints import Help
from driftlab.book.panels import EXPLORERS, SCENES
from executed import FOLDER, notebooks
from reading.outputs import Outputs
from reading.papers import equation_label
from reading.pictures import Pictures, size
from reading.solutions import fold_of, link_back
from support import ROOT

WEIGHT = 50_000
"""Bytes of a page's words, packed as servers send them."""
CHAPTERS = [name for name in notebooks() if name[:2].isdigit()]
PANELS = {panel.__name__: panel for panel in (*EXPLORERS, *SCENES)}
SVG = b'<svg xmlns="http://www.w3.org/2000/svg" width="72pt" height="36pt" viewBox="0 0 72 36"/>'


def sources(name):
    """All lines of code of a notebook, and its words."""
    cells = nbformat.read(FOLDER / name, as_version=4).cells
    return [
        "\n".join(cell.source for cell in cells if cell.cell_type == kind)
        for kind in ("code", "markdown")
    ]


# ------------------------------------------------------------------ outputs


def shown(output, plain="", source="", page="03_systematic_drift"):
    """What a chapter's page has of one HTML output, and its pictures."""
    pictures = Pictures()
    cell = nbformat.v4.new_code_cell(source)
    cell.outputs = [
        nbformat.v4.new_output("display_data", {"text/html": output, "text/plain": plain})
    ]
    (made,) = Outputs(pictures, page, "03").shown(cell)
    return made.data["text/html"], pictures


def inlined(raw, kind):
    return (
        f'<img src="data:image/{kind};base64,{base64.b64encode(raw).decode()}" alt="two &amp; a">'
    )


def test_a_picture_becomes_one_file_however_often_it_is_shown():
    pictures = Pictures()
    twice = pictures.as_files(2 * inlined(SVG, "svg+xml"), "../")
    (name,) = pictures.files
    assert pictures.files[name] == SVG
    assert twice.count(f'src="../_static/pictures/{name}" alt="two &amp; a" loading="lazy"') == 2
    assert name.endswith(".svg")
    assert 'width="96" height="48"' in twice


def test_room_is_kept_for_every_kind_of_picture():
    file = io.BytesIO()
    Image.new("RGB", (30, 20)).save(file, "jpeg")
    assert size(file.getvalue()) == (30, 20)
    assert size(SVG) == (96, 48)
    assert size(b'<svg viewBox="0 0 640 310.5">') == (640, 310)


def test_a_figure_is_a_place_once_and_leads_to_its_numbers():
    figure = (
        f'<figure style="margin: 0">{inlined(SVG, "svg+xml")}<figcaption>x</figcaption></figure>'
    )
    page, _ = shown(figure, "driftlab.figure('03-drift-map')\nx")
    assert page.startswith(
        '<figure class="driftlab-figure" id="fig-03-drift-map"><img src="_static'
    )
    assert 'href="gallery/index.html#figure-03-drift-map"' in page
    changed, _ = shown(figure, "driftlab.figure('03-drift-map', turns=2)\nx")
    assert "id=" not in changed
    assert "gallery" not in changed
    cell = nbformat.v4.new_code_cell()
    data = {"text/html": figure, "text/plain": "driftlab.figure('03-drift-map')\nx"}
    cell.outputs = [nbformat.v4.new_output("display_data", data)] * 2
    first, second = Outputs(Pictures(), "03_systematic_drift", "03").shown(cell)
    assert "id=" in first.data["text/html"]
    assert "id=" not in second.data["text/html"]


def test_an_open_exercise_has_room_its_hints_and_its_solution():
    help_ = Help("Where it stands: (2.4)", "nudge", "idea")
    card = Card("3.2", Verdict(None, "not answered yet."), help_, (), "0 of 6 right")
    page, _ = shown(card._repr_html_())
    assert page.startswith('<div class="exercise" data-exercise="3.2"></div><div class="hints">')
    assert page.endswith(fold_of("3.2", "solutions/03_systematic_drift.html"))
    assert "href='#chapter-03-where-it-stands-2-4'" in page
    assert "nudge" in page
    assert "0 of 6 right" not in page


def test_a_puzzle_has_room_for_a_guess():
    asked = "<p><b>A guess first.</b></p><ul><li>How far?</li></ul>"
    page, _ = shown(f"{asked}<p>Run this cell in JupyterLab.</p>")
    assert page == f'<div class="guess" data-guess="03">{asked}</div>'


def test_what_needs_a_kernel_is_left_out():
    cell = nbformat.v4.new_code_cell()
    data = {"application/vnd.jupyter.widget-view+json": {"model_id": "1"}, "text/plain": "A panel"}
    cell.outputs = [nbformat.v4.new_output("display_data", data)]
    assert Outputs(Pictures(), "03_systematic_drift", "03").shown(cell) == []


def test_a_solution_is_a_place_and_leads_back():
    cell = nbformat.v4.new_markdown_cell("## 3.2 Slide\n\nThe coefficient.")
    link_back([cell], "03")
    assert cell.source == (
        "(solution-3-2)=\n## 3.2 Slide\n\n[To the exercise](#chapter-03-3-2-slide)\n\n"
        "The coefficient."
    )


# ------------------------------------------------------------------ the pages as built


@pytest.fixture(scope="module")
def pages(site):
    """The page of each notebook."""
    return {name: (site / name).with_suffix(".html").read_text("utf-8") for name in notebooks()}


def tags(text, name):
    return re.findall(rf"<{name}\b[^>]*>", text)


def attributes(tag):
    return {
        key: html.unescape(double or single)
        for key, double, single in re.findall(r"""([\w-]+)=(?:"([^"]*)"|'([^']*)')""", tag)
    }


def article(text):
    return text[text.index("<article") : text.index("</article>")]


def words(text):
    """What a reader sees of a page, without formulas and code."""
    text = re.sub(r"<(script|style|pre|code)\b.*?</\1>", " ", article(text), flags=re.S)
    text = re.sub(r'<(span|div) class="[^"]*\bmath\b[^"]*"[^>]*>.*?</\1>', " ", text, flags=re.S)
    return html.unescape(re.sub(r"<[^>]*>", " ", text))


def test_every_notebook_is_a_page_under_its_name(pages):
    assert len(CHAPTERS) == 14
    for name, text in pages.items():
        title = re.search(r"^# (.*)$", sources(name)[1], re.M)[1]
        shown = re.search(r"<h1>(.*?)<a", text)[1]
        assert html.unescape(re.sub(r"<[^>]*>", "", shown)).replace("’", "'") == title


def test_pictures_are_files_with_words_and_room(site, pages):
    for name, text in pages.items():
        assert "data:image" not in text, name
        for tag in tags(article(text), "img"):
            found = attributes(tag)
            if "/pictures/" in found["src"] or found["src"].startswith("_static/pictures/"):
                assert found["alt"], (name, tag)
                assert found["loading"] == "lazy"
                assert int(found["width"]) > 100, (name, tag)
                assert int(found["height"]) > 50, (name, tag)
                assert ((site / name).parent / found["src"]).is_file(), (name, tag)


def test_figures_of_the_book_are_places_that_the_gallery_leads_to(site, pages):
    gallery = (site / "gallery/index.html").read_text("utf-8")
    count = 0
    for name in CHAPTERS:
        for figure in set(re.findall(r'\bfigure\("([\w-]+)"\)', sources(name)[0])):
            assert pages[name].count(f'id="fig-{figure}"') == 1, (name, figure)
            page = name.replace(".ipynb", ".html")
            assert f'href="../{page}#fig-{figure}"' in gallery, (name, figure)
            count += 1
    assert count > 50


def test_every_panel_and_scene_says_its_class_and_values(pages):
    seen = set()
    for name, text in pages.items():
        for tag in tags(text, "figure"):
            found = attributes(tag)
            if found.get("class") == "driftlab-still":
                panel = PANELS[found["data-panel"]]
                controls = {control.name for control in panel.controls}
                assert json.loads(found["data-values"]).keys() == controls, (name, tag)
                seen.add(found["data-panel"])
    assert seen == PANELS.keys()


def test_every_exercise_and_puzzle_has_its_room(pages):
    for name in CHAPTERS:
        code = sources(name)[0]
        for number in re.findall(r'^check\("([\d.]+)"', code, re.M):
            room = f'<div class="exercise" data-exercise="{number}"></div>'
            assert pages[name].count(room) == 1, number
            fold = f'href="solutions/{name.replace(".ipynb", ".html")}#solution-'
            assert f'{fold}{number.replace(".", "-")}"' in pages[name], number
        assert pages[name].count(f'<div class="guess" data-guess="{name[:2]}">') == code.count(
            f'guess("{name[:2]}")'
        )
    assert pages["11_one_triad.ipynb"].count('<div class="guesses">') == 1


def test_every_numbered_equation_has_its_place_and_the_ledger_leads_there(site, pages):
    for entry in ledger_entries():
        if label := equation_label(entry):
            (name,) = (name for name in CHAPTERS if name.startswith(entry.chapter))
            assert pages[name].count(f'id="{label}"') == 1, label
            page = (site / f"ledger/{entry.paper}.html").read_text("utf-8")
            assert f'href="../{name.replace(".ipynb", ".html")}#{label}"' in page, label


def test_what_jupyterlab_folds_is_folded(pages):
    for name in CHAPTERS:
        cells = nbformat.read(FOLDER / name, as_version=4).cells
        folded = [cell for cell in cells if cell.metadata.get("jp-MarkdownHeadingCollapsed")]
        assert pages[name].count('<details class="folded">') == len(folded), name


def test_nothing_is_left_raw(pages):
    for name, text in pages.items():
        seen = words(text)
        assert re.findall(r"\\[a-zA-Z]+|\$[^$\n]+\$", seen) == [], name
        assert re.findall(r"\|\s*-{3}|^\|.*\|$", seen, re.M) == [], name
        assert "widget-view" not in text, name


def test_the_words_of_a_page_weigh_little(site):
    for path in sorted(site.rglob("*.html")):
        text = path.read_text("utf-8")
        if "<article" in text:
            plain = html.unescape(re.sub(r"<[^>]*>", "", article(text)))
            assert len(gzip.compress(plain.encode())) < WEIGHT, path.relative_to(site)


def test_chapters_come_part_by_part_and_lead_on(pages):
    for here, there in pairwise(CHAPTERS):
        following = re.search(r'class="next-page" href="([^"]*)"', pages[here])[1]
        assert unquote(following) == there.replace(".ipynb", ".html")
    side = pages["03_systematic_drift.ipynb"]
    assert "Part I: Larin" in side
    readme = (ROOT / "README.md").read_text("utf-8")
    minutes = re.search(r"^\| 03 \|.*?\| (\d+) \|", readme, re.M)[1]
    assert f'<p class="ways">{minutes} minutes' in side


# ------------------------------------------------------------------ in a browser


@pytest.mark.browser
@pytest.mark.xdist_group("site-chapters")
def test_a_solution_comes_into_the_chapter_when_it_is_unfolded(address, page):
    page.goto(f"{address}/03_systematic_drift.html")
    fold = page.locator("details.solution").nth(1)
    fold.locator("summary").click()
    fold.get_by_text("all nine sliders matter").wait_for()
    fold.locator("mjx-container").first.wait_for()
    assert fold.locator("h2").count() == 0
    assert page.locator("details.solution mjx-container").count() > 0
    assert page.complaints == []


@pytest.mark.browser
@pytest.mark.xdist_group("site-chapters")
def test_from_a_disk_the_fold_leads_to_the_solution(site, page):
    page.goto((site / "03_systematic_drift.html").as_uri())
    fold = page.locator("details.solution").first
    fold.locator("summary").click()
    fold.locator("a").click()
    page.wait_for_url("**/solutions/03_systematic_drift.html#solution-3-1")
    assert page.complaints == []


@pytest.mark.browser
@pytest.mark.xdist_group("site-chapters")
def test_a_link_into_a_folded_section_unfolds_it(site, page):
    page.goto((site / "05_cayley_and_riccati.html").as_uri() + "#chapter-05-the-matrix-of-1-6")
    page.locator("h4", has_text="The matrix of (1.6)").wait_for(state="visible")
    assert page.locator("details.folded[open]").count() == 1


@pytest.mark.browser
@pytest.mark.xdist_group("site-chapters")
@pytest.mark.parametrize(
    ("said", "title"),
    [
        ("systematic drift", "03 The systematic drift"),
        ("seaway", "03 The systematic drift"),
        ("count by their area", "Small motions count by their area"),
        ("no ballistic error", "No ballistic error"),
    ],
)
def test_the_search_finds_chapters_and_their_sections(site, page, said, title):
    page.goto((site / "search.html").as_uri() + f"?q={said}")
    page.locator("ul.search li").first.wait_for()
    page.wait_for_function("document.querySelector('p.search-summary')?.textContent.includes('.')")
    found = page.locator("ul.search li").all_inner_texts()[:8]
    assert any(title in text for text in found), found
