"""The notebooks as pages: figures, panels, exercises, the ledger, and nothing for lecturers."""

import html
import json
import re
from itertools import pairwise
from urllib.parse import unquote

import nbformat
import pytest

from driftlab.book.chapters import chapters_with
from driftlab.book.exercises import all_exercises, hints_of
from driftlab.book.ledger import ledger_entries
from driftlab.book.panels import EXPLORERS, SCENES
from executed import FOLDER, notebooks, published
from pdf.contents import PARTS, chosen
from reading.papers import entry_label, in_the_papers
from reading.parts import chapters
from support import ROOT

pytestmark = pytest.mark.xdist_group("site")
CHAPTERS = [name for name in published() if name[:2].isdigit()]
PANELS = {panel.__name__: panel for panel in (*EXPLORERS, *SCENES)}


@pytest.fixture(scope="module")
def sources() -> dict:
    """The cells of each notebook."""
    return {name: nbformat.read(FOLDER / name, as_version=4).cells for name in published()}


@pytest.fixture(scope="module")
def pages(site) -> dict:
    """The page of each notebook."""
    return {name: (site / name).with_suffix(".html").read_text("utf-8") for name in published()}


def code_of(cells) -> str:
    return "\n".join(cell.source for cell in cells if cell.cell_type == "code")


def attributes(text, tag):
    """The attributes of each such tag of a text."""
    for found in re.findall(rf"<{tag}\b[^>]*>", text):
        pairs = re.findall(r"""([\w-]+)=(?:"([^"]*)"|'([^']*)')""", found)
        yield {key: html.unescape(double or single) for key, double, single in pairs}


def test_every_notebook_is_a_page_with_its_title_and_its_folds(sources, pages):
    assert [f"{row.page}.ipynb" for row in chapters(ROOT)] == CHAPTERS
    for name, cells in sources.items():
        title = next(cell.source for cell in cells if cell.source.startswith("# "))
        shown = re.sub(r"<[^>]*>", "", re.search(r"<h1>(.*?)<a", pages[name])[1])
        assert html.unescape(shown).replace("’", "'") == title.splitlines()[0][2:]
        folded = [cell for cell in cells if cell.metadata.get("jp-MarkdownHeadingCollapsed")]
        if name in CHAPTERS:
            assert pages[name].count('<details class="folded">') == len(folded), name


def test_cells_that_only_check_the_book_are_on_no_page(sources, pages):
    for name, cells in sources.items():
        text = html.unescape(re.sub(r"<[^>]*>", "", pages[name]))
        for cell in cells:
            if cell.metadata.get("jupyter", {}).get("source_hidden"):
                assert cell.source.splitlines()[-1] not in text, cell.id


def test_nothing_is_left_raw(pages):
    for name, text in pages.items():
        seen = text[text.index("<article") : text.index("</article>")]
        seen = re.sub(r"<(script|style|pre|code)\b.*?</\1>", " ", seen, flags=re.S)
        seen = re.sub(r'<(span|div) class="[^"]*\bmath\b.*?</\1>', " ", seen, flags=re.S)
        seen = html.unescape(re.sub(r"<[^>]*>", " ", seen))
        assert re.findall(r"\\[a-zA-Z]+|\$[^$\n]+\$|^\|.*\|$", seen, re.M) == [], name
        assert "widget-view" not in text, name
        assert "data:image" not in text, name


def test_pictures_have_words_and_keep_their_room(pages):
    for name, text in pages.items():
        for found in attributes(text, "img"):
            if "_static/pictures/" in found["src"]:
                assert found["alt"], (name, found)
                assert found["loading"] == "lazy"
                assert int(found["width"]) > 100, (name, found)
                assert int(found["height"]) > 50, (name, found)


def test_figures_of_the_book_lead_to_the_gallery(site, sources, pages):
    gallery = (site / "gallery/index.html").read_text("utf-8")
    for name in CHAPTERS:
        for figure in re.findall(r'\bfigure\("([\w-]+)"\)', code_of(sources[name])):
            assert f'href="gallery/index.html#figure-{figure}"' in pages[name], (name, figure)
            assert f'id="figure-{figure}"' in gallery, figure


def test_every_panel_and_scene_says_its_class_and_values(pages):
    seen = set()
    for name, text in pages.items():
        for found in attributes(text, "figure"):
            if found.get("class") == "driftlab-still":
                panel = PANELS[found["data-panel"]]
                controls = {control.name for control in panel.controls}
                assert json.loads(found["data-values"]).keys() == controls, (name, found)
                seen.add(panel.__name__)
    assert seen == PANELS.keys()


def test_every_exercise_and_puzzle_has_its_room_its_help_and_its_solution(sources, pages):
    for name in CHAPTERS:
        code, page, chapter = code_of(sources[name]), pages[name], name[:2]
        numbers = re.findall(r'^check\("([\d.]+)"', code, re.M)
        for number in numbers:
            room = f'<div class="exercise" data-exercise="{number}"></div>'
            assert page.count(room) == 1, number
            solution = f"solutions/{name[:-6]}.html#solution-{number.replace('.', '-')}"
            assert f'href="{solution}"' in page, number
        if chapter in chapters_with("exercises"):
            assert set(numbers) == set(all_exercises(chapter))
            helping = re.findall(r"section that helps: <a class='[\w ]+' href='#([^']+)'", page)
            assert len(helping) == len(hints_of(chapter))
        guesses = page.count(f'<div class="guess" data-guess="{chapter}">')
        assert guesses == code.count(f'guess("{chapter}")')
    assert pages["16_one_triad.ipynb"].count('<div class="guesses">') == 1


def test_ledger_and_reference_lead_to_each_other(site):
    for entry in ledger_entries():
        page = (site / f"ledger/{entry.paper}.html").read_text("utf-8")
        assert page.count(f'id="{entry_label(entry)}"') == 1
    text = "\n".join(in_the_papers("driftlab.triad.triad_matrix"))
    assert ":ref:`Larin, (2.4) <ledger-larin-2-4>`, *corrected*" in text
    assert in_the_papers("driftlab.vectors.unit") == []


def test_chapters_come_part_by_part_and_lead_on(pages):
    for here, there in pairwise(CHAPTERS):
        following = re.search(r'class="next-page" href="([^"]*)"', pages[here])[1]
        assert unquote(following) == there.replace(".ipynb", ".html")
    page = pages["03_systematic_drift.ipynb"]
    assert "Part I: A misaligned triad" in page
    readme = (ROOT / "README.md").read_text("utf-8")
    minutes = re.search(r"^\| 03 \|.*?\| (\d+) \|", readme, re.M)[1]
    assert f'<p class="ways">{minutes} minutes' in page
    for way in ("live/lab/index.html?path=03_systematic_drift.ipynb", "drift-lab.pdf"):
        assert f'href="{way}"' in page


def test_what_lecturers_keep_for_themselves_is_nowhere(site, pages):
    kept = set(notebooks()) - set(published())
    assert kept == {"instructors/examination.ipynb"}
    assert not any(name in kept for part in PARTS for name in chosen(part, notebooks()))
    assert not [path for path in site.rglob("*examination*") if "_modules" not in path.parts]
    for name, text in pages.items():
        assert not re.search(r'href="[^"]*instructors/', text), name
        assert "exam_paper" not in text, name
